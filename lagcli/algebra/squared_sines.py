"""Factors c - 1 and c + 1 as one: c² - 1 is -sin² of a cosine, sinh² of a cosh."""

from __future__ import annotations

from lagcli.algebra.field import FractionField
from lagcli.algebra.ring import Poly, factorization


def factors_and_sines(
    field: FractionField, poly: Poly
) -> tuple[int, list[tuple[Poly, int]], list[tuple[int, int]]]:
    """Content, the other irreducible factors, and the generators s of s² with their exponents."""
    ring = field.ring
    content, found = factorization(poly)
    number, factors = int(content), [(ring.lift(f), int(e)) for f, e in found]
    sines: list[tuple[int, int]] = []
    for g in sorted({g for factor, _ in factors for g in ring.used(factor)}):
        generator, cosine = field.generators[g], ring.generator(g)
        if generator.kind not in ("cos", "cosh"):
            continue
        ends = [cosine - ring.one, cosine + ring.one]
        pairs = min(next((e for f, e in factors if f == end), 0) for end in ends)
        if pairs:
            number *= (-1) ** pairs if generator.kind == "cos" else 1
            factors = [(f, e - pairs if f in ends else e) for f, e in factors]
            factors = [(f, e) for f, e in factors if e]
            sines.append((generator.partner, pairs))
    return number, factors, sines
