"""The ways in which a linkage can be put together: roots of its constraints, by Newton's method.

Where positions do not follow in closed form, f(q) = 0 is solved from many starts spread over the
turns of the angles and the lengths of the problem.  Roots that differ by whole turns are one.
The search finds roots and does not prove that there are no others.

References
----------
McCarthy, Soh, *Geometric Design of Linkages*, 2nd ed., section 2.2 (assembly configurations).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random

from lagcli.numerics.equations.determined import determined

#: With the unknowns: the residuals, then the rows of the Jacobian, one after the other.
Residuals = Callable[..., Sequence[float]]
Root = tuple[float, ...]

_STARTS, _ITERATIONS = 96, 60
#: A root's residuals beside those of the starts; roots closer than this are one.
_SOLVED, _SAME = 1e-13, 1e-6
#: Lengths are looked for up to this many times the largest one that is known.
_FAR = 3.0


def assemblies(at: Residuals, count: int, length: float) -> list[Root]:
    """The roots found, from the smallest on; angles within (-pi, pi].

    Parameters
    ----------
    at
        Residuals f and Jacobian df/dq at values of the unknowns.
    count
        Number of unknowns.
    length
        The largest magnitude among the known lengths.
    """
    random = Random(0)
    turns = [_is_angle(at, count, k, random) for k in range(count)]
    reach = [math.pi if turn else _FAR * length for turn in turns]
    found: list[Root] = []
    for _ in range(_STARTS):
        root = _newton(at, [random.uniform(-far, far) for far in reach])
        if root is not None:
            root = [_within_turn(x) if turn else x for x, turn in zip(root, turns, strict=True)]
            if not any(_is_same(root, other, turns) for other in found):
                found.append(tuple(root))
    return sorted(found)


def _newton(at: Residuals, x: list[float]) -> list[float] | None:
    """The root that Newton's steps lead to; None where they lead to none."""
    count, largest = len(x), 0.0
    for _ in range(_ITERATIONS):
        try:
            values = at(*x)
        except (ArithmeticError, ValueError):
            return None
        m = len(values) // (count + 1)
        residuals, entries = values[:m], values[m:]
        if not all(map(math.isfinite, values)):
            return None
        worst = max(map(abs, residuals))
        largest = max(largest, worst)
        step = determined(
            [entries[i * count : (i + 1) * count] for i in range(m)], [-f for f in residuals]
        )
        if len(step) < count:  # not an isolated root
            return None
        if worst <= _SOLVED * max(largest, 1e-300):
            return x
        x = [a + step[k] for k, a in enumerate(x)]
        if worst <= 1e3 * _SOLVED * largest and all(
            abs(step[k]) <= 1e-15 * abs(a) for k, a in enumerate(x)
        ):
            return x
    return None


def _is_angle(at: Residuals, count: int, k: int, random: Random) -> bool:
    """Whether a whole turn of an unknown changes nothing."""
    for _ in range(3):
        x = [random.uniform(-1, 1) for _ in range(count)]
        turned = [a + (2 * math.pi if j == k else 0.0) for j, a in enumerate(x)]
        try:
            pairs = list(zip(at(*x), at(*turned), strict=True))
        except (ArithmeticError, ValueError):
            return False
        if any(abs(a - b) > 1e-12 * max(1.0, abs(a), abs(b)) for a, b in pairs):
            return False
    return True


def _within_turn(x: float) -> float:
    found = math.remainder(x, 2 * math.pi)
    return math.pi if found <= -math.pi + 1e-12 else found


def _is_same(one: Sequence[float], other: Sequence[float], turns: Sequence[bool]) -> bool:
    """Whether two roots are one but for rounding and whole turns."""
    apart = (
        abs(math.remainder(a - b, 2 * math.pi)) if turn else abs(a - b) / max(abs(a), abs(b), 1.0)
        for a, b, turn in zip(one, other, turns, strict=True)
    )
    return max(apart) <= _SAME
