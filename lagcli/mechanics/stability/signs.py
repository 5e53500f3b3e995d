"""Signs in conditions of stability, for all values that the assumptions allow."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.algebra import Field
from lagcli.algebra.equations import coefficients
from lagcli.algebra.one_ratio import in_one_ratio
from lagcli.algebra.ring import factorization
from lagcli.algebra.signs import sign
from lagcli.mechanics.reduction.readable import deciding, is_positive, weak_sign

__all__ = ["is_positive", "sign_of", "weak_sign"]


def sign_of(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1, -1 or 0 where it has one sign for all values; else None."""
    known = sign(expression, positive)
    for other in (_on_the_circle, _in_one_ratio):
        known = other(expression, positive) if known is None else known
    return known


def _in_one_ratio(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1 or -1 for what has one sign at all ratios that `positive` leaves."""
    if not all(s.is_positive for s in expression.free_symbols):
        return None
    rest = deciding(expression, positive)
    return next((side for side in (1, -1) if in_one_ratio([side * rest], positive) == []), None)


def _on_the_circle(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1 for a + b cos(x) with a > 0 and squares at cos = 1 and cos = -1, over a positive."""
    field = Field([expression])
    element = field(expression)
    below = sign(1 / field.to_sympy(field.polynomial(element.denominator)), positive)
    if below is None:
        return None
    poly = element.numerator * below
    for g in field.ring.used(poly):
        if field.generators[g].kind != "cos" or field.ring.degree(poly, g) != 1:
            continue
        if g + 1 in field.ring.used(poly):
            continue
        a, b = coefficients(field, poly, g)
        ends = [(a + b).numerator, (a - b).numerator]
        if sign(field.to_sympy(a), positive) == 1 and all(map(_is_square, ends)):
            return 1
    return None


def _is_square(poly: object) -> bool:
    content, factors = factorization(poly)
    return int(content) > 0 and all(exponent % 2 == 0 for _, exponent in factors)
