"""Decimal numbers in place of exact ones, for `--numeric`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any

from lagcli.evaluation import Constant, finite_value
from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    quotient_of,
    signed,
    sum_of,
    walk,
)
from lagcli.rewriting import rebuilt

#: Significant digits: as many as a double holds for certain.
DIGITS = 15
#: The largest number under a root or below a line that stays: sqrt(33), 9.81/13.
_LONG = 99
_ROUNDING = Context(prec=DIGITS)


def with_decimals(node: Expression) -> Expression:
    """The expression with its constants worked out, each product with one in front."""
    constant = finite_value(node)
    if constant is not None:
        return number(constant)
    match node:
        case Sum(terms=terms):
            return _sum(with_decimals(term) for term in terms)
        case Negative() | Product() | Quotient():
            return _term(node)
        case Power(base=base, exponent=exponent):
            return Power(with_decimals(base), with_decimals(exponent))
        case _:
            return rebuilt(node, with_decimals)


class GivenDecimals:
    """What was given with a decimal point is answered with decimals: 981/500 as 1.962.

    A constant of an answer comes from the decimals given if it shares a prime factor with one
    of them; 2 and 5 tell nothing, except of a decimal such as 0.25 that has no other.

    Parameters
    ----------
    given
        The values that were written with a decimal point.
    """

    def __init__(self, given: Iterable[Fraction]) -> None:
        self._primes: set[int] = set()
        self._given = sorted({abs(value) for value in given if value})
        for value in self._given:
            found = _primes(value)
            self._primes |= found - {2, 5} or found

    def __bool__(self) -> bool:
        return bool(self._primes)

    def __call__(self, node: Expression) -> Expression:
        """The formula with its constants as decimals where they come from decimals."""
        if any(map(_is_long, walk(node))):
            return with_decimals(node)
        match node:
            case Negative() | Product() | Quotient():
                constant, above, below = self._whole_sum(*self._factors(node))
                simple = constant.denominator == 1 or not _primes(constant) & self._primes
                return _with_decimal(constant, above, below, simple=simple)
            case Power(base=base, exponent=exponent):
                return Power(self(base), exponent)
            case Number(value=value) if value.denominator != 1:
                return self(
                    Quotient(Number(Fraction(value.numerator)), Number(Fraction(value.denominator)))
                )
        return rebuilt(node, self)

    def _whole_sum(
        self, constant: Fraction, above: list[Expression], below: list[Expression]
    ) -> tuple[Fraction, list[Expression], list[Expression]]:
        """(100 a + 981 b)/100 as a + 9.81 b, (a + 59 b)/65 as (0.02 a + 1.18 b)/1.3.

        The constant, times a decimal that was given, is multiplied into a sum.
        """
        for divisor in (Fraction(1), *self._given) if constant.denominator != 1 else ():
            if not _primes(constant * divisor) <= {2, 5}:
                continue
            inner = self._inner(above, abs(constant * divisor))
            if inner is not None:
                below = below if divisor == 1 else [Number(divisor, decimal=True), *below]
                return Fraction(-1 if constant < 0 else 1), inner, below
        return constant, above, below

    def _scaled(self, node: Sum, constant: Fraction) -> Sum | None:
        """The sum times the constant; None where no decimal that was given appears."""
        terms, seen = [], False
        for term in node.terms:
            number, above, below = self._factors(term)
            product = number * constant
            inner = self._inner(above, constant) if abs(number) == 1 else None
            if inner is not None:
                above, product, seen = inner, number, True
            elif _primes(product) & self._primes:
                seen = True
            elif product.denominator > 2:
                return None
            simple = not _primes(product) & self._primes
            terms.append(_with_decimal(product, above, below, simple=simple))
        return Sum(tuple(terms)) if seen else None

    def _inner(self, above: list[Expression], constant: Fraction) -> list[Expression] | None:
        """The factors with the constant multiplied into a sum among them."""
        for place, factor in enumerate(above):
            scaled = self._scaled(factor, constant) if isinstance(factor, Sum) else None
            if scaled is not None:
                return [*above[:place], scaled, *above[place + 1 :]]
        return None

    def _factors(self, node: Expression) -> tuple[Fraction, list[Expression], list[Expression]]:
        """The rational factor, the other factors above the line and those below."""
        return _factors(node, lambda n: n.value if isinstance(n, Number) else None, self)


def _is_long(node: Expression) -> bool:
    """Whether it is a constant such as (1829 - sqrt(1535381))/26, which no book prints."""
    if not isinstance(node, Call | Power) or finite_value(node) is None:
        return False
    return any(isinstance(n, Number) and n.value.numerator > _LONG for n in walk(node))


def _primes(value: Fraction) -> set[int]:
    """The prime factors above and below, small ones by trial; what is left counts as one."""
    found = set()
    for number in (abs(value.numerator), value.denominator):
        for prime in range(2, 1000):
            while number and number % prime == 0:
                found.add(prime)
                number //= prime
        if number > 1:
            found.add(number)
    return found


def _with_decimal(
    constant: Fraction, above: list[Expression], below: list[Expression], *, simple: bool = False
) -> Expression:
    """c a/b with c as a decimal, over a whole number where it has no end; p a/(q b) if simple."""
    rest = constant.denominator
    for prime in () if simple else (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest > _LONG:  # 14831493.75/1319003
        constant, rest = _rounded(constant), 1
    head = Number(abs(constant) * rest, decimal=True)
    top = above if head.value == 1 and above else [head, *above]
    bottom = below if rest == 1 else [Number(Fraction(rest)), *below]
    whole = quotient_of(top, bottom)
    return Negative(whole) if constant < 0 else whole


def number(value: Constant) -> Expression:
    """A number of at most `DIGITS` significant digits, with a `Negative` for its sign."""
    exact = Fraction(value)
    whole = exact.denominator == 1 and abs(exact) < 10**DIGITS
    return signed(exact if whole else _rounded(exact), decimal=True)


def _rounded(exact: Fraction) -> Fraction:
    return Fraction(_ROUNDING.divide(Decimal(exact.numerator), Decimal(exact.denominator)))


def _sum(terms: Iterable[Expression]) -> Expression:
    """The terms with the constants among them added, where the first of them stood."""
    kept: list[Expression] = []
    constant: Constant = Fraction(0)
    place: int | None = None
    for term in terms:
        value = finite_value(term)
        if value is None:
            kept.append(term)
            continue
        place = len(kept) if place is None else place
        constant += value
    if place is not None and constant:
        kept.insert(place, number(constant))
    return sum_of(kept)


def _term(node: Expression) -> Expression:
    """c a b / (d e), with every constant of the term in c."""
    constant, above, below = _factors(node, finite_value, with_decimals)
    if Fraction(constant).denominator != 1:
        constant, above = _under_root(constant, above)
    head = number(constant)
    sign = isinstance(head, Negative)
    magnitude = head.operand if isinstance(head, Negative) else head
    top = above if magnitude == ONE and above else [magnitude, *above]
    result = quotient_of(top, below)
    return Negative(result) if sign else result


def _under_root(constant: Constant, above: list[Expression]) -> tuple[Constant, list[Expression]]:
    """1/3 sqrt(16.1 k/m) as sqrt(1.79 k/m)."""
    for place, factor in enumerate(above):
        if isinstance(factor, Call) and factor.function == "sqrt":
            c, over, under = _factors(factor.arguments[0], finite_value, with_decimals)
            if c > 0 and c != 1:
                inner = quotient_of([number(c * constant * constant), *over], under)
                kept = [*above[:place], Call("sqrt", (inner,)), *above[place + 1 :]]
                return Fraction(-1 if constant < 0 else 1), kept
    return constant, above


def _factors(
    node: Expression,
    known: Callable[[Expression], Constant | None],
    shown: Callable[[Expression], Expression],
) -> tuple[Any, list[Expression], list[Expression]]:
    """The constant of a term, the factors above its line and those below, as they are shown."""
    value = known(node)
    if value is not None:
        return value, [], []
    match node:
        case Negative(operand=operand):
            constant, above, below = _factors(operand, known, shown)
            return -constant, above, below
        case Product(factors=factors):
            constant, above, below = Fraction(1), list[Expression](), list[Expression]()
            for factor in factors:
                c, over, under = _factors(factor, known, shown)
                constant, above, below = constant * c, [*above, *over], [*below, *under]
            return constant, above, below
        case Quotient(numerator=numerator, denominator=denominator):
            c, above, below = _factors(numerator, known, shown)
            d, more_below, more_above = _factors(denominator, known, shown)
            if d == 0:
                return Fraction(1), [node], []
            return c / d, [*above, *more_above], [*below, *more_below]
        case _:
            return Fraction(1), [shown(node)], []
