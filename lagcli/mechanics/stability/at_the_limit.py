"""Linear equations where one condition of stability is an equality.

With the first-order matrix A and its characteristic polynomial p, solutions grow in proportion to
a power of t just where A has a Jordan block of an imaginary root.  Let r be the factors of p, each
once.  If A were diagonalizable, its minimal polynomial, which divides r, would give r(A) = 0.

References
----------
Gantmacher, *The Theory of Matrices*, vol. 1, chapter VII; vol. 2, chapter XIV, section 3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy
from sympy import Dummy, Expr, S, Symbol

from lagcli.algebra import dot, simplify, solve_linear
from lagcli.algebra.determinants import determinant_in
from lagcli.algebra.positivity import sign_of
from lagcli.algebra.systems import solve_system
from lagcli.mechanics.rest.linearization import Linearization

_MOST_COORDINATES = 3

Rows = list[list[Expr]]


def grows_at_equality(linear: Linearization, conditions: Sequence[Expr]) -> bool:
    """Whether displacements surely grow on the one edge of bounded motion.

    That is where one of the conditions is an equality; there the others hold.
    """
    edges = [k for k in range(len(conditions)) if _is_edge(linear, conditions, k)]
    return len(edges) == 1 and _grows(linear, conditions[edges[0]])


def _grows(linear: Linearization, condition: Expr) -> bool:
    return any(
        all(_has_jordan_block(linear, parameter, value) for value in values)
        for parameter, values in _solved(linear, condition)
    )


def _is_edge(linear: Linearization, conditions: Sequence[Expr], k: int) -> bool:
    """Whether all other conditions hold where this is an equality; not known: it is."""
    for parameter, values in _solved(linear, conditions[k]):
        others = [c for j, c in enumerate(conditions) if j != k]
        there = [simplify(c.xreplace({parameter: v})) for c in others for v in values]
        return not any(sign_of(x, ()) == -1 for x in there)
    return True


def _solved(linear: Linearization, condition: Expr) -> Iterator[tuple[Symbol, list[Expr]]]:
    """The values of one parameter at which it is an equality."""
    parameters = sorted(condition.free_symbols, key=lambda s: s.name)
    if not 0 < len(linear.M) <= _MOST_COORDINATES or {*parameters} & {*linear.system.q}:
        return
    for parameter in parameters:
        solved = solve_system([condition], [parameter])
        values = [each.values[parameter] for each in solved.solutions if each.values]
        if solved.complete and values and all(sign_of(v, ()) is not None for v in values):
            possible = [v for v in values if _may_be(parameter, v)]
            if possible:
                yield parameter, possible


def _may_be(parameter: Symbol, value: Expr) -> bool:
    return not parameter.is_positive or sign_of(value, ()) == 1


def _has_jordan_block(linear: Linearization, parameter: Symbol, value: Expr) -> bool:
    A = _first_order(linear, parameter, value)
    if A is None:
        return False
    n, s = len(A), Dummy("s")
    powers = determinant_in(s, [[s * int(i == j) - A[i][j] for j in range(n)] for i in range(n)])
    if powers is None:
        return False
    _, factors = sympy.factor_list(
        sympy.Add(*(simplify(c) * s**k for k, c in enumerate(powers))), s
    )
    once = sympy.Poly(sympy.Mul(*(f for f, _ in factors)), s)
    if once.degree() == n:
        return False
    entries = (x for row in _polynomial(once.all_coeffs(), A) for x in row)
    return any(sign_of(simplify(x), ()) in (1, -1) for x in entries)


def _first_order(linear: Linearization, parameter: Symbol, value: Expr) -> Rows | None:
    """A of (x, x')' = A (x, x')."""
    M, C, K = (
        [[e.xreplace({parameter: value}) for e in row] for row in matrix]
        for matrix in (linear.M, linear.C, linear.K)
    )
    n = len(M)
    solved = solve_linear(M, [[-x for x in (*k, *c)] for k, c in zip(K, C, strict=True)])
    if solved is None or solved.singular:
        return None
    above = [[S.Zero] * n + [S(int(i == j)) for j in range(n)] for i in range(n)]
    return [*above, *(list(row) for row in solved.values)]


def _polynomial(coefficients: Sequence[Expr], A: Rows) -> Rows:
    """Horner's scheme."""
    n = len(A)
    columns = list(zip(*A, strict=True))
    result: Rows = [[S.Zero] * n for _ in range(n)]
    for c in coefficients:
        result = [
            [simplify(dot(row, columns[j]) + (c if i == j else S.Zero)) for j in range(n)]
            for i, row in enumerate(result)
        ]
    return result
