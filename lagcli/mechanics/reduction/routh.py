"""Routh's reduction: the cyclic coordinates go, their momenta stay as constants.

With p_c = dL/dq_c' solved for the velocities of the cyclic coordinates c,

    R(q, q', t; p) = L - sum_c p_c q_c'

is the Lagrangian of the other coordinates, and q_c' = -dR/dp_c gives the cyclic ones back.
(Goldstein and Landau and Lifshitz call -R the Routhian.)  Where R is quadratic in the
velocities, R = sum M_ab q_a' q_b' / 2 + sum g_a q_a' - U_eff.

References
----------
Whittaker, *Analytical Dynamics*, 4th ed., section 38.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 41.
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 8.3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, shape, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.place import at
from lagcli.expression import ZERO, Equation
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.impacts import when_constant
from lagcli.mechanics.legendre import Inverse, LegendreTransform
from lagcli.mechanics.minimal import minimal, with_lagrangian
from lagcli.mechanics.system import System
from lagcli.problem_data import Constraint, Parameter
from lagcli.statements.wording import constraints_named

#: Why there is no reduced system where there are only momenta.
ALL_CYCLIC = "every coordinate is cyclic"
#: Why there is none where the constraints prescribe the whole motion.
NONE_LEFT = "the constraints leave no coordinate"


def _called(equations: Sequence[ConstraintEquation]) -> str:
    return constraints_named("the constraint", [e.name for e in equations])


class Routh:
    """The reduction of a system by all of its cyclic coordinates at once.

    Attributes
    ----------
    given, full : Derivation
        The system of the file, and that which is reduced: solved constraints are put in.
    reduced : Derivation or None
        That of the remaining coordinates, with R for L; None with a `reason`.
    """

    def __init__(self, derivation: Derivation) -> None:
        self.given = derivation
        self.full = minimal(derivation)
        self.system: System = self.full.system
        self.reason = ""

    # -- which coordinates -----------------------------------------------------------------------

    @cached_property
    def cyclic(self) -> tuple[int, ...]:
        """Coordinates that occur nowhere, and that no force and no constraint acts along."""
        dynamics = self.full.dynamics
        return tuple(
            j
            for j in self.full.noether.cyclic
            if is_zero(self.system.applied_forces[j]) is True
            and all(_independent(f, self.system.q[j]) for f in self.system.applied_forces)
            and all(self._untouched(e, j) for e in dynamics.constraints.equations)
        )

    @property
    def when_constant(self) -> dict[str, str]:
        """When the momenta, by coordinate, and E ("") are constant; only what an impact changes."""
        system, q = self.given.system, self.given.system.q
        found = {"": when_constant(system, [S.Zero] * len(q), S.One)}
        for j in self.cyclic:
            along = [S.One if x == self.system.q[j] else S.Zero for x in q]
            whole = self.full is self.given  # else it moves what was eliminated along with it
            when = when_constant(system, along, S.Zero) if whole else found[""]
            found[self.system.names[j]] = when
        return {name: when for name, when in found.items() if when}

    @cached_property
    def irreducible(self) -> dict[int, tuple[bool | None, str]]:
        """Coordinates that do not occur in L and are kept: is p_j constant, and why kept."""
        noether = self.full.noether
        momenta = zip(noether.cyclic, noether.cyclic_momenta, strict=True)
        return {j: (p.conserved, self._why_kept(j)) for j, p in momenta if j not in self.cyclic}

    def _why_kept(self, j: int) -> str:
        """What `cyclic` demands and coordinate j does not meet."""
        q, forces = self.system.q[j], self.system.applied_forces
        equations = self.full.dynamics.constraints.equations
        holding = [e for e in equations if is_zero(e.row[j]) is not True]
        vanishes = self.full.dynamics.vanishes_on_motion
        acting = [e for e in holding if vanishes(e.multiplier * e.row[j]).holds is not True]
        forced = is_zero(forces[j]) is not True
        if acting or forced:
            what = [_called(acting)] * bool(acting) + ["a force that is not in L"] * forced
            act = "acts" if len(acting) + forced == 1 else "act"
            return f"{' and '.join(what)} {act} along it"
        containing = [e for e in equations if not self._untouched(e, j)]
        if containing:
            contain = "contains" if len(containing) == 1 else "contain"
            rates = all(e in holding for e in containing)
            return f"{_called(containing)} {contain} {'its velocity' if rates else 'it'}"
        assert not all(_independent(f, q) for f in forces)
        return "a force that is not in L depends on it"

    def _untouched(self, equation: ConstraintEquation, j: int) -> bool:
        q = self.system.q[j]
        parts = (*equation.row, equation.f if equation.holonomic else equation.drift)
        return is_zero(equation.row[j]) is True and all(_independent(x, q) for x in parts)

    @property
    def kept(self) -> list[int]:
        """The other coordinates."""
        return [j for j in range(len(self.system.q)) if j not in self.cyclic]

    @property
    def momenta(self) -> tuple[Symbol, ...]:
        """The constants p_c."""
        return tuple(self.system.momenta[j] for j in self.cyclic)

    # -- the Routhian -----------------------------------------------------------------------------

    @cached_property
    def _inverse(self) -> Inverse | None:
        return LegendreTransform(self.full.dynamics).inverse_of(self.cyclic)

    @cached_property
    def velocities(self) -> tuple[Expr, ...] | None:
        """q_c'(q, q', t; p), verified by substitution; None where not solved."""
        if not self.cyclic:
            return ()
        if self._inverse is None:
            self.reason = "the momenta of cyclic coordinates were not solved for their velocities"
            return None
        return tuple(simplify(v) for v in self._inverse.explicit)

    @cached_property
    def function(self) -> Expr | None:
        """R(q, q', t; p)."""
        if self.velocities is None:
            return None
        if not self.cyclic:
            return simplify(self.system.L)
        assert self._inverse is not None
        flow = (self.system.qdot[j] for j in self.cyclic)
        legendre, action = LegendreTransform(self.full.dynamics), dot(self.momenta, flow)
        return legendre.with_images(self.system.L - action, [(self.cyclic, self._inverse)])

    @cached_property
    def reduced(self) -> Derivation | None:
        """The system of the remaining coordinates, equal to the full one by substitution."""
        R = self.function
        if R is None or self.velocities is None:
            return None
        if not self.kept:
            self.reason = ALL_CYCLIC if self.cyclic else NONE_LEFT
            return None
        put_in = self._back
        forces = [self.system.applied_forces[j].xreplace(put_in) for j in self.kept]
        momenta = tuple(Parameter(name=p.name) for p in self.momenta)
        constraints = tuple(
            Constraint(
                name=old.name,
                equation=Equation(shape(equation.f, self.system.order), ZERO),
                multiplier=old.multiplier,
                holds_while=None,
            )
            for old, equation in zip(
                self.full.problem.constraints, self.full.dynamics.constraints.equations, strict=True
            )
        )
        reduced = with_lagrangian(
            self.full, self.kept, R, forces, (*self.full.problem.parameters, *momenta), constraints
        )
        if not self._equal(reduced):
            self.reason = "the reduced equations could not be verified by substitution"
            return None
        return reduced

    @property
    def _back(self) -> dict[Expr, Expr]:
        assert self.velocities is not None
        return {self.system.qdot[j]: v for j, v in zip(self.cyclic, self.velocities, strict=True)}

    def _equal(self, reduced: Derivation) -> bool:
        """Whether the equations of R are those of L with q_c' and q_c'' put in.

        Both are linear in the accelerations: the constant terms and the coefficients agree.
        """
        new = reduced.system
        put_in = self._back
        put_in |= {
            self.system.qddot[j]: new.total_derivative(v)
            for j, v in zip(self.cyclic, put_in.values(), strict=True)
        }
        old = self.full.dynamics.lagrange.left_sides
        still = dict.fromkeys(new.qddot, S.Zero)
        residuals: list[Expr] = []
        for j, left in zip(self.kept, reduced.dynamics.lagrange.left_sides, strict=True):
            rest = left - old[j].xreplace(put_in)
            residuals += [rest.xreplace(still), *(rest.diff(a).xreplace(still) for a in new.qddot)]
        return reduced.dynamics.verifier.all_zero(residuals).holds is True

    # -- its parts --------------------------------------------------------------------------------

    @cached_property
    def quadratic(self) -> bool:
        """Whether R is a polynomial of second degree in the velocities."""
        assert self.reduced is not None
        return all(
            free_of(simplify(entry), self.reduced.system.qdot)
            for row in self.reduced.dynamics.lagrange.mass_matrix
            for entry in row
        )

    @cached_property
    def effective_potential(self) -> Expr:
        """U_eff = -R at q' = 0."""
        assert self.reduced is not None
        return -self._at_rest(self.reduced.system.L)

    @cached_property
    def potential_name(self) -> str:
        """Of the effective potential: U_eff at given momenta, else V, or V_eff = V - T_0."""
        given = self.given
        if self.cyclic or given.system.V is None:
            return "U_eff" if self.cyclic else "V_eff"
        relations = given.dynamics.constraints.relations
        V, solved = given.system.V, relations.solved if relations else {}
        while not free_of(V, solved):
            V = V.xreplace(solved)
        return "V" if is_zero(self.effective_potential - V) else "V_eff"

    @cached_property
    def balance(self) -> tuple[Expr, ...]:
        """dU_eff/dq, shape (n,): 0 on a steady motion where no force acts beside."""
        assert self.reduced is not None
        return tuple(simplify(self.effective_potential.diff(q)) for q in self.reduced.system.q)

    def rates_at(self, values: Mapping[Symbol, Expr]) -> dict[int, Expr]:
        """q_c' by coordinate index, where the other coordinates rest."""
        assert self.velocities is not None
        pairs = zip(self.cyclic, self.velocities, strict=True)
        return {j: at(self._at_rest(v), values) for j, v in pairs}

    def regular_at(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether the mass matrix can be inverted there, at rest, or along the constraints."""
        dynamics = self.full.dynamics
        mass = [[at(x, values) for x in row] for row in dynamics.lagrange.mass_matrix_at_rest]
        kept = [dynamics.constraints.equations[k].row for k in dynamics.independent_constraints]
        rows = [[at(x, values) for x in row] for row in kept]
        bordered = [[*m, *(row[j] for row in rows)] for j, m in enumerate(mass)]
        bordered += [[*row, *([S.Zero] * len(rows))] for row in rows]
        wholes = (determinant(each) for each in ([mass, bordered] if rows else [mass]))
        return any(whole is not None and is_zero(whole) is not True for whole in wholes)

    @cached_property
    def gyroscopic(self) -> tuple[Expr, ...]:
        """g_a = dR/dq_a' at q' = 0, shape (n,)."""
        assert self.reduced is not None
        return tuple(simplify(self._at_rest(p)) for p in self.reduced.dynamics.lagrange.momenta)

    @cached_property
    def gyroscopic_forces(self) -> bool:
        """Whether one velocity gives a force along another: dg_a/dq_b is not dg_b/dq_a."""
        assert self.reduced is not None
        q, g = self.reduced.system.q, self.gyroscopic
        return any(
            is_zero(g[a].diff(q[b]) - g[b].diff(q[a])) is not True
            for a in range(len(q))
            for b in range(a)
        )

    @cached_property
    def gyroscopic_change(self) -> bool:
        """Whether dg_a/dt gives forces."""
        return any(is_zero(g.diff(self.system.t)) is not True for g in self.gyroscopic)

    def _at_rest(self, expression: Expr) -> Expr:
        assert self.reduced is not None
        return expression.xreplace(dict.fromkeys(self.reduced.system.qdot, S.Zero))


def _independent(expression: Expr, q: Symbol) -> bool:
    return free_of(expression, [q]) or is_zero(expression.diff(q)) is True
