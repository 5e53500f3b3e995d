"""Polynomials that are positive because their mixed terms are paid for by squares.

2 u v <= u² + v², so that each term c x^α of unknown sign is outweighed by two terms p x^β, q x^γ
that are not negative, where |x^α|² <= x^β x^γ and c² <= 4 p q: the way in which m (R - b)² + I
and M² + m² - 2 M m cos(θ) are positive.  A sine or cosine in x^α counts as 1.  (Polynomials
with diagonally dominant Gram matrix: A. Ahmadi, A. Majumdar, SIAM J. Appl. Algebra Geom. 3
(2019) 193, section 3.)
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import product

from lagcli.algebra.entry import Field
from lagcli.algebra.ring import Poly

#: Terms of a polynomial beyond which none is looked for.
_MOST_TERMS = 40

_Monomial = tuple[tuple[int, int], ...]


def sign_by_squares(field: Field, poly: Poly) -> tuple[int, bool] | None:
    """(1, True) for what is positive, (1, False) for what may be 0 too; -1 likewise; or None."""
    terms = [(tuple(m), Fraction(c)) for m, c in field.ring.terms(poly)]
    if len(terms) > _MOST_TERMS:
        return None
    for value in (1, -1):
        strict = _outweighed(field, {m: value * c for m, c in terms})
        if strict is not None:
            return value, strict
    return None


def _outweighed(field: Field, terms: dict[_Monomial, Fraction]) -> bool | None:
    """Whether squares outweigh the rest strictly; None where they do not at all."""
    paying = {m: c for m, c in terms.items() if c > 0 and _is_nonnegative(field, m)}
    owing = {m: abs(c) for m, c in terms.items() if m not in paying}
    for monomial, size in owing.items():
        if not any(_paid(paying, target, size) for target in _bounds(field, monomial)):
            return None
    return any(c > 0 and _is_positive(field, m) for m, c in paying.items())


def _paid(paying: dict[_Monomial, Fraction], target: _Monomial, size: Fraction) -> bool:
    """Take p x^β and q x^γ with β + γ = 2 α and 4 p q >= c² from what is there."""
    doubled = {g: 2 * e for g, e in target}
    for first in [m for m, c in paying.items() if c > 0]:
        rest = {g: doubled.get(g, 0) - dict(first).get(g, 0) for g in {*doubled, *dict(first)}}
        second = tuple(sorted((g, e) for g, e in rest.items() if e))
        if any(e < 0 for _, e in second) or paying.get(second, 0) <= 0:
            continue
        shares = _shares(paying[first], paying[second], size, same=first == second)
        if shares is not None:
            paying[first] -= shares[0]
            paying[second] -= shares[1]
            return True
    return False


def _shares(
    p: Fraction, q: Fraction, size: Fraction, *, same: bool
) -> tuple[Fraction, Fraction] | None:
    """The parts of p and q to take: half each where that is possible."""
    if same:
        return (size, Fraction(0)) if size <= p else None
    half = size / 2
    if half <= p and half <= q:
        return half, half
    if 4 * p * q < size**2:
        return None
    return (p, size**2 / (4 * p)) if p < q else (size**2 / (4 * q), q)


def _bounds(field: Field, monomial: _Monomial) -> Iterator[_Monomial]:
    """Monomials at least as large as |x^α|: sines and cosines left out."""
    choices = [
        (0, 1) if field.generators[g].kind in ("cos", "sin") and e == 1 else (1,)
        for g, e in monomial
    ]
    for kept in product(*choices):
        yield tuple(sorted(p for p, keep in zip(monomial, kept, strict=True) if keep))


def _is_nonnegative(field: Field, monomial: _Monomial) -> bool:
    return all(
        e % 2 == 0 or field.generators[g].expression.is_nonnegative is True for g, e in monomial
    )


def _is_positive(field: Field, monomial: _Monomial) -> bool:
    return _is_nonnegative(field, monomial) and all(
        field.generators[g].expression.is_nonzero is True for g, _ in monomial
    )
