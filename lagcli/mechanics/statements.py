"""From a derivation to statements: each section in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import sympy
from sympy import Expr

from lagcli.answers import (
    AccelerationsSection,
    AlgebraSection,
    Answers,
    CanonicalPair,
    CanonicalSection,
    Charge,
    ChargesSection,
    ConstraintForcesSection,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    HamiltonianSection,
    LagrangeEquation,
    LagrangianSection,
    MatrixFormSection,
    ModesSection,
    MomentaSection,
    Multiplier,
    MultipliersSection,
    ReductionSection,
    Section,
    SpecialValue,
)
from lagcli.expression import ZERO, Expression
from lagcli.forces import ForcesSection
from lagcli.manners import Manner
from lagcli.mechanics.branches import sentence
from lagcli.mechanics.constraint_force import forces_on_points
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.impacts import between_impacts
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.readable import Readable
from lagcli.mechanics.stating import Stating
from lagcli.motions import HamiltonJacobiSection, SteadySection
from lagcli.phase_space import BracketsSection, TransformationsSection
from lagcli.problem import Problem
from lagcli.questions import FindSection
from lagcli.record import replace

if TYPE_CHECKING:
    from lagcli.mechanics.closed_form import ClosedForm

NUMERIC_CHECK = "50 digits"


def answers(problem: Problem, sections: Sequence[str] | None = None) -> Answers:
    """Derive what the sections need and state it.

    Parameters
    ----------
    problem
        A checked problem.
    sections
        Names out of `SECTIONS`; the usual ones when None.

    Raises
    ------
    ProblemError
        When the constraints cannot be used.
    """
    return Statements(Derivation(problem)).answers(sections)


_JUMP = (
    "L is not known to be continuous where the argument of a sign is 0: the impulse of a jump "
    "is not in the equations, and no conserved quantity is stated"
)


class Statements(Stating):
    """The sections of one derivation."""

    def __init__(self, derivation: Derivation) -> None:
        super().__init__(derivation.problem, "it is not stated for such a problem")
        self._derive(derivation)
        if not self.system.is_continuous:
            self.warnings.append(_JUMP)

    def _derive(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.system = derivation.system
        self.dynamics = derivation.dynamics
        self.readable = Readable(self.dynamics)

    def _begin_again(self) -> None:
        self._derive(Derivation(self.derivation.given))

    @property
    def makers(self) -> Mapping[str, Callable[[], Section]]:
        """What makes each section, by its name."""
        return {
            "lagrangian": self._lagrangian,
            "equations": self._equations,
            "matrix_form": self._matrix_form,
            "accelerations": self._accelerations,
            "multipliers": self._multipliers,
            "constraint_forces": self._constraint_forces,
            "forces": self._forces,
            "momenta": self._momenta,
            "energy": self._energy,
            "hamiltonian": self._hamiltonian,
            "canonical_equations": self._canonical_equations,
            "brackets": self._brackets,
            "canonical": self._canonical,
            "charges": self._charges,
            "discovered": self._discovered,
            "algebra": self._algebra,
            "find": self._find,
            "equilibria": self._equilibria,
            "modes": self._modes,
            "reduction": self._reduction,
            "steady_motions": self._steady_motions,
            "hamilton_jacobi": self._hamilton_jacobi,
        }

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        return self.dynamics.degrees_of_freedom

    @cached_property
    def _closed_form(self) -> ClosedForm:
        """The motion by elimination, from simplified entries."""
        from lagcli.mechanics.closed_form import ClosedForm

        lagrange, write = self.dynamics.lagrange, Manner(self.problem)
        return ClosedForm(
            self._matrix_form_of_problem(),
            self._taken,
            [[write(self._as_written(entry)) for entry in row] for row in lagrange.mass_matrix],
            [write(self._by_terms(force)) for force in lagrange.forcing],
        )

    # -- shapes ---------------------------------------------------------------------------

    def _as_written(self, expression: Expr) -> Expression:
        """Readable, without using the constraints."""
        return self.readable.as_written(expression)

    def _by_terms(self, expression: Expr, *, as_given: bool = False) -> Expression:
        """Term by term in velocities, accelerations, multipliers, as L and h are read."""
        return self.readable.by_terms(expression, as_given=as_given)

    def _on_surface(self, expression: Expr) -> Expression:
        """Readable, with the constraints used."""
        return self.readable.on_surface(expression)

    def _by_coordinate(self, values: Sequence[Expr]) -> dict[str, Expression]:
        return {
            name: self._on_surface(value)
            for name, value in zip(self.system.names, values, strict=True)
        }

    # -- sections ---------------------------------------------------------------------------
    def _lagrangian(self) -> LagrangianSection:
        return LagrangianSection(lagrangian=self._by_terms(self.system.L, as_given=True))

    def _equations(self) -> EquationsSection:
        constraints = self.dynamics.constraints.equations
        equations = tuple(
            LagrangeEquation(
                coordinate=name,
                left=self._by_terms(left),
                right=self._by_terms(
                    sympy.Add(force, *(e.multiplier * e.row[j] for e in constraints))
                ),
            )
            for j, (name, left, force) in enumerate(
                zip(
                    self.system.names,
                    self.dynamics.lagrange.left_sides,
                    self.system.applied_forces,
                    strict=True,
                )
            )
        )
        return EquationsSection(
            equations=equations,
            constraints={e.name: (self._as_written(e.f), ZERO) for e in constraints},
        )

    def _matrix_form(self) -> MatrixFormSection:
        constraints = self.dynamics.constraints
        return MatrixFormSection(
            mass_matrix=tuple(
                tuple(map(self._as_written, row)) for row in self.dynamics.lagrange.mass_matrix
            ),
            constraint_jacobian=tuple(
                tuple(map(self._as_written, row)) for row in constraints.jacobian
            ),
            forcing=tuple(map(self._as_written, self.dynamics.lagrange.forcing)),
            constraint_bias=tuple(self._as_written(e.bias) for e in constraints.equations),
        )

    def _accelerations(self) -> AccelerationsSection:
        motion = self.dynamics.motion
        if motion is None:
            abbreviated = self._abbreviated_accelerations()
            if abbreviated is not None:
                return abbreviated
            self._unsolved()
            degenerate = tuple(self.system.names[i] for i in self.dynamics.undetermined)
            return AccelerationsSection(
                accelerations=None, regular=not degenerate, degenerate=degenerate
            )
        self._note_check("the accelerations", motion.verified)
        return AccelerationsSection(
            accelerations=self._by_coordinate(motion.accelerations), verified=motion.verified
        )

    def _unsolved(self, why: str = "") -> None:
        degenerate = [self.system.names[i] for i in self.dynamics.undetermined]
        if not degenerate:
            super()._unsolved(why)
            return
        self.complete = False
        self.warnings.append(
            "the Lagrangian is singular: the Hessian of L in the velocities has no inverse "
            f"along {', '.join(degenerate)}, so the equations do not determine the accelerations"
            + ("; they have no solution" if self.dynamics.contradiction is not None else "")
        )

    def _note_check(self, what: str, verified: str | None) -> None:
        if verified == NUMERIC_CHECK:
            self.warnings.append(
                f"{what} were verified at 50 digits at random states, not decided exactly"
            )

    def answers(self, sections: Sequence[str] | None) -> Answers:
        """The asked sections; where a constraint has several factors, that they hold on each."""
        found = super().answers(sections)
        return replace(found, warnings=(*self._on_branches(), *found.warnings))

    def _on_branches(self) -> Iterator[str]:
        constraints = self.dynamics.constraints
        for equation in constraints.equations:
            factors = constraints.branches.get(equation.name)
            if factors is not None:
                qdot = self.system.qdot
                yield sentence(equation.name, factors, qdot, holonomic=equation.holonomic)

    def _multipliers(self) -> MultipliersSection:
        dynamics = self.dynamics
        motion = dynamics.motion
        if motion is None:
            kinds = [dynamics.constraints.kinds[e.name] for e in dynamics.constraints.equations]
            solved = self._abbreviated_multipliers(kinds)
            if solved is not None:
                return solved
            self._unsolved()
        equations = dynamics.constraints.equations
        values = (None,) * len(equations) if motion is None else motion.multipliers
        redundant = dynamics.redundant
        self._note_redundant(redundant)
        return MultipliersSection(
            multipliers={
                equation.name: Multiplier(
                    symbol=equation.multiplier.name,
                    value=None if value is None else self._on_surface(value),
                    kind=dynamics.constraints.kinds[equation.name],
                    verified=None if motion is None or value is None else motion.verified,
                )
                for equation, value in zip(equations, values, strict=True)
            },
            redundant=redundant,
        )

    def _constraint_forces(self) -> ConstraintForcesSection:
        dynamics = self.dynamics
        if dynamics.motion is None and dynamics.constraints.equations:
            found = self._abbreviated_forces()
            if found is not None:
                return found
            self._unsolved()
        total = dynamics.total_constraint_force
        return ConstraintForcesSection(
            forces={
                equation.name: None if force is None else self._by_coordinate(force)
                for equation, force in zip(
                    dynamics.constraints.equations, dynamics.constraint_forces, strict=True
                )
            },
            total=None if total is None else self._by_coordinate(total),
            on_points={
                constraint: {
                    point: tuple(map(self._on_surface, components))
                    for point, components in points.items()
                }
                for constraint, points in forces_on_points(dynamics).items()
            },
        )

    def _forces(self) -> ForcesSection:
        from lagcli.mechanics.real_forces import RealForces

        real = RealForces(self.dynamics)
        section = real.section()
        self.warnings.extend(real.warnings)
        return self._noted((section, real.missing))

    def _momenta(self) -> MomentaSection:
        noether = self.derivation.noether
        return MomentaSection(
            momenta={
                name: self.readable.momentum(p)
                for name, p in zip(self.system.names, self.dynamics.lagrange.momenta, strict=True)
            },
            cyclic=tuple(self.system.names[j] for j in noether.cyclic),
        )

    def _energy(self) -> EnergySection:
        energy = self.derivation.energy
        return EnergySection(
            function=self._by_terms(energy.readable_function, as_given=True),
            conserved=energy.conserved,
            is_total_energy=energy.is_total_energy,
            reason=energy.reason,
        )

    def _hamiltonian(self) -> HamiltonianSection:
        hamiltonian = self.derivation.hamiltonian
        try:
            function = hamiltonian.function
        except ArithmeticError:  # the inverse of M grew too long
            function = None
        if function is None:
            abbreviated = self._abbreviated_hamiltonian()
            if abbreviated is not None:
                return abbreviated
            self._missing("the Hamiltonian", hamiltonian.reason)
        return HamiltonianSection(
            hamiltonian=None if function is None else self._as_written(function),
            reason=hamiltonian.reason,
        )

    def _canonical_equations(self) -> CanonicalSection:
        hamiltonian = self.derivation.hamiltonian
        pairs = hamiltonian.canonical_equations
        if pairs is None:
            self._missing("the canonical equations", hamiltonian.reason)
            return CanonicalSection(equations=None, reason=hamiltonian.reason)
        return CanonicalSection(
            equations={
                name: CanonicalPair(q=self._as_written(q), p=self._as_written(p))
                for name, (q, p) in zip(self.system.names, pairs, strict=True)
            }
        )

    def _brackets(self) -> BracketsSection:
        from lagcli.mechanics.canonical.statement import PhaseSpace

        return self._of_phase_space(PhaseSpace(self.derivation), PhaseSpace.brackets)

    def _canonical(self) -> TransformationsSection:
        from lagcli.mechanics.canonical.statement import PhaseSpace

        return self._of_phase_space(PhaseSpace(self.derivation), PhaseSpace.transformations)

    def _charges(self) -> ChargesSection:
        return ChargesSection(charges=tuple(map(self._charge, self.derivation.noether.charges)))

    def _charge(self, charge: NoetherCharge) -> Charge:
        if charge.conserved is None:
            self._missing(
                f"whether '{charge.name}' is conserved",
                charge.broken_by or "its rate needs the solved motion",
            )
        self._note_check(f"the rate of '{charge.name}'", charge.verified)
        named = dict(zip(self.system.names, charge.transformation.changes, strict=True))
        named["t"] = charge.transformation.time
        return Charge(
            name=charge.name,
            source=charge.source,
            transformation={
                name: self._as_written(change) for name, change in named.items() if change != 0
            },
            gauge=None if charge.gauge is None else self._as_written(charge.gauge),
            conserved=charge.conserved,
            charge=None
            if not charge.complete
            else self._by_terms(
                self.derivation.energy.readable_function
                if charge.source == "time"
                else charge.charge,
                as_given=charge.source == "time",
            ),
            rate=None if charge.rate is None else self._on_surface(charge.rate),
            verified=charge.verified,
            broken_by=charge.broken_by,
            when=self._when(charge) if charge.conserved else "",
        )

    def _when(self, charge: NoetherCharge) -> str:
        change = charge.transformation
        return between_impacts(self.system, change.changes, change.time, charge.gauge)

    def _discovered(self) -> ChargesSection:
        from lagcli.mechanics.discovery.reality import real_where

        discovery = self.derivation.discovery
        listed = (*discovery.charges, *discovery.momentum_equations)
        if discovery.stopped and not listed:
            self._missing("the symmetries", "; ".join(discovery.stopped))
            return ChargesSection(charges=(), sought=False)
        self.warnings.extend(discovery.stopped)
        return ChargesSection(
            charges=tuple(
                replace(self._charge(c), where=real_where(c, self.system)) for c in listed
            )
        )

    def _algebra(self) -> AlgebraSection:
        from lagcli.mechanics.discovery.summary import algebra_section, summary

        discovery = self.derivation.discovery
        found = summary(discovery)  # before the special values, which take the work that is left
        special = tuple(
            SpecialValue(
                parameter=case.parameter.name,
                value=self._as_written(case.value),
                number=case.number,
                charges={c.name: self._by_terms(c.charge) for c in case.charges},
            )
            for case in discovery.special
        )
        section = algebra_section(discovery, found, self._separates)
        return replace(section, special=special)

    def _separates(self) -> bool:
        """Whether a complete integral of the Hamilton-Jacobi equation was found."""
        from lagcli.mechanics.reduction.separation import Separation

        separation = Separation(self.derivation)
        found = separation.driven or separation.separated
        return found is not None and len(found.constants) == len(separation.system.q)

    def _find(self) -> FindSection:
        from lagcli.mechanics.finding.find import answer_questions

        section = answer_questions(self.dynamics, self.derivation.noether)
        return self._noted((section, section.unanswered))

    def _equilibria(self) -> EquilibriaSection:
        from lagcli.mechanics.oscillations.small_oscillations import equilibria

        section = equilibria(self.dynamics)
        if section.equilibria is None:
            self._missing("the equilibria", section.reason)
        elif not section.complete:
            self.warnings.append("there may be equilibria that are not listed")
        return section

    def _modes(self) -> ModesSection:
        from lagcli.mechanics.oscillations.small_oscillations import modes

        section = modes(self.dynamics)
        if section.modes is None:
            self._missing("the normal modes", section.reason)
        return section

    def _reduction(self) -> ReductionSection:
        from lagcli.mechanics.reduction.statement import reduction

        return self._noted(reduction(self.derivation))

    def _hamilton_jacobi(self) -> HamiltonJacobiSection:
        from lagcli.mechanics.reduction.separation_statement import hamilton_jacobi

        return self._noted(hamilton_jacobi(self.derivation))

    def _steady_motions(self) -> SteadySection:
        from lagcli.mechanics.reduction.steady_statement import steady_motions

        return self._noted(steady_motions(self.derivation))
