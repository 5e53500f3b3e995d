"""Elimination of numbers of any kind with the largest pivot of all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


def reduced(
    work: list[list[Any]], n: int, least: Any, weights: Sequence[float] | None = None
) -> list[tuple[int, int]]:
    """Gauss-Jordan with full pivoting, in place; (row, column) of each pivot above the least.

    The pivots are compared by weights of their columns, if there are any.
    """
    weights = weights or [1.0] * n
    pivots: list[tuple[int, int]] = []
    rows = set(range(len(work)))
    columns = set(range(n))
    while rows and columns:
        _, i, j = max((abs(work[i][j]) * weights[j], -i, -j) for i in rows for j in columns)
        i, j = -i, -j
        if not abs(work[i][j]) > least:
            break
        pivots.append((i, j))
        rows.discard(i)
        columns.discard(j)
        top = [x / work[i][j] for x in work[i]]
        work[i] = top
        for k, row in enumerate(work):
            if k != i and row[j]:
                factor = row[j]
                work[k] = [x - factor * y for x, y in zip(row, top, strict=True)]
    return pivots
