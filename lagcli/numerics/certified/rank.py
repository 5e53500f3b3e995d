"""Where constraints become dependent on the way: a linkage that is flat, a crossing of curves.

The pivots of A M^-1 A^T vanish there as the square of the distance, so that their roots are
straight lines to both sides: between two rows where such a line, drawn on, meets 0.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., sections 4.2 (pivots of L D L^T) and 5.4.2 (of QR).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from lagcli.numerics.equations.null_space import pivots_of
from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Mode
from lagcli.numerics.hybrid.run import Run

#: Where roots change by less there is no such place.
_CONSTANT = 0.99

Pivots = Callable[[Mark], list[float]]
Roots = Callable[[Sequence[Mark]], list[float]]


class RankPlace(NamedTuple):
    """Between two times of a phase a pivot vanishes; `roots` are those of the pivots."""

    phase: int
    begin: float
    end: float
    roots: Roots


def varies(run: Run, marks: Sequence[Mark]) -> bool:
    """Whether the pivots change along some rows."""
    return any(min(roots(some)) < _CONSTANT for _, some, roots in _by_phase(run, marks))


def places(run: Run, marks: Sequence[Mark]) -> list[RankPlace]:
    """Where the root of a pivot, drawn on as a straight line, meets 0 between two of some rows."""
    found = []
    for number, some, roots_at in _by_phase(run, marks):
        roots, last = roots_at(some), len(some) - 1
        for j, here in enumerate(roots):
            beside = roots[max(0, j - 1) : j] + roots[j + 1 : j + 2]
            if here <= min(beside) and here <= max(beside) - here:
                begin, end = some[max(0, j - 1)].t, some[min(last, j + 1)].t
                found.append(RankPlace(number, begin, end, roots_at))
    return found


def _by_phase(run: Run, marks: Sequence[Mark]) -> list[tuple[int, list[Mark], Roots]]:
    """The rows of each phase that has constraints, and the smallest root of their pivots."""
    found = []
    for number, phase in enumerate(run.phases):
        some = [mark for mark in marks if mark.phase == number]
        if phase.surface is None or len(some) < 3:
            continue
        roots = _roots(_pivots(phase.mode), some)
        if roots is not None:
            found.append((number, some, roots))
    return found


def _roots(pivots: Pivots, marks: Sequence[Mark]) -> Roots | None:
    """The smallest pivot at each row, beside the largest that it is at some."""
    try:
        whole = [max(column) for column in zip(*map(pivots, marks), strict=True)]
    except (ArithmeticError, ValueError):
        return None
    # a constraint that follows from others all the way has no branches
    least = math.sqrt(PIVOT_TOLERANCE)
    kept = [k for k in range(0, len(whole), 2) if whole[k] > least * whole[k + 1]]

    def roots(some: Sequence[Mark]) -> list[float]:
        return [min(row[k] / whole[k] for k in kept) for row in map(pivots, some)]

    return roots if kept else None


def _pivots(mode: Mode) -> Pivots:
    """The root of each pivot at a row, and then of what it is left of."""
    motion, (_, held) = mode.motion, mode.motion.pivots
    if mode.equations.eliminated is not None:
        return lambda mark: [math.sqrt(abs(float(x))) for x in held(mark.t, *mark.q, *mark.v)]

    def of_numbers(mark: Mark) -> list[float]:
        mass, _, held, _ = motion.system(mark.t, *mark.q, *mark.v)
        masses = [float(row[j]) for j, row in enumerate(mass)]
        rows = [[float(x) for x in row] for row in held]
        return [x for pivot in pivots_of(masses, rows) for x in (pivot, 1.0)]

    return of_numbers
