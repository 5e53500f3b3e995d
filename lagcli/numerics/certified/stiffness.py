"""How stiff a motion is: its fastest decay, in units of the span.

The eigenvalue of the largest modulus of the linear equations at the beginning, by power
iteration.  Where it is negative and alone the state decays so quickly that an explicit method
is held to steps of about 6 of its times, however smooth the motion is; a fast oscillation has
a pair of eigenvalues, on which the iteration does not settle, and its steps are needed.

References
----------
Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., section IV.2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.numerics.equations.jacobian import jacobian
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.null_space import dot
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup

#: From here on an implicit method costs less than the fastest explicit one.
STIFF = 1e5
_ROUNDS = 30
_SETTLED = 1e-2
#: Difference quotients below this part of it need not be worked out exactly.
_CLEARLY = 0.1
_STEP = 1e-7


def decay(setup: Setup, modes: Modes) -> float:
    """Times of the fastest decay within the span; 0 where an oscillation is faster."""
    motion, (q, v) = modes.first.motion, setup.start
    if _fastest(motion, q, v) * setup.request.until < _CLEARLY * STIFF:
        return 0.0
    try:
        by_q, by_v = jacobian(motion)(0.0, *q, *v)
    except (ArithmeticError, ValueError):
        return 0.0
    n = motion.n
    rate = max(sum(map(abs, row)) for row in by_v)
    if not STIFF < rate * setup.request.until < math.inf:
        return 0.0
    x = [1.0 + j / (7 * n) for j in range(2 * n)]  # not at right angles to anything in particular
    for _ in range(_ROUNDS):
        moved = x[n:] + [dot((*row, *other), x) for row, other in zip(by_q, by_v, strict=True)]
        along = dot(x, moved) / dot(x, x)
        off = math.hypot(*(b - along * a for a, b in zip(x, moved, strict=True)))
        settled = off <= _SETTLED * abs(along) * math.hypot(*x)
        size = math.hypot(*moved)
        if not 0 < size < math.inf:
            return 0.0
        x = [b / size for b in moved]
    return -along * setup.request.until if settled and along < 0 else 0.0


def _fastest(motion: Motion, q: Sequence[float], v: Sequence[float]) -> float:
    """The largest sum of a row of da/dq', by difference quotients; inf where there are none.

    The exact derivatives of ten coordinates cost more than their motion.
    """
    sums = [0.0] * motion.n
    try:
        here = motion.accelerations(0.0, *q, *v)
        for j, speed in enumerate(v):
            step = _STEP * max(1.0, abs(speed))
            there = motion.accelerations(0.0, *q, *v[:j], speed + step, *v[j + 1 :])
            sums = [s + abs(b - a) / step for s, a, b in zip(sums, here, there, strict=True)]
    except (ArithmeticError, ValueError):
        return math.inf
    return max(sums) if all(map(math.isfinite, sums)) else math.inf
