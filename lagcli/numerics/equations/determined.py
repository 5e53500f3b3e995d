"""The unknowns that a linear system determines, whatever else it leaves open."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE
from lagcli.pivoting import reduced


def determined(rows: Sequence[Sequence[float]], right: Sequence[float]) -> dict[int, float]:
    """The unknowns that have one value in all solutions of A x = b, by column.

    Gauss and Jordan with the largest pivot; a row that has lost ten digits counts as
    dependent, and what it asks of b is not looked at.
    """
    system = [
        [x / scale for x in (*row, b)]
        for row, b in zip(rows, right, strict=True)
        if (scale := max(map(abs, row), default=0.0)) > 0
    ]
    width = len(rows[0]) if rows else 0
    bound = {c: r for r, c in reduced(system, width, PIVOT_TOLERANCE)}
    free = [j for j in range(width) if j not in bound]
    return {
        c: system[r][width]
        for c, r in bound.items()
        if not any(abs(system[r][j]) > PIVOT_TOLERANCE for j in free)
    }
