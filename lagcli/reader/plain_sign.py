"""The sign of a formula where it is plain to see from the signs of its parts."""

from __future__ import annotations

import math
from collections.abc import Mapping

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
    folded,
)


def plain_sign(
    formula: Expression,
    signs: Mapping[str, int],
    definitions: Mapping[str, Expression],
    velocity: int = 0,
) -> int:
    """1 or -1 for what is never negative or never positive, 0 where that is not plain to see.

    It follows from the signs of the parameters, and of all velocities, with which angles are those
    of slopes.
    """

    def sign(node: Expression, parts: list[int]) -> int:
        match node:
            case Number(value=value):
                return (value > 0) - (value < 0)
            case Name(name=name, primes=0) if name in definitions:
                return folded(definitions[name], sign)
            case Name(name=name, primes=primes):
                return velocity if primes else signs.get(name, 0)
            case Negative():
                return -parts[0]
            case Sum():
                return parts[0] if len(set(parts)) == 1 else 0
            case Product() | Quotient():
                return math.prod(parts)
            case Power(exponent=Number(value=power)) if power.denominator == 1:
                return 1 if power % 2 == 0 else parts[0]
            case Call(function="abs" | "exp" | "cosh"):
                return 1
            case Call(function="sign" | "tanh" | "atan"):
                return parts[0]
            case Call(function="cos" | "sin" | "tan"):
                return int(velocity != 0 and parts[0] == 1)
            case _:
                return 0

    return folded(formula, sign)
