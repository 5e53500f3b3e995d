"""Accelerations of points by their multipliers: m x'' = Q_x + sum_k lambda_k df_k/dx.

Solved for apart, x'' on the surface of the constraints is one of many equal fractions.  Its
denominator can vanish where nothing happens, and prefer one of several like bodies.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Pow, Symbol

from lagcli.algebra import Shapes
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.euler_lagrange import EulerLagrange


def by_multipliers(
    lagrange: EulerLagrange,
    equations: Sequence[ConstraintEquation],
    accelerations: Sequence[Expr],
    multipliers: Sequence[Expr],
    shapes: Shapes,
) -> tuple[Expr, ...]:
    """The accelerations, without coordinates below where the multipliers have none there.

    Unchanged where M is not diagonal and constant.
    """
    q = {*lagrange.system.q}
    M = lagrange.mass_matrix
    apart = all(
        (entry == 0) != (i == j) and not entry.free_symbols & q
        for i, row in enumerate(M)
        for j, entry in enumerate(row)
    )
    if not apart or _below(multipliers, q) or not _below(accelerations, q):
        return tuple(accelerations)
    return tuple(
        shapes.combination(
            [force, *multipliers], [1 / M[i][i], *(e.row[i] / M[i][i] for e in equations)]
        )
        for i, force in enumerate(lagrange.forcing)
    )


def _below(values: Sequence[Expr], q: set[Symbol]) -> bool:
    """Whether a coordinate stands in a denominator."""
    powers = (power for value in values for power in value.atoms(Pow))
    return any(p.exp.is_negative and p.base.free_symbols & q for p in powers)
