"""What the commands that run motions have in common: the file, numbers, names, a bar."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeVar

from lagcli.cli.error_output import report, report_line
from lagcli.cli.files import read_input, reason
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import Request, read, with_lagrangian
from lagcli.problem_data import Problem
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.studies.run_options import OptionReader

Options = TypeVar("Options")


def problem_of(file: str, request: Request | None = None) -> Problem | None:
    """The problem of a file, of standard input or the library; None with its mistakes printed."""
    try:
        found = read(file, read_input(file), request or Request())
    except OSError as error:
        report_line(f"{file}: error: {reason(error)}")
        return None
    report(found.source, found.diagnostics)
    return found.problem


class OfFile(Protocol):
    """The options of every command that runs motions: a file, its parameters and its state."""

    @property
    def file(self) -> str:
        """The problem."""

    @property
    def settings(self) -> tuple[str, ...]:
        """`--set`."""

    @property
    def state(self) -> tuple[str, ...]:
        """`--at`."""


@record(kw_only=True)
class StudyOptions:
    """What studies of one file have in common, as it was written."""

    file: str
    until: str | None = None
    settings: tuple[str, ...] = ()
    state: tuple[str, ...] = ()
    limit: float
    format_name: str
    output: Path | None = None


def understood(
    options: OfFile, read_options: Callable[[Problem], Options | None]
) -> tuple[Problem, Options] | None:
    """The file's problem with its Lagrangian, and the options; None once all mistakes are reported.

    Where a setting is wrong, the options are read beside the values of the file.
    """
    try:
        data = read_input(options.file)
    except OSError as error:
        report_line(f"{options.file}: error: {reason(error)}")
        return None
    found = read(options.file, data, Request(settings=options.settings, state=options.state))
    report(found.source, found.diagnostics)
    problem = found.problem
    if problem is None:
        plain = read(options.file, data).problem
        if plain is not None:
            read_options(plain)
        return None
    try:
        problem = with_lagrangian(problem)
    except ProblemError as error:
        report(error.source, error.diagnostics)
        return None
    wanted = read_options(problem)
    return None if wanted is None else (problem, wanted)


def option_reader(problem: Problem) -> OptionReader:
    """What reads the options of a run and prints every mistake."""
    from lagcli.studies.run_options import COMMAND_LINE, OptionReader

    def rejected(error: ProblemError) -> None:
        report(error.source, error.diagnostics)

    return OptionReader(problem, COMMAND_LINE, rejected)


def is_known(option: str, name: str, names: tuple[str, ...]) -> bool:
    """Whether a name is a known one; a message where it is not."""
    if name in names:
        return True
    from lagcli.reader.habits import meanings

    meant = meanings("languages").get(name)
    near = f"did you mean '{meant}'?" if meant in names else did_you_mean(name, names)
    advice = near or f"there are {', '.join(names)}"
    report_line(f"lagcli: error: {option}: unknown name '{name}': {advice}")
    return False


@contextmanager
def counted(doing: str) -> Iterator[Callable[[float, float], None] | None]:
    """A bar of how many of how many, where someone is there to see it."""
    with shared(doing) as bar:
        yield None if bar is None else lambda made, total: bar(made / total)


@contextmanager
def shared(doing: str) -> Iterator[Callable[[float], None] | None]:
    """A bar of the part that is done, where someone is there to see it."""
    if not sys.stderr.isatty():
        yield None
        return
    bar = _Bar(doing)
    try:
        yield bar
    finally:
        bar.close()


class _Bar:
    """Appears after a second; rich is imported only then."""

    _PATIENCE = 1.0

    def __init__(self, doing: str) -> None:
        from time import monotonic

        self._doing = doing
        self._now = monotonic
        self._started = monotonic()
        self._shown: object = None

    def __call__(self, part: float) -> None:
        if self._shown is None:
            if self._now() - self._started < self._PATIENCE:
                return
            from rich.console import Console
            from rich.progress import Progress

            self._shown = Progress(console=Console(stderr=True), transient=True)
            self._shown.start()
            self._task = self._shown.add_task(self._doing, total=1.0)
        self._shown.update(self._task, completed=part)  # type: ignore[attr-defined]

    def close(self) -> None:
        """Take the bar away."""
        if self._shown is not None:
            self._shown.stop()  # type: ignore[attr-defined]
