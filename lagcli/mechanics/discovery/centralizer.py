"""Symmetries made invariant under the total momenta: relative angular momentum and the like.

Two bodies have the rotation of all, the rotation about the centre of mass and their
difference; the basis with fewest entries has a mixture.  Where a combination with other
time-independent rotations commutes with all translations, it is taken instead:
[X, P] = 0 with X = sum xi_j d/dq_j, P = sum c_j d/dq_j is sum_j c_j dxi_i/dq_j = 0.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr

from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import kernel_modulo
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.noether import Transformation
from lagcli.mechanics.system import System


def centralized(
    transformations: Sequence[Transformation], system: System, allowed: Allowance
) -> list[Transformation]:
    """The same space of symmetries, with the last rotations made to commute with translations."""
    q = set(system.q)
    result = list(transformations)
    static = [
        k for k, x in enumerate(result)
        if x.time == 0 and system.t not in sympy.Tuple(*x.changes).free_symbols
    ]  # fmt: skip
    momenta = [k for k in static if not sympy.Tuple(*result[k].changes).free_symbols & q]
    turns = [k for k in static if k not in momenta]
    joint = [k for k in momenta if sum(c != 0 for c in result[k].changes) > 1]
    if not joint or len(turns) < 2:
        return result
    vectors: list[list[Expr]] = [
        [
            sympy.Add(*(c * e.diff(x) for c, x in zip(result[m].changes, system.q, strict=True)))
            for m in joint
            for e in result[k].changes
        ]
        for k in turns
    ]
    relation = Relation(vectors, [system.t, *system.q], allowed)
    _, kernel = kernel_modulo(relation.rows(len(turns) + 8), len(turns))
    exact = ExactSolver(relation.points)
    for combination in kernel:
        indices = sorted(combination)
        values = exact.recognized([combination[i] for i in indices])
        values = values or exact.solved([vectors[i] for i in indices])
        if values is None or len(indices) < 2:
            continue
        changes = [
            sympy.Add(
                *(c * result[turns[i]].changes[j] for i, c in zip(indices, values, strict=True))
            )
            for j in range(len(system.q))
        ]
        result[turns[indices[-1]]] = Transformation(
            scaled(changes, set(system.parameters)), sympy.S.Zero
        )
    return result
