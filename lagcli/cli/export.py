"""`lagcli export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lagcli.cli.choices import LANGUAGES
from lagcli.cli.error_output import report, report_line
from lagcli.cli.motion_commands import is_known, problem_of
from lagcli.cli.options import Output, option
from lagcli.cli.output import has_place, place
from lagcli.cli.simulate import File, Set
from lagcli.cli.status import Status
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import Request, derive, state
from lagcli.platform.stack import with_deep_stack
from lagcli.problem_data import Problem

To = Annotated[
    str | None,
    option(
        "--to",
        "LANGUAGE",
        "python, c, julia, fortran, matlab, modelica, sympy or mathematica.  "
        "[default: by the ending of -o]",
        LANGUAGES,
    ),
]


def export(file: File, to: To = None, output: Output = None, settings: Set = None) -> int:
    """Write the equations of motion as code in another language.

    The right-hand side and its Jacobian, the mass matrix, the constraint matrices, the
    multipliers, the energy and the conserved charges, each a function of the time t, the
    state y (coordinates, then velocities) and the parameters p in the order of the file.

    \b
    Examples:
      lagcli export double-pendulum -o pendulum.c
      lagcli export kepler --to julia
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import format_of
    from lagcli.export import LANGUAGES

    # of the two that write .py, the first
    endings = {ending: name for name, (ending, _) in reversed(LANGUAGES.items())}
    language = format_of(to, output, endings, "", "--to")
    if not language:
        raise typer.BadParameter(f"give one of {', '.join(LANGUAGES)}", param_hint="--to")
    if not is_known("--to", language, tuple(LANGUAGES)) & has_place(output, file):
        return Status.USAGE
    problem = problem_of(file, Request(settings=tuple(settings or ())))
    if problem is None:
        return Status.USAGE
    return with_deep_stack(lambda: _export(problem, file, language, output))


def _export(problem: Problem, name: str, language: str, output: Path | None) -> Status:
    from lagcli.export import NoCode, code_of, render
    from lagcli.export.routines import SECTIONS

    try:
        derivation = derive(problem)
        answers = state(derivation, Request(sections=SECTIONS))
        module = output.stem if output else Path(name).stem
        code = code_of(derivation.problem, answers, module if name != "-" else "problem")
        text = render(code, language)
    except ProblemError as error:
        report(error.source, error.diagnostics)
        return Status.USAGE
    except NoCode as error:
        report_line(f"{name}: {error}")
        return Status.NOT_FOUND
    if not place(text.encode(), output):
        return Status.USAGE
    if code.left_out:
        report_line(f"{name}: {code.left_out}")
    if code.missing:
        report_line(f"{name}: only the matrices were written: {code.missing}")
        return Status.NOT_FOUND
    return Status.WELL
