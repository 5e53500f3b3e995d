"""The irreducible factors of a formula."""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Poly, factorization


def irreducible_factors(element: Element) -> tuple[sympy.Rational, list[tuple[Poly, int]]]:
    """The number and the other factors with their exponents, sqrt(x)/x being 1/sqrt(x)."""
    ring, generators = element.field.ring, element.field.generators
    number, found = sympy.S.One, list[tuple[Poly, int]]()
    for poly, side in ((element.numerator, 1), (element.denominator, -1)):
        content, factors = factorization(ring.lift(poly))
        number *= sympy.Integer(int(content)) ** side
        found += [(f, side * int(k)) for f, k in factors]
    for g in ring.used(element.numerator):
        radicand, root = generators[g].radicand, ring.generator(g)
        content, parts = (1, []) if radicand is None else factorization(ring.lift(radicand))
        power = sum(k for f, k in found if f == root)
        below = -sum(k for f, k in found if len(parts) == 1 and f == parts[0][0])
        if power > 0 and below > 0:
            # r/x = c r^(1 - n) with r^n = c x
            found = [(f, k) for f, k in found if f not in (root, parts[0][0])]
            found.append((root, power - below * generators[g].index))
            number *= sympy.Integer(int(content)) ** below
    return number, [(f, k) for f, k in found if k]


def factors_of(expression: Expr) -> list[tuple[Expr, int]]:
    """The irreducible factors with their exponents, negative ones from the denominator."""
    field = Field([expression])
    number, factors = irreducible_factors(field(expression))
    sides = ((number.p, 1), (number.q, -1))
    found = [(sympy.Integer(n), side) for n, side in sides if n != 1]
    return [*found, *((field.polynomial_to_sympy(f), k) for f, k in factors)]


def square_part(number: Expr) -> tuple[Expr, Expr]:
    """(a, b) with number = a² b, of an integer, and b free of squares."""
    whole, root = sympy.sqrt(abs(number)).as_coeff_Mul()
    return whole, sympy.sign(number) * root**2
