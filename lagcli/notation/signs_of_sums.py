"""Which way round a sum stands: R − a where the file has it, 1 − cos θ, a denominator as before."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping

from lagcli.evaluation import finite_value, sign_at_random
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    all_negative,
    children,
    factors_of,
    opposite,
    walk,
)
from lagcli.notation.brackets import NamedMomenta
from lagcli.notation.factors import odd_base, parts_of, whole_power
from lagcli.notation.given_sums import GivenSums
from lagcli.notation.likeness import Key, signed_key
from lagcli.notation.ordering import Ordering


class FirstSigns(dict[Key, int]):
    """The sign with which each sum was first written, by its key."""

    def keep(self, node: Sum) -> None:
        """The sum stands as here from now on, unless it was written before."""
        sign, key = signed_key(node)
        self.setdefault(key, sign)

    def keep_odd(self, factors: Iterable[Expression]) -> None:
        """The same of every sum to an odd power."""
        for factor in factors:
            base, odd = odd_base(factor)
            if base is not None and odd:
                self.keep(base)

    def has(self, node: Sum) -> bool:
        """Whether the sum or its negative was written before."""
        return signed_key(node)[1] in self

    def turns(self, node: Sum) -> bool:
        """Whether it was written the other way round."""
        sign, key = signed_key(node)
        return self.get(key, sign) != sign


class SumSigns:
    """The signs in which sums are written.

    Parameters
    ----------
    formulas
        Those of the file.
    ordering, sums, momenta
        Of the file.
    positive
        The names that are positive.
    """

    def __init__(
        self,
        formulas: Iterable[Expression],
        ordering: Ordering,
        sums: GivenSums,
        momenta: NamedMomenta,
        positive: frozenset[str],
    ) -> None:
        self._ordering, self._sums, self._momenta = ordering, sums, momenta
        self._positive = positive
        self._file: dict[Key, int] = {}  # of a sum: that of the file, 0 where it has both
        self._below = FirstSigns()  # of denominators
        self._one_way: dict[Key, int] = {}  # of sums of constants that a section has both ways
        self._brackets: set[Key] = set()  # all sums of the file that are no whole formulas
        for node in formulas:
            for part in walk(node):
                if isinstance(part, Sum):
                    sign, key = signed_key(part)
                    if part is not node:
                        self._brackets.add(key)
                    if all_negative(part):
                        continue
                    self._file[key] = sign if self._file.get(key, sign) == sign else 0

    def anew(self, one_way: Mapping[Key, int]) -> None:
        """Begin another section, with the signs of these sums."""
        self._below.clear()
        self._one_way = dict(one_way)

    def both_ways(self, formulas: Iterable[Expression]) -> dict[Key, int]:
        """The sums of constants among the factors that stand both ways, a − b and b − a.

        With the sign in which all of them are to stand: few minus signs, then a before b.  None
        of a − b, b − c, c − a, which three like rows have in turn.
        """
        seen: dict[Key, dict[int, Sum]] = {}
        for each in formulas:
            for base in odd_sums(each):
                if self._ordering.is_parameter(base) and not self.is_settled(base):
                    sign, key = signed_key(base)
                    seen.setdefault(key, {})[sign] = base
        both = {key: found.popitem() for key, found in seen.items() if len(found) > 1}
        terms = Counter(signed_key(t)[1] for _, base in both.values() for t in base.terms)
        return {
            key: sign if self._is_usual(base) else -sign
            for key, (sign, base) in both.items()
            if all(terms[signed_key(t)[1]] == 1 for t in base.terms)
        }

    def _is_usual(self, node: Sum) -> bool:
        minuses = sum(isinstance(term, Negative) for term in node.terms)
        if 2 * minuses != len(node.terms):
            return 2 * minuses < len(node.terms)
        return not isinstance(min(node.terms, key=self._ordering.term), Negative)

    def against(self, node: Sum) -> bool | None:
        """Whether the section has it the other way round; None where it has it one way only."""
        sign, key = signed_key(node)
        return self._one_way[key] != sign if key in self._one_way else None

    def is_bracket(self, node: Sum) -> bool:
        """Whether the sum or its negative stands within a formula of the file."""
        return signed_key(node)[1] in self._brackets

    def is_settled(self, node: Sum) -> bool:
        """Whether the file says which way round it stands, or has it both ways."""
        return signed_key(node)[1] in self._file

    def keep(self, base: Sum) -> None:
        """A denominator after it stands as this sum does."""
        self._below.keep(base)

    def keep_odd(self, radicand: Expression) -> None:
        """Of sqrt((a − b)³ c): a denominator after it has a − b."""
        _, above, below = parts_of(radicand)
        self._below.keep_odd((*above, *below))

    def wrong(self, node: Sum, *, below: bool = False) -> bool | None:
        """Whether the other sign is the better one; None where neither is.

        A denominator stands as it stood the last time: the rows of an answer have the same one.
        """
        sign, key = signed_key(node)
        given = self._file.get(key, 0) or (self._below.get(key, 0) if below else 0)
        if given:
            return given != sign
        has_both = self._file.get(key) == 0
        if not has_both and (like := self._sums.multiple(node)) is not None:  # r − rs as 1 − rs/r
            return like[0] < 0
        if below and (found := sign_at_random(node, self._positive)):
            return found < 0
        if below and (constant := self._constant_term(node)) is not None:
            return isinstance(constant, Negative)
        if below and (positive := _determinant(node)) is not None:
            return not positive
        if below and (first := self._declared_first(node)) is not None:
            return not first
        number = next((t for t in node.terms if _is_number(t)), None)
        if number is not None and (value := finite_value(node)) is not None:
            return value < 0  # sqrt(33) - 1
        if number is not None:
            return isinstance(number, Negative)
        if (momentum := self._momenta.turned(node)) is not None:
            return momentum
        return True if all_negative(node) else None

    def _constant_term(self, node: Sum) -> Expression | None:
        """The a⁴ of a⁴ − (a² − b²) x²; None where others have no square of a coordinate."""
        constants = [term for term in node.terms if self._ordering.is_parameter(term)]
        others = [term for term in node.terms if term not in constants]
        powers = ([*map(whole_power, parts_of(term)[1])] for term in others)
        squared = (
            any(self._ordering.is_coordinate(b) and e > 0 and e % 2 == 0 for b, e in each)
            for each in powers
        )
        sign = sign_at_random(constants[0], self._positive) if len(constants) == 1 else 0
        return constants[0] if sign and others and all(squared) else None

    def _declared_first(self, node: Sum) -> bool | None:
        """Whether it is 3 a² − 2 b² with a before b in the file; False of 2 b² − 3 a²."""
        if len(node.terms) != 2:
            return None
        plus, minus = sorted(node.terms, key=lambda term: isinstance(term, Negative))
        letters = [_squared_letter(each) for each in (plus, opposite(minus))]
        if isinstance(plus, Negative) or not isinstance(minus, Negative) or None in letters:
            return None
        a, b = (self._ordering.factor(each) for each in letters if each is not None)
        return a < b

    def begins_worse(self, node: Sum) -> bool:
        """Whether a square is better that of the negative: (a − b)² in order, (x − f(x) y)²."""
        match node.terms:
            case (Name() as one, Negative(operand=Name() as other)):
                return not one.primes and self._ordering.factor(one) > self._ordering.factor(other)
            case (first, Negative(operand=Name())):
                return not isinstance(first, (Negative, Number))
            case _:
                return False


def odd_sums(node: Expression) -> Iterator[Sum]:
    """The sums to an odd power among the factors of a formula, none inside a function."""
    stack = [node]
    while stack:
        part = stack.pop()
        if isinstance(part, (Call, PartialCall)):
            continue
        if isinstance(part, (Product, Quotient, Negative)):
            _, above, below = parts_of(part)
            found = (odd_base(factor) for factor in (*above, *below))
            yield from (base for base, odd in found if base is not None and odd)
        stack += children(part)


def _squared_letter(node: Expression) -> Expression | None:
    """The letter of n a², with or without a number."""
    match [f for f in factors_of(node) if not isinstance(f, Number)]:
        case [Power(base=Name() as letter)]:
            return letter
        case _:
            return None


def _determinant(node: Sum) -> bool | None:
    """Whether a two-term sum is a b − c², the determinant of T; False of c² − a b."""
    factors = [[f for f in parts_of(t)[1] if not isinstance(f, Number)] for t in node.terms]
    squares = [all(whole_power(f)[1] % 2 == 0 for f in each) for each in factors]
    minus = [isinstance(term, Negative) for term in node.terms]
    return minus == squares if len(squares) == 2 and squares[0] != squares[1] else None


def _is_number(node: Expression) -> bool:
    inner = node.operand if isinstance(node, Negative) else node
    return isinstance(inner, Number)
