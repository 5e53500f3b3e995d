"""One problem to one file of code."""

from __future__ import annotations

from pathlib import Path

from lagcli.cli.choices import LANGUAGES
from lagcli.cli.error_output import report, report_line
from lagcli.cli.motion_commands import is_known, problem_of
from lagcli.cli.output import has_place, place
from lagcli.cli.status import Status
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import Request, derive, state
from lagcli.platform.stack import with_deep_stack
from lagcli.problem_data import Problem


def export_file(name: str, language: str, output: Path | None, settings: tuple[str, ...]) -> Status:
    """Derive, write, and say how it ended."""
    if not is_known("--to", language, LANGUAGES) & has_place(output, name):
        return Status.USAGE
    problem = problem_of(name, Request(settings=settings))
    if problem is None:
        return Status.USAGE
    return with_deep_stack(lambda: _export(problem, name, language, output))


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
    if code.missing:
        report_line(f"{name}: only the matrices were written: {code.missing}")
        return Status.NOT_FOUND
    return Status.WELL
