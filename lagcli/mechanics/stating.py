"""What every statement of a problem shares: which sections, in what order, and what is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from lagcli.diagnostics import ProblemError
from lagcli.expression import Expression
from lagcli.notation.given_formulas import names_of, symbols_of
from lagcli.notation.naming import Names
from lagcli.platform.effort import OutOfWork
from lagcli.platform.failures import describe
from lagcli.platform.limited import limited
from lagcli.problem_data import Problem
from lagcli.statements.answers import Answers, Section
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import built_in, in_order

if TYPE_CHECKING:
    from lagcli.mechanics.closed_form import ClosedForm
    from lagcli.mechanics.matrix_form import MatrixForm

#: Work that one section may take (see `lagcli.platform.effort`), and processor time.
UNITS = 30_000_000
SECONDS = 45.0

TOO_MUCH = "it takes more work than it is allowed"


class HasWhere(Protocol):
    """What is written with abbreviations."""

    @property
    def where(self) -> Mapping[str, Expression]:
        """The abbreviations in order of use."""
        ...


Kept = TypeVar("Kept", bound=HasWhere)
Stated = TypeVar("Stated")


class Stating:
    """The sections of one problem; warnings gather as they are made.

    A subclass takes the derivation of its kind of problem from the section's declaration.

    Parameters
    ----------
    problem
        What is stated.
    why_missing
        Why an answer is missing, where nothing more special is known.
    """

    def __init__(self, problem: Problem, why_missing: str) -> None:
        self.problem = problem
        self.warnings: list[str] = []
        self.complete = True
        #: the abbreviations of the formulas, in order of use
        self.where: dict[str, Expression] = {}
        self.reserved: set[str] = set()  # names of parts of the matrix form
        self.why_missing = why_missing
        self._share = 1.0  # of the work that a section may take

    def maker(self, declared: Declaration) -> Callable[[Any], Section] | None:
        """The derivation of a section for this kind of problem, if it has one."""
        raise NotImplementedError

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        raise NotImplementedError

    def answers(self, sections: Sequence[str] | None) -> Answers:
        """The requested sections (the usual ones for None), in their fixed order."""
        problem = self.problem
        requested = self._usual() if sections is None else sections
        made: dict[str, Section] = {}
        for declared in in_order(requested):
            section = self._made(declared)
            if section is not None:
                made[declared.name] = section
        return Answers(
            title=problem.title,
            coordinates=tuple(q.name for q in problem.coordinates),
            parameters=tuple(p.name for p in problem.parameters if p.name not in problem.named),
            degrees_of_freedom=self.degrees_of_freedom,
            sections=made,
            symbols=symbols_of(problem),
            multipliers={c.multiplier: c.name for c in problem.constraints},
            where=dict(self.where),
            named=problem.named,
            warnings=tuple(dict.fromkeys(self.warnings)),
            complete=self.complete,
            absent=tuple(name for name in requested if name not in made),
        )

    def _made(self, declared: Declaration) -> Section | None:
        """One section; None, with the reason in the warnings, where none could be made."""
        maker, name = self.maker(declared), declared.name
        if maker is None:
            self.lacks(f"the section '{name}'")
            return None
        try:
            return limited(lambda: maker(self), self._share * UNITS, self._share * SECONDS)
        except ProblemError:
            raise
        except OutOfWork:
            why = TOO_MUCH
        except Exception as error:  # noqa: BLE001 - one section's failure is not the others'
            why = describe(error)
        self.lacks(f"the section '{name}'", why)
        self._share /= 2  # so that all together end, too
        self._begin_again()
        return None

    def _begin_again(self) -> None:
        """Forget what was derived: what was interrupted is in no certain state."""

    # -- with abbreviations -----------------------------------------------------------------

    def _matrix_form_of_problem(self) -> MatrixForm:
        from lagcli.mechanics.matrix_form import MatrixForm

        return MatrixForm(self.problem)

    @cached_property
    def _closed_form(self) -> ClosedForm:
        """The motion by elimination, for what is too long to be written out."""
        from lagcli.mechanics.closed_form import ClosedForm

        return ClosedForm(self._matrix_form_of_problem(), self.taken)

    @property
    def taken(self) -> Names:
        """Every name that the file gives a meaning."""
        return Names((*names_of(self.problem), *self.reserved))

    def abbreviated(self, find: Callable[[ClosedForm], Kept | None]) -> Kept | None:
        """A closed form with its abbreviations noted; None where there is none."""
        from lagcli.mechanics.matrix_form import NotStructural

        try:
            found = find(self._closed_form)
        except (NotStructural, ArithmeticError, ValueError):
            return None
        for name, node in ({} if found is None else found.where).items():
            self.where.setdefault(name, node)  # what came first uses only what came before it
        return found

    def noted(self, found: tuple[Stated, Sequence[tuple[str, str]]]) -> Stated:
        """The section of (section, what is missing and why)."""
        section, missing = found
        for what, why in missing:
            self.lacks(what, why)
        return section

    def _usual(self) -> list[str]:
        """The sections that are shown without a request, for what the file gives."""
        return [each.name for each in built_in() if each.by_default(self.problem)]

    def lacks(self, what: str, why: str = "") -> None:
        """Note that a requested answer was not found."""
        self.complete = False
        self.warnings.append(f"{what} could not be found: {why or self.why_missing}")

    def unsolved(self, why: str = "") -> None:
        """Note that the motion was not solved."""
        self.complete = False
        reason = f": {why}" if why else ""
        self.warnings.append(
            f"the accelerations and multipliers were not solved in closed form{reason}; "
            "--show matrix_form gives the system for a numerical solution"
        )

    def note_redundant(self, names: Sequence[str]) -> None:
        """Note the redundant constraints."""
        if names:
            self.warnings.append(
                f"redundant: {', '.join(names)} (implied by the other constraints); "
                "the accelerations and the total constraint force are unique all the same"
            )
