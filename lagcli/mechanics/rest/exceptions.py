"""Values of the parameters for which conditions without a solution may have one."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import written
from lagcli.algebra.factors import factors_of
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.expression import Expression

_MOST_CONDITIONS = 4  # of which each is left out in turn


def without_unknowns(
    conditions: Sequence[Expr], unknowns: Sequence[Symbol]
) -> tuple[Expr, ...] | None:
    """What no choice of the unknowns makes 0, but perhaps one of parameters.

    None where all conditions may hold for special values of parameters that are not known, or for
    special functions.
    """
    if any(e.atoms(AppliedUndef) for e in conditions):
        return None
    found = _factors_without(conditions, unknowns)
    if found or any(sign(e) in (1, -1) for e in conditions):
        return found
    return None if _may_hold_for_special_values(conditions, unknowns) else ()


def _may_hold_for_special_values(conditions: Sequence[Expr], unknowns: Sequence[Symbol]) -> bool:
    """Whether all but one have a solution at which parameters decide that one, or a factor does."""
    if len(conditions) > _MOST_CONDITIONS:
        return False
    for k, left in enumerate(conditions):
        others = [e for j, e in enumerate(conditions) if j != k]
        solutions = solve_system(others, unknowns, families=True).solutions if others else ()
        if solutions and _perhaps_zero(left, unknowns):
            return True
        for each in solutions:
            rest = simplify(left.xreplace(dict(each.values)))
            if rest.free_symbols and free_of(rest, unknowns) and sign(rest) not in (1, -1):
                return True
    return False


def unless_written(
    vanishing: Sequence[Expr] | None, order: Sequence[str]
) -> tuple[Expression, ...] | None:
    """`unless` as it is read."""
    return None if vanishing is None else tuple(written(e, order) for e in vanishing)


def _factors_without(conditions: Sequence[Expr], unknowns: Sequence[Symbol]) -> tuple[Expr, ...]:
    open_ = [simplify(e) for e in conditions if free_of(e, unknowns)]
    open_ = [e for e in open_ if e != 0]
    if open_:
        deciding = [_perhaps_zero(e, unknowns) for e in open_]
        found = tuple({sympy.Mul(*each): None for each in deciding}) if all(deciding) else ()
        # sin(a) and cos(a) do not vanish together
        squares = simplify(sympy.Add(*(e**2 for e in found)))
        return () if squares.is_number and squares != 0 else found
    factors = [_perhaps_zero(e, unknowns) for e in conditions]
    common = [f for f in factors[0] if all(f in other for other in factors)] if factors else []
    return (sympy.Mul(*common),) if common else ()


def _perhaps_zero(condition: Expr, unknowns: Sequence[Symbol]) -> list[Expr]:
    """The factors without unknowns that can vanish."""
    return [
        f
        for f, k in factors_of(condition)
        if k > 0 and free_of(f, unknowns) and sign(f) not in (1, -1)
    ]
