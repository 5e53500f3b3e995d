"""What a formula will look like and how many operations it shows, before it is written."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from lagcli.algebra.shaping.atoms import Atoms, Coefficient, Exponent
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression
from lagcli.notation.ordering import Factor
from lagcli.record import record

#: One operation less is worth brackets around this many operations.
OPERATION = 6
_HALF = Fraction(1, 2)
#: A fraction inside brackets is worth that many bracketed operations.
_FRACTION = 3
#: A fraction in a denominator, or in a sum over a sum, is written only where nothing else is
#: possible: a/(b + c/d) is a*d/(b*d + c).
_NESTED = 10_000


@record
class PlannedProduct:
    """coefficient * prod part^exponent; a part is an atom or a sum.

    `cost` is the number of operations shown, `strain` that of operations inside
    brackets, counted once for every bracket around them.
    """

    coefficient: Coefficient
    parts: tuple[tuple[int | PlannedSum, Exponent], ...]
    cost: int
    strain: int
    #: Whether a fraction occurs that no function holds.
    fractional: bool = False

    @property
    def score(self) -> int:
        """What is to be least: a short formula, but not at the price of nested brackets."""
        return OPERATION * self.cost + self.strain

    def negated(self) -> PlannedProduct:
        """The product with the other sign."""
        cost = self.cost + (1 if self.coefficient.numerator > 0 else -1)
        return PlannedProduct(-self.coefficient, self.parts, cost, self.strain, self.fractional)


@record
class PlannedSum:
    """A sum of products."""

    terms: tuple[PlannedProduct, ...]
    cost: int
    strain: int
    fractional: bool = False

    @property
    def score(self) -> int:
        """As for a product."""
        return OPERATION * self.cost + self.strain

    def negated(self) -> PlannedSum:
        """The sum with the other sign."""
        terms = tuple(t.negated() for t in self.terms)
        return total(list(terms))

    def negatives(self) -> int:
        """How many terms have a minus sign."""
        return sum(t.coefficient.numerator < 0 for t in self.terms)


def product(
    atoms: Atoms, coefficient: Coefficient, parts: list[tuple[int | PlannedSum, Exponent]]
) -> PlannedProduct:
    """The product, its signs put where fewest are needed, and its cost."""
    signed: list[tuple[int | PlannedSum, Exponent]] = []
    best = -1
    gain = 0
    for part, exponent in parts:
        if isinstance(part, PlannedSum) and exponent % 2 == 1:
            count, minus = len(part.terms), part.negatives()
            if 2 * minus > count:
                part, coefficient, minus = part.negated(), -coefficient, count - minus
            if count - 2 * minus < 1 + (len(parts) == 1) and gain == 0:
                # turning this sum round costs less than the sign of the product
                best, gain = len(signed), 1
        elif (
            isinstance(part, PlannedSum)
            and exponent % 2 == 0
            and 2 * part.negatives() > len(part.terms)
        ):
            part = part.negated()
        signed.append((part, exponent))
    if coefficient.numerator < 0 and best >= 0:
        part, exponent = signed[best]
        assert isinstance(part, PlannedSum)
        signed[best] = (part.negated(), exponent)
        coefficient = -coefficient
    over_sum = any(e < 0 and isinstance(p, PlannedSum) for p, e in signed)
    if coefficient.denominator != 1 and not over_sum:
        coefficient = _halved(atoms, coefficient, signed)
    above = below = cost = strain = 0
    fractional = coefficient.denominator != 1
    for part, exponent in signed:
        size = abs(exponent)
        if isinstance(part, PlannedSum):
            cost += part.cost
            strain += part.cost + part.strain
            fractional = fractional or part.fractional
            if part.fractional:
                strain += _NESTED if over_sum else _FRACTION
        else:
            cost += atoms.costs[part]
        if size != 1:
            cost += 1 if isinstance(size, int) or size == _HALF else 2
        if exponent > 0:
            above += 1
        else:
            below += 1
            fractional = True
    above += abs(coefficient.numerator) != 1 or not above
    below += coefficient.denominator != 1
    cost += above - 1 + below + (coefficient.numerator < 0)
    return PlannedProduct(coefficient, tuple(signed), cost, strain, fractional)


def _halved(
    atoms: Atoms, coefficient: Coefficient, parts: list[tuple[int | PlannedSum, Exponent]]
) -> Coefficient:
    """(a + 2*b)/2 as a/2 + b where that shows less; the sum in `parts` is replaced.

    Above a denominator a sum stays free of fractions: (a + 2*b)/(2*c).  So does one that would
    have different numbers below: (2*a + 3*b)/6.
    """
    below, over = coefficient.denominator, any(e < 0 for _, e in parts)
    for position, (part, exponent) in enumerate(parts):
        if not isinstance(part, PlannedSum) or exponent != 1 or (over and not part.fractional):
            continue
        before = sum(abs(t.coefficient) != 1 for t in part.terms)
        divided = [Fraction(t.coefficient) / below for t in part.terms]
        after = sum((abs(x.numerator) != 1) + (x.denominator != 1) for x in divided)
        if after < before + 1 and len({x.denominator for x in divided} - {1}) == 1:
            pairs = zip(divided, part.terms, strict=True)
            terms = [product(atoms, x, list(t.parts)) for x, t in pairs]
            parts[position] = (total(terms), exponent)
            return coefficient * below
    return coefficient


def total(terms: list[PlannedProduct]) -> PlannedSum:
    """The sum of two or more products."""
    cost = sum(t.cost for t in terms) + len(terms) - 1
    fractional = any(t.fractional for t in terms)
    return PlannedSum(tuple(terms), cost, sum(t.strain for t in terms), fractional)


def cleared(atoms: Atoms, plan: PlannedSum) -> tuple[Fraction, PlannedSum]:
    """(c, S) with c S the sum, no numbers below in S: 1/2 and cos(2x) - 3 of cos(2x)/2 - 3/2."""
    if not plan.fractional:
        return Fraction(1), plan
    pairs = [_cleared_parts(atoms, term) for term in plan.terms]
    common = lcm(*(number.denominator for number, _ in pairs))
    terms = [product(atoms, number * common, parts) for number, parts in pairs]
    return Fraction(1, common), total(terms)


def _cleared_parts(
    atoms: Atoms, term: PlannedProduct
) -> tuple[Fraction, list[tuple[int | PlannedSum, Exponent]]]:
    """The number before a term and its parts, every bracket in it cleared."""
    number, parts = Fraction(term.coefficient), []
    for part, exponent in term.parts:
        if isinstance(part, PlannedSum) and isinstance(exponent, int):
            factor, part = cleared(atoms, part)
            number *= factor**exponent
        parts.append((part, exponent))
    return number, parts


def write(plan: PlannedProduct | PlannedSum, atoms: Atoms, writer: Writer) -> Expression:
    """The tree of a plan."""
    if isinstance(plan, PlannedSum):
        return writer.sum([write(t, atoms, writer) for t in plan.terms])
    factors: list[Factor] = [
        (atoms.trees[part] if isinstance(part, int) else write(part, atoms, writer), Fraction(e))
        for part, e in plan.parts
    ]
    return writer.product(Fraction(plan.coefficient), factors)
