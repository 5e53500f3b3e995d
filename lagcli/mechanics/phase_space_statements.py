"""The sections of a problem whose H gives no Lagrangian: those of phase space."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy import Expr

from lagcli.algebra import shape
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.expression import Expression
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.hamiltonian import GivenHamiltonian
from lagcli.mechanics.stating import Stating
from lagcli.statements.answers import Section
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import in_order


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
        self.derivation = derivation
        if self.problem.constraints:
            raise ProblemError(
                self.problem.source,
                tuple(
                    Diagnostic(
                        f"the constraint '{each.name}' cannot be used: H gives no Lagrangian; "
                        f"{self.why_missing}",
                        each.equation.span,
                        "its multiplier follows from a Lagrangian",
                    )
                    for each in self.problem.constraints
                ),
            )

    def maker(self, declared: Declaration) -> Callable[[Any], Section] | None:
        """The derivation of a section from H, if it has one."""
        return declared.phase_space

    @property
    def degrees_of_freedom(self) -> int:
        """Half the dimension of phase space."""
        return len(self.problem.coordinates)

    def _usual(self) -> list[str]:
        return [each.name for each in in_order(super()._usual()) if self.maker(each) is not None]

    def as_written(self, expression: Expr) -> Expression:
        """Readable."""
        return shape(expression, self.hamiltonian.system.order)
