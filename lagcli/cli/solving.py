"""Several files, one answer each: a file that is wrong does not stop the others."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

from lagcli.cli.command_work import CommandWork, Result
from lagcli.cli.error_output import report, report_line
from lagcli.cli.files import reason
from lagcli.cli.printing import Printing
from lagcli.cli.section_options import SectionOptions
from lagcli.cli.status import Status
from lagcli.diagnostics import ProblemError
from lagcli.formatters.registry import built_in
from lagcli.pipeline import Request, derive, read
from lagcli.platform.failures import describe
from lagcli.problem_data import Problem
from lagcli.sparing import keep_what_is_there, spare_sympy
from lagcli.statements.registry import is_built_in

#: A file's name, and its bytes or why there are none.
Input = tuple[str, bytes | OSError]


class SolvingOutcome(NamedTuple):
    """What is to be printed (None: nothing), and what has been reported on standard error.

    `repeatable` says that the same files and options would give the same again: nothing
    was missing on the disk, and no answer was left out that more time might have found.
    """

    status: Status
    text: str | None
    said: tuple[str, ...]
    repeatable: bool


class Tally:
    """What went wrong so far; the worst of it is the exit status."""

    def __init__(self) -> None:
        self.wrong = False  # a file or the command line
        self.missing = False  # an answer
        self.unreadable = False  # a file
        self.said: list[str] = []

    @property
    def status(self) -> Status:
        """2 over 1 over 0."""
        if self.wrong:
            return Status.USAGE
        return Status.NOT_FOUND if self.missing else Status.WELL


def solve_files(
    inputs: Sequence[Input],
    wanted: SectionOptions,
    printing: Printing,
    work: CommandWork[Result],
    *,
    only_read: bool = False,
) -> SolvingOutcome:
    """Answer every file that can be read, and format the answers together."""
    tally = Tally()
    problems = [_read(name, data, wanted.request, tally) for name, data in inputs]
    text = None
    if not only_read and any(problems):
        answered = [
            (problem, answer)
            for (name, _), problem in zip(inputs, problems, strict=True)
            if problem is not None
            if (answer := _answer(name, problem, wanted.request, work, tally)) is not None
        ]
        if answered:
            below = [_motion(problem, tally) for problem, _ in answered if printing.motion]
            options = printing.options(several=len(inputs) > 1, below=tuple(below))
            text = work.render([answer for _, answer in answered], printing.format_name, options)
    lasting = not (tally.missing or tally.unreadable or only_read)
    plain = all(map(is_built_in, wanted.request.sections or ()))
    repeatable = lasting and plain and printing.format_name in built_in()
    return SolvingOutcome(tally.status, text, tuple(tally.said), repeatable)


@cache
def _start_algebra(*, needed: bool) -> None:
    """SymPy is loaded before the collector starts; a large system does without it."""
    if needed:
        spare_sympy()
        import lagcli.mechanics.statements  # noqa: F401

    keep_what_is_there()


def _read(name: str, data: bytes | OSError, request: Request, tally: Tally) -> Problem | None:
    if isinstance(data, OSError):
        from lagcli.statements.registry import section_names

        hint = f"; sections are joined by commas, as in --show energy,{name}"
        report_line(f"{name}: error: {reason(data)}{hint if name in section_names() else ''}")
        tally.wrong = tally.unreadable = True
        return None
    found = read(name, data, request)
    tally.said.append(report(found.source, found.diagnostics))
    tally.wrong = tally.wrong or found.problem is None
    if (x := found.problem) is not None and x.initial and (x.constraints or x.contacts):
        from lagcli.values import off_constraints

        tally.said.append(report(found.source, off_constraints(x)))
    return found.problem


def _motion(problem: Problem, tally: Tally) -> str:
    """The motion as HTML; why there is none, or less, is a remark."""
    from lagcli.cli.motion_on_page import motion_below

    text, why = motion_below(problem)
    if why:
        remark = f"{problem.source.name}: no motion: {why}" if not text else why
        report_line(remark)
        tally.said.append(remark)
    return text


def _answer(
    name: str, problem: Problem, request: Request, work: CommandWork[Result], tally: Tally
) -> Result | None:
    try:
        derivation = derive(problem, named=request.named)
        _start_algebra(needed=derivation.gives_hamiltonian or derivation.large_form is None)
        answers = work.make(derivation, request)
    except ProblemError as error:
        tally.said.append(report(error.source, error.diagnostics))
        tally.wrong = True
    except Exception as error:  # noqa: BLE001 - one file's failure is not the others'
        report_line(f"{name}: error: {describe(error)}")
        tally.missing = True
    else:
        tally.missing = tally.missing or not answers.complete
        return answers
    return None
