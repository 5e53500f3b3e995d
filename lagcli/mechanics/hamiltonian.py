"""The Legendre transform, the Hamiltonian and the canonical equations.

    H(q, p, t) = sum_j p_j q_j' - L,    q_j' = dH/dp_j,
    p_j' = -dH/dq_j + Q_j - dD/dq_j' + sum_k lambda_k a_kj

with the velocities solved from p_j = dL/dq_j'.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 8.1 and 8.4.
Landau, Lifshitz, *The Classical Theory of Fields*, 4th ed., sections 9 and 16.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.algebra.determinants import determinant
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.positivity import deciding, vanishing_part
from lagcli.algebra.signs import sign
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.energy import EnergyFunction
from lagcli.mechanics.legendre import LegendreTransform, at_rest_against_far, bending
from lagcli.mechanics.system import System


class Hamiltonian:
    """The Hamiltonian form of a system in all its coordinates."""

    def __init__(self, dynamics: Dynamics, energy: EnergyFunction) -> None:
        self.dynamics = dynamics
        self.energy = energy
        self.system = dynamics.system
        self.legendre = LegendreTransform(dynamics)

    @property
    def velocities(self) -> tuple[Expr, ...] | None:
        """q'(q, p, t), verified by substitution of p = dL/dq'; None where not inverted."""
        return self.legendre.inverted if self.fold is None else None

    @cached_property
    def function(self) -> Expr | None:
        """H(q, p, t); None where the Legendre transform was not inverted."""
        if self.velocities is None:
            return None
        system = self.system
        if self.legendre.is_quadratic:
            return simplify(self._kinetic - self._at_rest)
        return self.in_phase_space(dot(system.momenta, system.qdot) - system.L)

    @cached_property
    def _at_rest(self) -> Expr:
        """L(q, 0, t), or 0 where L has no value at rest."""
        still = self.system.L.xreplace(dict.fromkeys(self.system.qdot, sympy.S.Zero))
        return sympy.S.Zero if still.has(*NO_VALUE) else still

    @cached_property
    def _kinetic(self) -> Expr:
        """(p - N) . q' / 2 with N = dL/dq' at q' = 0: H less -L(q, 0, t), of a quadratic L."""
        assert self.velocities is not None
        system = self.system
        at_rest = dict.fromkeys(system.qdot, sympy.S.Zero)
        momenta = self.dynamics.lagrange.momenta
        return sympy.Add(
            *(
                (p - momentum.xreplace(at_rest)) * velocity / 2
                for p, momentum, velocity in zip(
                    system.momenta, momenta, self.velocities, strict=True
                )
            )
        )

    def in_phase_space(self, expression: Expr) -> Expr:
        """An expression in q, q', t as one in q, p, t; there must be velocities."""
        return self.legendre.put_into(expression)

    @property
    def reason(self) -> str:
        """Why there is no Hamiltonian, or an empty text."""
        if self.velocities is not None:
            return ""
        if self.dynamics.degenerate:
            return "the Hessian of L is singular: the momenta do not determine the velocities"
        if self.fold is not None:
            return (
                "the Legendre transform has several branches: the determinant of the Hessian of L "
                "takes both signs, so the momenta do not determine the velocities"
            )
        return "the momenta could not be solved for the velocities in closed form"

    @cached_property
    def fold(self) -> Expr | None:
        """What the determinant of d²L/dq'² has the sign of, where that depends on velocities.

        Where it is 0 two branches of the Legendre transform meet.
        """
        if -1 in map(sign, self._opposed):
            return self._decisive
        whole = determinant(self.dynamics.lagrange.mass_matrix) if self.legendre.folds else None
        return None if whole is None else vanishing_part(simplify(whole))

    @property
    def folds_below(self) -> Expr | None:
        """What has no known sign, and where it is negative there are several branches."""
        return next((deciding(x) for x in self._opposed if sign(x) is None), None)

    @property
    def _opposed(self) -> list[Expr]:
        whole = self._decisive
        return [] if whole is None else at_rest_against_far(whole, self.system.qdot)

    @cached_property
    def _decisive(self) -> Expr | None:
        """det M without factors of known sign, a polynomial in the velocities; None of others."""
        if self.legendre.is_quadratic:
            return None
        return bending(self.dynamics.lagrange.mass_matrix, self.system.qdot)

    @cached_property
    def growth(self) -> tuple[tuple[Expr, Expr], ...] | None:
        """(p_j' - dL/dq_j at rest, dL/dq_j at rest), with multipliers, forces and dissipation."""
        if self.function is None or self.velocities is None:
            return None
        system, kinetic = self.system, sympy.S.Zero
        if self.legendre.is_quadratic:
            kinetic = simplify(self._kinetic)
        rows = []
        for j, q in enumerate(system.q):
            force = _force(system, self.dynamics.constraints.equations, j)
            if self.legendre.is_quadratic:
                moving = simplify(self.in_phase_space(force) - kinetic.diff(q))
            else:  # -dH/dq = dL/dq, which spares a derivative of roots and signs
                moving = self.in_phase_space((system.L - self._at_rest).diff(q) + force)
            rows.append((moving, self._at_rest.diff(q)))
        return tuple(rows)

    @property
    def shifts(self) -> dict[Symbol, Expr]:
        """What of each momentum does not vanish with the velocities: q A of m x' + q A.

        A momentum that has no value at rest, as that of sqrt(x'^2 + y'^2), has none.
        """
        still = dict.fromkeys(self.system.qdot, sympy.S.Zero)
        momenta = self.dynamics.lagrange.momenta
        at_rest = (simplify(p.xreplace(still)) for p in momenta)
        pairs = zip(self.system.momenta, at_rest, strict=True)
        return {p: b for p, b in pairs if b != 0 and not b.has(*NO_VALUE)}

    @property
    def canonical_equations(self) -> tuple[tuple[Expr, Expr], ...] | None:
        """(q_j', p_j') by coordinate."""
        if self.growth is None or self.velocities is None:
            return None
        return tuple((v, a + b) for v, (a, b) in zip(self.velocities, self.growth, strict=True))


