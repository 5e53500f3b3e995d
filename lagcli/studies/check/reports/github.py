"""For GitHub's log: workflow commands that mark the line of the file.

Reference: GitHub Docs, "Workflow commands for GitHub Actions", setting an error message.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lagcli.diagnostics import NOWHERE, Span, printable
from lagcli.studies.check.findings import Report


def render(reports: Iterable[Report]) -> Iterator[str]:
    """A command for each finding; nothing for what passed, and a count at the end."""
    failed = total = 0
    for report in reports:
        total += 1
        failed += not report.passed
        for diagnostic in report.diagnostics:
            advice = f" ({diagnostic.hint})" if diagnostic.hint else ""
            message = diagnostic.message + advice
            yield _command(diagnostic.severity, report, diagnostic.span, "file", message)
        for finding in report.findings:
            title = f"{finding.outcome.value}: {finding.subject}"
            yield _command("error", report, finding.span, title, finding.message)
    yield f"{total} problem{'s' * (total != 1)} checked, {failed} not passed\n"


def _command(severity: str, report: Report, span: Span, title: str, message: str) -> str:
    properties = {"file": report.source.name}
    if span != NOWHERE:
        properties |= {
            "line": str(span.line),
            "col": str(span.column),
            "endLine": str(span.end_line),
            "endColumn": str(span.end_column),
        }
    properties["title"] = title
    listed = ",".join(f"{name}={_property(value)}" for name, value in properties.items())
    return f"::{severity} {listed}::{_data(message)}\n"


def _data(text: str) -> str:
    """The text with its line breaks and percent signs escaped."""
    lines = map(printable, text.replace("%", "%25").splitlines())
    return "%0A".join(lines)


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
