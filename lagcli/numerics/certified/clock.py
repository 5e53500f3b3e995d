"""What the rounding of the time does in all the steps of a run.

In sin(w t) the argument is rounded by e w t of b bits, e = 2^-b: the acceleration errs by
e t |da/dt| in every step, alike in two runs that step alike.  Over N steps these errors add up as
by chance,

    |dv| = e T^2 |da/dt| / sqrt(N),    |dq| = T |dv|,

with the root mean square of da/dt at fixed q, q'.

References
----------
Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. (SIAM 2002), section 2.8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.run import Run

#: The bits that a method carries when nobody asks for more; others carry those of doubles.
BITS, DOUBLES = {"taylor80": 64, "taylor128": 113, "taylor": 133}, 53
#: Places at which da/dt is looked at, by differences over this part of the span.
_LOOKS, _LATER = 50, 1e-9


def clock_errors(run: Run, span: float) -> list[float]:
    """What every component of the state may err by; nothing where the time acts on none."""
    if not run.marks or not run.steps or not _is_driven(run):
        return []
    bits = BITS.get(run.method_name, DOUBLES)
    squares = [0.0] * len(run.marks[0].q)
    marks = run.marks[:: max(1, len(run.marks) // _LOOKS)]
    for mark in marks:
        motion = run.phases[mark.phase].mode.motion
        at, number, t = motion.accelerations, motion.arithmetic.number, Fraction(mark.t)
        try:
            now = at(number(t), *mark.q, *mark.v)
            then = at(number(t + Fraction(_LATER * span)), *mark.q, *mark.v)
        except (ArithmeticError, ValueError):
            continue
        for j, (a, b) in enumerate(zip(now, then, strict=True)):
            squares[j] += (float(b - a) / (_LATER * span)) ** 2 / len(marks)
    v = [2.0**-bits * span**2 * math.sqrt(x / run.steps) for x in squares]
    return [*(span * x for x in v), *v]


def column_changes(run: Run, mark: Mark, errors: Sequence[float]) -> list[float]:
    """How much the columns of a row change when each component of the state errs."""
    tabulate, n = run.phases[mark.phase].mode.tabulate, len(mark.q)
    state = [*mark.q, *mark.v]
    here = tabulate(mark.t, mark.q, mark.v)
    total = [0.0] * len(here)
    for k, error in enumerate(errors):
        moved = [*state[:k], state[k] + error, *state[k + 1 :]]
        there = tabulate(mark.t, moved[:n], moved[n:])
        for j, (a, b) in enumerate(zip(here, there, strict=True)):
            total[j] += math.inf if b is None else 0.0 if a is None else abs(float(b - a))
    return total


def _is_driven(run: Run) -> bool:
    return any(phase.mode.equations.depends_on_time for phase in run.phases)