class GivenHamiltonian:
    """The Hamiltonian form of a system whose file gives H, with or without a Lagrangian.

    Parameters
    ----------
    system
        The system; its L is not looked at.
    constraints
        Those that act.
    """

    reason = ""
    fold: Expr | None = None
    folds_below: Expr | None = None

    def __init__(self, system: System, constraints: Sequence[ConstraintEquation]) -> None:
        assert system.H is not None
        self.system = system
        self.function: Expr = system.H
        self._constraints = constraints

    @cached_property
    def velocities(self) -> tuple[Expr, ...]:
        """q' = dH/dp."""
        return tuple(simplify(self.function.diff(p)) for p in self.system.momenta)

    def in_phase_space(self, expression: Expr) -> Expr:
        """An expression in q, q', t as one in q, p, t."""
        flow = dict(zip(self.system.qdot, self.velocities, strict=True))
        return simplify(expression.xreplace(flow))

    @cached_property
    def growth(self) -> tuple[tuple[Expr, Expr], ...]:
        """(p_j', 0), with multipliers, forces and dissipation."""
        forces = (_force(self.system, self._constraints, j) for j in range(len(self.system.q)))
        slopes = (self.function.diff(q) for q in self.system.q)
        return tuple(
            (self.in_phase_space(f - h), sympy.S.Zero) for f, h in zip(forces, slopes, strict=True)
        )

    @property
    def shifts(self) -> dict[Symbol, Expr]:
        """None: the H of the file has its own brackets."""
        return {}

    @property
    def canonical_equations(self) -> tuple[tuple[Expr, Expr], ...]:
        """(q_j', p_j') by coordinate."""
        return tuple((v, p) for v, (p, _) in zip(self.velocities, self.growth, strict=True))


def _force(system: System, constraints: Sequence[ConstraintEquation], j: int) -> Expr:
    """Q_j - dD/dq_j' + sum_k lambda_k a_kj."""
    return system.applied_forces[j] + sympy.Add(*(e.multiplier * e.row[j] for e in constraints))
