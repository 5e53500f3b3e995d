"""SARIF, which code hosts and editors show beside the lines of a file.

Reference: OASIS, "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from urllib.parse import quote

from lagcli import __version__
from lagcli.diagnostics import NOWHERE, Span, printable
from lagcli.studies.check.findings import CheckOutcome, Report

_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {"error": "error", "warning": "warning"}


def render(reports: Iterable[Report]) -> Iterator[str]:
    """The log, once all is known."""
    results = [result for report in reports for result in _results(report)]
    rules = [
        {"id": _rule(outcome), "shortDescription": {"text": outcome.value}}
        for outcome in CheckOutcome
        if outcome is not CheckOutcome.PASSED
    ]
    tool = {"driver": {"name": "lagcli", "version": __version__, "rules": rules}}
    log = {"$schema": _SCHEMA, "version": "2.1.0", "runs": [{"tool": tool, "results": results}]}
    yield json.dumps(log, indent=2, ensure_ascii=False) + "\n"


def _results(report: Report) -> Iterator[dict[str, object]]:
    for diagnostic in report.diagnostics:
        advice = f" ({diagnostic.hint})" if diagnostic.hint else ""
        message = diagnostic.message + advice
        level = _LEVELS[diagnostic.severity]
        yield _result(report, CheckOutcome.INVALID, level, message, diagnostic.span)
    for finding in report.findings:
        message = f"{finding.subject}: {finding.message}"
        yield _result(report, finding.outcome, "error", message, finding.span)


def _result(
    report: Report, outcome: CheckOutcome, level: str, message: str, span: Span
) -> dict[str, object]:
    location: dict[str, object] = {"artifactLocation": {"uri": quote(report.source.name)}}
    if span != NOWHERE:
        location["region"] = {
            "startLine": span.line,
            "startColumn": span.column,
            "endLine": span.end_line,
            "endColumn": span.end_column,
        }
    text = "\n".join(map(printable, message.splitlines()))
    return {
        "ruleId": _rule(outcome),
        "level": level,
        "message": {"text": text},
        "locations": [{"physicalLocation": location}],
    }


def _rule(outcome: CheckOutcome) -> str:
    return outcome.value.replace(" ", "-")
