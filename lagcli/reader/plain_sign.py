"""The sign of a formula where it is plain to see from the signs of its parts."""

from __future__ import annotations

import math
from collections.abc import Callable

from lagcli.expression import Expression, Negative, Number, Product, Quotient, Sum, folded


def plain_sign(formula: Expression, other: Callable[[Expression, list[int]], int]) -> int:
    """1 or -1, and 0 where it is not plain to see.

    Parameters
    ----------
    other
        The sign of a name, a power or a function from those of its parts.
    """

    def sign(node: Expression, parts: list[int]) -> int:
        match node:
            case Number(value=value):
                return (value > 0) - (value < 0)
            case Negative():
                return -parts[0]
            case Sum():
                return parts[0] if len(set(parts)) == 1 else 0
            case Product() | Quotient():
                return math.prod(parts)
            case _:
                return other(node, parts)

    return folded(formula, sign)
