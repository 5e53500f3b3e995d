"""Numbers that no radical gives, as decimal fractions, and how they are written."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import mpmath
from sympy import Expr, Rational

from lagcli.algebra.simplification import shape
from lagcli.expression import Expression, signed

DIGITS = 15  # significant ones of a rounded root: those a double has
GUARD = 10  # further digits with which it is worked out


def decimal(value: Expr) -> Expr:
    """A number as the exact decimal fraction of its first 15 significant digits."""
    with mpmath.workdps(DIGITS + 5):
        number = mpmath.mpf(str(value))
        return Rational(mpmath.nstr(number, DIGITS, min_fixed=-9, max_fixed=DIGITS))


def is_decimal(value: Expr) -> bool:
    """Whether a root is one that `decimal` rounded."""
    return bool(value.is_Rational and len(str(value.q)) > DIGITS // 2)


def written(value: Expr, order: Sequence[str]) -> Expression:
    """The readable shape of a root; one that was rounded is written with a decimal point."""
    if not is_decimal(value) or 10**400 % int(value.q):
        return shape(value, order)
    return signed(Fraction(int(value.p), int(value.q)), decimal=True)


def rounded(value: Expr) -> Expr:
    """A function of a decimal as a decimal, anything else unchanged."""
    if value.is_number and any(map(is_decimal, value.atoms(Rational))):
        return decimal(value.evalf(DIGITS + GUARD))
    return value
