"""Rows of numbers: which are independent, and the shortest solution of a system of such."""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
from mpmath import mpf

from lagcli.pivoting import reduced
from lagcli.record import record

_RELATIVE = mpf(10) ** -20

Row = list[mpf]


@record
class Elimination:
    """The outcome of a pivoted elimination of rows: which are independent."""

    independent: tuple[int, ...]
    dependent: tuple[int, ...]


def independent_rows(rows: Sequence[Sequence[mpf]], tolerance: mpf) -> Elimination:
    """Take each row, in order, that is not a combination of those before it.

    Modified Gram-Schmidt: a row is dependent when what is left of it is below
    `tolerance` times its length.  Entries may be complex: a root of what is negative.
    """
    basis: list[list[mpf]] = []
    independent, dependent = [], []
    for index, row in enumerate(rows):
        rest = list(row)
        length = mpmath.sqrt(sum(abs(x) ** 2 for x in rest))
        for _ in range(2):  # twice is enough (Kahan, Parlett)
            for unit in basis:
                along = sum(x * y.conjugate() for x, y in zip(rest, unit, strict=True))
                rest = [x - along * y for x, y in zip(rest, unit, strict=True)]
        left = mpmath.sqrt(sum(abs(x) ** 2 for x in rest))
        if length == 0 or left <= tolerance * length:
            dependent.append(index)
        else:
            basis.append([x / left for x in rest])
            independent.append(index)
    return Elimination(tuple(independent), tuple(dependent))


def rows_of(entries: Sequence[mpf], width: int) -> list[Sequence[mpf]]:
    """A matrix that is written row after row."""
    return [entries[i : i + width] for i in range(0, len(entries), width)]


def least_norm_solution(rows: Sequence[Sequence[mpf]], right: Sequence[mpf]) -> list[mpf]:
    """The shortest x with rows . x = right, rows independent: x = A^T (A A^T)^-1 right."""
    a = mpmath.matrix([list(row) for row in rows])
    y = mpmath.lu_solve(a * a.T, mpmath.matrix(list(right)))
    return list(a.T * y)


def nullspace(rows: Sequence[Row]) -> list[Row]:
    """A basis of the c with rows c = 0."""
    width = len(rows[0])
    solved = _solved(rows, mpf(1))
    free = [k for k in range(width) if k not in solved]
    return [[-solved[k][j] if k in solved else mpf(k == j) for k in range(width)] for j in free]


def rank(rows: Sequence[Row]) -> int:
    """The rank, with what is small beside the largest entry taken for 0."""
    return len(_solved(rows, mpf(0)))


def _solved(rows: Sequence[Row], least: mpf) -> dict[int, Row]:
    """Reduced rows by the column of their pivot."""
    work = [list(row) for row in rows]
    scale = max((abs(x) for row in work for x in row), default=mpf(0))
    width = len(rows[0]) if rows else 0
    return {c: work[r] for r, c in reduced(work, width, _RELATIVE * max(scale, least))}
