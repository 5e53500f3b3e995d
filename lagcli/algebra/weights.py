"""Weights of parameters under scalings that leave formulas homogeneous."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Abs, Expr, Pow, Rational, S, Symbol

Weights = dict[Symbol, Rational]


class NotAPower(Exception):
    """An exponent has symbols in it."""


def weights(expression: Expr, rows: list[Weights]) -> Weights:
    """The powers of the symbols in a term; what terms of a sum differ by is put into `rows`.

    The expression is homogeneous under the scalings that are orthogonal to all rows.  Arguments
    of functions do not scale.
    """
    if isinstance(expression, Symbol):
        return {expression: S.One}
    if expression.is_number:
        return {}
    if isinstance(expression, Pow):
        if not expression.exp.is_Rational:
            raise NotAPower
        return {s: w * expression.exp for s, w in weights(expression.base, rows).items()}
    each = [weights(part, rows) for part in expression.args]
    if isinstance(expression, (sympy.Mul, Abs)):
        return _sum(each, S.One)
    if isinstance(expression, sympy.Add):
        rows += [_sum([other, each[0]], S.NegativeOne) for other in each[1:]]
        return each[0]
    rows += each
    return {}


def _sum(each: Sequence[Weights], sign: Expr) -> Weights:
    """The first one, with `sign` times the others."""
    total = dict(each[0])
    for other in each[1:]:
        for s, w in other.items():
            total[s] = total.get(s, S.Zero) + sign * w
    return total
