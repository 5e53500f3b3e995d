"""Is K(t, q, q', q'') a total time derivative dG/dt, and of what G?

If K = dG(t, q, q')/dt then K is linear in q'' with coefficients dG/dq', what is left is
linear in q' with coefficients dG/dq, and the rest is dG/dt: G is found by integrating one
variable after the other and subtracting.  K is no total derivative when something is left.
"""

from __future__ import annotations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import TIME, free_of
from lagcli.mechanics.system import System


def boundary_term(expression: Expr, system: System) -> Expr | None:
    """G with dG/dt = expression identically, or None where none was found."""
    rest = expression
    found = sympy.S.Zero
    for rates, variables in ((system.qddot, system.qdot), (system.qdot, system.q)):
        waiting = list(zip(rates, variables, strict=True))
        while waiting:
            # any order will do: what cannot be integrated by x is often easy by y
            for rate, variable in waiting:
                part = _part(rest, rate, variable, rates)
                if part is not None:
                    break
            else:
                return None
            waiting.remove((rate, variable))
            if part != 0:
                found += part
                rest = simplify(rest - system.total_derivative(part))
    if is_zero(rest) is True:
        return found
    if not free_of(rest, [*system.q, *system.qdot, *system.qddot]):
        return None
    part = antiderivative(rest, TIME)
    return None if part is None else found + part


def _part(rest: Expr, rate: Symbol, variable: Symbol, rates: tuple[Symbol, ...]) -> Expr | None:
    """The antiderivative by a variable of what multiplies its rate; None where not found."""
    coefficient = rest.diff(rate) if rate in rest.free_symbols else sympy.S.Zero
    if is_zero(coefficient) is True:
        return sympy.S.Zero
    coefficient = simplify(coefficient)
    return None if coefficient.has(*rates) else antiderivative(coefficient, variable)
