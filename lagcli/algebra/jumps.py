"""Expressions with signs: whether they jump where the argument of a sign changes its own."""

from __future__ import annotations

import sympy
from sympy import Expr, S

from lagcli.algebra.entry import Field
from lagcli.algebra.signs import sign as sign_of
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
    one, minus = (expression.xreplace({sign: value}) for value in (S.One, S.NegativeOne))
    step = (one - minus).xreplace({sympy.Abs(argument): S.Zero, argument: S.Zero})
    return (is_zero(step) is True and argument.is_polynomial()) or _has_factor(step, argument)


def _has_factor(step: Expr, argument: Expr) -> bool:
    """Whether the numerator of the step is a multiple of what the argument changes its sign with.

    That is its numerator, and its denominator: that of x/y does at y = 0.
    """
    field = Field([step, argument])
    try:
        whole, inside = field(step).numerator, field(argument)
    except ZeroDivisionError:
        return False
    factors = [inside.numerator]
    if sign_of(field.to_sympy(field.element(inside.denominator, field.ring.one))) is None:
        factors.append(inside.denominator)
    return all(field.ring.lift(whole) % field.ring.lift(f) == 0 for f in factors)
