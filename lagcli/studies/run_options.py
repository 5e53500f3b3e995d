"""The request of a run, read and checked: for the command line and for Python alike."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from lagcli.diagnostics import Diagnostic, ProblemError, Source
from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.problem_data import METHODS, Problem
from lagcli.reader.columns import (
    Column,
    pieces_of,
    read_along,
    read_columns,
    read_number,
    usual_columns,
)
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.value_checks import run_mistake, run_number
from lagcli.record import record

_USUAL_ACCURACY = 1e-9

Value = TypeVar("Value")


@record(kw_only=True)
class RunOptions:
    """The options of a run as they were written; None leaves one to the file."""

    until: str | float | None = None
    accuracy: str | float | None = None
    samples: int = 101
    times: Sequence[float] = ()
    show: Sequence[str] = ()
    method: str = "auto"
    stop_when: str | None = None
    project: bool = False
    precision: int | None = None
    whole: bool = False
    beyond: bool = False


@record
class Spelling:
    """How an option is written: `--stop-when X`, or `stop_when=X`."""

    before: str
    hyphen: str
    equals: str

    def __call__(self, name: str, value: str = "") -> str:
        """The option, with a value where one is given."""
        option = self.before + name.replace("_", self.hyphen)
        return f"{option}{self.equals}{value}" if value else option


COMMAND_LINE = Spelling("--", "-", " ")
PYTHON = Spelling("", "_", "=")


class OptionReader:
    """Reads the options for a problem, with those of its file where they are left out.

    Parameters
    ----------
    problem
        With its Lagrangian.
    spelled
        How messages write the options.
    tell
        What is done with a mistake; where it returns, the next one is looked for.

    Attributes
    ----------
    good : bool
        Whether there was no mistake.
    """

    def __init__(
        self, problem: Problem, spelled: Spelling, tell: Callable[[ProblemError], None]
    ) -> None:
        self.problem = problem
        self.good = True
        self._spelled = spelled
        self._tell = tell

    def request(
        self, options: RunOptions, *, without_end: float | None = None
    ) -> RunRequest | None:
        """The run, None after a mistake; it has this end where none is given."""
        file = self.problem.simulation
        if without_end is None or options.until is not None or file.until is not None:
            until = self.end(options.until)
        else:
            until = without_end
        accuracy = self.accuracy(options.accuracy)
        method = file.method if options.method == "auto" and file.method else options.method
        if method not in METHODS:
            advice = did_you_mean(method, METHODS) or f"there are {', '.join(METHODS)}"
            spelled = self._spelled("method")
            self._mistaken("lagcli", f"{spelled}: unknown name '{method}': {advice}")
        columns = self._columns(options.show)
        stop = options.stop_when
        along = stop and self._read(
            lambda: read_along(self.problem, stop, self._spelled("stop_when"))
        )
        if not self.good or until is None:
            return None
        return RunRequest(
            until=until,
            end=self._formula("until", options.until),
            accuracy=accuracy,
            samples=options.samples,
            times=tuple(map(float, options.times)),
            columns=columns,
            project=options.project,
            stop_when=along or None,
            stop_name=stop or "",
            method=method,
            digits=options.precision,
            whole=options.whole,
            beyond=options.beyond,
            written=to_grammar,
        )

    def end(self, given: str | float | None) -> float | None:
        """The end, which there must be."""
        if given is None and self.problem.simulation.until is None:
            give = f"give {self._spelled('until', 'T')}, or simulation: {{until: T}}"
            self._mistaken(self.problem.source.name, f"when does it end? {give}")
        return self.until(given)

    def until(self, given: str | float | None) -> float | None:
        """The end; None where there is none."""
        return self._number("until", given)

    def accuracy(self, given: str | float | None) -> float:
        """The requested accuracy, or the usual one."""
        accuracy = self._number("accuracy", given)
        return _USUAL_ACCURACY if accuracy is None else accuracy

    def _columns(self, show: Sequence[str]) -> tuple[Column, ...]:
        if not show:
            return tuple(usual_columns(self.problem))
        found = {"t": Column("t", None)}
        for piece in pieces_of(show):
            read = self._read(lambda piece=piece: read_columns(self.problem, [piece]))  # type: ignore[misc]
            found |= {column.name: column for column in read or ()}
        return tuple(found.values())

    def _number(self, name: str, given: str | float | None) -> float | None:
        """A number of the call, or else of the file."""
        formula = self._formula(name, given)
        value = None if formula is None else run_number(formula)
        if value is not None and (mistake := run_mistake(name, value)):
            self._mistaken("lagcli", f"{self._spelled(name)}: {mistake}")
        return value

    def _formula(self, name: str, given: str | float | None) -> Expression | None:
        """A number as it is written."""
        if given is None:
            return self._of_file(name)
        text = repr(given) if isinstance(given, float) else str(given)
        return self._read(lambda: read_number(text, self._spelled(name)))

    def _of_file(self, name: str) -> Expression | None:
        file = self.problem.simulation
        return file.until if name == "until" else file.accuracy

    def _read(self, work: Callable[[], Value]) -> Value | None:
        """What the work reads; None after a mistake."""
        try:
            return work()
        except ProblemError as error:
            self._report(error)
            return None

    # -- mistakes ------------------------------------------------------------------------------

    def _mistaken(self, where: str, sentence: str) -> None:
        self._report(ProblemError(Source(where, ""), (Diagnostic(sentence),)))

    def _report(self, error: ProblemError) -> None:
        self.good = False
        self._tell(error)
