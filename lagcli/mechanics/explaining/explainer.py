"""What every step of an explanation knows: the derivation, its letters and its shapes."""

from __future__ import annotations

from lagcli.algebra import is_zero
from lagcli.expression import Name
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.explaining.words import Letters
from lagcli.mechanics.readable import Readable
from lagcli.statements.answers import Section


class Explainer:
    """One derivation, ready to be explained."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.problem = derivation.problem
        self.system = derivation.system
        self.dynamics = derivation.dynamics
        self.readable = Readable(self.dynamics)
        self.letters = Letters(derivation.given)
        #: the sections that have been explained
        self.stated: dict[str, Section] = {}
        self.averaged = False  # whether the potential of the averaged motion has been stated

    @property
    def velocities(self) -> tuple[Name, ...]:
        """The velocities as names."""
        return tuple(Name(name, 1) for name in self.system.names)

    @property
    def accelerations(self) -> tuple[Name, ...]:
        """The accelerations as names."""
        return tuple(Name(name, 2) for name in self.system.names)

    @property
    def constraints(self) -> str:
        """Constraint, or constraints; empty without any."""
        number = len(self.dynamics.constraints.equations)
        return f"constraint{'s' * (number > 1)}" if number else ""

    @property
    def constraint_forces(self) -> str:
        """The force of the constraint, or the forces of the constraints; empty without any."""
        several = "s" * self.constraints.endswith("s")
        return self.constraints and f"the force{several} of the {self.constraints}"

    @property
    def forced(self) -> bool:
        """Whether generalized forces act, by the file's forces or by those on points."""
        return any(is_zero(force) is not True for force in self.system.forces)

    @property
    def damped(self) -> bool:
        """Whether there is a dissipation function."""
        return self.problem.dissipation is not None
