"""The printed answers against the mathematics itself, by numbers at random states.

The formulas are built anew from what is printed, so that a slip on the way from the
solution to the page is found too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

from sympy import Expr, Symbol

from lagcli.abbreviations import written_out
from lagcli.algebra import dot
from lagcli.mechanics.derivation import Derivation
from lagcli.statements.answers import (
    AccelerationsSection,
    Answers,
    ChargesSection,
    MultipliersSection,
)
from lagcli.studies.check.findings import CheckOutcome, Finding

#: The sections that have laws.
SECTIONS = ("accelerations", "multipliers", "charges")


class Laws:
    """Every law that the answers to one problem must obey.

    Yields a finding for each that is broken or could not be tested, None for the others.
    """

    def __init__(self, derivation: Derivation, answers: Answers) -> None:
        self.system = derivation.system
        self.dynamics = derivation.dynamics
        self.answers = written_out(answers)

    def __iter__(self) -> Iterator[Finding | None]:
        """The findings: the equations, the constraints, then the charges."""
        accelerations = cast(AccelerationsSection, self.answers.sections["accelerations"])
        if accelerations.accelerations is None:
            if accelerations.regular:
                yield Finding(CheckOutcome.UNDECIDED, "accelerations", "no solution was found")
            return
        motion = dict(
            zip(
                self.system.qddot,
                map(self.system.build, accelerations.accelerations.values()),
                strict=True,
            )
        )
        yield from self._equations(motion)
        yield from self._constraints(motion)
        yield from self._charges(motion)

    def _test(self, subject: str, law: str, residual: Sequence[Expr]) -> Finding | None:
        verdict = self.dynamics.verifier.vanishes_at_random_states(residual)
        if verdict is True:
            return None
        if verdict is None:
            return Finding(CheckOutcome.UNDECIDED, subject, f"nobody could decide whether {law}")
        return Finding(CheckOutcome.WRONG, subject, f"it is not so that {law}")

    def _equations(self, motion: dict[Symbol, Expr]) -> Iterator[Finding | None]:
        """d/dt(dL/dq') - dL/dq = Q - dD/dq' + sum lambda df/dq, accelerations put in."""
        forces = self._constraint_forces()
        if forces is None:
            return
        for name, left, applied, force in zip(
            self.system.names,
            self.dynamics.lagrange.left_sides,
            self.system.applied_forces,
            forces,
            strict=True,
        ):
            residual = (left - applied - force).xreplace(motion)
            law = f"the solution satisfies the equation of {name}"
            yield self._test(f"equations.{name}", law, [residual])

    def _constraint_forces(self) -> Sequence[Expr] | None:
        """sum lambda df/dq by coordinate, with the printed multipliers where all are."""
        constraints = self.dynamics.constraints
        section = cast(MultipliersSection, self.answers.sections["multipliers"])
        values = [each.value for each in section.multipliers.values()]
        if None in values:
            return self.dynamics.total_constraint_force
        built = [self.system.build(value) for value in values if value is not None]
        return [
            dot(built, (e.row[j] for e in constraints.equations)) for j in range(len(self.system.q))
        ]

    def _constraints(self, motion: dict[Symbol, Expr]) -> Iterator[Finding | None]:
        """d2f/dt2 = 0 for f(q, t), d/dt(a q' + b) = 0 for velocity constraints."""
        for equation in self.dynamics.constraints.equations:
            rate = self.system.total_derivative(equation.f)
            if equation.holonomic:
                rate = self.system.total_derivative(rate)
            law = f"the solution keeps the constraint '{equation.name}'"
            yield self._test(f"constraints.{equation.name}", law, [rate.xreplace(motion)])

    def _charges(self, motion: dict[Symbol, Expr]) -> Iterator[Finding | None]:
        """dQ/dt is the rate that is printed, 0 for a conserved charge."""
        for charge in cast(ChargesSection, self.answers.sections["charges"]).charges:
            if charge.charge is None or charge.rate is None:
                continue
            rate = self.system.total_derivative(self.system.build(charge.charge))
            residual = rate.xreplace(motion) - self.system.build(charge.rate)
            law = f"the rate of '{charge.name}' is the printed one"
            yield self._test(f"charges.{charge.name}", law, [residual])
