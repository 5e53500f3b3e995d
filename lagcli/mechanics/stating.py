"""What every statement of a problem shares: which sections, in what order, and what is missing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol, TypeVar

from lagcli.algebra.effort import OutOfWork
from lagcli.algebra.limited import limited
from lagcli.answers import DEFAULT_SECTIONS, SECTIONS, Answers, DimensionsSection, Section
from lagcli.diagnostics import ProblemError
from lagcli.failures import describe
from lagcli.problem import Problem

#: Work that one section may take (see `lagcli.algebra.effort`), and processor time.
UNITS = 30_000_000
SECONDS = 45.0

TOO_MUCH = "it takes more work than it is allowed"


class HasMissing(Protocol):
    """What gathers (what, why) while it makes a section."""

    missing: list[tuple[str, str]]


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
