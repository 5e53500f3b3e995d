"""`lagcli diff`."""

from __future__ import annotations

import sys
from typing import Annotated

from lagcli.cli.error_output import report
from lagcli.cli.motion_commands import problem_of
from lagcli.cli.options import argument
from lagcli.cli.status import Status
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import with_lagrangian
from lagcli.platform.stack import with_deep_stack
from lagcli.problem_data import Problem

Old = Annotated[str, argument("OLD", "A problem, or its name in the library.")]
New = Annotated[str, argument("NEW", "Another one.")]


def diff(old: Old, new: New) -> int:
    """Say whether two files mean the same physics.

    They do with the same coordinates, accelerations, constraints and multipliers at every
    state; formulas may have another shape, Lagrangians may differ by a total derivative.
    Values of parameters and the initial state are compared as well.

    The exit status is 0 when they mean the same, 1 when something differs or was not
    decided, and 2 when a file is wrong.

    Example: lagcli diff before.yaml after.yaml
    """
    first, second = _problem(old), _problem(new)
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
