"""The check of one problem: reading, deriving, comparing."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.diagnostics import ProblemError, Source
from lagcli.pipeline import Read, Request, derive, read, state
from lagcli.studies.check.findings import CheckOutcome, Finding, Report
from lagcli.verification import REFUTED, UNDECIDED

if TYPE_CHECKING:
    from lagcli.mechanics.derivation import Derivation
    from lagcli.statements.answers import Answers

#: The sections that are verified of each problem, whatever it expects.
SECTIONS = ("accelerations", "multipliers", "charges")


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
    from lagcli.studies.check.expectations import sections_expected
    from lagcli.studies.check.initial import initial_mistakes

    source, problem = Source(found.source.name, ""), found.problem
    if problem is None:
        return Report(found.source, diagnostics=found.diagnostics)
    expected = [declared.name for declared in sections_expected(problem.expect)]
    sections = tuple(dict.fromkeys([*SECTIONS, *expected]))
    try:
        derivation = derive(problem)
        if derivation.no_lagrangian:
            return _check_phase_space(derivation, source)
        off = initial_mistakes(derivation.problem)
        if off:
            return Report(found.source, diagnostics=off)
        answers = state(derivation, Request(sections=sections))
        if answers.absent:
            return _without_sections(source, answers)
        results = compared(derivation, answers)
    except ProblemError as error:
        return Report(error.source, diagnostics=error.diagnostics)
    findings = tuple(result for result in results if result is not None)
    return Report(source, len(results), findings)


def compared(derivation: Derivation, answers: Answers) -> list[Finding | None]:
    """Every comparison of the answers: with `expect`, in numbers, with the expected motion.

    None stands for one that holds.
    """
    from lagcli.studies.check.expectations import Expectations
    from lagcli.studies.check.trajectory import TrajectoryCheck

    expectations = Expectations(derivation, answers)
    if derivation.no_lagrangian:  # there is no motion in q and q'
        return list(expectations)
    trajectory = TrajectoryCheck(derivation.problem)
    return [*expectations, *_confirmed(answers), *trajectory]


def _confirmed(answers: Answers) -> Iterator[Finding | None]:
    """What `solve` verified in numbers before it would print it, section by section."""
    from lagcli.statements.answers import AccelerationsSection

    found = answers.sections["accelerations"]
    assert isinstance(found, AccelerationsSection)
    left_out = [said for said in answers.warnings if REFUTED in said or UNDECIDED in said]
    if found.accelerations is None and found.regular and not left_out:
        yield Finding(CheckOutcome.UNDECIDED, "accelerations", "no solution was found")
    for said in left_out:
        outcome = CheckOutcome.WRONG if REFUTED in said else CheckOutcome.UNDECIDED
        yield Finding(outcome, "verification", said)
    yield from [None] * (len(answers.sections) - len(left_out))


def _without_sections(source: Source, answers: Answers) -> Report:
    """Nothing can be compared with a section that could not be made."""
    reason = "; ".join(w for w in answers.warnings if "the section" in w or REFUTED in w)
    outcome = CheckOutcome.BROKEN if "bug of lagcli" in reason else CheckOutcome.UNDECIDED
    outcome = CheckOutcome.WRONG if REFUTED in reason else outcome
    findings = tuple(Finding(outcome, name, reason) for name in answers.absent)
    return Report(source, len(findings), findings)


def _check_phase_space(derivation: Derivation, source: Source) -> Report:
    """A problem without a Lagrangian has no motion in q and q' to compare with."""
    from lagcli.studies.check.expectations import sections_expected

    expected = sections_expected(derivation.given.expect)
    possible = tuple(each.name for each in expected if each.phase_space is not None)
    results = compared(derivation, state(derivation, Request(sections=possible)))
    results += [
        Finding(
            CheckOutcome.UNDECIDED, each.name, f"H gives no Lagrangian: {derivation.no_lagrangian}"
        )
        for each in expected
        if each.phase_space is None
    ]
    findings = tuple(result for result in results if result is not None)
    return Report(source, len(results), findings)


def broken(name: str, sentence: str) -> Report:
    """The report of a problem at which lagcli itself failed."""
    return Report(Source(name, ""), findings=(Finding(CheckOutcome.BROKEN, "lagcli", sentence),))


def too_long(name: str, limit: float) -> Report:
    """The report of a problem that was given up."""
    sentence = f"took longer than {limit:g} s"
    return Report(Source(name, ""), findings=(Finding(CheckOutcome.TOO_LONG, "time", sentence),))
