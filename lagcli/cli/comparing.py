"""Two files compared, and the differences as lines."""

from __future__ import annotations

import sys

from lagcli.cli.error_output import report
from lagcli.cli.motion_commands import problem_of
from lagcli.cli.status import Status
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import with_lagrangian
from lagcli.platform.stack import with_deep_stack
from lagcli.problem_data import Problem


def compare_files(old: str, new: str) -> Status:
    """Compare, print, and say how it ended."""
    problems = [_problem(name) for name in (old, new)]
    first, second = problems
    if first is None or second is None:
        return Status.USAGE
    return with_deep_stack(lambda: _compared(first, second))


def _problem(name: str) -> Problem | None:
    problem = problem_of(name)
    try:
        return problem and with_lagrangian(problem)
    except ProblemError as error:
        report(error.source, error.diagnostics)
        return None


def _compared(first: Problem, second: Problem) -> Status:
    from lagcli.studies.check.difference import differences

    try:
        found = differences(first, second)
    except ProblemError as error:
        report(error.source, error.diagnostics)
        return Status.USAGE
    if not found:
        sys.stdout.write("the same physics\n")
        return Status.WELL
    for one in found:
        sys.stdout.write(f"{one.verdict}: {one.subject}\n")
        for mark, text in (("-", one.old), ("+", one.new)):
            if text:
                sys.stdout.write(f"  {mark} {text}\n")
    return Status.NOT_FOUND
