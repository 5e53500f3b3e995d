"""Sums of fractions as the file has them: x²/a⁴ + y²/b⁴ for (b⁴ x² + a⁴ y²)/(a⁴ b⁴).

A file that writes an ellipsoid as x²/a² + y²/b² + z²/c² = 1 is answered with the sums of Jacobi's
geodesics, in which no axis stands out.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction

from lagcli.expression import (
    ONE,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    length,
    power_of,
    quotient_of,
    walk,
)
from lagcli.notation.factors import parts_of, product_of_powers, whole_power
from lagcli.notation.ordering import Ordering
from lagcli.rewriting import rebuilt

_MOST = 6  # terms of such a sum
_Term = tuple[Fraction, Counter[Expression]]


class GivenFractions:
    """The letters by which the file divides the terms of a sum, each by another one.

    Parameters
    ----------
    formulas
        Of the file.
    ordering
        Of the factors of a product.
    """

    def __init__(self, formulas: Iterable[Expression], ordering: Ordering) -> None:
        self._ordering = ordering
        self._letters: set[Expression] = set()
        for part in (part for node in formulas for part in walk(node)):
            letters = [*_divisors(part)] if isinstance(part, Sum) else []
            if len(letters) > 1 and len(set(letters)) == len(letters):
                self._letters.update(letters)

    def __call__(self, node: Expression) -> Expression:
        """The formula with such sums where it is shorter."""
        if not self._letters:
            return node
        if isinstance(node, (Product, Quotient)):
            shown = self._product(node)
            node = shown if length(shown) < length(node) else node
        return rebuilt(node, self)

    def _product(self, node: Expression) -> Expression:
        minus, above, below = parts_of(node)
        outside, sums = Counter[Expression](), list[list[Expression]]([[], []])
        number = Fraction(1)
        for side, sign, factors in (0, 1, above), (1, -1, below):
            for factor in factors:
                base, exponent = whole_power(factor)
                found = self._fractions(base) if isinstance(base, Sum) else None
                if found is not None:
                    times, inner = found
                    outside.update({b: sign * exponent * e for b, e in times.items()})
                    sums[side].append(power_of(inner, exponent))
                elif isinstance(base, Number):
                    number *= base.value ** (sign * exponent)
                elif isinstance(base, Name):
                    outside[base] += sign * exponent
                else:
                    sums[side].append(factor)
        if not any(isinstance(f, (Sum, Power)) for factors in sums for f in factors):
            return node
        _, over, under = parts_of(
            product_of_powers(number, {b: e for b, e in outside.items() if e}, self._ordering)
        )
        over = [] if over == [ONE] and sums[0] else over
        whole = quotient_of([*over, *sums[0]], [*under, *sums[1]])
        return Negative(whole) if minus ^ (number < 0) else whole

    def _fractions(self, node: Sum) -> tuple[Counter[Expression], Sum] | None:
        """The letters before the sum, and the sum with each term over one other letter."""
        terms = [*_expanded(node)]
        if not 1 < len(terms) <= _MOST:
            return None
        letters = {b for _, powers in terms for b in powers if b in self._letters}
        most = Counter({b: max(powers[b] for _, powers in terms) for b in letters})
        found, divided = list[Expression](), list[Expression]()
        for number, powers in terms:
            left = {b: e - most[b] for b, e in powers.items() if e != most[b]}
            left |= {b: -most[b] for b in letters if b not in powers}
            under = [b for b, e in left.items() if b in letters]
            if len(under) != 1:
                return None
            divided += under
            found.append(product_of_powers(number, left, self._ordering))
        if len(set(divided)) != len(divided):
            return None
        return most, Sum(tuple(sorted(found, key=self._ordering.term)))


def _divisors(node: Sum) -> Iterator[Expression]:
    """The letters below the terms that have one each."""
    for term in node.terms:
        _, _, below = parts_of(term)
        names = {whole_power(factor)[0] for factor in below}
        if len(names) == 1 and isinstance(next(iter(names)), Name):
            yield names.pop()


def _expanded(node: Expression) -> Iterator[_Term]:
    """The terms of a sum, those of inner sums multiplied out."""
    for term in node.terms if isinstance(node, Sum) else (node,):
        minus, above, below = parts_of(term)
        number, powers = Fraction(-1 if minus else 1), Counter[Expression]()
        inner = [f for f in above if isinstance(f, Sum)]
        for sign, factors in (1, above), (-1, below):
            for base, exponent in map(whole_power, factors):
                if isinstance(base, Number):
                    number *= base.value ** (sign * exponent)
                elif base not in inner:
                    powers[base] += sign * exponent
        if len(inner) != 1:
            powers.update(inner)
            yield number, powers
            continue
        for times, others in _expanded(inner[0]):
            both = Counter(powers)
            both.update(others)
            yield number * times, both
