"""Polynomials in sin and cos as polynomials in t = tan(angle/2), and back.

    cos = (1 − t²)/(1 + t²),   sin = 2t/(1 + t²).

The slot of the sine stands for t meanwhile.
"""

from __future__ import annotations

from lagcli.algebra.field import FractionField
from lagcli.algebra.ring import Poly


def angles_of(field: FractionField, poly: Poly) -> list[int]:
    """The generators that are the cosines of the angles that occur, ascending."""
    found = set()
    for g in field.ring.used(poly):
        generator = field.generators[g]
        if generator.kind in ("cos", "sin"):
            found.add(g if generator.kind == "cos" else generator.partner)
    return sorted(found)


def degree_in_angle(field: FractionField, poly: Poly, cosine: int) -> int:
    """The degree in sin and cos of one angle together."""
    return max(
        sum(e for g, e in monomial if g in (cosine, cosine + 1))
        for monomial, _ in field.ring.terms(poly)
    )


def to_half_angle(field: FractionField, poly: Poly, cosine: int, degree: int) -> Poly:
    """(1 + t²)^degree times the polynomial."""
    ring = field.ring
    t = ring.generator(cosine + 1)
    result = ring.zero
    for (c, s), rest in _split(field, poly, (cosine, cosine + 1)).items():
        result += rest * (1 - t * t) ** c * (2 * t) ** s * (1 + t * t) ** (degree - c - s)
    return result


def from_half_angle(field: FractionField, poly: Poly, cosine: int, degree: int) -> Poly:
    """2^degree (1 + t²)^-degree times the polynomial in t.

    t²/(1 + t²) = (1 − cos)/2, 1/(1 + t²) = (1 + cos)/2, t/(1 + t²) = sin/2.
    """
    ring = field.ring
    c, s = ring.generator(cosine), ring.generator(cosine + 1)
    result = ring.zero
    for (power,), rest in _split(field, poly, (cosine + 1,)).items():
        half, odd = divmod(power, 2)
        result += rest * (1 - c) ** half * (1 + c) ** (degree - odd - half) * s**odd
    return result


def _split(
    field: FractionField, poly: Poly, generators: tuple[int, ...]
) -> dict[tuple[int, ...], Poly]:
    """The coefficients of the powers of some generators."""
    groups: dict[tuple[int, ...], list[tuple[tuple[tuple[int, int], ...], int]]] = {}
    for monomial, coefficient in field.ring.terms(poly):
        exponents = dict(monomial)
        key = tuple(exponents.get(g, 0) for g in generators)
        rest = tuple(pair for pair in monomial if pair[0] not in generators)
        groups.setdefault(key, []).append((rest, coefficient))
    return {key: field.ring.build(terms) for key, terms in groups.items()}
