"""DOP853: the explicit Runge-Kutta method of order 8 of Dormand and Prince.

Order 8, error estimates of order 5 and 3 combined into one of order 7, dense output of
order 7; 12 evaluations a step, 3 more where the inside of a step is asked for.  Not for
stiff problems: the step is bound by the fastest rate, about 6 over it.

The step is generated for the number of coordinates and uses q' as the rate of q, so that
an evaluation is that of q'' alone.

References
----------
Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., sections II.5
(the method), II.6 (dense output) and II.4 (step control).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import told
from lagcli.numerics.equations.straight_line import run_generated
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.steps import (
    DEPENDENT,
    SINGULAR_MASS,
    CannotGoOn,
    Method,
    MotionOfMode,
    Step,
    StepSize,
    Stretch,
    Tolerance,
)
from lagcli.numerics.integrators.switching import Kinks
from lagcli.numerics.integrators.tableau_853 import DENSE, ERROR_3, ERROR_5, NODES, STAGES, Row

ORDER = 8
State = tuple[float, list[float], list[float]]
_END = 13  # the stage at the end of the step
_LAST = 16
_FIRST = 1e-4  # of the longest step, for the first
#: So many steps that cover less than this part of the span are looked at: where a pivot of the
#: mass matrix has lost so much they are steps of its rounding.
_CRAWLS, _NOWHERE, _SINGULAR = 128, 1e-4, 1e-8


class Dop853:
    """The steps of one run.

    Parameters
    ----------
    motion
        In doubles.
    surface
        The constraints, or None.
    generated
        What `generated_step` has made for the same motion before.
    """

    name = "dop853"
    sees = even = False

    def __init__(
        self, motion: Motion, surface: Surface | None, generated: tuple[Any, Any] | None = None
    ) -> None:
        self.motion, self.surface, self.n = motion, surface, motion.n
        self.evaluations = 0
        self.rejected = 0
        self.reached: int | None = None
        self.generated = generated or generated_step(motion.n, motion.accelerations)
        self._step, self._dense = self.generated

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Accepted steps to the end, or to where friction sticks (`reached`).

        Raises
        ------
        CannotGoOn
            Where the step becomes shorter than rounding, with the reason.
        """
        q, v, until, t = stretch
        n = self.n
        motion, kinks = self.motion, Kinks(self.motion, tolerance)
        self.reached = None
        if motion.kinks:
            kinks.begin(t, q, v)
        rate = self._rate(t, q, v)
        size = StepSize(tolerance.first_step(stretch, rate, _FIRST), ORDER, until)
        lost = [0.0] * (2 * n)  # what rounding takes from the sums (Kahan)
        attempts, since, start_of_all = 0, t, (t, q, v)
        while t < until:
            attempts += 1
            if attempts % _CRAWLS == 0:
                if t - since < _NOWHERE * until:
                    self._look_at_pivots(start_of_all, (t, q, v))
                since = t
            h, last = size.from_time(t)
            reason = ""
            try:
                change, end, five, three, stages = self._step(t, h, q, v, rate)
                tolerance.see(q, v, change)
                error = self._error(h, five, three, tolerance)
                if error <= 1:
                    end_q, end_v, left = added(q, v, change, lost)
                    if self.surface is not None:
                        end_q, end_v = self.surface.project(t + h, end_q, end_v)
                        next_rate = self._rate(t + h, end_q, end_v)
                    else:
                        next_rate = end
            except (ArithmeticError, ValueError) as failure:
                error, reason = math.inf, told(failure)
            self.evaluations += 12
            if not error <= 1:
                self.rejected += 1
                if size.is_nothing(error, t):
                    raise CannotGoOn(t, q, v, reason)
                if error < math.inf:
                    tolerance.rejected(five)
                tolerance.forget()
                continue
            tolerance.accepted()
            previous = (q, v, rate)
            inside = self._inside(t, h, previous, change, end, stages)
            if motion.kinks:
                shorter = kinks.first(t, h, end_q, end_v, inside)
                if shorter is not None:  # the step is made again, up to the kink
                    size.h = shorter
                    if kinks.stuck(t + shorter, until):
                        raise CannotGoOn(t, q, v, kinks.why())
                    continue
            start = t
            t = until if last else t + h
            q, v, rate = end_q, end_v, next_rate
            lost = left
            yield Step(start, h, t, q, v, inside)
            if kinks.reached is not None:
                if kinks.sticks(t, q, v):
                    self.reached = kinks.reached
                    return
                v = kinks.pass_through(t, q, v)
                rate = self._rate(t, q, v)
            size.grow(error, tolerance.longest)

    def _look_at_pivots(self, first: State, here: State) -> None:
        """End where a pivot has vanished, beside which steps are those of rounding."""
        (mass, held), (t, q, v), (t_0, q_0, v_0) = self.motion.pivots, here, first
        whole = mass(t, *q, *v)
        if any(abs(x) < _SINGULAR * abs(y) for x, y in zip(whole[::2], whole[1::2], strict=True)):
            raise CannotGoOn(*here, SINGULAR_MASS)
        both = zip(held(t, *q, *v)[::2], held(t_0, *q_0, *v_0)[::2], strict=True)
        if any(abs(x) < _SINGULAR * abs(y) for x, y in both):
            raise CannotGoOn(*here, DEPENDENT)

    def _rate(self, t: float, q: Sequence[float], v: Sequence[float]) -> tuple[float, ...]:
        self.evaluations += 1
        return self.motion.accelerations(t, *q, *v)

    def _error(
        self, h: float, five: Sequence[float], three: Sequence[float], tolerance: Tolerance
    ) -> float:
        """The error in units of the tolerance: e5^2 / sqrt(e5^2 + e3^2/100)."""
        a = b = 0.0
        for x, y, scale in zip(five, three, tolerance.scales, strict=True):
            a += (x / scale) ** 2
            b += (y / scale) ** 2
        if not (a < math.inf and b < math.inf):
            return math.inf
        if a == 0.0:
            return 0.0
        return h * a / math.sqrt((a + 0.01 * b) * len(five)) / tolerance.value

    def _inside(
        self,
        t: float,
        h: float,
        start: tuple[list[float], list[float], Sequence[float]],
        change: Sequence[float],
        end: Sequence[float],
        stages: Any,
    ) -> Callable[[float], tuple[list[float], list[float], list[float]]]:
        """Positions, velocities and rates of the velocities by the dense output."""
        q, v, rate = start
        polynomials: list[list[float]] = []

        def at(time: float) -> tuple[list[float], list[float], list[float]]:
            if not polynomials:
                self.evaluations += 3
                polynomials.extend(self._dense(t, h, q, v, rate, change, end, stages))
            x = (time - t) / h
            values, slopes = zip(*(_interpolated(p, x) for p in polynomials), strict=True)
            n = self.n
            return (
                [a + b for a, b in zip(q, values[:n], strict=True)],
                [a + b for a, b in zip(v, values[n:], strict=True)],
                [s / h for s in slopes[n:]],
            )

        return at


