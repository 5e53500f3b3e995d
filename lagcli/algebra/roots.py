"""Rational powers: a generator s with s^q = radicand, known factors taken out.

sqrt(a*b) = sqrt(a)*sqrt(b) holds when a or b is not negative, so every factor of a
radicand that is known to be nonnegative gets a root of its own; the others stay
together.  sqrt(N/D) = sqrt(N*D)/|D|.
"""

from __future__ import annotations

from fractions import Fraction

import sympy

from lagcli.algebra.field import Element, Generator
from lagcli.algebra.generators import ExpressionField
from lagcli.algebra.half_angles import (
    angles_of,
    degree_in_angle,
    from_half_angle,
    to_half_angle,
)
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.squared_sines import factors_and_sines

_MOST_ANGLES = 5  # beyond, and at higher degrees, no square is looked for in half angles
_HIGHEST = 8  # measured: at most 2; twice the degree in each half angle
_MAX_FACTORED = 10**24  # larger integers under a root are not factored


def is_nonnegative(field: ExpressionField, poly: Poly) -> bool:
    """Whether the assumptions show at once that the polynomial is >= 0."""
    for monomial, coefficient in field.ring.terms(poly):
        if coefficient < 0:
            return False
        if any(e % 2 and not field.generators[g].nonnegative for g, e in monomial):
            return False
    return True


def absolute(field: ExpressionField, element: Element) -> Element:
    """|element|, factor by factor."""
    return _absolute(field, element.numerator) / _absolute(field, element.denominator)


def _absolute(field: ExpressionField, poly: Poly) -> Element:
    number, factors, sines = factors_and_sines(field, poly)
    result = field.rational(abs(number))
    for sine, pairs in sines:
        result = result * field.generator(sine) ** (2 * pairs)
    for factor, exponent in factors:
        base = field.polynomial(factor)
        if exponent % 2 and not is_nonnegative(field, factor):
            base = base if is_nonnegative(field, -factor) else field.modulus(factor)
            if base.numerator == factor:
                base = -base
        result = result * base**exponent
    return result


def sign(field: ExpressionField, element: Element) -> Element:
    """sign(element), factor by factor."""
    return _sign(field, element.numerator) * _sign(field, element.denominator)


def _sign(field: ExpressionField, poly: Poly) -> Element:
    if poly == 0:
        return field.rational(0)
    content, factors = factorization(poly)
    result = field.rational(1 if int(content) > 0 else -1)
    for factor, exponent in factors:
        expression = field.polynomial_to_sympy(factor)
        if expression.is_positive is not True:
            base = -1 if expression.is_negative else 1
            one = field.rational(base) if base < 0 else field.signum(factor)
            result = result * one ** int(exponent)
    return result


def rational_power(field: ExpressionField, base: Element, exponent: Fraction) -> Element:
    """base^exponent."""
    if exponent.denominator == 1:
        return base**exponent.numerator
    if base.is_zero():
        return base
    root = _root(field, base, exponent.denominator)
    return root**exponent.numerator


def _root(field: ExpressionField, base: Element, index: int) -> Element:
    above, below = base.numerator, base.denominator
    if below == 1 or is_nonnegative(field, below):
        # (N/D)^(1/q) = (N D^(q-1))^(1/q) / D for D >= 0
        root = _polynomial_root(field, above * below ** (index - 1), index)
        if index == 2 and len(above) > 1:
            _note_scale(field, above, below)
        return root / field.polynomial(below)
    if index == 2:
        return _polynomial_root(field, above * below, 2) / _absolute(field, below)
    return field.opaque(sympy.Pow(field.to_sympy(base), sympy.Rational(1, index)))


