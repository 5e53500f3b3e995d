"""The sign that a sum has at random states; for the shape of a formula, never for a claim."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from operator import mul
from random import Random

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

_STATES = 24
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    name: getattr(math, name) for name in "sqrt exp log sin cos tan sinh cosh tanh".split()
} | {"abs": abs}


def sign_at_random(node: Expression, positive: Iterable[str]) -> int:
    """1 or -1 where the formula has this sign at all random states, else 0.

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
        values = {
            name: draw.uniform(0.1, 2) if name.name in known and not name.primes
            else draw.uniform(-2, 2)
            for name in sorted(names, key=str)
        }  # fmt: skip
        try:
            signs.add(math.copysign(1, _value(node, values)))
        except (ArithmeticError, ValueError, KeyError, TypeError):
            return 0
        if len(signs) > 1:
            return 0
    return int(signs.pop())


def _value(node: Expression, values: Mapping[Name, float]) -> float:
    match node:
        case Number(value=value):
            return float(value)
        case Name(name="pi"):
            return math.pi
        case Name():
            return values[node]
        case Negative(operand=inner):
            return -_value(inner, values)
        case Sum(terms=terms):
            return math.fsum(_value(term, values) for term in terms)
        case Product(factors=factors):
            return reduce(mul, (_value(factor, values) for factor in factors))
        case Quotient(numerator=above, denominator=below):
            return _value(above, values) / _value(below, values)
        case Power(base=base, exponent=exponent):
            return math.pow(_value(base, values), _value(exponent, values))
        case Call(function=function, arguments=(argument,), primes=0):
            return _FUNCTIONS[function](_value(argument, values))
        case _:
            raise KeyError(type(node).__name__)
