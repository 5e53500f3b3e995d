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

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Clock
from lagcli.mechanics.discovery.modular import kernel_modulo
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.noether import Transformation


def tangent(
    transformations: Sequence[Transformation], dynamics: Dynamics, clock: Clock
) -> list[Transformation]:
    """A basis of the combinations of transformations that are tangent to all constraints."""
    if not transformations:
        return []
    system, relations = dynamics.system, dynamics.constraints.relations
    vectors: list[list[Expr]] = []
    for transformation in transformations:
        clock.check()
        vector = []
        for equation in dynamics.constraints.equations:
            across = sympy.Add(
                *(a * x for a, x in zip(equation.row, transformation.changes, strict=True)),
                equation.drift * transformation.time,
            )
            across = simplify(across, relations)
            # what vanishes on the surface is no condition
            vector.append(sympy.S.Zero if is_zero(across, relations) is True else across)
        vectors.append(vector)
    # the simplest transformations last: each combination has one that no other has
    order = list(reversed(range(len(vectors))))
    variables = [system.t, *system.q, *system.qdot]
    relation = Relation([vectors[k] for k in order], variables, clock)
    _, kernel = kernel_modulo(relation.rows(len(vectors) + 8), len(vectors))
    exact = ExactSolver(relation.points)
    found = []
    for combination in kernel:
        indices = sorted(combination)
        values = exact.recognized([combination[i] for i in indices])
        if values is None:
            values = exact.solved([relation.vectors[i] for i in indices])
        if values is None:
            continue
        chosen = [(transformations[order[i]], c) for i, c in zip(indices, values, strict=True)]
        changes = [
            sympy.Add(*(c * each.changes[j] for each, c in chosen)) for j in range(len(system.q))
        ]
        time = sympy.Add(*(c * each.time for each, c in chosen))
        *changes, time = scaled((*changes, time), set(system.parameters))
        found.append(Transformation(tuple(changes), time))
    found.reverse()
    return found
