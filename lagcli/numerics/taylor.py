"""Power series: any order, any precision.

The series of q at the beginning of a step is found by putting the coefficients known so
far into the equations of motion, which gives the next one (the next two where q'' does not
depend on q').  The order follows from the tolerance, p = 1 - log(tolerance)/2, and the step
from the last coefficients, so that the rest of the series is below the tolerance: several
of them, since by symmetry one or two may vanish (a pendulum released at exactly 90°).

Explicit, dense output of the same order for nothing, some p passes a step.

References
----------
Jorba, Zou, "A software package for the numerical integration of ODEs by means of
high-order Taylor methods", Experimental Mathematics 14 (2005), sections 2 and 3.
Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE
Trans. Comput. 66 (2017): here the radii are dropped after each coefficient, the bound on
the error is measured as for any other method.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from lagcli.numerics.motion import Motion
from lagcli.numerics.steps import CannotGoOn, Step, Tolerance
from lagcli.numerics.surface import Surface

_LOWEST = 8
_LOOKED_AT = 4  # coefficients, for the length of the step
_SAFETY = 0.9
_FIRST = 1e-3  # of the longest step
_SHORTEST = 4e-16


class Taylor:
    """The steps of one run.

    Parameters
    ----------
    motion
        In balls.
    surface
        The constraints, or None.
    """

    name = "taylor"

    def __init__(self, motion: Motion, surface: Surface | None) -> None:
        from flint import arb, arb_series, ctx

        self.motion, self.surface, self.n = motion, surface, motion.n
        self.evaluations = 0
        self.reached: int | None = None
        self._ball, self._series, self._context = arb, arb_series, ctx
        mask = 0
        for v in motion.equations.qdot:
            mask |= v.mask
        nodes = [*(entry for row in motion.equations.mass for entry in row)]
        nodes += [*motion.equations.forcing, *motion.equations.bias]
        #: how many coefficients one pass gives
        self._gain = 1 if any(node.mask & mask for node in nodes) else 2

    def steps(
        self,
        q: list[Any],
        v: list[Any],
        until: float,
        tolerance: Tolerance,
        begin: float = 0.0,
    ) -> Iterator[Step]:
        """Accepted steps from `begin` to `until`.

        Raises
        ------
        CannotGoOn
            Where the series has no radius of convergence left.
        """
        t, order = begin, order_for(tolerance.value)
        while t < until:
            series = self._coefficients(t, q, v, order)
            self._see(series, tolerance)
            h = min(self._length(series, tolerance), tolerance.longest)
            if not h > _SHORTEST * max(t, 1e-3 * until):
                raise CannotGoOn(t, q, v, "")
            end = until if t + 1.01 * h >= until else t + h
            inside = self._inside(t, series)
            q, v, _ = inside(end)
            if self.surface is not None:
                q, v = self.surface.project(end, q, v)
            q, v = [x.mid() for x in q], [x.mid() for x in v]
            yield Step(t, end - t, end, q, v, inside)
            t = end

    def _coefficients(
        self, t: float, q: Sequence[Any], v: Sequence[Any], order: int
    ) -> list[list[Any]]:
        """The series of each coordinate up to the order."""
        series, context = self._series, self._context
        x = [[position, velocity] for position, velocity in zip(q, v, strict=True)]
        usual = context.cap
        try:
            while len(x[0]) <= order:
                known = len(x[0]) - (2 - self._gain)
                context.cap = known
                places = [series(c[:known]) for c in x]
                rates = [series([k * c[k] for k in range(1, known + 1) if k < len(c)]) for c in x]
                try:
                    found = self.motion.accelerations(series([t, 1]), *places, *rates)
                except (ZeroDivisionError, ValueError):
                    raise CannotGoOn(t, q, v, "something is divided by 0") from None
                self.evaluations += 1
                for c, a in zip(x, found, strict=True):
                    for k in range(len(c) - 2, known):
                        value = a[k] if isinstance(a, series) else a if k == 0 else 0
                        c.append(self._ball(value).mid() / ((k + 1) * (k + 2)))
                    if not c[-1].is_finite():
                        raise CannotGoOn(t, q, v, "something is not defined")
        finally:
            context.cap = usual
        return x

    def _see(self, series: list[list[Any]], tolerance: Tolerance) -> None:
        """Tell the scales where it is and, for what begins at 0, where it goes at first."""
        h = _FIRST * tolerance.longest
        low = [[float(x) for x in c[:4]] for c in series]
        change = [c[1] * h + c[2] * h * h for c in low]
        change += [2 * c[2] * h + 3 * c[3] * h * h for c in low]
        tolerance.see([c[0] for c in low], [c[1] for c in low], change)

    def _length(self, series: list[list[Any]], tolerance: Tolerance) -> float:
        """The step after which the last terms are the tolerance times the scale."""
        h, n = math.inf, self.n
        for j, c in enumerate(series):
            for k in range(len(c) - _LOOKED_AT, len(c)):
                size = abs(float(c[k]))
                if size > 0:
                    room = tolerance.value * tolerance.scales[j] / size
                    h = min(h, room ** (1 / k))
                    room = tolerance.value * tolerance.scales[n + j] / (k * size)
                    h = min(h, room ** (1 / (k - 1)))
        return _SAFETY * h

    def _inside(self, start: float, series: list[list[Any]]) -> Any:
        """Positions, velocities and accelerations anywhere in the step."""
        ball = self._ball

        def at(t: float) -> tuple[list[Any], list[Any], list[Any]]:
            h = ball(t) - ball(start)
            q, v, a = [], [], []
            for c in series:
                x = u = b = ball(0)
                for coefficient in reversed(c):
                    b = b * h + u * 2
                    u = u * h + x
                    x = x * h + coefficient
                q.append(x.mid())
                v.append(u.mid())
                a.append(b.mid())
            return q, v, a

        return at


def order_for(tolerance: float) -> int:
    """The order at which a step costs least for its length."""
    return max(_LOWEST, math.ceil(1 - math.log(tolerance) / 2))
