"""Expressions with signs: whether they jump where the argument of a sign changes its own."""

from __future__ import annotations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.simplification import is_zero


def is_continuous(expression: Expr) -> bool:
    """Whether the expression is known not to jump at the zeros of the arguments of its signs.

    Elsewhere all functions of the grammar are continuous where they are defined.

    Examples
    --------
    >>> x, t = sympy.symbols("x t", real=True)
    >>> is_continuous(x**2 * sympy.sign(x)), is_continuous(t * sympy.sign(x))
    (True, False)
    """
    signs = expression.atoms(sympy.sign)
    return all(_meets(expression, each, each.args[0]) for each in signs)


def _meets(expression: Expr, sign: Expr, argument: Expr) -> bool:
    """E with sign = 1 equals E with sign = -1 where the argument f is 0."""
    step = expression.xreplace({sign: sympy.S.One}) - expression.xreplace(
        {sign: sympy.S.NegativeOne}
    )
    if is_zero(step) is True:
        return True
    for symbol in sorted(argument.free_symbols, key=str):
        root = _root(argument, symbol)
        if root is not None:
            return is_zero(step.xreplace({symbol: root})) is True
    return False


def _root(argument: Expr, symbol: Symbol) -> Expr | None:
    """Where a function that is linear in the symbol is 0."""
    slope = argument.diff(symbol)
    if slope.has(symbol) or slope.is_zero is not False:
        return None
    return -argument.xreplace({symbol: sympy.S.Zero}) / slope
