"""The equations of motion to first order about an equilibrium, along the constraint surface.

With q = q0 + B x, the columns of B spanning the displacements with A(q0) dq = 0,

    M x'' + C x' + K x = 0,
    M = B^T (mass matrix) B,   C = -B^T (d forcing/dq') B,
    K = -B^T d(forcing + A^T lambda0)/dq B,

where lambda0 holds the constraint forces at rest.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 6.1 and 6.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy
from sympy import Expr, S

from lagcli.algebra import is_zero, nullspace, simplify, solve_linear
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.oscillations.equilibria import RestPoint, RestPoints, at

Matrix = list[list[Expr]]


class Linearization:
    """M, C and K about one equilibrium, shapes (n, n) with n degrees of freedom.

    Attributes
    ----------
    basis : list of list of Expr
        The columns of B, each a displacement of all coordinates.
    """

    def __init__(self, rest: RestPoints, point: RestPoint) -> None:
        self.dynamics: Dynamics = rest.dynamics
        self.system = rest.system
        self.point = point
        self._rest = rest
        rows = [[at(a, point.values) for a in row] for row in self.dynamics.constraints.jacobian]
        self._rows = rows
        n = len(self.system.q)
        self.basis: Matrix = (
            nullspace(rows)
            if rows
            else [[S.One if i == j else S.Zero for j in range(n)] for i in range(n)]
        )

    @property
    def forces_at_rest(self) -> tuple[Expr, ...]:
        """forcing(q, q' = 0)."""
        return self._rest.forces_at_rest

    @cached_property
    def M(self) -> Matrix:
        """The mass matrix."""
        return self._along(self.dynamics.lagrange.mass_matrix)

    @cached_property
    def C(self) -> Matrix:
        """Damping (symmetric part) and gyroscopic terms (antisymmetric part)."""
        forcing = self.dynamics.lagrange.forcing
        return self._along([[-f.diff(v) for v in self.system.qdot] for f in forcing])

    @cached_property
    def K(self) -> Matrix:
        """The stiffness."""
        equations = self.dynamics.constraints.equations
        lam = self._constraint_forces()
        total = [
            force + sympy.Add(*(x * e.row[j] for x, e in zip(lam, equations, strict=True)))
            for j, force in enumerate(self._rest.forces_at_rest)
        ]
        return self._along([[-f.diff(q) for q in self.system.q] for f in total])

    def _constraint_forces(self) -> list[Expr]:
        """lambda0 with A^T lambda0 = -forcing: from A A^T lambda0 = -A forcing."""
        if not self._rows:
            return []
        kept = self.dynamics.independent_constraints
        rows = [self._rows[k] for k in kept]
        forces = [at(f, self.point.values) for f in self._rest.forces_at_rest]
        gram = [[_dot(a, b) for b in rows] for a in rows]
        solution = solve_linear(gram, [-_dot(a, forces) for a in rows])
        lam: list[Expr] = [S.Zero] * len(self._rows)
        if solution is None or solution.singular:
            raise ZeroDivisionError
        for k, value in zip(kept, solution.values, strict=True):
            lam[k] = value
        return lam

    def _along(self, matrix: Sequence[Sequence[Expr]]) -> Matrix:
        """B^T matrix B at the equilibrium, with q' = 0."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        values = [
            [at(entry.xreplace(still), self.point.values) if entry else S.Zero for entry in row]
            for row in matrix
        ]
        return [
            [
                simplify(
                    sympy.Add(
                        *(
                            u[i] * values[i][j] * v[j]
                            for i in range(len(u))
                            for j in range(len(v))
                            if u[i] and v[j] and values[i][j]
                        )
                    )
                )
                for v in self.basis
            ]
            for u in self.basis
        ]

    # -- its kind --------------------------------------------------------------------------------

    @property
    def damping(self) -> Matrix:
        """The symmetric part of C, by which Rayleigh's function is x'.damping.x'/2."""
        n = len(self.C)
        return [[simplify((self.C[i][j] + self.C[j][i]) / 2) for j in range(n)] for i in range(n)]

    @cached_property
    def damped(self) -> bool:
        """Whether C has a symmetric part."""
        return any(
            is_zero(self.C[i][j] + self.C[j][i]) is not True
            for i in range(len(self.C))
            for j in range(i, len(self.C))
        )

    @cached_property
    def gyroscopic(self) -> bool:
        """Whether C has an antisymmetric part."""
        return any(
            is_zero(self.C[i][j] - self.C[j][i]) is not True
            for i in range(len(self.C))
            for j in range(i)
        )

    @property
    def nonholonomic(self) -> bool:
        """Whether a constraint cannot be integrated: displacements have other rules then."""
        return "nonholonomic" in self.dynamics.constraints.kinds.values()

    @cached_property
    def has_potential(self) -> bool:
        """Whether K is symmetric."""
        return all(
            is_zero(self.K[i][j] - self.K[j][i]) is True
            for i in range(len(self.K))
            for j in range(i)
        )

    @cached_property
    def regular(self) -> bool:
        """Whether the mass matrix can be inverted there."""
        if not self.M:
            return False
        solution = solve_linear(self.M, [S.Zero] * len(self.M))
        return solution is not None and not solution.singular


def _dot(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    return sympy.Add(*(x * y for x, y in zip(a, b, strict=True)))