def _note_scale(field: ExpressionField, above: Poly, below: Poly) -> None:
    """Remember that sqrt(above/d²) was used: it may read better than sqrt(above)/d.

    Only for d >= 0: it is sqrt(above)/|d| otherwise; and where d² cancels in one term at least,
    as in 1 - v²/c².
    """
    if len(below) != 1 or below.leading_coefficient() != 1:
        return
    ring = field.ring
    monomial, _ = next(ring.terms(below))
    if not monomial or any(e % 2 for _, e in monomial):
        return
    held = (dict(term) for term, _ in ring.terms(above))
    if not any(all(term.get(g, 0) >= e for g, e in monomial) for term in held):
        return
    scale = ring.build([(tuple((g, e // 2) for g, e in monomial), 1)])
    if not is_nonnegative(field, scale):
        return
    for number, generator in enumerate(field.generators):
        if generator.kind == "root" and ring.lift(generator.radicand) == ring.lift(above):
            field.root_scales[number] = scale


def _polynomial_root(field: ExpressionField, radicand: Poly, index: int) -> Element:
    ring = field.ring
    square = _hidden_square(field, radicand) if index == 2 else None
    if square is not None:
        return absolute(field, square)
    radicand = ring.reduce(radicand)
    if index == 2:
        number, factors, sines = factors_and_sines(field, radicand)
    else:
        content, factors = factorization(radicand)
        number, sines = int(content), []
    together = ring.constant(-1 if number < 0 else 1)
    result = _integer_root(field, abs(number), index)
    for sine, pairs in sines:
        result = result * absolute(field, field.generator(sine)) ** pairs
    factors.sort(key=lambda pair: str(pair[0]))
    for factor, exponent in factors:
        whole, rest = divmod(exponent, index)
        if is_nonnegative(field, factor):
            result = result * field.polynomial(factor) ** whole
            if rest:
                result = result * _radical(field, factor, index) ** rest
        elif index == 2:
            base = field.polynomial(factor)
            result = result * (base if whole % 2 == 0 else absolute(field, base)) ** whole
            together = together * factor**rest
        else:
            together = together * factor**exponent
    if together != 1:
        result = result * _radical(field, together, index)
    return result


def _integer_root(field: ExpressionField, number: int, index: int) -> Element:
    result = field.rational(1)
    if number == 1:
        return result
    factors = sympy.factorint(number) if number < _MAX_FACTORED else {number: 1}
    for prime, exponent in sorted(factors.items()):
        whole, rest = divmod(exponent, index)
        result = result * field.rational(int(prime) ** whole)
        if rest:
            result = result * _radical(field, field.ring.constant(int(prime)), index) ** rest
    return result


def _hidden_square(field: ExpressionField, radicand: Poly) -> Element | None:
    """The square root modulo sin² + cos² = 1: 1 − cos² is a square though it factors."""
    return _square_of_one_angle(field, radicand) or _square_in_half_angles(field, radicand)


def _square_in_half_angles(field: ExpressionField, radicand: Poly) -> Element | None:
    """The square root of 1 − cos²(a + b), which is one of a polynomial in tan(a/2), tan(b/2)."""
    radicand = field.ring.lift(radicand)
    angles = angles_of(field, radicand)
    degrees = [degree_in_angle(field, radicand, cosine) for cosine in angles]
    if not 1 < len(angles) < _MOST_ANGLES or any(d % 2 or d > _HIGHEST for d in degrees):
        return None
    inside = radicand
    for cosine, degree in zip(angles, degrees, strict=True):
        inside = to_half_angle(field, inside, cosine, degree)
    content, factors = inside.factor_squarefree()
    if content < 0 or any(exponent % 2 for _, exponent in factors):
        return None
    root = field.ring.one
    for factor, exponent in factors:
        root *= factor ** (exponent // 2)
    for cosine, degree in zip(angles, degrees, strict=True):
        root = from_half_angle(field, root, cosine, degree // 2)
    scale = field.rational(Fraction(1, 2 ** sum(d // 2 for d in degrees)))
    return _integer_root(field, int(content), 2) * field.polynomial(root) * scale


def _square_of_one_angle(field: ExpressionField, radicand: Poly) -> Element | None:
    ring = field.ring
    radicand = ring.lift(radicand)
    for index in ring.used(radicand):
        generator = field.generators[index]
        if generator.kind not in ("cos", "cosh"):
            continue
        other = ring.generator(generator.partner) ** 2
        value = ring.one - other if generator.kind == "cos" else other + ring.one
        swapped = substitute_square(field, radicand, index, value)
        if len(swapped) >= len(radicand) or swapped.leading_coefficient() < 0:
            continue
        _, factors = swapped.factor_squarefree()
        if all(exponent % 2 == 0 for _, exponent in factors):
            number = abs(int(swapped.content()))
            result = _integer_root(field, number, 2)
            for factor, exponent in factors:
                result = result * field.polynomial(factor) ** (exponent // 2)
            return result
    return None


def substitute_square(field: ExpressionField, poly: Poly, index: int, value: Poly) -> Poly:
    """The polynomial with g_index² replaced by value."""
    ring = field.ring
    poly = ring.lift(poly)
    result = ring.zero
    for power, coefficient in ring.coefficients(poly, index).items():
        result += coefficient * ring.generator(index) ** (power % 2) * value ** (power // 2)
    return result


def _radical(field: ExpressionField, radicand: Poly, index: int) -> Element:
    """The generator s with s^index = radicand, made when it is new."""
    ring = field.ring
    radicand = ring.lift(radicand)
    independent = ("symbol", "opaque", "power", "exp")
    if any(field.generators[g].kind not in independent for g in ring.used(radicand)):
        field.doubtful = True  # it may be a square: sqrt(3 + 2 sqrt(2)) = 1 + sqrt(2)
    for number, generator in enumerate(field.generators):
        if generator.kind != "root":
            continue
        value = ring.lift(generator.radicand)
        if generator.index == index and value == radicand:
            return field.generator(number)
        if not value.is_constant() and not value.gcd(radicand).is_constant():
            field.doubtful = True
        if generator.index != index:
            field.doubtful = True
    expression = sympy.Pow(field.to_sympy(field.polynomial(radicand)), sympy.Rational(1, index))
    number = field.add_generator(
        Generator("root", expression, index=index, radicand=radicand, nonnegative=True)
    )
    field.ring.rule(number, index, radicand)
    return field.generator(number)
