"""Exact coefficients of an integral on one curved surface, in a chart of it.

Where the constraints are solved for coordinates, or a single f(q) = 0 is left that is of second
degree in a coordinate, which then is a square root of the others, dQ/dt = 0 becomes an identity
in independent variables: linear equations over the field of the parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.dynamics import Dynamics

_MOST_TERMS = 16


def solved_in_chart(
    values: Sequence[Expr], dynamics: Dynamics, allowed: Allowance
) -> list[Expr] | None:
    """c with sum c_k values_k constant on the motion, the last one 1; None where not found."""
    chart, motion = _chart(dynamics), dynamics.motion
    if chart is None or motion is None or len(values) > _MOST_TERMS:
        return None
    put, dependent = chart
    system = dynamics.system
    moving = list(zip(system.q, system.qdot, strict=True))
    pushed = list(zip(system.qdot, motion.accelerations, strict=True))

    def rate(value: Expr) -> Expr:
        return put(sympy.Add(*(value.diff(x) * dx for x, dx in (*moving, *pushed))))

    variables = [s for s in (*system.q, *system.qdot) if s not in dependent]
    found = Relation([[rate(value)] for value in values], variables, allowed).of_last()
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
    if not positions:
        return relations.substitute, set(relations.solved)
    if len(positions) > 1 or relations.solved:
        return None
    [f] = positions
    for x, dx in zip(reversed(system.q), reversed(system.qdot), strict=True):
        if f.is_polynomial(x) and sympy.degree(f, x) == 2:
            return _half(f, x, dx, dynamics), {x, dx}
    return None


def _half(f: Expr, x: Symbol, dx: Symbol, dynamics: Dynamics) -> Callable[[Expr], Expr]:
    """What puts x and x' on the surface f = 0, of second degree in x."""
    a, b, c = sympy.Poly(f, x).all_coeffs()
    root = (-b + sympy.sqrt(sympy.expand(b**2 - 4 * a * c))) / (2 * a)
    rates = zip(dynamics.system.q, dynamics.system.qdot, strict=True)
    follows = -sympy.Add(*(f.diff(y) * dy for y, dy in rates if y != x)) / f.diff(x)
    return lambda e: e.xreplace({dx: follows}).xreplace({x: root})
