"""Is K(t, q, q', q'') a total time derivative dG/dt, and of what G?

If K = dG(t, q, q')/dt then K is linear in q'' with coefficients dG/dq', what is left is
linear in q' with coefficients dG/dq, and the rest is dG/dt: G is found by integrating one
variable after the other and subtracting.

Whether there is a G at all is decided by derivatives alone: K is a total derivative exactly
where Euler's operator annihilates it,

    E_j K = dK/dq_j - d/dt (dK/dq_j') + d2/dt2 (dK/dq_j'') = 0   for all j.

References
----------
Olver, *Applications of Lie Groups to Differential Equations*, 2nd ed., theorem 4.7.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import TIME, free_of, without_jumps
from lagcli.algebra.integral import integral
from lagcli.mechanics.system import System

Pair = tuple[Symbol, Symbol]  # the rate of a variable, and the variable


def boundary_term(expression: Expr, system: System, *, rules: bool = True) -> Expr | None:
    """G with dG/dt = expression identically, or None where none was found in closed form.

    Without `rules` only what integrates term by term is found, which takes little time.
    """
    found, rest, waiting = _closed_parts(expression, system, rules=rules)
    if waiting:
        return None
    if is_zero(rest) is True:
        return found
    if not free_of(rest, [*system.q, *system.qdot, *system.qddot]):
        return None
    part = antiderivative(rest, TIME, rules=rules)
    return None if part is None else found + part


def boundary_integral(expression: Expr, system: System) -> Expr | None:
    """G for a K that Euler's operator annihilates, with integrals that are not elementary.

    The one-form that is left, a . dq + b dt, is closed.  It is integrated along a path from a
    fixed state, one variable after the other; what comes later still has its value at the start.
    """
    found, rest, waiting = _closed_parts(expression, system)
    still = dict.fromkeys(system.qdot, sympy.S.Zero)
    if any(not free_of(rest, [rate]) for rate in system.qddot):
        return None
    slopes = [(x, simplify(rest.diff(rate).xreplace(still))) for rate, x in waiting]
    slopes.append((TIME, simplify(rest.xreplace(still))))
    for place, (variable, slope) in enumerate(slopes):
        part = _from_start(slope, variable, [x for x, _ in slopes[place + 1 :]])
        if part is None:
            return None
        found += part
    return found


def _from_start(slope: Expr, variable: Symbol, later: Sequence[Symbol]) -> Expr | None:
    """The integral of a slope by its variable, from where it is regular: from 0, or else 1."""
    for value in (sympy.S.Zero, sympy.S.One):
        try:
            fixed = slope.xreplace({x: _within(x, value) for x in later})
        except TypeError:  # of SymPy for cosh(zoo)
            continue
        start = _within(variable, value)
        if _finite(fixed) and _finite(fixed.xreplace({variable: start})):
            whole = antiderivative(fixed, variable)
            if whole is None or not _finite(whole.xreplace({variable: start})):
                factor, rest = fixed.as_independent(variable, as_Add=False)
                return factor * integral(rest, variable, start, variable)
            return whole - whole.xreplace({variable: start})
    return None


def _within(variable: Symbol, value: Expr) -> Expr:
    return -value if variable.is_negative else value


def _finite(formula: Expr) -> bool:
    return not formula.has(sympy.zoo, sympy.nan, sympy.oo, sympy.I)


def _closed_parts(
    expression: Expr, system: System, *, rules: bool = True
) -> tuple[Expr, Expr, list[Pair]]:
    """A part of G in closed form, what is left of K, and the variables not integrated by."""
    rest = expression
    found = sympy.S.Zero
    for rates, variables in ((system.qddot, system.qdot), (system.qdot, system.q)):
        waiting = list(zip(rates, variables, strict=True))
        while waiting:
            # any order will do: what cannot be integrated by x is often easy by y
            for rate, variable in waiting:
                part = _part(rest, rate, variable, rates, rules=rules)
                if part is not None:
                    break
            else:
                return found, rest, waiting
            waiting.remove((rate, variable))
            if part != 0:
                found += part
                rest = simplify(rest - system.total_derivative(part))
    return found, rest, []


def _part(
    rest: Expr, rate: Symbol, variable: Symbol, rates: tuple[Symbol, ...], *, rules: bool
) -> Expr | None:
    """The antiderivative by a variable of what multiplies its rate; None where not found."""
    coefficient = rest.diff(rate) if rate in rest.free_symbols else sympy.S.Zero
    if is_zero(coefficient) is True:
        return sympy.S.Zero
    coefficient = simplify(coefficient)
    return None if coefficient.has(*rates) else antiderivative(coefficient, variable, rules=rules)


def euler_operator(expression: Expr, system: System) -> list[Expr]:
    """E_j K for each coordinate; the third and fourth derivatives of q are symbols there."""
    marks = ("'''", "''''")
    higher = ([Symbol(q.name + mark, real=True) for q in system.q] for mark in marks)
    orders = (system.q, system.qdot, system.qddot, *higher)

    def rate(formula: Expr) -> Expr:
        terms = [formula.diff(TIME)]
        for below, above in pairwise(orders):
            terms += [v * formula.diff(x) for x, v in zip(below, above, strict=True)]
        return without_jumps(sympy.Add(*terms))

    return [
        without_jumps(expression.diff(q) - rate(expression.diff(v) - rate(expression.diff(a))))
        for q, v, a in zip(system.q, system.qdot, system.qddot, strict=True)
    ]
