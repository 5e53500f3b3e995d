"""Decimal numbers in place of exact ones, for `--numeric`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from decimal import Context, Decimal
from fractions import Fraction

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
)
from lagcli.rewriting import rebuilt

#: Significant digits: as many as a double holds for certain.
DIGITS = 15
_ROUNDING = Context(prec=DIGITS)

_FUNCTIONS: dict[str, Callable[..., float]] = {
    **{
        name: getattr(math, name)
        for name in (
            "sqrt exp log sin cos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh"
        ).split()
    },
    "abs": abs,
    "sign": lambda x: (x > 0) - (x < 0),
    "cot": lambda x: 1 / math.tan(x),
    "sec": lambda x: 1 / math.cos(x),
    "csc": lambda x: 1 / math.sin(x),
}

Constant = Fraction | float


def value_of(node: Expression) -> Constant | None:
    """The number that an expression without names is, exact where it is rational.

    Raises
    ------
    ArithmeticError, ValueError
        Where it has none: 1/0, sqrt(-1).
    """
    match node:
        case Number(value=value):
            return value
        case Name(name="pi", primes=0):
            return math.pi
        case Negative(operand=operand):
            return None if (a := value_of(operand)) is None else -a
        case Sum(terms=terms):
            parts = [value_of(term) for term in terms]
            return None if None in parts else sum(p for p in parts if p is not None)
        case Product(factors=factors):
            parts = [value_of(factor) for factor in factors]
            return None if None in parts else _product(p for p in parts if p is not None)
        case Quotient(numerator=a, denominator=b):
            above, below = value_of(a), value_of(b)
            return None if above is None or below is None else above / below
        case Power(base=a, exponent=b):
            base, exponent = value_of(a), value_of(b)
            return None if base is None or exponent is None else _power(base, exponent)
        case Call(function=function, arguments=arguments, primes=0) if function in _FUNCTIONS:
            parts = [value_of(argument) for argument in arguments]
            return None if None in parts else _FUNCTIONS[function](*parts)
        case _:
            return None


def with_decimals(node: Expression) -> Expression:
    """The expression with its constants worked out, each product with one in front."""
    constant = _known(node)
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


def number(value: Constant) -> Expression:
    """A number of at most `DIGITS` significant digits, with a `Negative` for its sign."""
    exact = Fraction(value)
    if exact.denominator == 1 and abs(exact) < 10**DIGITS:
        rounded = exact
    else:
        rounded = Fraction(_ROUNDING.divide(Decimal(exact.numerator), Decimal(exact.denominator)))
    digits = Number(abs(rounded), decimal=True)
    return Negative(digits) if rounded < 0 else digits


def _known(node: Expression) -> Constant | None:
    """`value_of`, and None also where there is no finite number."""
    try:
        value = value_of(node)
    except (ArithmeticError, ValueError):
        return None
    return (
        value
        if isinstance(value, Fraction) or (value is not None and math.isfinite(value))
        else None
    )


def _product(values: Iterable[Constant]) -> Constant:
    product: Constant = Fraction(1)
    for value in values:
        product *= value
    return product


def _power(base: Constant, exponent: Constant) -> Constant:
    if isinstance(exponent, Fraction) and exponent.denominator == 1 and abs(exponent) < 1000:
        return base ** int(exponent)
    result: float | complex = float(base) ** float(exponent)
    if isinstance(result, complex):
        raise ValueError("not real")  # noqa: TRY004 - as math.sqrt(-1) says it
    return result


def _sum(terms: Iterable[Expression]) -> Expression:
    """The terms with the constants among them added, where the first of them stood."""
    kept: list[Expression] = []
    constant: Constant = Fraction(0)
    place: int | None = None
    for term in terms:
        value = _known(term)
        if value is None:
            kept.append(term)
            continue
        place = len(kept) if place is None else place
        constant += value
    if place is not None and constant:
        kept.insert(place, number(constant))
    return kept[0] if len(kept) == 1 else Sum(tuple(kept))


def _term(node: Expression) -> Expression:
    """c a b / (d e), with every constant of the term in c."""
    constant, above, below = _factors(node)
    head = number(constant)
    sign = isinstance(head, Negative)
    magnitude = head.operand if isinstance(head, Negative) else head
    top = above if magnitude == ONE and above else [magnitude, *above]
    result = top[0] if len(top) == 1 else Product(tuple(top))
    if below:
        result = Quotient(result, below[0] if len(below) == 1 else Product(tuple(below)))
    return Negative(result) if sign else result


def _factors(node: Expression) -> tuple[Constant, list[Expression], list[Expression]]:
    """The constant of a term, the factors above its line and those below."""
    value = _known(node)
    if value is not None:
        return value, [], []
    match node:
        case Negative(operand=operand):
            constant, above, below = _factors(operand)
            return -constant, above, below
        case Product(factors=factors):
            parts = [_factors(factor) for factor in factors]
            return (
                _product(c for c, _, _ in parts),
                [x for _, above, _ in parts for x in above],
                [x for _, _, below in parts for x in below],
            )
        case Quotient(numerator=numerator, denominator=denominator):
            c, above, below = _factors(numerator)
            d, more_below, more_above = _factors(denominator)
            if d == 0:
                return Fraction(1), [node], []
            return c / d, [*above, *more_above], [*below, *more_below]
        case _:
            return Fraction(1), [with_decimals(node)], []
