"""What the commands that run motions have in common: the file, numbers, names, a bar."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from lagcli.cli.files import read_input, reason
from lagcli.cli.telling import tell, tell_line
from lagcli.diagnostics import Diagnostic, ProblemError, Source
from lagcli.evaluation import value_of
from lagcli.expression import Expression
from lagcli.pipeline import Request, read, with_lagrangian
from lagcli.problem_data import Problem
from lagcli.reader.suggest import did_you_mean

_USUAL_ACCURACY = 1e-9

Options = TypeVar("Options")


def problem_of(file: str, request: Request | None = None) -> Problem | None:
    """The problem of a file, of standard input or the library; None with its mistakes printed."""
    try:
        found = read(file, read_input(file), request or Request())
    except OSError as error:
        tell_line(f"{file}: error: {reason(error)}")
        return None
    tell(found.source, found.diagnostics)
    return found.problem


def understood(
    file: str,
    settings: tuple[str, ...],
    state: tuple[str, ...],
    options: Callable[[Problem], Options | None],
) -> tuple[Problem, Options] | None:
    """The file's problem with its Lagrangian, and the options; None once all mistakes are told.

    Where a setting is wrong, the options are read beside the values of the file.
    """
    try:
        data = read_input(file)
    except OSError as error:
        tell_line(f"{file}: error: {reason(error)}")
        return None
    found = read(file, data, Request(settings=settings, state=state))
    tell(found.source, found.diagnostics)
    problem = found.problem
    if problem is None:
        plain = read(file, data).problem
        if plain is not None:
            options(plain)
        return None
    try:
        problem = with_lagrangian(problem)
    except ProblemError as error:
        tell(error.source, error.diagnostics)
        return None
    wanted = options(problem)
    return None if wanted is None else (problem, wanted)


class NumericOptions:
    """Options that are numbers, with those of the `file` where they are left out.

    `good` is false once one of them is no number, or out of its range, which is told.
    """

    def __init__(self, file: Source) -> None:
        self.file = file
        self.good = True

    def until(self, text: str | None, given: Expression | None) -> float | None:
        """The end; None where there is none."""
        until = self._number(text, given, "--until")
        if until is not None and not 0 < until < math.inf:
            self._wrong("--until", text, given, f"the end must be a time after 0{_not(until)}")
        return until

    def end(self, file: str, text: str | None, given: Expression | None) -> float | None:
        """The end, which there must be; None where there is none."""
        if text is None and given is None:
            tell_line(
                f"{file}: error: when does it end? give --until T, or simulation: {{until: T}}"
            )
            self.good = False
        return self.until(text, given)

    def accuracy(self, text: str | None, given: Expression | None) -> float:
        """The requested accuracy, or the usual one."""
        accuracy = self._number(text, given, "--accuracy")
        if accuracy is not None and not 0 < accuracy < 1:
            self._wrong("--accuracy", text, given, f"it lies between 0 and 1{_not(accuracy)}")
        return _USUAL_ACCURACY if accuracy is None else accuracy

    def formula(self, text: str | None, given: Expression | None, option: str) -> Expression | None:
        """A number as it is written; None where there is none."""
        from lagcli.reader.columns import read_number

        try:
            return given if text is None else read_number(text, option)
        except ProblemError as error:
            tell(error.source, error.diagnostics)
            self.good = False
            return None

    def _number(self, text: str | None, given: Expression | None, option: str) -> float | None:
        formula = self.formula(text, given, option)
        return None if formula is None else _value(formula)

    def _wrong(
        self, option: str, text: str | None, given: Expression | None, sentence: str
    ) -> None:
        if text is None and given is not None:
            message = f"'{option.removeprefix('--')}': {sentence}"
            tell(self.file, [Diagnostic(message, given.span)])
        else:
            tell_line(f"lagcli: error: {option}: {sentence}")
        self.good = False


def _not(value: float) -> str:
    return f", not {value:g}" if math.isfinite(value) else ", and a double"


def _value(formula: Expression) -> float:
    """A number; nan, which no option takes, where it is none."""
    try:
        return float(value_of(formula) or 0)
    except (ArithmeticError, ValueError):
        return math.nan


def is_known(option: str, name: str, names: tuple[str, ...]) -> bool:
    """Whether a name is a known one; a message where it is not."""
    if name in names:
        return True
    advice = did_you_mean(name, names) or f"there are {', '.join(names)}"
    tell_line(f"lagcli: error: {option}: unknown name '{name}': {advice}")
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
