"""Complete cancellation of fractions, also modulo sin² + cos² = 1 and under roots.

Polynomials in sin and cos have no unique factors, sin² = (1 − cos)(1 + cos), so their
greatest common divisor can miss a factor.  In t = tan(angle/2) they do:

    cos = (1 − t²)/(1 + t²),   sin = 2t/(1 + t²).

A fraction in lowest terms in t is also one of lowest degree in sin and cos.
"""

from __future__ import annotations

import random
from collections.abc import Sequence

from flint import nmod_poly

from lagcli.algebra.field import Element, FractionField
from lagcli.algebra.half_angles import (
    angles_of,
    degree_in_angle,
    from_half_angle,
    to_half_angle,
)

_PRIME = 2**61 - 1  # a sum that is not 0 is 0 modulo it once in 10^17
_MAX_TERMS = 600  # measured: up to 716


def cancelled(field: FractionField, element: Element) -> Element:
    """The element with numerator and denominator as short as cancellation makes them."""
    element = field.lifted(element)
    if element.is_polynomial() or element.size() > _MAX_TERMS:
        return element
    element = _rationalized(field, element)
    angles = angles_of(field, element.denominator)
    shared = [g for g in angles if _may_cancel(field, element, g)]
    if not shared:
        return element
    shorter = _in_half_angles(field, element, shared)
    return shorter if shorter.size() <= element.size() else element


def _rationalized(field: FractionField, element: Element) -> Element:
    """Multiply by the conjugate of a + b*sqrt(P) where that makes the fraction shorter.

    Of a number P, also where only the denominator is: 9/(1 + 2 sqrt(7)) = (2 sqrt(7) - 1)/3.
    """
    ring = field.ring
    for index in ring.used(element.denominator):
        generator = field.generators[index]
        if generator.kind != "root" or generator.index != 2:
            continue
        below = ring.lift(element.denominator)
        root = ring.generator(index)
        slope = ring.derivative(below, index)  # below = a + b*root
        conjugate = field.element(below - 2 * slope * root, ring.one).numerator
        other = field.element(
            ring.lift(element.numerator) * conjugate, below * ring.lift(conjugate)
        )
        fewer = len(other.denominator) < len(element.denominator)
        allowed = element.size() + (fewer and generator.expression.is_number)
        if other.size() < allowed:
            element = field.lifted(other)
    return element


def _may_cancel(field: FractionField, element: Element, cosine: int) -> bool:
    """Whether both have a common factor in t where everything else is a random number.

    They are taken modulo a large prime: a common factor is never missed there, and one
    that is not common is found with a probability of 1e-18.
    """
    source = random.Random(cosine)
    values: dict[int, int] = {}
    for index, generator in enumerate(field.generators):
        if generator.kind == "cos":
            t = source.randrange(_PRIME)
            scale = pow(1 + t * t, -1, _PRIME)
            values[index] = (1 - t * t) * scale % _PRIME
            values[index + 1] = 2 * t * scale % _PRIME
        elif index not in values:
            values[index] = source.randrange(_PRIME)
    degree = max(
        degree_in_angle(field, p, cosine) for p in (element.numerator, element.denominator)
    )
    polys = []
    for poly in (element.numerator, element.denominator):
        sums: dict[tuple[int, int], int] = {}
        for monomial, coefficient in field.ring.terms(poly):
            c = s = 0
            value = coefficient
            for g, e in monomial:
                if g == cosine:
                    c = e
                elif g == cosine + 1:
                    s = e
                else:
                    value = value * pow(values[g], e, _PRIME) % _PRIME
            sums[c, s] = (sums.get((c, s), 0) + value) % _PRIME
        minus, plus, twice = (
            nmod_poly([1, 0, -1], _PRIME),
            nmod_poly([1, 0, 1], _PRIME),
            nmod_poly([0, 2], _PRIME),
        )
        total = nmod_poly([0], _PRIME)
        for (c, s), value in sums.items():
            total += minus**c * twice**s * plus ** (degree - c - s) * value
        polys.append(total)
    return bool(polys[0].gcd(polys[1]).degree() > 0)


def _in_half_angles(field: FractionField, element: Element, angles: Sequence[int]) -> Element:
    """Cancel in t = tan(angle/2); the slot of the sine stands for t meanwhile."""
    above, below = element.numerator, element.denominator
    for cosine in angles:
        degree = max(degree_in_angle(field, p, cosine) for p in (above, below))
        above, below = (to_half_angle(field, p, cosine, degree) for p in (above, below))
    common = above.gcd(below)
    above, below = above / common, below / common
    for cosine in angles:
        t = cosine + 1
        degree = (max(field.ring.degree(p, t) for p in (above, below)) + 1) // 2
        above, below = (from_half_angle(field, p, cosine, degree) for p in (above, below))
    return field.element(above, below)
