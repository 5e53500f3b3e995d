"""Multipliers that a singular Lagrangian determines all the same.

Where M has no inverse on the allowed motions, K = [[M, -A^T], [A, 0]] has a kernel.  What has no
part in it is the same in every solution of K (q'', lambda) = r: m (x' + y')²/2 with x + y = b t
says nothing of x - y, but lambda = 0.  The unknowns that a basis of columns leaves out are set
to 0, and the others solved for.
"""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr

from lagcli.algebra import Shapes, dot, solve_linear
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.row_rank import independent_rows, rows_of
from lagcli.mechanics.states import State
from lagcli.mechanics.verify import Verifier, ZeroVerdict

_DEPENDENT = mpf(10) ** -25  # of the length of a row at 60 digits

Numbers = Sequence[Sequence[mpf]]


def determined_unknowns(
    K: Sequence[Sequence[Expr]],
    right: Sequence[Expr],
    state: State,
    verifier: Verifier,
    shapes: Shapes,
) -> tuple[list[Expr | None], ZeroVerdict] | None:
    """The unknowns of K x = right that every solution has in common; None for the others.

    Parameters
    ----------
    K, right
        A square system without an inverse.
    state
        A random state, at which its rank is seen.

    Returns
    -------
    The unknowns, and how K x = right was verified; None where that has no solution, or one that
    is too long.
    """
    n = len(K)
    with mpmath.workdps(DIGITS + 10):
        numbers = rows_of(Evaluator([x for row in K for x in row], DIGITS + 10)(state), n)
        rows = _independent(numbers)
        columns = _independent([list(column) for column in zip(*numbers, strict=True)])
        certain = [_in_span(numbers, k) for k in range(n)]
    square = [[K[i][j] for j in columns] for i in rows]
    solution = solve_linear(square, [right[i] for i in rows], shapes=shapes)
    if solution is None or solution.singular:
        return None
    x: list[Expr] = [sympy.S.Zero] * n
    for j, value in zip(columns, solution.values, strict=True):
        assert isinstance(value, Expr)
        x[j] = value
    residuals = [dot(row, x) - r for row, r in zip(K, right, strict=True)]
    verdict = verifier.all_zero(residuals)
    if verdict.holds is not True:
        return None
    return [value if sure else None for value, sure in zip(x, certain, strict=True)], verdict


def _independent(rows: Numbers) -> tuple[int, ...]:
    return independent_rows(rows, _DEPENDENT).independent


def _in_span(rows: Numbers, k: int) -> bool:
    """Whether the k-th unit vector is a combination of the rows: the kernel has no part in it."""
    unit = [mpf(int(j == k)) for j in range(len(rows))]
    return len(rows) in independent_rows([*rows, unit], _DEPENDENT).dependent
