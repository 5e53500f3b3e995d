"""The irreducible factors of a formula."""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.ring import factorization


def factors_of(expression: Expr) -> list[tuple[Expr, int]]:
    """The irreducible factors with their exponents, negative ones from the denominator."""
    field = Field([expression])
    element = field(expression)
    found: list[tuple[Expr, int]] = []
    for poly, side in ((element.numerator, 1), (element.denominator, -1)):
        content, factors = factorization(field.ring.lift(poly))
        if int(content) != 1:
            found.append((sympy.Integer(int(content)), side))
        found += [(field.polynomial_to_sympy(f), side * int(k)) for f, k in factors]
    return found


def square_part(number: Expr) -> tuple[Expr, Expr]:
    """(a, b) with number = a² b, of an integer, and b free of squares."""
    whole, root = sympy.sqrt(abs(number)).as_coeff_Mul()
    return whole, sympy.sign(number) * root**2
