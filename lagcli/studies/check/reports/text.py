"""For reading: a line for each problem, and where and what for each failure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from lagcli.diagnostics import NOWHERE, printable
from lagcli.diagnostics import render as render_diagnostics
from lagcli.studies.check.findings import CheckOutcome, Finding, Report


def render(reports: Iterable[Report]) -> Iterator[str]:
    """The lines of each report when it comes, then how many ended how."""
    outcomes: Counter[CheckOutcome] = Counter()
    checks = 0
    for report in reports:
        outcomes[report.outcome] += 1
        checks += report.checks
        yield "".join(f"{line}\n" for line in _lines(report))
    told = [f"{outcomes[outcome]} {outcome.value}" for outcome in CheckOutcome if outcomes[outcome]]
    problems = outcomes.total()
    yield f"{problems} problem{'s' * (problems != 1)}, {checks} checks: {', '.join(told)}\n"


def _lines(report: Report) -> Iterator[str]:
    if report.passed:
        yield f"passed  {printable(report.source.name)}  ({report.checks} checks)"
        return
    yield f"FAILED  {printable(report.source.name)}  ({report.outcome.value})"
    for line in render_diagnostics(report.source, report.diagnostics).splitlines():
        yield f"    {line}"
    for finding in report.findings:
        yield f"    {place(report, finding)}: {finding.outcome.value}: {finding.subject}"
        yield f"        {printable(finding.message)}"


def place(report: Report, finding: Finding) -> str:
    """`file:line:column` of the expectation, or the file alone."""
    name = printable(report.source.name)
    if finding.span == NOWHERE:
        return name
    return f"{name}:{finding.span.line}:{finding.span.column}"