def _interpolated(coefficients: Sequence[float], x: float) -> tuple[float, float]:
    """x (c1 + (1 - x)(c2 + x (c3 + …))) and its slope."""
    value = slope = 0.0
    for place in range(len(coefficients) - 1, -1, -1):
        value += coefficients[place]
        if place % 2 == 0:
            slope = slope * x + value
            value *= x
        else:
            slope = slope * (1 - x) - value
            value *= 1 - x
    return value, slope


def added(
    q: Sequence[float], v: Sequence[float], change: Sequence[float], lost: Sequence[float]
) -> tuple[list[float], list[float], list[float]]:
    """State + change, and what the rounding of the sums has taken."""
    total, left = [], []
    for x, d, e in zip((*q, *v), change, lost, strict=True):
        d += e
        s = x + d
        total.append(s)
        left.append(d - (s - x) if abs(x) >= abs(d) else x - (s - d))
    n = len(q)
    return total[:n], total[n:], left


def dop853(mode: MotionOfMode, surface: Surface | None) -> Method:
    """The method of a mode."""
    if mode.generated is None:
        mode.generated = generated_step(mode.motion.n, mode.motion.accelerations)
    return Dop853(mode.motion, surface, mode.generated)


def generated_step(n: int, accelerations: Callable[..., Any]) -> tuple[Any, Any]:
    """The functions `step` and `dense` for n coordinates."""
    each = range(n)

    def names(letter: str, stage: int) -> list[str]:
        return [f"{letter}{stage}_{j}" for j in each]

    def sums(row: Row, letter: str, j: int) -> str:
        return " + ".join(f"{a!r}*{letter}{k}_{j}" for k, a in row.items())

    def stage(number: int) -> list[str]:
        """Velocities u, positions x and accelerations b of a stage."""
        row = STAGES[number]
        lines = [f"u{number}_{j} = v{j} + h*({sums(row, 'b', j)})" for j in each]
        places = ", ".join(f"q{j} + h*({sums(row, 'u', j)})" for j in each)
        call = f"f(t + {NODES[number]!r}*h, {places}, {', '.join(names('u', number))})"
        return [*lines, f"{_tuple(names('b', number))} = {call}"]

    q, v = [f"q{j}" for j in each], [f"v{j}" for j in each]
    head = [
        f"{_tuple(q)} = q", f"{_tuple(v)} = v", f"{_tuple(names('u', 1))} = v",
        f"{_tuple(names('b', 1))} = b",
    ]  # fmt: skip
    kept = [k for k in range(2, _END) if k in STAGES[14] or k in STAGES[15] or k in DENSE[0]]
    inner = [name for k in kept for letter in "ub" for name in names(letter, k)]
    both = [(letter, j) for letter in "ub" for j in each]
    end = STAGES[_END]
    change = [f"d{j}" for j in each] + [f"e{j}" for j in each]
    ahead = ", ".join([f"q{j} + d{j}" for j in each] + [f"v{j} + e{j}" for j in each])
    estimates = ", ".join(
        _tuple([sums(row, letter, j) for letter, j in both]) for row in (ERROR_5, ERROR_3)
    )
    step = [
        "def step(t, h, q, v, b):",
        *head,
        *(line for k in range(2, _END) for line in stage(k)),
        *(f"d{j} = h*({sums(end, 'u', j)})" for j in each),
        *(f"e{j} = h*({sums(end, 'b', j)})" for j in each),
        f"end = f(t + h, {ahead})",
        f"return ({', '.join(change)},), end, {estimates}, {_tuple(inner)}",
    ]
    dense = [
        "def dense(t, h, q, v, b, change, end, inner):",
        *head,
        f"{_tuple(inner)} = inner",
        f"{_tuple(change)} = change",
        f"{_tuple(names('b', _END))} = end",
        *(f"u{_END}_{j} = v{j} + e{j}" for j in each),
        *(line for k in range(_END + 1, _LAST + 1) for line in stage(k)),
        "return ("
        + "".join(
            f"({d}, h*{letter}1_{j} - {d}, 2*{d} - h*({letter}1_{j} + {letter}{_END}_{j}), "
            + "".join(f"h*({sums(row, letter, j)}), " for row in DENSE)
            + "), "
            for (letter, j), d in zip(both, change, strict=True)
        )
        + ")",
    ]
    given = {"f": accelerations}
    step_made, dense_made = (
        run_generated([lines[0], *(f"    {line}" for line in lines[1:])], name, given)
        for name, lines in (("step", step), ("dense", dense))
    )
    return step_made, dense_made


def _tuple(names: Sequence[str]) -> str:
    return f"({', '.join(names)},)"
