"""What every statement of a problem shares: which sections, in what order, and what is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Protocol, TypeVar

from lagcli.answers import (
    DEFAULT_SECTIONS,
    SECTIONS,
    AccelerationsSection,
    Answers,
    ConstraintForcesSection,
    ConstraintKind,
    DimensionsSection,
    HamiltonianSection,
    Multiplier,
    MultipliersSection,
    Section,
)
from lagcli.diagnostics import ProblemError
from lagcli.effort import OutOfWork
from lagcli.expression import Expression
from lagcli.failures import describe
from lagcli.limited import limited
from lagcli.problem import Problem

if TYPE_CHECKING:
    from lagcli.mechanics.closed_form import ClosedForm
    from lagcli.mechanics.matrix_form import MatrixForm

#: Work that one section may take (see `lagcli.effort`), and processor time.
UNITS = 30_000_000
SECONDS = 45.0

TOO_MUCH = "it takes more work than it is allowed"


class HasWhere(Protocol):
    """What is written with abbreviations."""

    @property
    def where(self) -> Mapping[str, Expression]:
        """The abbreviations in order of use."""
        ...


class HasMissing(Protocol):
    """What gathers (what, why) while it makes a section."""

    missing: list[tuple[str, str]]


Kept = TypeVar("Kept", bound=HasWhere)
Phase = TypeVar("Phase", bound=HasMissing)
Stated = TypeVar("Stated")


class Stating:
    """The sections of one problem; warnings gather as they are made.

    A subclass gives the maker of each section that it can state.

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
        #: makers of sections that are none of mechanics
        self.others: dict[str, Callable[[], Section]] = {}
        #: the abbreviations of the formulas, in order of use
        self.where: dict[str, Expression] = {}
        self._reserved: set[str] = set()  # names of parts of the matrix form
        self._why_missing = why_missing
        self._share = 1.0  # of the work that a section may take

    @property
    def makers(self) -> Mapping[str, Callable[[], Section]]:
        """What makes each section, by its name."""
        raise NotImplementedError

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        raise NotImplementedError

    def answers(self, sections: Sequence[str] | None) -> Answers:
        """The asked sections (the usual ones for None), in their fixed order."""
        problem = self.problem
        makers = {**self.makers, "dimensions": self._dimensions, **self.others}
        asked = self._usual() if sections is None else sections
        made: dict[str, Section] = {}
        for name in SECTIONS:
            section = self._made(name, makers) if name in asked else None
            if section is not None:
                made[name] = section
        quantities = (*problem.coordinates, *problem.parameters)
        return Answers(
            title=problem.title,
            coordinates=tuple(q.name for q in problem.coordinates),
            parameters=tuple(p.name for p in problem.parameters),
            degrees_of_freedom=self.degrees_of_freedom,
            sections=made,
            symbols={q.name: q.symbol for q in quantities if q.symbol is not None},
            multipliers={c.multiplier: c.name for c in problem.constraints},
            where=dict(self.where),
            warnings=tuple(dict.fromkeys(self.warnings)),
            complete=self.complete,
            absent=tuple(name for name in asked if name not in made),
        )

    def _made(self, name: str, makers: Mapping[str, Callable[[], Section]]) -> Section | None:
        """One section; None, with the reason in the warnings, where none could be made."""
        if name not in makers:
            self._missing(f"the section '{name}'")
            return None
        try:
            return limited(makers[name], self._share * UNITS, self._share * SECONDS)
        except ProblemError:
            raise
        except OutOfWork:
            why = TOO_MUCH
        except Exception as error:  # noqa: BLE001 - one section's failure is not the others'
            why = describe(error)
        self._missing(f"the section '{name}'", why)
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

        return ClosedForm(self._matrix_form_of_problem(), self._taken)

    @property
    def _taken(self) -> set[str]:
        """Every name that the file gives a meaning."""
        from lagcli.mechanics.closed_form import names_of

        return names_of(self.problem) | self._reserved

    def _abbreviated(self, find: Callable[[ClosedForm], Kept | None]) -> Kept | None:
        """A closed form with its abbreviations noted; None where there is none."""
        from lagcli.mechanics.matrix_form import NotStructural

        try:
            found = find(self._closed_form)
        except (NotStructural, ArithmeticError, ValueError):
            return None
        for name, node in ({} if found is None else found.where).items():
            self.where.setdefault(name, node)  # what came first uses only what came before it
        return found

    def _abbreviated_accelerations(self) -> AccelerationsSection | None:
        found = self._abbreviated(lambda form: form.motion)
        if found is None:
            return None
        names = (q.name for q in self.problem.coordinates)
        return AccelerationsSection(
            accelerations=dict(zip(names, found.accelerations, strict=True)),
            verified="50 digits",
        )

    def _abbreviated_multipliers(
        self, kinds: Sequence[ConstraintKind | None]
    ) -> MultipliersSection | None:
        found = self._abbreviated(lambda form: form.motion)
        if found is None:
            return None
        rows = zip(self.problem.constraints, found.multipliers, kinds, strict=True)
        return MultipliersSection(
            multipliers={
                c.name: Multiplier(
                    symbol=c.multiplier, value=value, kind=kind, verified="50 digits"
                )
                for c, value, kind in rows
            }
        )

    def _abbreviated_forces(self) -> ConstraintForcesSection | None:
        found = self._abbreviated(lambda form: form.constraint_forces)
        if found is None:
            return None
        names = [q.name for q in self.problem.coordinates]
        count = len(names)
        rows = [
            dict(zip(names, found.values[k : k + count], strict=True))
            for k in range(0, len(found.values), count)
        ]
        *single, total = rows
        return ConstraintForcesSection(
            forces=dict(zip((c.name for c in self.problem.constraints), single, strict=True)),
            total=total,
        )

    def _abbreviated_hamiltonian(self) -> HamiltonianSection | None:
        found = self._abbreviated(lambda form: form.hamiltonian)
        return None if found is None else HamiltonianSection(hamiltonian=found.values[0])

    def _dimensions(self) -> DimensionsSection:
        from lagcli.mechanics.quantity_units import dimensions_section

        return dimensions_section(self.problem)

    def _noted(self, found: tuple[Stated, Sequence[tuple[str, str]]]) -> Stated:
        """The section of (section, what is missing and why)."""
        section, missing = found
        for what, why in missing:
            self._missing(what, why)
        return section

    def _usual(self) -> list[str]:
        """The default sections, without those that have nothing to say here."""
        idle = set() if self.problem.constraints else {"multipliers", "constraint_forces"}
        if not self.problem.find:
            idle.add("find")
        usual = [name for name in DEFAULT_SECTIONS if name not in idle]
        return [*usual, *self._asked_by_file()]

    def _asked_by_file(self) -> list[str]:
        """The sections that are shown because of what the file gives."""
        given = self.problem
        asked = ["hamiltonian", "canonical_equations"] if given.hamiltonian is not None else []
        asked += ["brackets"] if given.brackets else []
        return [*asked, "canonical"] if given.canonical_transformations else asked

    def _of_phase_space(self, phase: Phase, state: Callable[[Phase], Stated]) -> Stated:
        """A section of phase space, and what is missing there."""
        return self._noted((state(phase), phase.missing))

    def lacks(self, what: str, why: str) -> None:
        """Note that an answer was asked for and not found."""
        self._missing(what, why)

    def _missing(self, what: str, why: str = "") -> None:
        self.complete = False
        self.warnings.append(f"{what} could not be found: {why or self._why_missing}")

    def _unsolved(self, why: str = "") -> None:
        self.complete = False
        reason = f": {why}" if why else ""
        self.warnings.append(
            f"the accelerations and multipliers were not solved in closed form{reason}; "
            "--show matrix_form gives the system for a numerical solution"
        )

    def _note_redundant(self, names: Sequence[str]) -> None:
        if names:
            self.warnings.append(
                f"redundant: {', '.join(names)} (implied by the other constraints); "
                "the accelerations and the total constraint force are unique all the same"
            )
