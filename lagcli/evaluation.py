"""A formula in numbers, node by node, by whatever functions the numbers have."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import reduce
from operator import add, mul
from random import Random
from typing import Any, TypeAlias, TypeVar

from lagcli.expression import FUNCTIONS as GRAMMAR
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
    walk,
)

Constant: TypeAlias = Fraction | float

Real = TypeVar("Real", bound=Any)

#: The functions of the grammar, of doubles, with "power" and "pi" (of no arguments).
FUNCTIONS: dict[str, Callable[..., float]] = {
    **{name: getattr(math, name) for name in GRAMMAR if hasattr(math, name)},
    "abs": abs,
    "sign": lambda x: (x > 0) - (x < 0),
    "cot": lambda x: 1 / math.tan(x),
    "sec": lambda x: 1 / math.cos(x),
    "csc": lambda x: 1 / math.sin(x),
    "power": math.pow,  # ValueError where it is not real
    "pi": lambda: math.pi,
}
#: Random states at which the sign of a formula is looked at.
_STATES = 24


def evaluated(
    node: Expression,
    values: Mapping[str, Any],
    functions: Mapping[str, Callable[..., Any]],
    number: Callable[[Fraction], Any] = float,
) -> Any:
    """The value of a formula, worked out as it is written, from left to right.

    Parameters
    ----------
    node
        The formula.
    values
        Of its names, `x'` with the prime; that of pi among them.
    functions
        By name; of the numbers that the values are, floats, arrays or balls.
    number
        Makes such a number of an exact one.

    Raises
    ------
    KeyError
        For a name, a function or another node that has no numbers.
    ArithmeticError, ValueError
        Where the formula is not defined.
    """

    def value(part: Expression) -> Any:
        return evaluated(part, values, functions, number)

    match node:
        case Number(value=exact):
            return number(exact)
        case Name():
            return values[str(node)]
        case Negative(operand=operand):
            return -value(operand)
        case Sum(terms=terms):
            return reduce(add, map(value, terms))
        case Product(factors=factors):
            return reduce(mul, map(value, factors))
        case Quotient(numerator=above, denominator=below):
            return value(above) / value(below)
        case Power(base=base, exponent=exponent) if "power" in functions:
            return functions["power"](value(base), value(exponent))
        case Power(base=base, exponent=Number(value=exact)) if exact.denominator == 1:
            return value(base) ** int(exact)
        case Power(base=base, exponent=exponent):
            return value(base) ** value(exponent)
        case Call(function=function, arguments=arguments, primes=0):
            return functions[function](*map(value, arguments))
    raise KeyError(f"no numbers for {type(node).__name__}")


def value_of(node: Expression) -> Constant | None:
    """The number that an expression without names is, exact where it is rational.

    Raises
    ------
    ArithmeticError, ValueError
        Where it has none: 1/0, sqrt(-1).
    """
    try:
        value: Constant = evaluated(node, {"pi": math.pi}, _EXACT, lambda exact: exact)
    except KeyError:
        return None
    return value


def finite_value(node: Expression) -> Constant | None:
    """`value_of`, and None also where there is no finite number, or too large a one on the way."""
    try:
        value = value_of(node)
    except (ArithmeticError, ValueError):
        return None
    finite = isinstance(value, Fraction) or (value is not None and math.isfinite(value))
    return value if finite else None


def _power(base: Constant, exponent: Constant) -> Constant:
    if isinstance(exponent, Fraction) and exponent.denominator == 1 and abs(exponent) < 1000:
        return base ** int(exponent)
    result: float | complex = float(base) ** float(exponent)
    if isinstance(result, complex):
        raise ValueError("not real")  # noqa: TRY004 - as math.sqrt(-1) says it
    return result


_EXACT = FUNCTIONS | {"power": _power}


def sign_at_random(node: Expression, positive: Iterable[str]) -> int:
    """1 or -1 where the formula has this sign at all random states, else 0.

    For the shape of a formula, never for a claim.

    Parameters
    ----------
    node
        The formula.
    positive
        The names that are positive; others are of either sign.
    """
    names = {part for part in walk(node) if isinstance(part, Name) and part.name != "pi"}
    known, draw = frozenset(positive), Random(len(names))
    signs = set()
    for _ in range(_STATES):
        values = {"pi": math.pi} | {
            str(name): draw.uniform(0.1, 2) if name.name in known and not name.primes
            else draw.uniform(-2, 2)
            for name in sorted(names, key=str)
        }  # fmt: skip
        try:
            signs.add(math.copysign(1, evaluated(node, values, FUNCTIONS)))
        except (ArithmeticError, ValueError, KeyError, TypeError):
            return 0
        if len(signs) > 1:
            return 0
    return int(signs.pop())


def bisected(
    holds: Callable[[Real], bool], inside: Real, outside: Real, halvings: int
) -> tuple[Real, Real]:
    """The two numbers brought together about the place between them where `holds` ends.

    Either of them may be the larger one; what holds at the first does not at the second.
    """
    for _ in range(halvings):
        middle = (inside + outside) / 2
        if middle in {inside, outside}:
            break
        inside, outside = (middle, outside) if holds(middle) else (inside, middle)
    return inside, outside
