"""The check of one problem: reading, deriving, comparing."""

from __future__ import annotations

import time
from itertools import chain

from lagcli.check.findings import Finding, Outcome, Report
from lagcli.diagnostics import ProblemError, Source
from lagcli.pipeline import Read, Request, derive, read, state


def check_problem(name: str, data: bytes) -> Report:
    """Check what is printed for a problem.

    Parameters
    ----------
    name
        The file's name in the report.
    data
        The file's bytes.
    """
    began = time.monotonic()
    report = _check(read(name, data))
    seconds = time.monotonic() - began
    return Report(report.source, report.checks, report.findings, report.diagnostics, seconds)


def _check(found: Read) -> Report:
    from lagcli.check.comparison import Comparison
    from lagcli.check.expectations import Expectations, sections_expected
    from lagcli.check.laws import SECTIONS, Laws
    from lagcli.check.trajectory import TrajectoryCheck

    source, problem = Source(found.source.name, ""), found.problem
    if problem is None:
        return Report(found.source, diagnostics=found.diagnostics)
    sections = tuple(dict.fromkeys([*SECTIONS, *sections_expected(problem.expect)]))
    try:
        derivation = derive(problem)
        answers = state(derivation, Request(sections=sections))
        comparison = Comparison(derivation)
        results = list(
            chain(
                Expectations(derivation, answers, comparison),
                Laws(derivation, answers),
                TrajectoryCheck(problem),
            )
        )
    except ProblemError as error:
        return Report(error.source, diagnostics=error.diagnostics)
    findings = tuple(result for result in results if result is not None)
    return Report(source, len(results), findings)


def broken(name: str, sentence: str) -> Report:
    """The report of a problem at which lagcli itself failed."""
    return Report(Source(name, ""), findings=(Finding(Outcome.BROKEN, "lagcli", sentence),))


def too_long(name: str, limit: float) -> Report:
    """The report of a problem that was given up."""
    sentence = f"took longer than {limit:g} s"
    return Report(Source(name, ""), findings=(Finding(Outcome.TOO_LONG, "time", sentence),))
