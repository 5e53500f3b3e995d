"""A derivation: the whole theory of one problem, each part computed once."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from lagcli.problem_data import Problem

if TYPE_CHECKING:  # a large system is stated without SymPy, which these import
    from lagcli.mechanics.discovery.discovery import Discovery
    from lagcli.mechanics.discovery.special import SpecialCase
    from lagcli.mechanics.dynamics import Dynamics
    from lagcli.mechanics.energy import EnergyFunction
    from lagcli.mechanics.hamiltonian import GivenHamiltonian, Hamiltonian
    from lagcli.mechanics.matrix_form import MatrixForm
    from lagcli.mechanics.noether import Noether
    from lagcli.mechanics.system import System


class Derivation:
    """The parts of the theory for one problem, computed at their first use.

    Raises
    ------
    ProblemError
        From the part that finds it: a constraint that is not linear in the velocities,
        constraints that contradict each other, an initial state off the constraints.
    """

    def __init__(self, problem: Problem) -> None:
        self.given = problem

    @property
    def gives_hamiltonian(self) -> bool:
        """Whether the file states H, and L is made from it."""
        return self.given.hamiltonian is not None

    @cached_property
    def problem(self) -> Problem:
        """The problem as given, with the Lagrangian where it gives H.

        Raises
        ------
        NoLagrangian
            Where there is none.
        """
        if not self.gives_hamiltonian:
            return self.given
        from lagcli.mechanics.from_hamiltonian import with_lagrangian

        return with_lagrangian(self.given)

    @cached_property
    def no_lagrangian(self) -> str:
        """Why the H of the file gives no Lagrangian; empty where all is well."""
        if not self.gives_hamiltonian:
            return ""
        from lagcli.mechanics.from_hamiltonian import NoLagrangian

        try:
            self.problem  # noqa: B018 - made here
        except NoLagrangian as error:
            return error.reason
        return ""

    @cached_property
    def large_form(self) -> MatrixForm | None:
        """The matrix form as structure, of a system too large for simplified formulas."""
        if self.gives_hamiltonian:
            return None
        from lagcli.mechanics.extent import large_form

        return large_form(self.problem)

    @cached_property
    def system(self) -> System:
        """Coordinates, L, forces as formulas."""
        from lagcli.mechanics.system import System

        return System(self.problem)

    @cached_property
    def dynamics(self) -> Dynamics:
        """Equations, constraints, solved motion."""
        from lagcli.mechanics.dynamics import Dynamics

        return Dynamics(self.system)

    @cached_property
    def energy(self) -> EnergyFunction:
        """The energy function and its rate."""
        from lagcli.mechanics.energy import EnergyFunction

        return EnergyFunction(self.dynamics)

    @cached_property
    def hamiltonian(self) -> Hamiltonian | GivenHamiltonian:
        """The Legendre transform and the canonical equations."""
        from lagcli.mechanics.hamiltonian import GivenHamiltonian, Hamiltonian
        from lagcli.mechanics.system import System

        if self.no_lagrangian:
            return GivenHamiltonian(System(self.given), ())
        if self.gives_hamiltonian:
            return GivenHamiltonian(self.system, self.dynamics.constraints.equations)
        return Hamiltonian(self.dynamics, self.energy)

    @cached_property
    def noether(self) -> Noether:
        """Charges of the candidate and of the evident symmetries."""
        from lagcli.mechanics.noether import Noether

        return Noether(self.dynamics, self.energy)

    @cached_property
    def discovery(self) -> Discovery:
        """Symmetries and first integrals that nobody listed."""
        from lagcli.mechanics.discovery.discovery import Discovery

        return Discovery(self.noether, self._unconstrained_discovery, _discovery_of)

    def _unconstrained_discovery(self) -> Discovery | None:
        """The same in coordinates that no constraint binds, where they are known."""
        from lagcli.mechanics.fewer_coordinates import unconstrained

        problem = unconstrained(self.dynamics)
        return None if problem is None else Derivation(problem).discovery

    @cached_property
    def special_cases(self) -> tuple[SpecialCase, ...]:
        """Values of parameters at which there are more charges, with these."""
        from lagcli.mechanics.discovery.special_search import special_cases

        return special_cases(self.discovery, _discovery_of)


def _discovery_of(problem: Problem) -> Discovery:
    return Derivation(problem).discovery
