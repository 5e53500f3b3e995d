"""How much of a step passes over nothing, for methods whose steps come without series.

The cubics through the states at both ends of a step, put into what may be narrow, give a series;
for that the rules are those of `compiled.unseen`, which need no more of it than its size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from lagcli.graph.nodes import mask_of
from lagcli.numerics.compiled.layout import DIVIDES, JUMPS
from lagcli.numerics.compiled.narrow import Narrow, narrow_parts
from lagcli.numerics.compiled.unseen import ATTEMPTS, SHORTER, is_seen
from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.numerics.integrators.steps import (
    CannotGoOn,
    Method,
    NotPossible,
    Step,
    Stretch,
    Tolerance,
)

#: Of the series.
_TERMS = 8
#: Of the time that has passed, or of a thousandth of the span.
_SHORTEST = 4e-16
#: Where a step must be shorter than this part, steps of one length are too many.
_NARROW = 0.01


class Sight:
    """What may be passed over of one motion.

    Parameters
    ----------
    motion
        Its equations and what is looked at beside them.
    """

    def __init__(self, motion: Motion) -> None:
        self._watched = _narrow(motion)
        self.motion = motion
        self._balls: Balls | None = None

    def part(self, step: Step, q: Sequence[Any], v: Sequence[Any]) -> float:
        """The part of a step from a state that passes over nothing: 1, or less."""
        if not self._watched:
            return 1.0
        part = 1.0
        try:
            rows = self._series(step, q, v)
        except (ArithmeticError, ValueError):
            return SHORTER
        for _ in range(ATTEMPTS):
            if all(self._is_clear(each, rows, part) for each in self._watched):
                break
            part *= SHORTER
        return part

    def _is_clear(self, each: Narrow, rows: dict[Any, list[float]], part: float) -> bool:
        c = rows[each.argument]
        whole = c if each.whole is None else rows[each.whole]
        power = int(each.whole is not None) if each.kind == DIVIDES else each.power
        return bool(is_seen(each.kind, c, whole, power, len(c) - 1, part))

    def _series(self, step: Step, q: Sequence[Any], v: Sequence[Any]) -> dict[Any, list[float]]:
        """The coefficients of what is watched, in powers of the part of the step."""
        from flint import arb, arb_series, ctx

        ends = zip(q, v, step.q, step.v, strict=True)
        # 1 - v² of a v next to 1 is nothing in doubles
        cubics = [_cubic(arb(step.h), *map(arb, each)) for each in ends]
        columns = [arb_series(c) for c in cubics]
        if isinstance(v[0], float):
            columns += [arb_series([k * c[k] / step.h for k in (1, 2, 3)]) for c in cubics]
        else:  # the error of x over a short step is more than 1 - v² of a v next to 1
            pairs = (tuple(map(arb, pair)) for pair in zip(v, step.v, strict=True))
            columns += [arb_series([u, end - u]) for u, end in pairs]
        usual, ctx.cap = ctx.cap, _TERMS
        try:
            found = self._function(arb_series([step.start, step.h]), *columns)
        finally:
            ctx.cap = usual
        nodes = [node for each in self._watched for node in each.nodes]
        return {
            node: [_size(value, k) for k in range(_TERMS)]
            for node, value in zip(nodes, found, strict=True)
        }

    @property
    def _function(self) -> Any:
        motion = self.motion
        if self._balls is None:
            self._balls = Balls()
            ball = self._balls.ball
            constants = {symbol: ball(x) for symbol, x in motion.constants.items()}
            nodes = [node for each in self._watched for node in each.nodes]
            self._made = straight_line(motion.equations.state, nodes, constants, self._balls)
        return self._made


def _narrow(motion: Motion) -> list[Narrow]:
    equations = motion.equations
    mask = mask_of(equations.state)
    nodes = [*equations.dynamics, *motion.looked_at]
    found = narrow_parts(equations.graph, nodes, mask, turning=True)
    known = mask | mask_of(motion.constants)
    return [
        each
        for each in found  # a sign is looked at as every step is made
        if each.kind != JUMPS and not any(node.mask & ~known for node in each.nodes)
    ]


def _cubic(h: Any, x: Any, u: Any, end_x: Any, end_u: Any) -> list[Any]:
    """Hermite's, in powers of the part of the step."""
    d, first, last = end_x - x, h * u, h * end_u
    return [x, first, 3 * d - 2 * first - last, first + last - 2 * d]


def _size(value: Any, k: int) -> float:
    from flint import arb_series

    if not isinstance(value, arb_series):
        return float(value) if k == 0 else 0.0
    return float(value[k])


def seen_steps(
    method: Method,
    sight: Sight,
    stretch: Stretch,
    tolerance: Tolerance,
    shortened: Callable[[], None],
) -> Iterator[Step]:
    """The steps of a method, none of which passes over anything.

    Parameters
    ----------
    method, sight
        Of one motion.
    stretch, tolerance
        As for the method.
    shortened
        Called where a step is made again, shorter.

    Raises
    ------
    CannotGoOn
        Where no step is short enough.
    NotPossible
        Where steps of one length would have to be shorter by far.
    """
    (q, v, until, t), longest = stretch, tolerance.longest
    while t < until:
        for step in method.steps(Stretch(q, v, until, t), tolerance):
            part = sight.part(step, q, v)
            if part < 1:
                shortened()
                if part < _NARROW and method.even:
                    raise NotPossible("steps of one length pass over what is narrow")
                tolerance.longest = step.h * part
                if not tolerance.longest > _SHORTEST * max(t, 1e-3 * until):
                    raise CannotGoOn(t, q, v, "")
                break
            q, v, t = step.q, step.v, step.end
            yield step
            if tolerance.longest < longest:
                tolerance.longest = min(longest, 2 * tolerance.longest)
                if not sight.motion.kinks:  # of which the method knows the last
                    break
        else:  # at the end, or where friction has stopped the steps
            break
    tolerance.longest = longest
