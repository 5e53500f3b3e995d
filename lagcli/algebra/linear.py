"""Exact linear algebra over the field: solutions, ranks, null spaces.

Rows are combined in the fraction field.  The pivot is the shortest entry of the sparsest
row and column (Markowitz), so that masses and constants are eliminated before sums.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr

from lagcli.algebra.build import as_expr
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.generic_rank import has_full_rank
from lagcli.algebra.relations import Relations
from lagcli.algebra.shapes import Shapes
from lagcli.algebra.simplification import ReadableShapes
from lagcli.algebra.writing import Writer
from lagcli.platform.effort import OutOfWork
from lagcli.record import record

Matrix = Sequence[Sequence[Expr]]
_Rows = list[dict[int, Element]]


@record
class LinearSolution:
    """The solution of A x = b.

    Attributes
    ----------
    values
        x, simplified; rows of values when b has several columns.  Empty when singular.
    determinant
        det A, simplified (without `shapes`); None when singular.
    singular
        Whether det A = 0.
    rank
        The rank of A for generic values of the symbols.
    """

    values: list[Expr] | list[list[Expr]]
    determinant: Expr | None
    singular: bool
    rank: int


_READ = 1500  # terms of a value; the triple pendulum has 255, that of four links 15 000
_COMPUTED = 8_000  # terms of an entry on the way
_ADDED = 2_000_000  # products of terms of two fractions that are added


def solve_linear(
    A: Matrix,
    b: Sequence[Expr] | Matrix,
    budget: int = 1_000_000,
    shapes: Shapes | None = None,
) -> LinearSolution | None:
    """Solve A x = b exactly.

    Parameters
    ----------
    A, b
        n rows of n entries; n right-hand sides, or n rows of them.
    budget
        Products of terms after which None is returned: no time is measured, so that an
        answer is the same on every machine.  None also where a value is too long to be read.
    shapes
        Where the values are to be written as they were found here.  Its relations that are
        solved for a symbol shorten the entries from the start.  The others shorten only the
        result: used while eliminating, they would leave factors below that vanish where det A
        does not, as x does in x'/x for y y' = -x x'.
    """
    relations = None if shapes is None else shapes.relations
    several = bool(b) and isinstance(b[0], (list, tuple))
    columns: list[list[Expr]] = [list(row) if several else [row] for row in b]
    n, width = len(A), len(columns[0]) if columns else 1
    rows, field = _enter([[*row, *more] for row, more in zip(A, columns, strict=True)], relations)
    try:
        found = _eliminate(field, rows, n, None, budget)
    except OutOfWork:
        return None
    if len(found.pivots) < n:
        return LinearSolution([], None, singular=True, rank=len(found.pivots))
    if _vanishes(field, found.determinant, relations):
        return LinearSolution([], None, singular=True, rank=rank(A, relations))
    row_of = {column: row for row, column in found.pivots}
    if any(x.size() > _READ for row in rows for x in row.values()):
        return None
    readable = ReadableShapes(field, Writer(() if shapes is None else shapes.order), relations)

    def simplified(element: Element) -> Expr:
        value, tree = readable.pair(element)
        if shapes is not None:
            shapes.keep(value, tree)
        return value

    zero = field.rational(0)
    values = [
        [simplified(rows[row_of[k]].get(n + j, zero)) for j in range(width)] for k in range(n)
    ]
    determinant = found.determinant
    det = readable.pair(determinant)[0] if shapes is None else field.to_sympy(determinant)
    flat: list[Expr] | list[list[Expr]] = values if several else [v[0] for v in values]
    return LinearSolution(flat, det, singular=False, rank=n)


def dot(a: Iterable[Expr], b: Iterable[Expr]) -> Expr:
    """sum a_i b_i."""
    return sympy.Add(*(x * y for x, y in zip(a, b, strict=True)))


def unit_vectors(n: int) -> list[tuple[Expr, ...]]:
    """Those of n components."""
    return [tuple(sympy.Integer(i == k) for i in range(n)) for k in range(n)]


def rank(A: Matrix, relations: Relations | None = None) -> int:
    """The rank of A for generic values of the symbols."""
    if not relations and has_full_rank([[as_expr(x) for x in row] for row in A]):
        return len(A[0]) if A else 0
    rows, field = _enter(A, relations)
    width = len(A[0]) if A else 0
    return len(_eliminate(field, rows, width, relations).pivots)


def nullspace(A: Matrix, relations: Relations | None = None) -> list[list[Expr]]:
    """A basis of the vectors x with A x = 0."""
    if not relations and A and has_full_rank([[as_expr(x) for x in row] for row in A]):
        return []
    rows, field = _enter(A, relations)
    width = len(A[0]) if A else 0
    pivots = _eliminate(field, rows, width, relations).pivots
    bound = {column: row for row, column in pivots}
    vectors = []
    readable = ReadableShapes(field, Writer(), relations)
    for free in range(width):
        if free in bound:
            continue
        vector = [field.rational(0)] * width
        vector[free] = field.rational(1)
        for column, row in bound.items():
            if free in rows[row]:
                vector[column] = -rows[row][free]
        vectors.append([readable.pair(x)[0] for x in vector])
    return vectors


def left_nullspace(A: Matrix, relations: Relations | None = None) -> list[list[Expr]]:
    """A basis of the vectors y with y A = 0: the ways in which rows are redundant."""
    if not A:
        return []
    return nullspace([list(column) for column in zip(*A, strict=True)], relations)


def _enter(A: Matrix, relations: Relations | None) -> tuple[_Rows, Field]:
    """The nonzero entries of the rows in one field."""
    entries = [[as_expr(x) for x in row] for row in A]
    if relations:
        entries = [[relations.substitute(x) for x in row] for row in entries]
    field = Field([x for row in entries for x in row], closed=not relations)
    rows: _Rows = []
    for row in entries:
        elements = {j: field(x) for j, x in enumerate(row)}
        rows.append({j: x for j, x in elements.items() if not _vanishes(field, x, relations)})
    return rows, field


def _vanishes(field: Field, element: Element, relations: Relations | None) -> bool:
    if element.is_zero():
        return True
    return bool(relations) and relations is not None and relations.contain(field, element.numerator)


@dataclass(slots=True)
class _Elimination:
    pivots: list[tuple[int, int]]
    determinant: Element


def _eliminate(
    field: Field,
    rows: _Rows,
    width: int,
    relations: Relations | None,
    budget: float = float("inf"),
) -> _Elimination:
    """Gauss and Jordan: afterwards each pivot is 1 and alone in its column."""
    pivots: list[tuple[int, int]] = []
    determinant = field.rational(1)
    left = list(range(len(rows)))
    while True:
        chosen = _pivot(rows, left, width)
        if chosen is None:
            break
        r, c = chosen
        value = rows[r][c]
        if relations and relations.remaining:
            value = relations.shortest(field, value)
        determinant = determinant * value
        inverse = value.inverse()
        rows[r] = {j: x * inverse for j, x in rows[r].items()}
        left.remove(r)
        pivots.append(chosen)
        for i, row in enumerate(rows):
            if i == r or c not in row:
                continue
            factor = -row.pop(c)
            for j, x in rows[r].items():
                if j == c:
                    continue
                budget -= factor.size() * x.size() + (row[j].size() if j in row else 0)
                if budget < 0:
                    raise OutOfWork
                y = factor * x
                if j in row:
                    if row[j].size() * y.size() > _ADDED:
                        raise OutOfWork
                    y = row[j] + y
                if y.size() > _COMPUTED:
                    raise OutOfWork
                if _vanishes(field, y, relations):
                    row.pop(j, None)
                else:
                    row[j] = y
    order = [c for _, c in sorted(pivots)]
    inversions = sum(a > b for i, a in enumerate(order) for b in order[i + 1 :])
    return _Elimination(pivots, -determinant if inversions % 2 else determinant)


def _pivot(rows: _Rows, left: list[int], width: int) -> tuple[int, int] | None:
    """Row and column of the entry that is cheapest to eliminate by."""
    fill = dict.fromkeys(range(width), 0)
    for i in left:
        for j in rows[i]:
            if j < width:
                fill[j] += 1
    best: tuple[tuple[int, int, int, int], int, int] | None = None
    for i in left:
        inside = [j for j in rows[i] if j < width]
        for j in inside:
            entry = rows[i][j]
            cost = (entry.size(), (fill[j] - 1) * (len(inside) - 1), i, j)
            if best is None or cost < best[0]:
                best = (cost, i, j)
    return None if best is None else (best[1], best[2])
