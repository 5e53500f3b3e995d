"""From a derivation to statements: each section in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from sympy import Expr

from lagcli.expression import Expression, operation_count
from lagcli.mechanics.branches import Surfaces
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import SolvedMotion
from lagcli.mechanics.readable import Readable
from lagcli.mechanics.stating import Kept, Stating
from lagcli.notation.manner import Manner
from lagcli.record import replace
from lagcli.statements.answers import Answers, Section
from lagcli.statements.declaration import Declaration

if TYPE_CHECKING:
    from lagcli.mechanics.closed_form import ClosedForm

NUMERIC_CHECK = "50 digits"
#: Operations that a printed acceleration may have where the elimination has half of them.
_READABLE = 150


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

    def maker(self, declared: Declaration) -> Callable[[Any], Section] | None:
        """The derivation of a section."""
        return declared.derive

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
            self.taken,
            [[write(self.as_written(entry)) for entry in row] for row in lagrange.mass_matrix],
            [write(self.by_terms(force)) for force in lagrange.forcing],
        )

    def abbreviated(self, find: Callable[[ClosedForm], Kept | None]) -> Kept | None:
        """A closed form with its abbreviations noted; None where there is none, or no pivot."""
        return None if self.dynamics.singular else super().abbreviated(find)

    # -- shapes ---------------------------------------------------------------------------

    def as_written(self, expression: Expr) -> Expression:
        """Readable, without using the constraints."""
        return self.readable.as_written(expression)

    def by_terms(self, expression: Expr, *, as_given: bool = False) -> Expression:
        """Term by term in velocities, accelerations, multipliers, as L and h are read."""
        return self.readable.by_terms(expression, as_given=as_given)

    def hamiltonian(self) -> Expression | None:
        """H with its energies apart; None where it was not found."""
        from lagcli.mechanics.hamiltonian_form import hamiltonian_form

        return hamiltonian_form(self.derivation.hamiltonian, self.readable)

    def on_surface(self, expression: Expr) -> Expression:
        """Readable, with the constraints used."""
        return self.readable.on_surface(expression)

    def by_coordinate(self, values: Sequence[Expr]) -> dict[str, Expression]:
        """One value for each coordinate, with the constraints used."""
        return {
            name: self.readable.on_surface(value, name)
            for name, value in zip(self.system.names, values, strict=True)
        }

    @cached_property
    def motion(self) -> SolvedMotion | None:
        """The solved motion; None where it is long beyond reading, and an elimination is not."""
        motion = self.dynamics.motion
        rows: Sequence[Expr | None] = ()
        if motion is not None:
            rows = (*motion.accelerations, *motion.multipliers)
        counts = [operation_count(self.on_surface(row)) for row in rows if row is not None]
        if max(counts, default=0) <= _READABLE:
            return motion
        found = self._closed_form.motion
        steps = (
            ()
            if found is None
            else (*found.where.values(), *found.accelerations, *found.multipliers)
        )
        return None if 0 < 2 * sum(map(operation_count, steps)) < sum(counts) else motion

    # -- what is missing --------------------------------------------------------------------

    def unsolved(self, why: str = "") -> None:
        """Note that the motion was not solved."""
        degenerate = [self.system.names[i] for i in self.dynamics.undetermined]
        if not degenerate:
            super().unsolved(why)
            return
        self.complete = False
        self.warnings.append(
            "the Lagrangian is singular: the Hessian of L in the velocities has no inverse "
            f"along {', '.join(degenerate)}, so the equations do not determine the accelerations"
            + ("; they have no solution" if self.dynamics.contradiction is not None else "")
        )

    def note_check(self, what: str, verified: str | None) -> None:
        """Note what was verified at random states only."""
        if verified == NUMERIC_CHECK:
            verb = "was" if what.startswith("the rate") else "were"
            self.warnings.append(
                f"{what} {verb} verified at 50 digits at random states, not decided exactly"
            )

    def answers(self, sections: Sequence[str] | None) -> Answers:
        """The requested sections; of a constraint with factors, whether they hold on each."""
        found = super().answers(sections)
        return replace(found, warnings=(*self._on_branches(), *found.warnings))

    def _on_branches(self) -> Iterator[str]:
        constraints = self.dynamics.constraints
        manner = Manner(self.problem)
        surfaces = Surfaces(lambda form: manner.vanishing(self.as_written(form)))
        for equation in constraints.equations:
            factors = constraints.branches.get(equation.name, ())
            if factors and not any(constraints.follows(f, equation) for f in factors):
                position = equation.f if equation.holonomic else None
                yield surfaces.of_factors(equation.name, factors, self.system.qdot, position)
        states = self.dynamics.states
        for forms, elimination in states.other_surfaces:
            rank, usual = len(elimination.independent), len(self.dynamics.independent_constraints)
            yield surfaces.of_another_rank(forms, rank, usual)
