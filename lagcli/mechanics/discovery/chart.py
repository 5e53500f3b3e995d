"""Exact coefficients of an integral on one curved surface, in a chart of it.

Where the constraints are solved for coordinates, or a single f(q) = 0 is left that is of second
degree in a coordinate, which then is a square root of the others, dQ/dt = 0 becomes an identity
in independent variables: linear equations over the field of the parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.dynamics import Dynamics

_MOST_TERMS = 16


def solved_in_chart(
    rates: Sequence[Expr],
    dependent: AbstractSet[Expr],
    dynamics: Dynamics,
    allowed: Allowance,
) -> list[Expr] | None:
    """c with sum c_k rates_k = 0 on the surface; None where not found.

    The rates have none of the `dependent` velocities.
    """
    chart = _chart(dynamics)
    if chart is None or len(rates) > _MOST_TERMS:
        return None
    put, gone = chart
    system = dynamics.system
    variables = [
        s for s in (system.t, *system.q, *system.qdot) if s not in gone and s not in dependent
    ]
    found = Relation([[put(rate)] for rate in rates], variables, allowed).of_last()
    return None if found is None else _without_common([*found, sympy.S.One])


def _without_common(values: Sequence[Expr]) -> list[Expr]:
    """Polynomials without a common factor, such as (a^2 - b^2)^3, where they are quotients."""
    fractions = [sympy.fraction(sympy.together(x)) for x in values]
    below = sympy.lcm_list([b for _, b in fractions])
    tops = [sympy.cancel(a * below / b) for a, b in fractions]
    common = sympy.gcd_list(tops)
    return [sympy.factor(sympy.cancel(x / common)) for x in tops]


def _chart(dynamics: Dynamics) -> tuple[Callable[[Expr], Expr], set[Expr]] | None:
    """What puts a formula on (one half of) the surface, and the symbols that are gone then."""
    relations, system = dynamics.constraints.relations, dynamics.system
    if relations is None:
        return None
    positions = [f for f in relations.remaining if free_of(f, system.qdot)]
    gone: set[Expr] = set(relations.solved)
    if not positions:
        return relations.substitute, gone
    if len(positions) > 1:
        return None
    [f] = positions
    for x in reversed(system.q):
        if f.is_polynomial(x) and sympy.degree(f, x) == 2:
            return _half(f, x), {*gone, x}
    return None


def _half(f: Expr, x: Symbol) -> Callable[[Expr], Expr]:
    """What puts x on the surface f = 0, of second degree in x."""
    a, b, c = sympy.Poly(f, x).all_coeffs()
    root = (-b + sympy.sqrt(sympy.expand(b**2 - 4 * a * c))) / (2 * a)
    return lambda e: e.xreplace({x: root})
