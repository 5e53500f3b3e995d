"""Determinants, whole and by powers of a symbol."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, S, Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.linear import solve_linear
from lagcli.algebra.polynomial_roots import coefficients


def determinant(matrix: Sequence[Sequence[Expr]]) -> Expr | None:
    """The determinant; None where it is too long or has no value, 0 for a singular matrix."""
    try:
        solution = solve_linear(matrix, [S.Zero] * len(matrix))
    except ZeroDivisionError:
        return None
    if solution is None:
        return None
    return S.Zero if solution.determinant is None else solution.determinant


def determinant_in(symbol: Symbol, matrix: Sequence[Sequence[Expr]]) -> list[Expr] | None:
    """The coefficients of a determinant by powers of a symbol, the constant term first."""
    whole = determinant(matrix)
    if whole is None:
        return None
    field = Field([whole])
    element, number = field(whole), field.number_of(symbol)
    if number is None:
        return [whole]
    below = field.polynomial(element.denominator)
    return [field.to_sympy(part / below) for part in coefficients(field, element.numerator, number)]
