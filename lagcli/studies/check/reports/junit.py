"""For build servers: JUnit's XML, one test case for each problem.

Wrong, undecided and late answers are failures; an invalid file and a bug are errors.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from xml.sax.saxutils import escape, quoteattr

from lagcli.diagnostics import render as render_diagnostics
from lagcli.studies.check.findings import CheckOutcome, Report, place

#: What XML 1.0 cannot hold, even escaped.
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_ERRORS = (CheckOutcome.INVALID, CheckOutcome.BROKEN)


def render(reports: Iterable[Report]) -> Iterator[str]:
    """The document, once all is known."""
    everything = list(reports)
    errors = sum(report.outcome in _ERRORS for report in everything)
    failures = sum(not report.passed for report in everything) - errors
    seconds = sum(report.seconds for report in everything)
    yield '<?xml version="1.0" encoding="UTF-8"?>\n'
    yield (
        f'<testsuite name="lagcli check" tests="{len(everything)}" failures="{failures}" '
        f'errors="{errors}" skipped="0" time="{seconds:.3f}">\n'
    )
    for report in everything:
        yield _case(report)
    yield "</testsuite>\n"


def _case(report: Report) -> str:
    head = f"name={_attribute(report.source.name)} file={_attribute(report.source.name)}"
    head = f'  <testcase classname="lagcli.check" {head} time="{report.seconds:.3f}"'
    if report.passed:
        return f"{head}/>\n"
    kind = "error" if report.outcome in _ERRORS else "failure"
    details = render_diagnostics(report.source, report.diagnostics) + "".join(
        f"{place(report, finding)}: {finding.outcome.value}: {finding.subject}: {finding.message}\n"
        for finding in report.findings
    )
    message = _attribute(details.partition("\n")[0])
    outcome = _attribute(report.outcome.value)
    body = f"<{kind} type={outcome} message={message}>{escape(_allowed(details))}</{kind}>"
    return f"{head}>\n    {body}\n  </testcase>\n"


def _attribute(text: str) -> str:
    return quoteattr(_allowed(text))


def _allowed(text: str) -> str:
    return _FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text)
