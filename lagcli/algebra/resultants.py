"""Equations in two unknowns: what one of them must satisfy alone, and the pairs of values.

An unknown that occurs in sines and cosines only is taken by t = tan(angle/2), in which both are
polynomials; where t is infinite, at pi, is a case of its own.

References
----------
Cox, Little, O'Shea, *Ideals, Varieties, and Algorithms*, 4th ed., section 3.6.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations

import sympy
from sympy import Expr, Symbol
from sympy.functions.elementary.trigonometric import InverseTrigonometricFunction

from lagcli.algebra.decimals import DIGITS, GUARD, decimal
from lagcli.algebra.entry import Field
from lagcli.algebra.equations import solve_for
from lagcli.algebra.half_angles import degree_in_angle, from_half_angle, to_half_angle
from lagcli.algebra.numeric import vanishes_at_random
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.simplification import simplify

_MOST_TERMS = 120  # measured: at most 3
_HIGHEST = 16  # measured: at most 4
_LONGEST = 40  # operations of a number; measured: at 95 the linear motion there took 40 s


def pairs_of_values(
    equations: Sequence[Expr], kept: Symbol, gone: Symbol
) -> list[dict[Symbol, Expr]] | None:
    """The pairs of values that fulfil all equations; None where not all are found."""
    resultants = (_without(two, kept, gone) for two in combinations(equations, 2))
    conditions = next((found for found in resultants if found is not None), None)
    if conditions is None:
        return None
    pairs: list[dict[Symbol, Expr]] = []
    for condition in conditions:
        roots = solve_for(condition, kept)
        if roots is None:
            return None
        for root in map(simplify, roots.values):
            if not _may_be_real(root):
                continue
            there = [substituted(e, kept, root) for e in equations]
            open_ = [e for e in there if not vanishes_at_random(e)]
            if not open_:
                return None  # a line of solutions
            solved = [solve_for(e, gone) for e in open_[: 1 + root.has(sympy.sign)]]
            if None in solved:
                return None
            candidates = [
                {kept: root, gone: simplify(other)}
                for others in solved
                for other in (others.values if others else ())
            ]
            found = [
                pair
                for pair in candidates
                if _may_be_real(pair[gone])
                and all(vanishes_at_random(_at(e, pair)) for e in equations)
            ]
            if root.has(sympy.sign) and not found:
                return None  # each may hold for one sign alone
            pairs += [_readable(pair) for k, pair in enumerate(found) if pair not in found[:k]]
    return pairs


def _readable(pair: dict[Symbol, Expr]) -> dict[Symbol, Expr]:
    """Decimals where a number would take more radicals than one reads."""
    numbers = [value for value in pair.values() if value.is_number]
    if all(value.count_ops() <= _LONGEST for value in numbers):
        return pair
    return {
        unknown: decimal(value.evalf(DIGITS + GUARD))
        if value in numbers and not (value / sympy.pi).is_Rational
        else value
        for unknown, value in pair.items()
    }


def _at(expression: Expr, pair: Mapping[Symbol, Expr]) -> Expr:
    return expression.subs(list(pair.items()), simultaneous=True)


def _may_be_real(root: Expr) -> bool:
    if root.free_symbols:
        return True
    return bool(abs(sympy.im(root.evalf(30))) < sympy.Float("1e-15"))


def substituted(expression: Expr, unknown: Symbol, root: Expr) -> Expr:
    """The root put in, sines of multiples expanded first so that sin(acos(k)) is radical."""
    if unknown not in expression.free_symbols:
        return expression
    if not root.has(InverseTrigonometricFunction):
        return expression.subs(unknown, root)
    field = Field([expression])
    try:
        return field.to_sympy(field(expression)).subs(unknown, root)
    except ZeroDivisionError:
        return expression.subs(unknown, root)


def _without(equations: Sequence[Expr], kept: Symbol, gone: Symbol) -> list[Expr] | None:
    """Equations in one unknown alone of which each solution of both fulfils one.

    None where there is no resultant, or where it vanishes: both have a factor in common.
    """
    field = Field(equations)
    polys = [field(e).numerator for e in equations]
    slots = {u: _slot(field, polys, u) for u in (kept, gone)}
    if None in slots.values() or any(len(p) > _MOST_TERMS for p in polys) or field.has_roots:
        return None
    polys = [field.ring.lift(p) for p in polys]
    angles = [g for g in slots.values() if g is not None and field.generators[g].kind == "cos"]
    for g in angles:
        polys = [to_half_angle(field, p, g, degree_in_angle(field, p, g)) for p in polys]
    places = {u: g + (g in angles) for u, g in slots.items() if g is not None}
    ring = field.ring
    if any(ring.degree(p, g) > _HIGHEST for p in polys for g in places.values()):
        return None
    resultant = polys[0].resultant(polys[1], ring.capacity - 1 - places[gone])
    if resultant == 0:
        return None
    found = []
    angle = slots[kept] if slots[kept] in angles else None
    for factor, _ in factorization(resultant)[1]:
        degree = ring.degree(factor, places[kept])
        if degree == 0:
            continue
        alone = (
            factor
            if angle is None
            else from_half_angle(field, factor, angle, degree // 2 + degree % 2)
        )
        found.append(field.polynomial_to_sympy(alone))
    if angle is not None:
        found.append(kept - sympy.pi)  # where t is infinite
    return found


def _slot(field: Field, polys: Sequence[Poly], unknown: Symbol) -> int | None:
    """The generator of an unknown, or the cosine of it; None where it stands elsewhere as well."""
    used = {g for p in polys for g in field.ring.used(p)}
    within = {g for g in used if unknown in field.generators[g].expression.free_symbols}
    if within == {field.number_of(unknown)}:
        return next(iter(within))
    cosines = {
        g if field.generators[g].kind == "cos" else field.generators[g].partner
        for g in within
        if field.generators[g].kind in ("cos", "sin") and field.generators[g].argument == unknown
    }
    known = {g + k for g in cosines for k in (0, 1)}
    return next(iter(cosines)) if len(cosines) == 1 and within <= known else None
