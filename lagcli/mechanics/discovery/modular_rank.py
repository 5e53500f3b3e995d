"""The rank of rows of polynomials modulo primes, at random values and where a factor vanishes.

A rank that falls at a random point of the factor's zeros falls at all of them but for a set
of lower dimension (Schwartz, J. ACM 27 (1980) 701).
"""

from __future__ import annotations

import random
from collections.abc import Collection, Mapping, Sequence

from flint import nmod_mat, nmod_poly

from lagcli.algebra.ring import Poly
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import (
    PRIME,
    ModularPoints,
    Terms,
    evaluated,
    linear_root,
    pivot_columns,
)

#: Entries by column.
Row = dict[int, Poly]

#: Others, at which a factor of the numbers alone may have a zero that it has not at the first.
_PRIMES = (PRIME, *(2**61 - k for k in (1, 31, 45, 229, 259, 283, 339)))
_DRAWS = 16


class ModularRank:
    """The rank of one set of rows in the ring of the constants.

    Parameters
    ----------
    points
        The values of the constants.
    rows, width
        The matrix.
    allowed
        Raises TooMuchWork.
    """

    def __init__(
        self, points: ModularPoints, rows: Sequence[Row], width: int, allowed: Allowance
    ) -> None:
        self.points = points
        self.ring = points.field.ring
        self.width = width
        self.allowed = allowed
        self._rows = [{k: points.terms(x) for k, x in row.items()} for row in rows]
        self._source = random.Random("lagcli rank")
        used = {g for row in rows for x in row.values() for g in self.ring.used(x)}
        self._primes = _PRIMES if all(map(self._is_free, used)) else (PRIME,)
        matrix = self._matrix(self._rows, points.constants, PRIME)
        transposed = [list(column) for column in zip(*matrix, strict=True)]
        self._basis = [self._rows[k] for k in pivot_columns(transposed)] if transposed else []

    def is_lower_at(self, factor: Poly) -> bool:
        """Whether the rank is lower where the factor vanishes; True where no zero was found."""
        zero = self._zero(factor)
        return zero is None or self._is_lower(zero)

    def is_lower_at_both(self, one: Poly, other: Poly) -> bool:
        """Whether the rank is lower where both factors vanish; False where no zero was found."""
        for first, second in ((one, other), (other, one)):
            zero = self._zero(first)
            last = self._zero(second, zero, self.ring.used(first)) if zero else None
            if last is not None:
                return self._is_lower(last)
        return False

    def _is_lower(self, zero: tuple[dict[int, int], int]) -> bool:
        rank = len(self._basis)
        return self._rank(self._basis, *zero) < rank and self._rank(self._rows, *zero) < rank

    def _rank(
        self, rows: Sequence[Mapping[int, Terms]], values: Mapping[int, int], prime: int
    ) -> int:
        self.allowed.spend(len(rows) * self.width**2 // 700)
        return int(nmod_mat(self._matrix(rows, values, prime), prime).rank())

    def _matrix(
        self, rows: Sequence[Mapping[int, Terms]], values: Mapping[int, int], prime: int
    ) -> list[list[int]]:
        matrix = [[0] * self.width for _ in rows]
        for dense, row in zip(matrix, rows, strict=True):
            for k, terms in row.items():
                dense[k] = evaluated(terms, values, prime)
        return matrix

    # -- zeros of a factor ----------------------------------------------------------------------

    def _zero(
        self,
        factor: Poly,
        given: tuple[dict[int, int], int] | None = None,
        kept: Collection[int] = (),
    ) -> tuple[dict[int, int], int] | None:
        """Values of the constants at which it vanishes, and the prime.

        It is solved for a symbol on which no other generator depends; with the values that are
        `given` for none of those `kept`.
        """
        for g in filter(self._is_free, set(self.ring.used(factor)) - set(kept)):
            parts = self.ring.coefficients(factor, g)
            terms = {k: self.points.terms(x) for k, x in parts.items()}
            powers = range(max(terms, default=0) + 1)
            for draw in range(1 if given else _DRAWS):
                prime = self._primes[draw % len(self._primes)]
                values = self._drawn() if draw else dict(self.points.constants)
                if given is not None:
                    values, prime = given
                numbers = [evaluated(terms.get(k, []), values, prime) for k in powers]
                root = linear_root(nmod_poly(numbers, prime))
                if root is not None:
                    return {**values, g: root}, prime
        return None

    def _is_free(self, g: int) -> bool:
        generators = self.points.field.generators
        symbol = generators[g].expression
        return generators[g].kind == "symbol" and not any(
            symbol in other.expression.free_symbols
            for k, other in enumerate(generators)
            if k != g and self.points.constant[k]
        )

    def _drawn(self) -> dict[int, int]:
        """Other values of the symbols that stand for themselves."""
        return {
            k: self._source.randrange(2, PRIME - 2) if self._is_free(k) else value
            for k, value in self.points.constants.items()
        }
