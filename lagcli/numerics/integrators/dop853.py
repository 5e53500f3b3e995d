"""DOP853: the explicit Runge-Kutta method of order 8 of Dormand and Prince.

Order 8, error estimates of order 5 and 3 combined into one of order 7, dense output of
order 7; 12 evaluations a step, 3 more where the inside of a step is requested.  Not for
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
from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.straight_line import run_generated
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.controlled import Controlled, State, Trial
from lagcli.numerics.integrators.steps import (
    DEPENDENT,
    SINGULAR_MASS,
    Inside,
    Method,
    MotionOfMode,
    StopWithReason,
    moved,
)
from lagcli.numerics.integrators.tableau_853 import DENSE, ERROR_3, ERROR_5, NODES, STAGES, Row

ORDER = 8
_END = 13  # the stage at the end of the step
_LAST = 16
_FIRST = 1e-4  # of the longest step, for the first
#: So many steps that cover less than this part of the span are looked at: where a pivot of the
#: mass matrix has lost so much they are steps of its rounding.
_CRAWLS, _NOWHERE, _SINGULAR = 128, 1e-4, 1e-8


class Dop853(Controlled):
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

    name, power, first = "dop853", ORDER, _FIRST

    def __init__(
        self, motion: Motion, surface: Surface | None, generated: tuple[Any, Any] | None = None
    ) -> None:
        super().__init__(motion, surface)
        self._step, self._dense = generated or generated_step(motion.n, motion.accelerations)

    def begin(self) -> None:
        """Nothing has been tried."""
        self._lost = [0.0] * (2 * self.n)  # what rounding takes from the sums (Kahan)
        self._attempts, self._since = 0, self.stretch.begin

    def _look_at_pivots(self, t: float, state: State) -> None:
        """End where a pivot has vanished, beside which steps are those of rounding."""
        self._attempts += 1
        if self._attempts % _CRAWLS:
            return
        crawls, self._since = t - self._since < _NOWHERE * self.stretch.until, t
        if not crawls:
            return
        (mass, held), (q, v, _) = self.motion.pivots, state
        whole = mass(t, *q, *v)
        if any(abs(x) < _SINGULAR * abs(y) for x, y in zip(whole[::2], whole[1::2], strict=True)):
            raise StopWithReason(t, q, v, SINGULAR_MASS)
        q_0, v_0, _, t_0 = self.stretch
        both = zip(held(t, *q, *v)[::2], held(t_0, *q_0, *v_0)[::2], strict=True)
        if any(abs(x) < _SINGULAR * abs(y) for x, y in both):
            raise StopWithReason(t, q, v, DEPENDENT)

    def tried(self, t: float, h: float, state: State) -> Trial:
        """A step."""
        self._look_at_pivots(t, state)
        q, v, rate = state
        self.calls += 12
        change, end, five, three, stages = self._step(t, h, q, v, rate)
        self.tolerance.see(q, v, change)
        error = self._error(h, five, three)
        if not error <= 1:
            return Trial(error, None, five if error < math.inf else ())
        end_q, end_v, left = added(q, v, change, self._lost)
        next_rate = end
        if self.surface is not None:
            end_q, end_v = self.surface.project(t + h, end_q, end_v)
            next_rate = self.rate(t + h, end_q, end_v)
        return Trial(error, (end_q, end_v, next_rate), five, (left, change, end, stages))

    def accepted(self, trial: Trial, ratio: float) -> None:  # noqa: ARG002
        """Keep what rounding took from the sums."""
        self._lost = trial.kept[0]

    def _error(self, h: float, five: Sequence[float], three: Sequence[float]) -> float:
        """The error in units of the tolerance: e5^2 / sqrt(e5^2 + e3^2/100)."""
        a = b = 0.0
        for x, y, scale in zip(five, three, self.tolerance.scales, strict=True):
            a += (x / scale) ** 2
            b += (y / scale) ** 2
        if not (a < math.inf and b < math.inf):
            return math.inf
        if a == 0.0:
            return 0.0
        return h * a / math.sqrt((a + 0.01 * b) * len(five)) / self.tolerance.value

    def inside(self, t: float, h: float, state: State, trial: Trial) -> Inside:
        """Positions, velocities and rates of the velocities by the dense output."""
        (q, v, rate), (_, change, end, stages) = state, trial.kept
        polynomials: list[list[float]] = []

        def at(time: float) -> tuple[list[float], list[float], list[float]]:
            if not polynomials:
                self.calls += 3
                polynomials.extend(self._dense(t, h, q, v, rate, change, end, stages))
            x = (time - t) / h
            values, slopes = zip(*(_interpolated(p, x) for p in polynomials), strict=True)
            return *moved(q, v, values), [s / h for s in slopes[self.n :]]

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
