"""Brackets with momenta, and squares of brackets that occur elsewhere in the formula.

(p_x + q B y/2)/m, not (2 p_x + q B y)/(2 m);
sqrt(p_r² + p_phi²/r² + m² c²), not sqrt(r² (p_r² + m² c²) + p_phi²)/r, for r > 0;
(a − b)² beside a − b.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import gcd

from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    opposite,
    quotient_of,
    walk,
)
from lagcli.notation.factors import parts_of, product_of_powers, whole_power
from lagcli.notation.likeness import Key, parity, signed_key
from lagcli.notation.ordering import Ordering
from lagcli.rewriting import rebuilt

_Powers = dict[Expression, int]


class NamedMomenta:
    """Formulas with momenta as a book writes them.

    Parameters
    ----------
    coordinates, positive
        Names of the coordinates, and of what is positive.
    ordering
        Of factors and terms.
    """

    def __init__(
        self, coordinates: Iterable[str], positive: frozenset[str], ordering: Ordering
    ) -> None:
        self._names = frozenset("p_" + name for name in coordinates)
        self._positive = positive
        self._ordering = ordering

    def occur(self, node: Expression) -> bool:
        """Whether there is a momentum in it."""
        return any(isinstance(part, Name) and part.name in self._names for part in walk(node))

    def turned(self, node: Sum) -> bool | None:
        """Whether the one bare momentum of a difference has the minus; None without one."""
        bare = [t for t in node.terms if self.is_bare(t)]
        others = [t for t in node.terms if t not in bare]
        if len(bare) != 1 or len(others) != 1 or self._ordering.is_parameter(others[0]):
            return None
        if not all(map(self._ordering.is_parameter, parts_of(others[0])[2])):
            return None
        return isinstance(bare[0], Negative)

    def are_subtracted(self, node: Sum) -> bool:
        """Whether momenta occur in what a difference subtracts alone: q B r² − 2 p."""
        match node.terms:
            case (first, Negative(operand=other)):
                return self.occur(other) and not (isinstance(first, Negative) or self.occur(first))
            case _:
                return False

    def is_bare(self, term: Expression) -> bool:
        """Whether it is a momentum, or one with a minus."""
        term = term.operand if isinstance(term, Negative) else term
        return isinstance(term, Name) and term.name in self._names

    def root(self, radicand: Sum) -> Expression:
        """The root of a sum with what all of its terms can be divided by before it."""
        terms = [each for term in radicand.terms for each in self._opened(term)]
        number = self._number(terms)
        letters = [r for r in self._letters(terms) if self._divides(r, terms)]
        if number == 1 and not letters:
            return Call("sqrt", (radicand,))
        below: _Powers = {Name(r): 2 for r in letters}
        inside = [self._divided(term, number, below) for term in terms]
        inside.sort(key=self._ordering.term)
        scale = [Number(Fraction(number))] if number > 1 else []
        return quotient_of([*scale, *map(Name, letters), Call("sqrt", (Sum(tuple(inside)),))], [])

    def product(self, node: Expression) -> Expression:
        """A product with the numbers in front of momenta and the letters of roots cancelled."""
        minus, above, below = parts_of(node)
        number, powers, changed = Fraction(1), dict[Expression, int](), False
        for factors, sign in (above, 1), (below, -1):
            for base, exponent in map(whole_power, factors):
                if isinstance(base, Number):
                    number *= base.value ** (sign * exponent)
                else:
                    changed |= base in powers
                    powers[base] = powers.get(base, 0) + sign * exponent
        over_sum = any(isinstance(base, Sum) and e < 0 for base, e in powers.items())
        for base, exponent in () if over_sum else [*powers.items()]:
            if not isinstance(base, Sum):
                continue
            times = self._before_momentum(base)
            if times > 1 and number.denominator % times**exponent == 0:
                number *= times**exponent
                inner = self._over(base, times)
                powers[self._upright(inner) if exponent % 2 == 0 else inner] = powers.pop(base)
                changed = True
        if not changed:
            return node
        whole = product_of_powers(number, powers, self._ordering)
        return Negative(whole) if minus else whole

    def _opened(self, term: Expression) -> list[Expression]:
        """The terms of r² (a + b), of anything else the term itself."""
        minus, above, below = parts_of(term)
        brackets = [f for f in above if isinstance(f, Sum)]
        others = [whole_power(f) for f in above if not isinstance(f, Sum)]
        letters = all(isinstance(b, Name) and b.name in self._positive for b, _ in others)
        if minus or below or len(brackets) != 1 or not letters or not others:
            return [term]
        rest = [f for f in above if not isinstance(f, Sum)]
        found = []
        for each in brackets[0].terms:
            other, factors, under = parts_of(each)
            whole = quotient_of([*factors, *rest], under)
            found.append(Negative(whole) if other else whole)
        return found

    def _letters(self, terms: Iterable[Expression]) -> list[str]:
        """The positive letters whose squares occur."""
        powers = (whole_power(f) for term in terms for f in parts_of(term)[1])
        names = (b.name for b, e in powers if isinstance(b, Name) and e > 1)
        return [name for name in dict.fromkeys(names) if name in self._positive]

    def _divides(self, letter: str, terms: Iterable[Expression]) -> bool:
        """Whether terms without r² have momenta, and some with r² as well."""
        held: dict[bool, list[bool]] = {True: [], False: []}
        for term in terms:
            powers = dict(map(whole_power, parts_of(term)[1]))
            held[powers.get(Name(letter), 0) > 1].append(self.occur(term))
        return any(held[True]) and all(held[False]) and bool(held[False])

    def _number(self, terms: Iterable[Expression]) -> int:
        """n where each term is n² times a number or a square of n p + f."""
        found = 0
        for term in terms:
            _, above, below = parts_of(term)
            factor = 1
            for base, exponent in map(whole_power, above):
                if isinstance(base, Number) and base.value.denominator == 1:
                    factor *= base.value.numerator
                elif isinstance(base, Sum) and exponent == 2:
                    factor *= self._before_momentum(base) ** 2
            if any(isinstance(f, Number) for f in below):
                return 1
            found = gcd(found, factor)
        return next((n for n in (4, 3, 2) if found % n**2 == 0), 1)

    def _before_momentum(self, node: Sum) -> int:
        """n of n p + f with one momentum p."""
        with_momenta = [term for term in node.terms if self.occur(term)]
        if len(with_momenta) != 1:
            return 1
        match with_momenta[0]:
            case (
                Product(factors=(Number(value=value), Name()))
                | Negative(operand=Product(factors=(Number(value=value), Name())))
            ) if value.denominator == 1:
                return value.numerator
            case _:
                return 1

    def _over(self, node: Sum, number: int) -> Sum:
        """A sum divided by a number, term by term."""
        return Sum(tuple(self._divided_by(term, number) for term in node.terms))

    def _upright(self, node: Sum) -> Sum:
        """p − q A for q A − p, whose square it is."""
        return Sum((*map(opposite, node.terms[::-1]),)) if self.turned(node) else node

    def _divided_by(self, term: Expression, number: int) -> Expression:
        minus, above, below = parts_of(term)
        value = Fraction(1, number)
        for factors, sign in (above, 1), (below, -1):
            for each in factors:
                value *= each.value**sign if isinstance(each, Number) else 1
        rest = [[f for f in factors if not isinstance(f, Number)] for factors in (above, below)]
        if value.numerator != 1 or not rest[0]:
            rest[0].insert(0, Number(Fraction(value.numerator)))
        if value.denominator != 1:
            rest[1].insert(0, Number(Fraction(value.denominator)))
        whole = quotient_of(rest[0], rest[1])
        return Negative(whole) if minus else whole

    def _divided(self, term: Expression, number: int, below: _Powers) -> Expression:
        """The term over number² and the squares of letters."""
        minus, above, under = parts_of(term)
        for place, factor in enumerate(above):
            base, exponent = whole_power(factor)
            if (
                exponent == 2
                and isinstance(base, Sum)
                and self._before_momentum(base) % number == 0
            ):
                inner = self._upright(self._over(base, number))
                above[place] = Power(inner, Number(Fraction(2)))
                number = 1
        powers: _Powers = {}
        for factors, sign in (above, 1), (under, -1):
            for base, exponent in map(whole_power, factors):
                powers[base] = powers.get(base, 0) + sign * exponent
        for base, exponent in below.items():
            powers[base] = powers.get(base, 0) - exponent
        value = Fraction(1, number**2)
        for base in [b for b in powers if isinstance(b, Number)]:
            value *= base.value ** powers.pop(base)
        whole = product_of_powers(value, powers, self._ordering)
        return Negative(whole) if minus else whole


def squares_as_brackets(node: Expression, known: dict[Key, int]) -> Expression:
    """(a − b)² for (b − a)² in a formula that has a − b.

    `known` are the signs of squares that were written before: all rows have the same one.
    """
    signs: dict[Key, int] = {}
    squares = set[Sum]()
    for base, odd in _differences(node):
        if odd:
            sign, key = signed_key(base)
            signs[key] = 0 if signs.get(key, sign) != sign else sign
        else:
            squares.add(base)
    turned = set[Sum]()
    for base in squares:
        sign, key = signed_key(base)
        if known.setdefault(key, signs.get(key) or sign) != sign:
            turned.add(base)
    return _turned(node, turned) if turned else node


def _turned(node: Expression, turned: set[Sum]) -> Expression:
    found = rebuilt(node, lambda part: _turned(part, turned))
    if isinstance(node, Power) and node.base in turned and parity(node.exponent) == 0:
        assert isinstance(found, Power)
        assert isinstance(found.base, Sum)
        return Power(Sum((*map(opposite, found.base.terms[::-1]),)), node.exponent)
    return found


def _differences(node: Expression) -> Iterator[tuple[Sum, bool]]:
    """Every a − b that is a factor, and whether to an odd power."""
    even = set[int]()
    for part in walk(node):
        if isinstance(part, Power) and parity(part.exponent) == 0:
            even.add(id(part.base))
        if isinstance(part, (Product, Quotient, Power)):
            for factor in parts_of(part)[1] if not isinstance(part, Power) else (part.base,):
                if isinstance(factor, Sum) and len(factor.terms) == 2:
                    minus = [isinstance(t, Negative) for t in factor.terms]
                    if minus[0] != minus[1]:
                        yield factor, id(factor) not in even
