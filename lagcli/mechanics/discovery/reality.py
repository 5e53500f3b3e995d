"""Where a charge is real: square roots of parameters that may have either sign."""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.statements.motions import Above


def real_where(charge: NoetherCharge, system: System) -> tuple[Above, ...]:
    """What must be positive for the transformation, gauge and charge to be real where L is."""
    given = charge.transformation
    formulas = [*given.changes, given.time, charge.charge, charge.gauge or sympy.S.Zero]
    moving = {system.t, *system.q, *system.qdot}
    bounds = {bound for formula in formulas for bound in not_negative_where_real(formula)}
    constant = (b for b in bounds if not b.free_symbols & moving and weak_sign(b) != 1)
    given_real = tuple(not_negative_where_real(system.L))
    return conditions(sorted(constant, key=_by_length), system.order, given_real)


def _by_length(bound: Expr) -> tuple[int, object]:
    return int(bound.count_ops()), sympy.default_sort_key(bound)
