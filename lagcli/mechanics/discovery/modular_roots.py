"""Roots of polynomials modulo the prime, of one or of a few that go together.

Equal numbers of equations and unknowns are taken apart by elimination of their monomials,
those of high degree first: of two circles the difference is linear, and what is left is
quadratic in one unknown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import nmod_mat, nmod_poly

from lagcli.mechanics.discovery.modular import PRIME, Terms, evaluated, linear_root

_Poly = dict[tuple[int, ...], int]  # exponents of the unknowns -> coefficient


def joint_root(
    equations: Sequence[Terms], unknowns: Sequence[int], values: Mapping[int, int]
) -> dict[int, int] | None:
    """Values of the unknowns at which all vanish; None where none was found."""
    found = _solved([_in(terms, unknowns, values) for terms in equations], len(unknowns))
    return None if found is None else dict(zip(unknowns, found, strict=True))


def _in(terms: Terms, unknowns: Sequence[int], values: Mapping[int, int]) -> _Poly:
    poly: _Poly = {}
    for coefficient, monomial in terms:
        exponents = [0] * len(unknowns)
        value = coefficient
        for g, exponent in monomial:
            if g in unknowns:
                exponents[unknowns.index(g)] = exponent
            else:
                value = value * pow(values[g], exponent, PRIME) % PRIME
        key = tuple(exponents)
        poly[key] = (poly.get(key, 0) + value) % PRIME
    return poly


def _solved(equations: list[_Poly], count: int) -> list[int] | None:
    """The unknowns, by linear equations among the combinations first."""
    if count == 1:
        root = _univariate(equations)
        return None if root is None else [root]
    rows = _reduced(equations)
    for row in rows:
        leading = [m for m in row if sum(m) == 1 and row[m]]
        if any(sum(m) > 1 and row[m] for m in row) or not leading:
            continue
        unknown = leading[0].index(1)
        slope = pow(-row[leading[0]] % PRIME, -1, PRIME)
        line = {m: c * slope % PRIME for m, c in row.items() if m != leading[0]}
        others = [_put(other, unknown, line) for other in rows if other is not row]
        rest = _solved(others, count - 1)
        if rest is None:
            return None
        point = [*rest[:unknown], 0, *rest[unknown:]]
        return [*rest[:unknown], _value(line, point), *rest[unknown:]]
    return None


def _reduced(equations: Sequence[_Poly]) -> list[_Poly]:
    monomials = sorted({m for e in equations for m in e}, key=lambda m: (-sum(m), m))
    table, rank = nmod_mat([[e.get(m, 0) for m in monomials] for e in equations], PRIME).rref()
    return [
        {m: int(x) for m, x in zip(monomials, row, strict=True) if int(x)}
        for row in table.table()[:rank]
    ]


def _put(poly: _Poly, unknown: int, line: _Poly) -> _Poly:
    """The polynomial with a linear expression for one unknown, which goes."""
    total: _Poly = {}
    for exponents, coefficient in poly.items():
        power: _Poly = {tuple(0 for _ in exponents): coefficient}
        for _ in range(exponents[unknown]):
            power = _product(power, line)
        rest = tuple(0 if k == unknown else e for k, e in enumerate(exponents))
        for m, c in _product(power, {rest: 1}).items():
            key = (*m[:unknown], *m[unknown + 1 :])
            total[key] = (total.get(key, 0) + c) % PRIME
    return total


def _product(a: _Poly, b: _Poly) -> _Poly:
    result: _Poly = {}
    for m, x in a.items():
        for n, y in b.items():
            key = tuple(i + j for i, j in zip(m, n, strict=True))
            result[key] = (result.get(key, 0) + x * y) % PRIME
    return result


def _value(poly: _Poly, point: Sequence[int]) -> int:
    return evaluated([(c, tuple(enumerate(m))) for m, c in poly.items()], point)


def _univariate(equations: Sequence[_Poly]) -> int | None:
    common = nmod_poly([0], PRIME)
    for equation in equations:
        top = max((m[0] for m in equation), default=0)
        poly = nmod_poly([equation.get((k,), 0) for k in range(top + 1)], PRIME)
        common = common.gcd(poly) if common.degree() >= 0 else poly
    return linear_root(common)
