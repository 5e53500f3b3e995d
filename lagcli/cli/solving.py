"""Several files, one answer each: a file that is wrong does not stop the others."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from lagcli.answers import Answers
from lagcli.cli.asking import Asked
from lagcli.cli.files import print_result, read_input, reason, write_output
from lagcli.cli.status import Status
from lagcli.cli.telling import tell, tell_line
from lagcli.diagnostics import ProblemError
from lagcli.failures import describe
from lagcli.formatters import Options
from lagcli.pipeline import Request, derive, read, render, state
from lagcli.problem import Problem
from lagcli.record import record

PIPE_WIDTH = 80


@record(kw_only=True)
class Printing:
    """Where to, and in which form."""

    format_name: str
    output: Path | None
    standalone: bool
    width: int | None

    def options(self, *, several: bool) -> Options:
        """What the formatter is told of the place where its text will stand."""
        if self.output is not None or not sys.stdout.isatty():
            width = PIPE_WIDTH
        else:
            width = shutil.get_terminal_size((PIPE_WIDTH, 24)).columns
        return Options(
            width=self.width or width,
            unicode=self.encoding.lower().startswith("utf"),
            standalone=self.standalone,
            several=several,
        )

    @property
    def encoding(self) -> str:
        """UTF-8, but for text on a terminal that has something else."""
        if self.output is not None or self.format_name != "text":
            return "utf-8"
        return sys.stdout.encoding or "utf-8"


class Tally:
    """What went wrong so far; the worst of it is the exit status."""

    def __init__(self) -> None:
        self.wrong = False  # a file or the command line
        self.missing = False  # an answer

    @property
    def status(self) -> Status:
        """2 over 1 over 0."""
        if self.wrong:
            return Status.USAGE
        return Status.NOT_FOUND if self.missing else Status.WELL


def solve_files(files: Sequence[str], asked: Asked, printing: Printing) -> Status:
    """Answer every file that can be read, print the answers together."""
    tally = Tally()
    for mistake in asked.mistakes:
        tell_line(f"lagcli: error: {mistake}")
        tally.wrong = True
    has_place = _has_place(printing.output)
    tally.wrong = tally.wrong or not has_place
    problems = [_read(name, asked.request, tally) for name in files]
    if asked.mistakes or not has_place:
        return tally.status
    answers = [
        answer
        for name, problem in zip(files, problems, strict=True)
        if problem is not None
        if (answer := _answer(name, problem, asked.request, tally)) is not None
    ]
    if answers:
        _print(answers, printing, several=len(files) > 1, tally=tally)
    return tally.status


def _has_place(output: Path | None) -> bool:
    """Whether there is a place for what comes out; asked before any work is done."""
    if output is None:
        return True
    if output.is_dir():
        tell_line(f"{output}: error: is a directory")
        return False
    if not output.resolve().parent.is_dir():
        tell_line(f"{output}: error: there is no directory '{output.parent}'")
        return False
    return True


def _read(name: str, request: Request, tally: Tally) -> Problem | None:
    try:
        found = read(name, read_input(name), request)
    except OSError as error:
        tell_line(f"{name}: error: {reason(error)}")
        tally.wrong = True
        return None
    tell(found.source, found.diagnostics)
    tally.wrong = tally.wrong or found.problem is None
    return found.problem


def _answer(name: str, problem: Problem, request: Request, tally: Tally) -> Answers | None:
    try:
        answers = state(derive(problem), request)
    except ProblemError as error:
        tell(error.source, error.diagnostics)
        tally.wrong = True
    except Exception as error:  # noqa: BLE001 - one file's failure is not the others'
        tell_line(f"{name}: error: {describe(error)}")
        tally.missing = True
    else:
        tally.missing = tally.missing or not answers.complete
        return answers
    return None


def _print(answers: list[Answers], printing: Printing, *, several: bool, tally: Tally) -> None:
    text = render(answers, printing.format_name, printing.options(several=several))
    data = text.encode(printing.encoding, "replace")
    if printing.output is None:
        print_result(data)
        return
    try:
        write_output(printing.output, data)
    except OSError as error:
        tell_line(f"{printing.output}: error: {reason(error)}")
        tally.wrong = True
