"""The equations of motion to first order about an equilibrium, along the constraint surface.

With q = q0 + B x, the columns of B spanning the displacements with A(q0) dq = 0,

    M x'' + C x' + K x = 0,
    M = B^T (mass matrix) B,   C = -B^T (d forcing/dq') B,
    K = -B^T (d forcing/dq + lambda0^T dA/dq) B,

where lambda0 holds the constraint forces at rest.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 6.1 and 6.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.place import at, where_positive
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.rest.rest_conditions import RestConditions, RestPoint
from lagcli.mechanics.verify import conjunction

Matrix = list[list[Expr]]


class Linearization:
    """M, C and K about one equilibrium, shapes (n, n) with n degrees of freedom.

    Attributes
    ----------
    basis : list of list of Expr
        The columns of B, each a displacement of all coordinates.
    """

    def __init__(self, rest: RestConditions, point: RestPoint, *, released: bool = False) -> None:
        self.dynamics: Dynamics = rest.dynamics
        self.system = rest.system
        self.point = point
        self.rest = rest
        kinds, equations = self.dynamics.constraints.kinds, self.dynamics.constraints.equations
        self._acting = [
            k for k, e in enumerate(equations) if not (released and kinds[e.name] == "nonholonomic")
        ]
        rows = [[at(a, point.values) for a in equations[k].row] for k in self._acting]
        self.rows = rows
        n = len(self.system.q)
        self.basis: Matrix = (
            nullspace(rows)
            if rows
            else [[S.One if i == j else S.Zero for j in range(n)] for i in range(n)]
        )

    @property
    def independent(self) -> tuple[Symbol, ...]:
        """The coordinates whose displacements x are, one for each column of B; () if none are."""
        found = []
        for k, column in enumerate(self.basis):
            others = [*self.basis[:k], *self.basis[k + 1 :]]
            places = (j for j, x in enumerate(column) if x == 1 and not any(o[j] for o in others))
            if (place := next(places, None)) is None:
                return ()
            found.append(self.system.q[place])
        return tuple(found)

    @property
    def forces_at_rest(self) -> tuple[Expr, ...]:
        """forcing(q, q' = 0)."""
        return self.rest.forces_at_rest

    @cached_property
    def M(self) -> Matrix:
        """The mass matrix."""
        return self._along(self._there(self.rest.mass_matrix))

    @cached_property
    def C(self) -> Matrix:
        """Damping (symmetric part) and gyroscopic terms (antisymmetric part)."""
        forcing = self.rest.forcing
        return self._along(self._there([[-f.diff(v) for v in self.system.qdot] for f in forcing]))

    @cached_property
    def K(self) -> Matrix:
        """The stiffness."""
        return self._along(self.stiffness)

    @cached_property
    def stiffness(self) -> Matrix:
        """Of all coordinates: the change of forces along B with any displacement."""
        q, equations = self.system.q, self.dynamics.constraints.equations
        values = self._there([[-f.diff(x) for x in q] for f in self.rest.forces_at_rest])
        for k, force in self.constraint_forces.items():  # constant: B^T A^T = 0
            turned = self._there([[-a.diff(x) for x in q] for a in equations[k].row])
            values = [
                [e + force * x for e, x in zip(*rows, strict=True)]
                for rows in zip(values, turned, strict=True)
            ]
        return values

    @cached_property
    def constraint_forces(self) -> dict[int, Expr]:
        """lambda0 by constraint, A^T lambda0 = -forcing: from A A^T lambda0 = -A forcing."""
        independent = self.dynamics.independent_constraints
        kept = [k for k in self._acting if k in independent]
        if not kept:
            return {}
        rows = [self.rows[self._acting.index(k)] for k in kept]
        forces = [at(f, self.point.values) for f in self.rest.forces_at_rest]
        gram = [[dot(a, b) for b in rows] for a in rows]
        solution = solve_linear(gram, [-dot(a, forces) for a in rows])
        if solution is None or solution.singular:
            raise ZeroDivisionError
        return dict(zip(kept, solution.values, strict=True))

    @cached_property
    def balanced(self) -> bool:
        """Whether these constraints alone hold it at rest."""
        forces = [at(f, self.point.values) for f in self.rest.forces_at_rest]
        return all(is_zero(dot(vector, forces)) is True for vector in self.basis)

    @cached_property
    def smooth(self) -> bool:
        """Whether forces and constraints have derivatives there: |v| v has one at 0, |x| none."""
        state = (*self.system.q, *self.system.qdot)
        rows = (row for each in self.dynamics.constraints.equations for row in each.row)
        return all(
            self._vanish([node.args[0]]) is False or self._vanish(_steps(force, node, state))
            for force in (*self.dynamics.lagrange.forcing, *rows)
            for node in force.atoms(sympy.sign, sympy.Abs)
            if not free_of(node, state)
        )

    def _vanish(self, expressions: Sequence[Expr]) -> bool | None:
        """Whether all are 0 in this state."""
        values = {**dict.fromkeys(self.system.qdot, S.Zero), **self.point.values}
        return conjunction(is_zero(at(e, values)) for e in expressions)

    @cached_property
    def drifts(self) -> bool:
        """Whether displacements must move: a constraint a(q) q' + b(q) = 0 has a gradient of b.

        The velocities that it allows are not those of displacements along it then.
        """
        terms = [e.drift for e in self.dynamics.constraints.equations if not e.holonomic]
        slopes = (drift.diff(q) for drift in terms for q in self.system.q)
        return any(is_zero(at(slope, self.point.values)) is not True for slope in slopes)

    def _there(self, matrix: Sequence[Sequence[Expr]]) -> Matrix:
        """A matrix at the equilibrium, with q' = 0."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        return [
            [self._here(entry.xreplace(still)) if entry else S.Zero for entry in row]
            for row in matrix
        ]

    def _along(self, values: Sequence[Sequence[Expr]]) -> Matrix:
        """B^T matrix B."""

        def form(u: Sequence[Expr], v: Sequence[Expr]) -> Expr:
            terms = (
                (x, a, y)
                for x, row in zip(u, values, strict=True)
                for a, y in zip(row, v, strict=True)
            )
            return simplify(sympy.Add(*(x * a * y for x, a, y in terms if x and a and y)))

        return [[form(u, v) for v in self.basis] for u in self.basis]

    # -- its kind --------------------------------------------------------------------------------

    def _here(self, entry: Expr) -> Expr:
        return where_positive(at(entry, self.point.values), self.point.positive)

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

    @cached_property
    def exact(self) -> bool:
        """Whether the equations of motion are linear themselves."""
        system, lagrange = self.system, self.dynamics.lagrange
        state = (*system.q, *system.qdot)
        equations = self.dynamics.constraints.equations
        constant = [entry for row in lagrange.mass_matrix for entry in row]
        constant += [entry for e in equations for entry in e.row]
        constant += [f.diff(x) for f in lagrange.forcing for x in state]
        return all(free_of(simplify(entry), state) for entry in constant)

    @property
    def nonholonomic(self) -> bool:
        """Whether a constraint cannot be integrated: displacements have other rules then."""
        return self.dynamics.constraints.nonholonomic

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


def _steps(force: Expr, node: Expr, state: Sequence[Symbol]) -> list[Expr]:
    """The jump of the force and of its derivatives where the argument changes its sign."""
    u = node.args[0]
    sides = ({sympy.Abs(u): s * u, sympy.sign(u): S(s)} for s in (-1, 1))
    left, right = (force.xreplace(each).xreplace(each) for each in sides)  # sign(|u|) is sign(s u)
    return [left - right, *((left - right).diff(x) for x in state)]
