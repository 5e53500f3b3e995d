"""Where a charge is real: square roots of parameters that may have either sign."""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.reduction.readable import conditions
from lagcli.mechanics.system import System
from lagcli.statements.motions import Above


def real_where(charge: NoetherCharge, system: System) -> tuple[Above, ...]:
    """What must be positive for the transformation, its gauge and its charge to be real."""
    given = charge.transformation
    formulas = [*given.changes, given.time, charge.charge, charge.gauge or sympy.S.Zero]
    radicands = dict.fromkeys(
        radicand for formula in formulas for radicand in _radicands(formula, system)
    )
    return conditions(sorted(radicands, key=sympy.count_ops), system.order)


def _radicands(formula: Expr, system: System) -> list[Expr]:
    moving = {system.t, *system.q, *system.qdot}
    roots = [
        power.base
        for power in formula.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q % 2 == 0 and not power.base.free_symbols & moving
    ]
    return sorted(roots, key=sympy.default_sort_key)
