"""Fractions and letters in brackets: (m g − k l cos θ)/(m l), 2 Ω y' + Ω² x."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Sum,
    operation_count,
    walk,
)
from lagcli.notation.factors import parts_of, product_of_powers, whole_power
from lagcli.notation.ordering import Ordering, accelerates, is_letter, is_rate

_GROWTH = 2  # operations that a sum may have more without an inner bracket
_TERMS = 3  # of such a bracket


@dataclass(slots=True)
class _Monomial:
    """number · Π base^exponent, sqrt(m) of a letter as m^(1/2)."""

    number: Fraction
    powers: dict[Expression, Fraction]

    @classmethod
    def of(cls, node: Expression) -> _Monomial:
        return cls.product(*parts_of(node))

    @classmethod
    def product(
        cls, minus: bool, above: Sequence[Expression], below: Sequence[Expression]
    ) -> _Monomial:
        found = cls(Fraction(-1 if minus else 1), {})
        for factors, sign in (above, 1), (below, -1):
            for factor in factors:
                found.multiply(factor, sign)
        return found

    def multiply(self, factor: Expression, sign: int) -> None:
        base, power = whole_power(factor)
        exponent = Fraction(power)
        if isinstance(base, Number):
            self.number *= base.value ** (sign * power)
            return
        if isinstance(base, Call) and base.function == "sqrt":
            (inner,) = base.arguments
            base, exponent = (inner, exponent / 2) if isinstance(inner, Name) else (base, exponent)
        self.powers[base] = self.powers.get(base, Fraction(0)) + sign * exponent
        if not self.powers[base]:
            del self.powers[base]

    def times(self, other: _Monomial) -> _Monomial:
        powers = dict(self.powers)
        for base, exponent in other.powers.items():
            powers[base] = powers.get(base, Fraction(0)) + exponent
        return _Monomial(self.number * other.number, {b: e for b, e in powers.items() if e})

    def times_sum(self, node: Expression, ordering: Ordering) -> Expression:
        """The product with a sum, or with what it has become."""
        whole = _Monomial(self.number, dict(self.powers))
        whole.multiply(node, 1)
        return whole.written(ordering)

    def written(self, ordering: Ordering) -> Expression:
        powers = dict(self.powers)
        for base, exponent in self.powers.items():
            if exponent.denominator == 2:
                half = Fraction(1, 2) if exponent > 0 else Fraction(-1, 2)
                powers[base] = exponent - half
                powers[Call("sqrt", (base,))] = 2 * half
        return product_of_powers(self.number, {b: e for b, e in powers.items() if e}, ordering)

    def below(self) -> dict[Expression, Fraction]:
        return {base: -e for base, e in self.powers.items() if e < 0}


def products(term: Expression, ordering: Ordering) -> list[Expression]:
    """The terms of a x (b + c/d)/e without its bracket and those within; itself without one."""
    minus, above, below = parts_of(term)
    sums = [factor for factor in above if isinstance(factor, Sum)]
    if len(sums) != 1 or len(above) + len(below) == 1:
        return [term]
    if not any(isinstance(part, Name) for part in walk(sums[0])):  # (2 + sqrt(2)) k
        return [term]
    outside = _Monomial.product(minus, [f for f in above if f is not sums[0]], below)
    parts = [part for each in sums[0].terms for part in products(each, ordering)]
    return [_Monomial.of(part).times(outside).written(ordering) for part in parts]


class Brackets:
    """The inner brackets of products and sums, where a book has one fraction or none.

    Parameters
    ----------
    ordering
        Of factors and terms.
    momenta
        Names of the momenta.
    """

    def __init__(self, ordering: Ordering, momenta: frozenset[str]) -> None:
        self._ordering = ordering
        self._momenta = momenta

    def over_one(self, terms: Sequence[Expression]) -> tuple[Sum, _Monomial] | None:
        """S and 1/d with S/d the sum of the terms, d a product of powers of letters."""
        parts = [_Monomial.of(term) for term in terms]
        below: dict[Expression, Fraction] = {}
        for part in parts:
            for base, exponent in part.below().items():
                below[base] = max(below.get(base, exponent), exponent)
        if not below or any(isinstance(base, (Sum, Power)) for base in below):
            return None
        number = lcm(*(part.number.denominator for part in parts))
        whole = _Monomial(Fraction(number), below)
        above = [part.times(whole).written(self._ordering) for part in parts]
        inverse = _Monomial(Fraction(1, number), {b: -e for b, e in below.items()})
        return Sum(tuple(sorted(above, key=self._ordering.term))), inverse

    def merged(self, node: Expression) -> tuple[Expression, Sum] | None:
        """k (2 m + M)/(m M) for (1/m + 2/M) k, and the new bracket.

        A fraction in a bracket stays where the bracket is not divided by anything and nothing
        before it cancels: (Ω² cos θ − g/R) sin θ; so does a form in the momenta over letters.
        1 beside a ratio of letters does not: (A − C) cos θ/C, but (1/A − 1/B) cos θ.
        """
        minus, above, below = parts_of(node)
        if any(isinstance(f.base if isinstance(f, Power) else f, Sum) for f in below):
            return None
        for bracket in above:
            if not isinstance(bracket, Sum) or (found := self.over_one(bracket.terms)) is None:
                continue
            inside, inverse = found
            outside = [f for f in above if f is not bracket]
            letters = {whole_power(f)[0] for f in outside}
            constant = all(map(self._ordering.is_parameter, above))
            divided = any(not isinstance(f, Number) for f in below) or (bool(below) and constant)
            one = ONE in bracket.terms or Negative(ONE) in bracket.terms
            plain = constant or (one and self._ordering.is_parameter(bracket))
            masses = plain and all(map(is_letter, inside.terms))
            if not (divided or masses or letters & inverse.powers.keys()):
                continue
            if self._is_form(bracket) and not any(
                isinstance(whole_power(f)[0], Call) for f in below
            ):
                continue
            whole = inverse.times(_Monomial.product(minus, outside, below))
            return whole.times_sum(inside, self._ordering), inside
        return None

    def joined(self, node: Expression) -> Expression:
        """The product with each letter once: m² for m m, which brackets have left."""
        _, above, below = parts_of(node)
        over, under = (
            [b for b, _ in map(whole_power, factors) if isinstance(b, Name)]
            for factors in (above, below)
        )
        once = len({*under}) == len(under) and not {*over} & {*under}
        return node if once else _Monomial.of(node).written(self._ordering)

    def _is_form(self, node: Sum) -> bool:
        """Whether momenta stand in all of its terms to the second power."""
        return min(map(self._degree, node.terms)) > 1

    def _degree(self, term: Expression) -> int:
        """The degree in the momenta of a term, above its denominator."""
        _, above, _ = parts_of(term)
        degree = 0
        for base, exponent in map(whole_power, above):
            if isinstance(base, Sum):
                degree += exponent * max(map(self._degree, base.terms))
            elif self._momentum(base):
                degree += exponent
        return degree

    def _momentum(self, node: Expression) -> bool:
        return any(isinstance(part, Name) and part.name in self._momenta for part in walk(node))

    def opened(self, term: Expression) -> list[Expression]:
        """2 Ω y' and Ω² x of Ω (2 y' + Ω x): the letter before the bracket is also in it."""
        minus, above, below = parts_of(term)
        brackets = [f for f in above if isinstance(f, Sum)]
        if len(brackets) != 1 or len(above) == 1 or len(brackets[0].terms) > _TERMS:
            return [term]
        (bracket,) = brackets
        if accelerates(bracket):
            return [term]
        if any(isinstance(whole_power(f)[0], Sum) for f in (*above, *below) if f is not bracket):
            return [term]
        outside = _Monomial.product(minus, [f for f in above if f is not bracket], below)
        parts = [_Monomial.of(each) for each in bracket.terms]
        if any(isinstance(base, Sum) for part in parts for base in part.powers):
            return [term]
        fractional = any(part.below() for part in parts)
        inside = {base for part in parts for base, e in part.powers.items() if e > 0}
        before = {base for base, e in outside.powers.items() if e > 0 and isinstance(base, Name)}
        form = any(is_rate(base) or self._momentum(base) for base in inside & before)
        if all(map(is_letter, bracket.terms)) and not form:
            return [term]
        if self._momentum(bracket) and not (
            any(map(self._momentum, outside.powers))
            and (fractional or not any(map(self._ordering.is_coordinate, inside)))
        ):
            return [term]  # (p − q A) stays together, and so does p_x (x p_y − y p_x)
        if all(any(map(is_rate, part.powers)) for part in parts) and not any(
            map(is_rate, outside.powers)
        ):
            return [term]  # R (x' + R θ')
        if not inside & before:
            return [term]
        found = [part.times(outside).written(self._ordering) for part in parts]
        found.sort(key=self._ordering.term)
        more = sum(map(operation_count, found)) + len(found) - 1 - operation_count(term)
        return found if more <= _GROWTH + (fractional or form) else [term]

    def velocity(self, terms: list[Expression]) -> list[Expression]:
        """l₁ l₂ p − l₁ p_φ − l₂ p_ψ for l₁ (l₂ p − p_φ) − l₂ p_ψ: each term has one momentum."""
        if len(terms) == 1 or any(self._degree(term) != 1 for term in terms):
            return terms
        found = [part for term in terms for part in self._each_momentum(term)]
        return terms if len(found) == len(terms) else sorted(found, key=self._ordering.term)

    def _each_momentum(self, term: Expression) -> list[Expression]:
        """l₁ l₂ p and l₁ p_φ of l₁ (l₂ p + p_φ), a bracket of momenta behind letters alone."""
        minus, above, below = parts_of(term)
        brackets = [f for f in above if isinstance(f, Sum)]
        if len(brackets) != 1 or any(self._degree(each) != 1 for each in brackets[0].terms):
            return [term]
        if any(not isinstance(f, Number) for f in below):
            return [term]  # p_v/J − (p_u − p_v)/(m l²)
        outside = _Monomial.product(minus, [f for f in above if f is not brackets[0]], below)
        parts = [_Monomial.of(each) for each in brackets[0].terms]
        single = not any(isinstance(base, Sum) for part in parts for base in part.powers)
        if not single or not all(isinstance(base, Name) for base in outside.powers):
            return [term]
        return [part.times(outside).written(self._ordering) for part in parts]

    def spread(self, node: Expression) -> list[Expression]:
        """2 g/(m (x − y)³) and ω² x of (2 g/(x − y)³ + m ω² x)/m."""
        minus, above, below = parts_of(node)
        match above:
            case [Sum(terms=terms)] if below and len(terms) <= _TERMS:
                parts = [_Monomial.of(term) for term in terms]
            case _:
                return [node]
        inner = any(isinstance(base, Sum) for part in parts for base in part.below())
        if not inner or not all(isinstance(whole_power(f)[0], (Name, Number)) for f in below):
            return [node]
        outside = _Monomial.product(minus, [], below)
        return [part.times(outside).written(self._ordering) for part in parts]
