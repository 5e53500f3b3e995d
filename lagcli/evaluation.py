"""A formula in numbers, node by node, by whatever functions the numbers have."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import Any

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
)


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
        For a name or a function that has no numbers.
    ArithmeticError, ValueError
        Where the formula is not defined, or holds a node that has no numbers.
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
    raise ValueError(f"no numbers for {type(node).__name__}")
