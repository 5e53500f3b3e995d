"""The Euler-Lagrange equations and the matrices they are made of.

    d/dt(dL/dq_j') - dL/dq_j = Q_j - dD/dq_j' + sum_k lambda_k a_kj

written out is M q'' = forcing + A^T lambda with the mass matrix
M_ij = d2L/dq_i' dq_j' and forcing_i = Q_i - dD/dq_i' + dL/dq_i
- sum_j (d2L/dq_i' dq_j) q_j' - d2L/dq_i' dt.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 1.4 and 1.5.
Landau, Lifshitz, *Mechanics*, 3rd ed., sections 2 and 25.
"""

from __future__ import annotations

from functools import cached_property

import sympy
from sympy import Expr

from lagcli.algebra.build import free_of, without_jumps
from lagcli.mechanics.system import System


class EulerLagrange:
    """Momenta, mass matrix and forcing of a system, before any constraint."""

    def __init__(self, system: System) -> None:
        self.system = system

    @cached_property
    def momenta(self) -> tuple[Expr, ...]:
        """p_j = dL/dq_j'."""
        return tuple(without_jumps(self.system.L.diff(v)) for v in self.system.qdot)

    @cached_property
    def lagrangian_forces(self) -> tuple[Expr, ...]:
        """dL/dq_j."""
        return tuple(without_jumps(self.system.L.diff(q)) for q in self.system.q)

    @cached_property
    def mass_matrix(self) -> tuple[tuple[Expr, ...], ...]:
        """M_ij = d2L/dq_i' dq_j', the Hessian of L, shape (n, n), symmetric."""
        system = self.system
        if self._from_points:
            return self._mass_matrix_of_points()
        n = len(system.q)
        upper = {
            (i, j): without_jumps(self.momenta[i].diff(system.qdot[j]))
            for i in range(n)
            for j in range(i, n)
        }
        return tuple(tuple(upper[min(i, j), max(i, j)] for j in range(n)) for i in range(n))

    @cached_property
    def mass_matrix_at_rest(self) -> tuple[tuple[Expr, ...], ...]:
        """M where q' = 0."""
        still = dict.fromkeys(self.system.qdot, sympy.S.Zero)
        return tuple(tuple(entry.xreplace(still) for entry in row) for row in self.mass_matrix)

    @cached_property
    def forcing(self) -> tuple[Expr, ...]:
        """What stands beside M q'': velocity terms, potential and applied forces, shape (n,)."""
        if self._from_points:
            return self._forcing_of_points()
        system = self.system
        at_rest = dict.fromkeys(system.qddot, sympy.S.Zero)
        return tuple(
            applied + force - system.total_derivative(momentum).xreplace(at_rest)
            for applied, force, momentum in zip(
                system.applied_forces, self.lagrangian_forces, self.momenta, strict=True
            )
        )

    @cached_property
    def left_sides(self) -> tuple[Expr, ...]:
        """d/dt(dL/dq_j') - dL/dq_j with q'' in it."""
        return tuple(
            self.system.total_derivative(momentum) - force
            for momentum, force in zip(self.momenta, self.lagrangian_forces, strict=True)
        )

    # -- from the Jacobians of the points ----------------------------------------------

    @cached_property
    def _from_points(self) -> bool:
        """T is the sum over points of constant mass and V has no velocities in it."""
        system, problem = self.system, self.system.problem
        return (
            problem.lagrangian is None
            and problem.kinetic is None
            and system.V is not None
            and free_of(system.V, system.qdot)
            and all(
                p.mass is not None and free_of(p.mass, [*system.q, *system.qdot, system.t])
                for p in system.particles
            )
        )

    @cached_property
    def _jacobians(self) -> tuple[tuple[Expr, tuple[Expr, ...], Expr], ...]:
        """For each component of each point: m, dr/dq_j, and r'' with q'' = 0."""
        system = self.system
        still = dict.fromkeys(system.qddot, sympy.S.Zero)
        rows = []
        for particle in system.particles:
            for x in particle.position:
                velocity = system.total_derivative(x)
                rows.append(
                    (
                        particle.mass,
                        tuple(x.diff(q) for q in system.q),
                        system.total_derivative(velocity).xreplace(still),
                    )
                )
        return tuple(rows)

    def _mass_matrix_of_points(self) -> tuple[tuple[Expr, ...], ...]:
        """M_ij = sum m (dr/dq_i) . (dr/dq_j)."""
        n = len(self.system.q)
        upper = {
            (i, j): sympy.Add(
                *(m * row[i] * row[j] for m, row, _ in self._jacobians if row[i] and row[j])
            )
            for i in range(n)
            for j in range(i, n)
        }
        return tuple(tuple(upper[min(i, j), max(i, j)] for j in range(n)) for i in range(n))

    def _forcing_of_points(self) -> tuple[Expr, ...]:
        """Q_i - dD/dq_i' - dV/dq_i - sum m (dr/dq_i) . (r'' with q'' = 0)."""
        system = self.system
        assert system.V is not None
        potential = system.V
        return tuple(
            applied
            - without_jumps(potential.diff(q))
            - sympy.Add(*(m * row[i] * c for m, row, c in self._jacobians if row[i] and c))
            for i, (applied, q) in enumerate(zip(system.applied_forces, system.q, strict=True))
        )
