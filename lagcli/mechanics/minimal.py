"""The same motion in fewer coordinates: holonomic constraints that are solved are put in.

With q_i = f_i(q, t) for the coordinates that the constraints give, the Lagrangian of the
others is L with q_i and q_i' = df_i/dt put in, and their forces are
Q_j + sum_i Q_i df_i/dq_j.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 1.4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import shape, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.expression import ZERO, Equation
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.derivation import Derivation
from lagcli.problem_data import Constraint, Parameter, Problem


def minimal(derivation: Derivation, *, rolling: bool = False) -> Derivation:
    """The derivation itself, or that of the problem without the coordinates that are solved.

    Velocity constraints that are `integrated` are put in, too; under others it is left alone, or
    with `rolling` all of them are kept.
    """
    system, constraints = derivation.system, derivation.dynamics.constraints
    kept_constraints = [e for e in constraints.equations if not e.holonomic]
    if kept_constraints and not rolling:
        return integrated(minimal(derivation, rolling=True)) or derivation
    relations = constraints.relations
    if relations is None or relations.remaining:
        return derivation
    solved = {q: relations.solved[q] for q in system.q if q in relations.solved}
    independent = derivation.dynamics.independent_constraints
    if not solved or len(solved) != sum(constraints.equations[k].holonomic for k in independent):
        return derivation
    while not all(free_of(value, solved) for value in solved.values()):
        solved = {q: value.xreplace(solved) for q, value in solved.items()}
    if any(q.is_positive and sign(value) != 1 for q, value in solved.items()):
        return derivation
    return _without(derivation, solved, kept_constraints)


def integrated(derivation: Derivation) -> Derivation | None:
    """The same without velocity constraints on coordinates that L does not contain.

    a q' + b = 0 with constant a and b is a q + b t = 0; None of constraints of another kind.
    """
    system = derivation.system
    solved: dict[Symbol, Expr] = {}
    acting = [system.L, *system.applied_forces]
    absent = [q for q in system.q if all(free_of(x, [q]) for x in acting)]
    for e in derivation.dynamics.constraints.equations:
        if e.holonomic or not free_of(sympy.Add(*e.row, e.drift), (*system.q, system.t)):
            return None
        terms = (a * q for a, q in zip(e.row, system.q, strict=True))
        whole = simplify(sympy.Add(e.drift * system.t, *terms).xreplace(solved))
        q = next((q for q in absent if not free_of(whole, [q])), None)
        if q is None:
            return None
        value = {q: simplify(-whole.xreplace({q: S.Zero}) / whole.diff(q))}
        solved = {x: simplify(old.xreplace(value)) for x, old in solved.items()} | value
    return _without(derivation, solved, []) if solved else None


def _without(
    derivation: Derivation,
    solved: Mapping[Symbol, Expr],
    kept_constraints: Sequence[ConstraintEquation],
) -> Derivation:
    """The derivation of the other coordinates, and of the constraints that are kept."""
    system = derivation.system
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
    names = {c.name: c for c in derivation.problem.constraints}
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
    parameters = derivation.problem.parameters
    L = simplify(system.L.xreplace(put_in))
    return with_lagrangian(derivation, kept, L, forces, parameters, velocity)


def with_lagrangian(
    derivation: Derivation,
    kept: list[int],
    lagrangian: Expr,
    forces: list[Expr],
    parameters: tuple[Parameter, ...],
    constraints: tuple[Constraint, ...] = (),
) -> Derivation:
    """The derivation of another Lagrangian for some of the coordinates.

    Its parameters have no values: what holds for all of them is tested anywhere.
    """
    old = derivation.problem
    names = [derivation.system.names[j] for j in kept]
    order = (*derivation.system.order, *(p.name for p in parameters))
    problem = Problem(
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
    made = Derivation(problem)
    before = [name for name in derivation.system.order if name in {p.name for p in parameters}]
    made.system.order = (*before, *(name for name in made.system.order if name not in before))
    return made
