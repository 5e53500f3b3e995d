"""The roots of a polynomial in cos x and sin x, in cosh x and sinh x, or in exp x."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy
from sympy import Dummy, Expr, S

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.polynomial_roots import coefficients, polynomial_roots
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.roots import substitute_square
from lagcli.algebra.simplification import simplify


def angle_roots(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """The angles in (-pi, pi] at which a polynomial in its cosine and sine vanishes.

    Parameters
    ----------
    cosine
        The generator of the cosine; that of the sine follows it.
    """
    ring = field.ring
    roots: list[Expr] = []
    _, factors = factorization(ring.lift(poly))
    for factor, _ in sorted(factors, key=lambda pair: (pair[0].total_degree(), str(pair[0]))):
        used = ring.used(factor)
        if cosine not in used and cosine + 1 not in used:
            continue
        found = _angles(field, ring.lift(factor), cosine)
        if found is None:
            return None
        roots += found
    return [root for root in dict.fromkeys(roots) if root.is_real is not False]


def logarithms(field: Field, poly: Poly, exponential: int) -> list[Expr] | None:
    """The x at which a polynomial in exp(x) vanishes."""
    values = polynomial_roots(field, poly, exponential)
    return (
        None if values is None else [sympy.log(v) for v in values if v != 0 and not _below_zero(v)]
    )


def hyperbolic_roots(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """The x at which a polynomial in cosh(x) and sinh(x) vanishes."""
    ring = field.ring
    roots: list[Expr] = []
    for factor, _ in factorization(ring.lift(poly))[1]:
        used = {cosine, cosine + 1} & set(ring.used(factor))
        if not used:
            continue
        whole = ring.lift(factor)
        alone = _without_cosine(field, whole, cosine, 1) if len(used) > 1 else whole
        if alone is None:
            values = _by_exponential(field, whole, cosine)
        elif cosine in ring.used(alone):
            values = polynomial_roots(field, alone, cosine)
            apart = (v for v in values or () if not _below_zero(v - 1 if v.is_number else v))
            values = values and [side * sympy.acosh(v) for v in apart for side in (-1, 1)]
        else:
            values = polynomial_roots(field, alone, cosine + 1)
            values = values and [sympy.asinh(v) for v in values]
        if values is None:
            return None
        roots += values
    return list(dict.fromkeys(roots))


def _angles(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    ring, sine = field.ring, cosine + 1
    if ring.degree(poly, sine) == 0:
        if (square := _square(field, poly, cosine)) is not None:
            return _with_square(square)
        values = polynomial_roots(field, poly, cosine)
        return None if values is None else [a for c in values for a in _with_cosine(c)]
    swapped = _without_cosine(field, poly, cosine)
    if swapped is not None:
        values = polynomial_roots(field, swapped, sine)
        return None if values is None else [a for s in values for a in _with_sine(s)]
    if (ratio := _ratio(field, poly, cosine)) is not None:  # a cos + b sin = 0: tan = -a/b
        return _with_tangent(field.to_sympy(-ratio))
    return _by_half_angle(field, poly, cosine)


def _without_cosine(field: Field, poly: Poly, cosine: int, side: int = -1) -> Poly | None:
    """The polynomial in the sine alone: cos² = 1 - sin², cosh² = 1 + sinh²; None: it is not one."""
    ring = field.ring
    if any(power % 2 for power in ring.coefficients(poly, cosine)):
        return None
    return substitute_square(field, poly, cosine, ring.one + side * ring.generator(cosine + 1) ** 2)


def _below_zero(value: Expr) -> bool:
    """Whether it is not positive wherever it is real: a square root with a minus, say."""
    if value.is_number:
        return bool(value.evalf() < 0)
    return value.is_nonpositive or all(
        f.is_nonnegative or (f.is_Pow and f.exp == S.Half) for f in sympy.Mul.make_args(-value)
    )


def _square(field: Field, poly: Poly, cosine: int) -> Expr | None:
    """The cos² at which a polynomial a cos² + b vanishes; None of any other."""
    found = coefficients(field, poly, cosine)
    if len(found) != 3 or not found[1].is_zero():
        return None
    return simplify(field.to_sympy(-found[0] / found[2]))


def _with_square(cosine: Expr) -> list[Expr]:
    """±x and ±(pi - x) by the shortest of cos x, sin x and tan x."""
    squares = {sympy.acos: cosine, sympy.asin: simplify(1 - cosine)}
    squares[sympy.atan] = simplify(1 / cosine - 1)
    inverse = min(squares, key=lambda f: sympy.count_ops(squares[f]))
    if inverse is sympy.acos:
        return [a for side in (-1, 1) for a in _with_cosine(side * simplify(sympy.sqrt(cosine)))]
    x = inverse(simplify(sympy.sqrt(squares[inverse])))
    return [-x, x, sympy.pi - x, x - sympy.pi]


def _with_cosine(value: Expr) -> list[Expr]:
    if value == 1:
        return [S.Zero]
    if value == -1:
        return [sympy.pi]
    if value.is_number and abs(value.evalf()) > 1:
        return []
    return [-sympy.acos(value), sympy.acos(value)]


def _with_sine(value: Expr) -> list[Expr]:
    if value.is_zero:
        return [S.Zero, sympy.pi]
    if abs(value) == 1:
        return [sympy.asin(value)]
    if value.is_number and abs(value.evalf()) > 1:
        return []
    angle = sympy.asin(sympy.factor_terms(value))  # asin(-v) is -asin(v)
    return [angle, -sympy.pi - angle if value.is_negative else sympy.pi - angle]


def _with_tangent(value: Expr) -> list[Expr]:
    angle = sympy.atan(sympy.factor_terms(value))
    return [angle, angle - sympy.pi if value.is_positive else angle + sympy.pi]


def _by_exponential(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """Of a cosh x + b sinh x = 0: tanh x = -a/b; else by exp(x) = cosh x + sinh x."""
    ratio = _ratio(field, poly, cosine)
    if ratio is not None:
        return [sympy.atanh(sympy.factor_terms(field.to_sympy(-ratio)))]
    E = field(Dummy("#E", positive=True))
    half = field.rational(Fraction(1, 2))
    images = {cosine: half * (E + E**-1), cosine + 1: half * (E - E**-1)}
    return logarithms(
        field, _put_in(field, poly, images).numerator, field.ring.used(E.numerator)[0]
    )


def _ratio(field: Field, poly: Poly, cosine: int) -> Element | None:
    """a/b of a polynomial a cos + b sin, else None."""
    free, *along = coefficients(field, poly, cosine + 1)
    if len(along) != 1:
        return None
    ratio = free / (along[0] * field.generator(cosine))
    used = {*field.ring.used(ratio.numerator), *field.ring.used(ratio.denominator)}
    return None if {cosine, cosine + 1} & used else ratio


def _by_half_angle(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """With t = tan(angle/2): cos = (1 - t²)/(1 + t²), sin = 2 t/(1 + t²)."""
    ring, sine = field.ring, cosine + 1
    t = field(Dummy("#t", real=True))
    number = ring.used(t.numerator)[0]
    one = field.rational(1)
    images = {
        cosine: (one - t * t) / (one + t * t),
        sine: (t + t) / (one + t * t),
    }
    values = polynomial_roots(field, _put_in(field, poly, images).numerator, number)
    if values is None:
        return None
    angles = [2 * sympy.atan(value) for value in values]
    at_pi = ring.compose(poly, {cosine: ring.constant(-1), sine: ring.zero})
    return [sympy.pi, *angles] if at_pi == 0 else angles


def _put_in(field: Field, poly: Poly, images: Mapping[int, Element]) -> Element:
    """A polynomial with values for some generators."""
    ring, total = field.ring, field.rational(0)
    for monomial, coefficient in ring.terms(poly):
        rest = tuple(pair for pair in monomial if pair[0] not in images)
        term = field.polynomial(ring.build([(rest, coefficient)]))
        for generator, exponent in monomial:
            if generator in images:
                term = term * images[generator] ** exponent
        total = total + term
    return total
