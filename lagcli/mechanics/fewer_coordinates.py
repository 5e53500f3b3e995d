"""The same problem in fewer coordinates: constraints that are solved are put in.

With q_i = f_i(q, t) for the coordinates that holonomic constraints give, the Lagrangian of the
others is L with q_i and q_i' = df_i/dt put in, and their forces are
Q_j + sum_i Q_i df_i/dq_j.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 1.4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, shape, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.expression import ZERO, Equation
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.system import System
from lagcli.problem_data import Constraint, Parameter, Problem
from lagcli.record import replace


def unconstrained(dynamics: Dynamics) -> Problem | None:
    """The problem in coordinates that no constraint binds; None where there are none."""
    fewer = without_holonomic(dynamics)
    if all(e.holonomic for e in dynamics.constraints.equations):
        return fewer
    return without_integrated(dynamics if fewer is None else Dynamics(System(fewer)))


def without_holonomic(dynamics: Dynamics) -> Problem | None:
    """Without what the holonomic constraints give, all others kept; None where they are not solved.

    Where a coordinate that is positive would lose its sign, none is left out.
    """
    system, constraints = dynamics.system, dynamics.constraints
    relations = constraints.relations
    if relations is None or relations.remaining:
        return None
    solved = {q: relations.solved[q] for q in system.q if q in relations.solved}
    independent = dynamics.independent_constraints
    if not solved or len(solved) != sum(constraints.equations[k].holonomic for k in independent):
        return None
    while not all(free_of(value, solved) for value in solved.values()):
        solved = {q: value.xreplace(solved) for q, value in solved.items()}
    if any(q.is_positive and sign(value) != 1 for q, value in solved.items()):
        return None
    return _without(system, solved, [e for e in constraints.equations if not e.holonomic])


def without_integrated(dynamics: Dynamics) -> Problem | None:
    """Without velocity constraints on coordinates that L does not contain.

    None of constraints of another kind than `integral_of` has.
    """
    system = dynamics.system
    solved: dict[Symbol, Expr] = {}
    acting = [system.L, *system.applied_forces]
    absent = [q for q in system.q if all(free_of(x, [q]) for x in acting)]
    for e in dynamics.constraints.equations:
        found = integral_of(e.row, e.drift, system) if not e.holonomic else None
        if found is None:
            return None
        whole = simplify(found.xreplace(solved))
        q = next((q for q in absent if not free_of(whole, [q])), None)
        if q is None:
            return None
        value = {q: simplify(-whole.xreplace({q: S.Zero}) / whole.diff(q))}
        solved = {x: simplify(old.xreplace(value)) for x, old in solved.items()} | value
    return _without(system, solved, []) if solved else None


def integral_of(row: Sequence[Expr], drift: Expr, system: System) -> Expr | None:
    """a q + B(t) for a q' + b(t) = 0 with constant a, B' = b; None of others."""
    if not (free_of(sympy.Tuple(*row), (*system.q, system.t)) and free_of(drift, system.q)):
        return None
    moved = antiderivative(drift, system.t)
    return None if moved is None else dot(row, system.q) + moved


def _without(
    system: System, solved: Mapping[Symbol, Expr], kept_constraints: Sequence[ConstraintEquation]
) -> Problem:
    """The problem of the other coordinates, and of the constraints that are kept."""
    flow = dict(zip(system.q, system.qdot, strict=True))
    put_in: dict[Expr, Expr] = {
        **solved,
        **{flow[q]: system.total_derivative(value) for q, value in solved.items()},
    }
    kept = [j for j, q in enumerate(system.q) if q not in solved]
    forces = [
        sympy.Add(
            system.applied_forces[j],
            *(
                system.applied_forces[i] * solved[q].diff(system.q[j])
                for i, q in enumerate(system.q)
                if q in solved
            ),
        ).xreplace(put_in)
        for j in kept
    ]
    names = {c.name: c for c in system.problem.constraints}
    left = [(e.name, simplify(e.f.xreplace(put_in))) for e in kept_constraints]
    velocity = tuple(
        Constraint(
            name=name,
            equation=Equation(shape(f, system.order), ZERO),
            multiplier=names[name].multiplier,
            holds_while=None,
        )
        for name, f in left
        if f != 0
    )
    L = simplify(system.L.xreplace(put_in))
    return problem_of(system, kept, L, forces, system.problem.parameters, velocity)


def problem_of(
    system: System,
    kept: Sequence[int],
    lagrangian: Expr,
    forces: Sequence[Expr],
    parameters: tuple[Parameter, ...],
    constraints: tuple[Constraint, ...] = (),
) -> Problem:
    """The problem of another Lagrangian for some of the coordinates.

    Its parameters have no values: what holds for all of them is tested anywhere.
    """
    old = system.problem
    names = [system.names[j] for j in kept]
    order = (*system.order, *(p.name for p in parameters))
    return Problem(
        source=old.source,
        title=old.title,
        coordinates=tuple(c for c in old.coordinates if c.name in names),
        parameters=tuple(replace(p, value=None) for p in parameters),
        functions=old.functions,
        lagrangian=shape(lagrangian, order),
        forces={
            name: shape(force, order)
            for name, force in zip(names, forces, strict=True)
            if force != 0
        },
        constraints=constraints,
        initial={name: value for name, value in old.initial.items() if name.name in names},
    )
