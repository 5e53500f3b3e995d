"""Charges of the problem without the coordinates that constraints give, of the problem with them.

With q_i = f_i(q, t) put in, L of the others has dL/dq_j' = p_j + sum_i p_i df_i/dq_j and
the energy function h - sum_i p_i df_i/dt.  So Q = p.xi - h tau - G is the same function of the
motion with the displacements that the constraints then demand, a_k . xi + b_k tau = 0.

References
----------
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 17 (constraints).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from collections.abc import Set as AbstractSet

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify, solve_linear
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery import point
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.fewer_coordinates import integral_of
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.mechanics.system import System
from lagcli.record import replace


def lifted(
    charges: Iterable[NoetherCharge], fewer: System, noether: Noether
) -> Iterator[NoetherCharge]:
    """The charges of the system with `fewer` coordinates that are proved for the whole one."""
    constants = set(noether.system.parameters)
    for charge in charges:
        given = charge.transformation
        moved = dict(zip(fewer.q, given.changes, strict=True))
        whole = _with_given(moved, given.time, noether)
        if whole is None or charge.gauge is None:
            continue
        values = (*whole, given.time)
        readable = scaled(values, constants)
        scale = _denominators(readable, constants)
        readable = tuple(simplify(scale * x) for x in readable)
        pairs = zip(readable, values, strict=True)
        factor = next(simplify(new / old) for new, old in pairs if old != 0)
        if given.time == 0 and factor.could_extract_minus_sign():
            factor, readable = -factor, tuple(-x for x in readable)
        *changes, time = readable
        transformation = Transformation(tuple(changes), time)
        proved = point.with_gauge(noether, transformation, simplify(factor * charge.gauge))
        if proved is not None:
            yield (
                proved
                if point.is_energy(transformation)
                else _shorter(proved, simplify(factor * charge.charge), noether)
            )


def growth_of(noether: Noether) -> Expr | None:
    """exp(Gamma) where the forces are -Gamma'(t) dL/dq', those of exp(Gamma) L; None elsewhere."""
    system = noether.system
    pairs = zip(system.applied_forces, noether.dynamics.lagrange.momenta, strict=True)
    rates = {simplify(-force / p) if p != 0 else sympy.nan for force, p in pairs}
    rate = rates.pop()
    if rates or rate in {0, sympy.nan} or not free_of(rate, (*system.q, *system.qdot)):
        return None
    integral = antiderivative(rate, system.t)
    return None if integral is None else simplify(sympy.exp(integral))


def of_growing(
    charges: Iterable[NoetherCharge], growth: Expr, noether: Noether
) -> Iterator[NoetherCharge]:
    """The charges of exp(Gamma) L with the multipliers that L has for them."""
    for charge in charges:
        given = charge.transformation
        if charge.gauge is not None:
            *changes, time = (simplify(growth * x) for x in (*given.changes, given.time))
            proved = point.with_gauge(noether, Transformation(tuple(changes), time), charge.gauge)
            if proved is not None:
                yield replace(proved, charge=charge.charge)


def of_velocity_constraints(noether: Noether) -> Iterator[NoetherCharge]:
    """a q + B(t) of each constraint a q' + B'(t) = 0 with constant a."""
    dynamics, system = noether.dynamics, noether.system
    relations = dynamics.constraints.relations
    assert relations is not None
    for k in dynamics.independent_constraints:
        e = dynamics.constraints.equations[k]
        *row, drift = (simplify(relations.substitute(x)) for x in (*e.row, e.drift))
        integral = None if e.holonomic else integral_of(row, drift, system)
        if integral is None:
            continue
        still = Transformation((sympy.S.Zero,) * len(system.q), sympy.S.Zero)
        proved = point.with_gauge(noether, still, -integral)
        if proved is not None:
            yield proved


def _denominators(values: Iterable[Expr], constants: AbstractSet[Expr]) -> Expr:
    """The product of the constants by which they are divided: cos(alpha) of tan(alpha)."""
    open_ = (x.replace(sympy.tan, lambda u: sympy.sin(u) / sympy.cos(u)) for x in values)
    below: Expr = sympy.S.One
    for x in open_:
        below = sympy.lcm(below, sympy.denom(sympy.together(x)))
    return below.as_independent(*(below.free_symbols - constants), as_Add=False)[0]


def _shorter(charge: NoetherCharge, fewer: Expr, noether: Noether) -> NoetherCharge:
    """With the constraints used, where that makes it no longer."""
    longer = sympy.count_ops(fewer) > sympy.count_ops(charge.charge)
    if longer or noether.dynamics.verifier.is_zero(charge.charge - fewer).holds is not True:
        return charge
    return replace(charge, charge=fewer)


def _with_given(moved: dict[Expr, Expr], time: Expr, noether: Noether) -> tuple[Expr, ...] | None:
    """xi of all coordinates, by a_k . xi + b_k tau = 0."""
    dynamics, q = noether.dynamics, noether.system.q
    rows = [dynamics.constraints.equations[k] for k in dynamics.independent_constraints]
    given = [i for i, x in enumerate(q) if x not in moved]
    kept = [i for i, x in enumerate(q) if x in moved]
    right = [-dot([e.row[i] for i in kept], [moved[q[i]] for i in kept]) - e.drift * time
             for e in rows]  # fmt: skip
    if len(rows) != len(given):
        return None
    solution = solve_linear(
        [[e.row[i] for i in given] for e in rows], right, shapes=dynamics.shapes
    )
    if solution is None or solution.singular:
        return None
    values = {**moved, **dict(zip((q[i] for i in given), solution.values, strict=True))}
    return tuple(values[x] for x in q)
