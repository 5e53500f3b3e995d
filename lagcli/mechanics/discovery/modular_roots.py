"""Roots of polynomials modulo the prime, of one or of a few that go together.

Equal numbers of equations and unknowns are taken apart by elimination of their monomials,
those of high degree first: of two circles the difference is linear, and what is left is
quadratic in one unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import nmod_mat, nmod_mpoly, nmod_mpoly_ctx, nmod_poly

from lagcli.mechanics.discovery.modular import PRIME, Terms, linear_root


def joint_root(
    equations: Sequence[Terms], unknowns: Sequence[int], values: Mapping[int, int]
) -> dict[int, int] | None:
    """Values of the unknowns at which all vanish; None where none was found."""
    ring = nmod_mpoly_ctx.get([f"x{k}" for k in range(len(unknowns))], PRIME)
    polys = [_in(terms, unknowns, values, ring) for terms in equations]
    found = _solved(polys, [*range(len(unknowns))], ring)
    return None if found is None else {unknown: found[k] for k, unknown in enumerate(unknowns)}


def _in(
    terms: Terms, unknowns: Sequence[int], values: Mapping[int, int], ring: nmod_mpoly_ctx
) -> nmod_mpoly:
    places = dict(zip(unknowns, ring.gens(), strict=True))
    total = ring.constant(0)
    for coefficient, monomial in terms:
        term = ring.constant(coefficient % PRIME)
        for g, exponent in monomial:
            term *= places[g] ** exponent if g in places else pow(values[g], exponent, PRIME)
        total += term
    return total


def _solved(
    equations: list[nmod_mpoly], left: list[int], ring: nmod_mpoly_ctx
) -> dict[int, int] | None:
    """The unknowns that are left, by linear equations among the combinations first."""
    if len(left) == 1:
        root = _univariate(equations, left[0])
        return None if root is None else {left[0]: root}
    rows = _reduced(equations, ring)
    for row in rows:
        linear = [m for m in row.monoms() if sum(m) == 1]
        if not linear or row.total_degree() > 1:
            continue
        leading, gens = min(linear), [*ring.gens()]
        unknown, slope = leading.index(1), pow(-int(row[leading]) % PRIME, -1, PRIME)
        line = gens[unknown] + row * slope
        put_in = [line if k == unknown else x for k, x in enumerate(gens)]
        others = [other.compose(*put_in) for other in rows if other is not row]
        rest = _solved(others, [k for k in left if k != unknown], ring)
        if rest is None:
            return None
        return rest | {unknown: int(line(*(rest.get(k, 0) for k in range(len(gens)))))}
    return None


def _reduced(equations: Sequence[nmod_mpoly], ring: nmod_mpoly_ctx) -> list[nmod_mpoly]:
    monomials = sorted({m for e in equations for m in e.monoms()}, key=lambda m: (-sum(m), m))
    table, rank = nmod_mat([[int(e[m]) for m in monomials] for e in equations], PRIME).rref()
    return [
        ring.from_dict({m: int(x) for m, x in zip(monomials, row, strict=True) if int(x)})
        for row in table.table()[:rank]
    ]


def _univariate(equations: Sequence[nmod_mpoly], unknown: int) -> int | None:
    common = nmod_poly([0], PRIME)
    for equation in equations:
        numbers = {m[unknown]: int(c) for m, c in equation.terms()}
        top = max(numbers, default=0)
        poly = nmod_poly([numbers.get(k, 0) for k in range(top + 1)], PRIME)
        common = common.gcd(poly) if common.degree() >= 0 else poly
    return linear_root(common)
