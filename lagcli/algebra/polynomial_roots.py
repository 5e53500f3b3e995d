"""The roots of a polynomial in one generator of a field, by radicals.

It is factored; factors of degree one and two, and powers x^k = a, are solved by radicals.  What
has only numbers in it is solved by numbers where radicals do not serve.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd

import sympy
from sympy import Dummy, Expr, Rational, S

from lagcli.algebra.decimals import DIGITS, GUARD, decimal
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.simplification import simplify

MAX_DEGREE = 24  # cos 24 x in cos x; cos(299792458 x) has roots that nobody lists


def coefficients(field: Field, poly: Poly, generator: int) -> list[Element]:
    """The coefficients by powers of a generator, constant term first."""
    parts = field.ring.coefficients(poly, generator)
    degree = max(parts, default=0)
    return [field.polynomial(parts.get(k, field.ring.zero)) for k in range(degree + 1)]


def polynomial_roots(field: Field, poly: Poly, generator: int) -> list[Expr] | None:
    """The roots in one generator, without repetition; None where no closed form was found.

    Roots that are surely not real are left out.
    """
    roots: list[Expr] = []
    for found, _, _ in factor_roots(field, poly, generator):
        if found is None:
            return None
        roots += found
    return [root for root in dict.fromkeys(roots) if root.is_real is not False]


def factor_roots(
    field: Field, poly: Poly, generator: int
) -> list[tuple[list[Expr] | None, int, int]]:
    """By irreducible factor: roots (None without closed form), multiplicity, degree."""
    factors = factors_by_coefficients(field, poly, generator)
    return [(_roots(field, parts), many, len(parts) - 1) for parts, many in factors]


def factors_by_coefficients(
    field: Field, poly: Poly, generator: int
) -> list[tuple[list[Element], int]]:
    """Those with the generator: the coefficients a_0, a_1, … and the multiplicity of each."""
    _, factors = factorization(field.ring.lift(poly))
    factors.sort(key=lambda pair: (pair[0].total_degree(), str(pair[0])))
    parted = ((coefficients(field, factor, generator), many) for factor, many in factors)
    return [(parts, many) for parts, many in parted if len(parts) > 1]


def _roots(field: Field, a: Sequence[Element]) -> list[Expr] | None:
    """The roots of a_0 + a_1 x + … of an irreducible polynomial."""
    degree = len(a) - 1
    step = gcd(*(k for k in range(1, degree + 1) if not a[k].is_zero()))
    if step > 1:
        powers = _roots(field, a[::step])
        return None if powers is None else _radicals(powers, step)
    if degree == 1:
        return [field.to_sympy(-a[0] / a[1])]
    if degree == 2:
        # x = (-b ± sqrt(b² - 4 a c)) / (2 a)
        root = sympy.sqrt(simplify(field.to_sympy(a[1] ** 2 - field.rational(4) * a[2] * a[0])))
        # of |b| and -|b| together the modulus is of no use
        moduli = (x.args[0] if isinstance(x, sympy.Abs) else x for x in sympy.Mul.make_args(root))
        root = sympy.Mul(*moduli)
        middle, below = field.to_sympy(-a[1]), field.to_sympy(field.rational(2) * a[2])
        return [simplify((middle - root) / below), simplify((middle + root) / below)]
    return _scaled_roots(field, a)


def _scaled_roots(field: Field, a: Sequence[Element]) -> list[Expr] | None:
    """With x = r y, r = a_(n-1)/a_n, the coefficients may become numbers."""
    n = len(a) - 1
    scale = field.rational(1) if a[n - 1].is_zero() else _without_number(a[n - 1] / a[n])
    numbers = [(a[k] / (a[n] * scale ** (n - k))).rational() for k in range(n)]
    if any(number is None for number in numbers):
        return None
    unit = scale.rational()
    exact = [Rational(b.numerator, b.denominator) for b in numbers if b is not None]
    if n == 3:
        return [simplify(field.to_sympy(scale)) * y for y in _cubic_roots(*exact)]
    if unit is None or n > MAX_DEGREE:
        return None
    poly = sympy.Poly([1, *reversed(exact)], Dummy())
    return [decimal(Rational(unit) * root.evalf(DIGITS + GUARD)) for root in poly.real_roots()]


def _without_number(element: Element) -> Element:
    """The element over the ratio of its leading coefficients."""
    above = int(element.numerator.leading_coefficient())
    below = int(element.denominator.leading_coefficient())
    return element * element.field.rational(Fraction(below, above))


def _cubic_roots(a0: Rational, a1: Rational, a2: Rational) -> list[Expr]:
    """The real roots of y³ + a_2 y² + a_1 y + a_0 (Viète, Cardano), y = z - a_2/3."""
    p, q = a1 - a2**2 / 3, 2 * a2**3 / 27 - a2 * a1 / 3 + a0
    discriminant = -4 * p**3 - 27 * q**2
    if discriminant >= 0:
        # z = 2 sqrt(-p/3) cos(acos(3 q/(2 p) sqrt(-3/p))/3 - 2 pi k/3)
        angle = sympy.acos(3 * q / (2 * p) * sympy.sqrt(-3 / p))
        return [
            2 * sympy.sqrt(-p / 3) * sympy.cos((angle - 2 * sympy.pi * k) / 3) - a2 / 3
            for k in range(3)
        ]
    root = sympy.sqrt(q**2 / 4 + p**3 / 27)
    return [sympy.real_root(-q / 2 + root, 3) + sympy.real_root(-q / 2 - root, 3) - a2 / 3]


def _radicals(powers: Sequence[Expr], k: int) -> list[Expr] | None:
    """The real x with x^k one of the given values; None: an odd root of an angle's open sign."""
    roots: list[Expr] = []
    for value in map(simplify, powers):
        if value.is_zero:
            roots.append(S.Zero)
        elif k % 2 == 0:
            if value.is_negative:
                continue
            root = simplify(sympy.Pow(value, Rational(1, k)))
            roots += [-root, root]
        elif value.is_nonnegative:
            roots.append(sympy.Pow(value, Rational(1, k)))
        elif value.is_nonpositive:
            roots.append(-sympy.Pow(-value, Rational(1, k)))
        elif value.is_rational_function():
            roots.append(sympy.sign(value) * sympy.Pow(sympy.Abs(value), Rational(1, k)))
        else:
            return None
    return roots
