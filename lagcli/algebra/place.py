"""The value of a formula at a place: roots, multiple angles and infinite parts among it."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from contextlib import suppress

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra.build import CIRCULAR, without_jumps
from lagcli.algebra.decimals import rounded
from lagcli.algebra.entry import Field
from lagcli.algebra.numeric import Evaluator, vanishes_at_random, with_assumed_sign
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import is_zero, simplify

#: What stands in a formula that has no value somewhere.
NO_VALUE = S.NaN, S.ComplexInfinity
_LAST_DIGITS = mpf("1e-13")


def at(expression: Expr, values: Mapping[Symbol, Expr]) -> Expr:
    """The value at a place; multiple angles are expanded, so that sin(acos(k)) is radical."""
    present = {s: v for s, v in values.items() if s in expression.free_symbols}
    if not present:
        return expression
    expression = without_jumps(expression)
    if not expression.has(*CIRCULAR, sympy.sinh, sympy.cosh):
        # one fraction of sums of roots would be long, and is needed where parts are infinite only
        there = expression.xreplace(present)
        if not there.has(S.NaN, S.ComplexInfinity, S.Infinity, S.NegativeInfinity):
            return rounded(simplify(there))
        roots = (p for p in expression.atoms(sympy.Pow) if _divides_by_root(p))
        if any(is_zero(p.base.xreplace(present)) is True for p in roots):
            return S.NaN
    elif all(v.is_number for v in present.values()) and not _divides_by(expression, present):
        there = expression.xreplace(present)
        if not there.has(S.NaN, S.ComplexInfinity, *CIRCULAR):
            return rounded(simplify(there))
    field, element = Field([expression]), None
    with suppress(ZeroDivisionError):
        element = field(expression)
        expression = field.to_sympy(element)
    value = rounded(simplify(expression.xreplace(present)))
    if value != 0 or element is None:
        return value
    below = field.to_sympy(field.polynomial(element.denominator))
    return S.NaN if is_zero(below.xreplace(present)) is True else value


def lies_in(family: Mapping[Symbol, Expr], values: Mapping[Symbol, Expr]) -> bool:
    """Whether a place, or a family of places, is among those of a family."""
    return all(is_zero(values.get(s, s) - at(v, values)) is True for s, v in family.items())


def where_positive(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """The same where these are positive: sign and modulus of what is in proportion to them."""
    known: dict[Expr, Expr] = {}
    for node in expression.atoms(sympy.Abs, sympy.sign):
        for side in (sign(simplify(node.args[0] / u)) for u in positive):
            if side in (1, -1):
                known[node] = S(side) if node.func is sympy.sign else side * node.args[0]
    return expression.xreplace(known)


def nearly_vanishes(force: Expr, values: Mapping[Symbol, Expr], rounded: list[Symbol]) -> bool:
    """Whether the force changes its sign, or vanishes, within the last digits of the values.

    Letters that remain in it have random values, of the sign they are assumed to have.
    """
    put_in = list(values.items())
    slopes = [force.diff(q) * values[q] for q in rounded]
    there = [x.subs(put_in, simultaneous=True) for x in (force, *slopes)]
    letters = sorted({s for x in there for s in x.free_symbols}, key=lambda s: s.name)
    source, evaluator = random.Random("letters"), Evaluator(there)
    for _ in range(2 if letters else 1):
        drawn = {s: mpf(source.randint(100, 3000)) / 1009 for s in letters}
        found = evaluator.where_defined(
            {s: with_assumed_sign(source, s, size) for s, size in drawn.items()}
        )
        if found is None or not all(isinstance(x, mpf) and mpmath.isfinite(x) for x in found):
            return False
        residual, *moved = found
        if abs(residual) > _LAST_DIGITS * sum(map(abs, moved), mpf("1e-25")):
            return False
    return True


def vanishes(expression: Expr) -> bool:
    """Whether it is 0 to many digits, which a singular point of the potential is not."""
    if not expression.is_number:
        return vanishes_at_random(expression)
    value = expression.evalf(50)
    return value is not sympy.nan and bool(abs(value) < sympy.Float("1e-40"))


def _divides_by(expression: Expr, moving: Mapping[Symbol, Expr]) -> bool:
    """Whether a power of what moves may be a divisor."""
    powers = (p for p in expression.atoms(sympy.Pow) if p.exp.is_nonnegative is not True)
    return any(p.free_symbols & moving.keys() for p in powers)


def _divides_by_root(power: sympy.Pow) -> bool:
    return bool(power.exp.is_Rational and not power.exp.is_Integer and power.exp < 0)
