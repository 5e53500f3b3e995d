"""What a formula will look like and how many operations it shows, before it is written."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from lagcli.algebra.shaping.atoms import Atoms, Exponent
from lagcli.algebra.writing import Factor, Writer
from lagcli.expression import Expression


@dataclass(frozen=True, slots=True)
class Product:
    """coefficient * prod part^exponent; a part is an atom or a sum."""

    coefficient: Fraction
    parts: tuple[tuple[int | Sum, Exponent], ...]
    cost: int

    def negated(self) -> Product:
        """The product with the other sign."""
        cost = self.cost + (1 if self.coefficient > 0 else -1)
        return Product(-self.coefficient, self.parts, cost)


@dataclass(frozen=True, slots=True)
class Sum:
    """A sum of products."""

    terms: tuple[Product, ...]
    cost: int

    def negated(self) -> Sum:
        """The sum with the other sign."""
        terms = tuple(t.negated() for t in self.terms)
        return Sum(terms, self.cost + sum(t.cost for t in terms) - sum(t.cost for t in self.terms))

    def negatives(self) -> int:
        """How many terms have a minus sign."""
        return sum(t.coefficient < 0 for t in self.terms)


def product(
    atoms: Atoms, coefficient: Fraction, parts: list[tuple[int | Sum, Exponent]]
) -> Product:
    """The product, its signs put where fewest are needed, and its cost."""
    signed: list[tuple[int | Sum, Exponent]] = []
    best = -1
    gain = 0
    for part, exponent in parts:
        if isinstance(part, Sum) and exponent % 2 == 1:
            count, minus = len(part.terms), part.negatives()
            if 2 * minus > count:
                part, coefficient, minus = part.negated(), -coefficient, count - minus
            if count - 2 * minus < 1 and gain == 0:
                # turning this sum round costs less than the sign of the product
                best, gain = len(signed), 1
        elif isinstance(part, Sum) and exponent % 2 == 0 and 2 * part.negatives() > len(part.terms):
            part = part.negated()
        signed.append((part, exponent))
    if coefficient < 0 and best >= 0:
        part, exponent = signed[best]
        assert isinstance(part, Sum)
        signed[best] = (part.negated(), exponent)
        coefficient = -coefficient
    above = below = cost = 0
    for part, exponent in signed:
        size = abs(exponent)
        cost += atoms.costs[part] if isinstance(part, int) else part.cost
        if size != 1:
            cost += 1 if size.denominator == 1 or size == Fraction(1, 2) else 2
        if exponent > 0:
            above += 1
        else:
            below += 1
    above += abs(coefficient.numerator) != 1 or not above
    below += coefficient.denominator != 1
    cost += above - 1 + below + (coefficient < 0)
    return Product(coefficient, tuple(signed), cost)


def total(terms: list[Product]) -> Sum:
    """The sum of two or more products."""
    return Sum(tuple(terms), sum(t.cost for t in terms) + len(terms) - 1)


def write(plan: Product | Sum, atoms: Atoms, writer: Writer) -> Expression:
    """The tree of a plan."""
    if isinstance(plan, Sum):
        return writer.sum([write(t, atoms, writer) for t in plan.terms])
    factors: list[Factor] = [
        (atoms.trees[part] if isinstance(part, int) else write(part, atoms, writer), Fraction(e))
        for part, e in plan.parts
    ]
    return writer.product(plan.coefficient, factors)
