"""The sections of a problem whose H gives no Lagrangian: those of phase space."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sympy import Expr

from lagcli.algebra import shape
from lagcli.answers import (
    CanonicalPair,
    CanonicalSection,
    HamiltonianSection,
    LagrangianSection,
    Section,
)
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.expression import Expression
from lagcli.mechanics.canonical.statement import PhaseSpace
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.hamiltonian import GivenHamiltonian
from lagcli.mechanics.stating import Stating
from lagcli.phase_space import (
    BracketsSection,
    TransformationsSection,
)


class PhaseSpaceStatements(Stating):
    """H and what follows from it without velocities.

    Raises
    ------
    ProblemError
        When there are constraints: their multipliers follow from the second derivatives
        of a Lagrangian.
    """

    def __init__(self, derivation: Derivation) -> None:
        super().__init__(derivation.given, derivation.no_lagrangian)
        found = derivation.hamiltonian
        assert isinstance(found, GivenHamiltonian)
        self.hamiltonian = found
        self._phase_space = PhaseSpace(derivation)
        if self.problem.constraints:
            raise ProblemError(
                self.problem.source,
                tuple(
                    Diagnostic(
                        f"the constraint '{each.name}' cannot be used: H gives no Lagrangian; "
                        f"{self._why_missing}",
                        each.equation.span,
                        "its multiplier follows from a Lagrangian",
                    )
                    for each in self.problem.constraints
                ),
            )

    @property
    def makers(self) -> Mapping[str, Callable[[], Section]]:
        """What makes each section, by its name."""
        return {
            "lagrangian": self._lagrangian,
            "hamiltonian": self._hamiltonian,
            "canonical_equations": self._canonical_equations,
            "brackets": self._brackets,
            "canonical": self._canonical,
        }

    @property
    def degrees_of_freedom(self) -> int:
        """Half the dimension of phase space."""
        return len(self.problem.coordinates)

    def _usual(self) -> list[str]:
        return ["lagrangian", *self._asked_by_file()]

    def _as_written(self, expression: Expr) -> Expression:
        return shape(expression, self.hamiltonian.system.order)

    def _lagrangian(self) -> LagrangianSection:
        self._missing("the Lagrangian")
        return LagrangianSection(lagrangian=None)

    def _hamiltonian(self) -> HamiltonianSection:
        return HamiltonianSection(hamiltonian=self._as_written(self.hamiltonian.function))

    def _canonical_equations(self) -> CanonicalSection:
        names = (coordinate.name for coordinate in self.problem.coordinates)
        return CanonicalSection(
            equations={
                name: CanonicalPair(q=self._as_written(q), p=self._as_written(p))
                for name, (q, p) in zip(names, self.hamiltonian.canonical_equations, strict=True)
            }
        )

    def _brackets(self) -> BracketsSection:
        return self._of_phase_space(self._phase_space, PhaseSpace.brackets)

    def _canonical(self) -> TransformationsSection:
        return self._of_phase_space(self._phase_space, PhaseSpace.transformations)
