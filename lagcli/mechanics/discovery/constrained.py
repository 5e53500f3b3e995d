"""Symmetries of L that do not leave the constraints: for them d'Alembert's forces do nothing.

The constraint forces change a charge at the rate sum_k lambda_k a_k . (xi - q' tau), and on
the motion a_k . q' = -b_k.  So the charge stays where a_k . xi + b_k tau = 0, a linear
condition on the coefficients of a combination of symmetries of L.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 2.7.
Bloch, Krishnaprasad, Marsden, Murray, Arch. Rational Mech. Anal. 136 (1996) 21.
"""

from __future__ import annotations

from collections.abc import Sequence

import mpmath
from sympy import Expr

from lagcli.algebra import dot
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.row_rank import rank
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.surface import relations_on_surface
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.noether import Transformation


def tangent(
    transformations: Sequence[Transformation], dynamics: Dynamics, allowed: Allowance
) -> list[Transformation]:
    """A basis of the combinations of transformations that are tangent to all constraints."""
    if not transformations:
        return []
    system = dynamics.system
    vectors: list[list[Expr]] = [
        [
            dot(equation.row, transformation.changes) + equation.drift * transformation.time
            for equation in dynamics.constraints.equations
        ]
        for transformation in transformations
    ]
    found = []
    for combination in relations_on_surface(vectors, dynamics, allowed):
        chosen = [transformations[k] for k in combination]
        columns = zip(*((*each.changes, each.time) for each in chosen), strict=True)
        whole = [dot(list(combination.values()), column) for column in columns]
        *changes, time = scaled(whole, set(system.parameters))
        found.append(Transformation(tuple(changes), time))
    found.reverse()
    return found


def rank_on_surface(dynamics: Dynamics, charges: Sequence[Expr]) -> int | None:
    """How many of the functions are independent on the surface: the rank of their gradients.

    None where no state was found to take it at.
    """
    system, constraints = dynamics.system, dynamics.constraints
    relations = [*(e.f for e in constraints.equations if e.holonomic), *constraints.velocity_forms]
    variables = (*system.q, *system.qdot)
    evaluate = Evaluator([e.diff(x) for e in (*relations, *charges) for x in variables])
    with mpmath.workdps(DIGITS):
        for state in dynamics.states.take(3):
            try:
                values = evaluate(state)
            except (ArithmeticError, ValueError):
                continue
            width = len(variables)
            rows = [values[k : k + width] for k in range(0, len(values), width)]
            return rank(rows) - rank(rows[: len(relations)])
    return None if charges else 0


def dimension_of_states(dynamics: Dynamics) -> int:
    """How many numbers give a state: positions on the constraints, and their velocities."""
    held = dynamics.states.conditions_on_positions()
    return len(dynamics.system.q) - held + dynamics.degrees_of_freedom
