"""Remainders modulo an ideal, by a Gröbner basis in an order of one's choice.

The rules of the ring (sin² + cos² = 1, roots) belong to the ideal.  The basis is
completed by Buchberger's algorithm within bounds; where these end it early, a remainder
of 0 still proves membership.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from math import lcm
from operator import itemgetter

from flint import Ordering, fmpq_mpoly_ctx

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Poly

_MAX_BASIS = 24  # measured: up to 25
_MAX_TERMS = 60  # measured: up to 278
#: Of the degrees of the given polynomials, in a basis: completed without it, two products of two
#: factors went to degree 101 and took minutes.
_MAX_GROWTH = 4
_MAX_PAIRS = 120
#: Of a coefficient: up to 5 in the library.  Three products of two factors came to 464, whose
#: remainders have 38,000: the answer took 52 s, within this bound 8 s.
_MAX_BITS = 60
_SHORT = 20  # terms of a polynomial whose remainder is found anew each time
_RECENT = 8  # others whose remainders are kept


class Ideal:
    """The ideal of some polynomials and of the ring's rules.

    Parameters
    ----------
    generators
        Generators of the ring by falling rank; the others rank below, as constants do.
    """

    def __init__(self, field: Field, polys: Sequence[Poly], generators: Sequence[int]) -> None:
        self.field = field
        self._ranked = list(generators)
        #: The generators that occur in the polynomials, a cosine with its sine.
        self.inside: set[int] = set()
        for poly in polys:
            for number in field.ring.used(poly):
                partner = field.generators[number].partner
                self.inside.update((number, partner) if partner >= 0 else (number,))
        self._open()
        ring = field.ring
        rules = [rule for _, rule in (*ring.rules.values(), *ring.mixed)]
        self.basis = _completed([self._inside(p) for p in [*polys, *rules]])
        self._leading = [
            {n: int(e) for n, e in zip(self._order, b.monomial(0), strict=True) if e}
            for b in self.basis
        ]

    def remainder(self, poly: Poly) -> Element:
        """The remainder of a polynomial."""
        poly = self.field.ring.lift(poly)
        if self.field.ring.capacity != self._capacity:
            self._open()
            self.basis = [b.project_to_context(self.context) for b in self.basis]
        known = next((rest for other, rest in self._recent if other == poly), None)
        if known is None:
            known = self._outside(_remainder(self._inside(poly), self.basis))
            if len(poly) > _SHORT:
                self._recent.append((poly, known))
        return known

    @property
    def is_whole(self) -> bool:
        """Whether 1 is seen to be in it, for general values of what ranks below."""
        return any(not leading.keys() & {*self._ranked} for leading in self._leading)

    def touches(self, poly: Poly) -> bool:
        """Whether some term is divisible by a leading term: else it is its own remainder."""
        for monomial, _ in self.field.ring.terms(poly):
            exponents = dict(monomial)
            for leading in self._leading:
                if all(exponents.get(n, 0) >= e for n, e in leading.items()):
                    return True
        return False

    def _open(self) -> None:
        ring = self.field.ring
        self._capacity = ring.capacity
        self._recent: deque[tuple[Poly, Element]] = deque(maxlen=_RECENT)
        rest = [n for n in reversed(range(ring.capacity)) if n not in self._ranked]
        self._order = [*self._ranked, *rest]
        self.context = fmpq_mpoly_ctx.get([f"g{n}" for n in self._order], Ordering.lex)
        last = ring.capacity - 1
        self._permuted = itemgetter(*(last - n for n in self._order), 0)
        place = {n: position for position, n in enumerate(self._order)}
        self._restored = itemgetter(*(place[last - i] for i in range(ring.capacity)), 0)

    def _inside(self, poly: Poly) -> Poly:
        """The polynomial in the order of the ideal."""
        terms = self.field.ring.lift(poly).to_dict()
        permuted = self._permuted
        return self.context.from_dict({permuted(e)[:-1]: c for e, c in terms.items()})

    def _outside(self, poly: Poly) -> Element:
        terms = poly.to_dict()
        common = lcm(*(int(c.q) for c in terms.values())) if terms else 1
        ring, restored = self.field.ring, self._restored
        above = ring.context.from_dict(
            {restored(e)[:-1]: int(c.p) * (common // int(c.q)) for e, c in terms.items()}
        )
        return self.field.element(above, ring.constant(common))


def _remainder(poly: Poly, basis: Sequence[Poly]) -> Poly:
    """The remainder by all of the basis."""
    before = None
    while poly not in (before, 0):
        before = poly
        for divisor in basis:
            poly = poly % divisor
    return poly


def _completed(polys: Sequence[Poly]) -> list[Poly]:
    """A Gröbner basis, or as much of one as the bounds allow."""
    basis: list[Poly] = []
    pairs: deque[tuple[Poly, Poly]] = deque()

    def add(poly: Poly) -> None:
        poly = poly / poly.leading_coefficient()
        pairs.extend((other, poly) for other in basis)
        basis.append(poly)

    for poly in polys:
        rest = _remainder(poly, basis)
        if rest != 0:
            add(rest)
    highest = _MAX_GROWTH * max((poly.total_degree() for poly in basis), default=0)
    for _ in range(_MAX_PAIRS):
        if not pairs or len(basis) > _MAX_BASIS:
            break
        left, right = pairs.popleft()
        if _coprime(left, right):
            continue
        rest = _remainder(_difference(left, right), basis)
        if rest == 0 or len(rest) > _MAX_TERMS or rest.total_degree() > highest:
            continue
        if _bits(rest / rest.leading_coefficient()) <= _MAX_BITS:
            add(rest)
    return _interreduced(basis)


def _bits(poly: Poly) -> int:
    """The bits of its longest coefficient, both parts of the fraction counted."""
    return max(int(c.p).bit_length() + int(c.q).bit_length() for c in poly.coeffs())


def _difference(left: Poly, right: Poly) -> Poly:
    """The S-polynomial, in which the leading terms cancel."""
    a, b = left.monomial(0), right.monomial(0)
    top = tuple(map(max, a, b))
    context = left.context()
    first = context.from_dict({tuple(t - e for t, e in zip(top, a, strict=True)): 1})
    second = context.from_dict({tuple(t - e for t, e in zip(top, b, strict=True)): 1})
    return first * left - second * right


def _coprime(left: Poly, right: Poly) -> bool:
    """Buchberger's first criterion: the S-polynomial then reduces to 0."""
    pairs = zip(left.monomial(0), right.monomial(0), strict=True)
    return not any(a and b for a, b in pairs)


def _interreduced(basis: list[Poly]) -> list[Poly]:
    """The basis without members whose leading monomial another one divides."""
    kept: list[Poly] = []
    for position, poly in enumerate(basis):
        top = poly.monomial(0)
        others = [*kept, *basis[position + 1 :]]
        if not any(all(map(int.__le__, map(int, o.monomial(0)), map(int, top))) for o in others):
            kept.append(poly)
    return [_remainder(p, [o for o in kept if o is not p]) for p in kept]
