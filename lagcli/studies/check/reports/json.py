"""For machines: one JSON object."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from lagcli.diagnostics import NOWHERE, Span
from lagcli.formatters.json_values import fields_of
from lagcli.studies.check.findings import CheckOutcome, Report


def render(reports: Iterable[Report]) -> Iterator[str]:
    """The object, once all is known."""
    everything = list(reports)
    value = {
        "schema": 1,
        "summary": {
            outcome.value: sum(report.outcome is outcome for report in everything)
            for outcome in CheckOutcome
        },
        "problems": [_problem(report) for report in everything],
    }
    yield json.dumps(value, indent=2, ensure_ascii=False) + "\n"


def _problem(report: Report) -> dict[str, object]:
    return {
        "file": report.source.name,
        "outcome": report.outcome.value,
        "checks": report.checks,
        "findings": [
            {
                "outcome": finding.outcome.value,
                "subject": finding.subject,
                **_place(finding.span),
                "message": finding.message,
            }
            for finding in report.findings
        ],
        "diagnostics": [
            {
                "severity": diagnostic.severity,
                **_place(diagnostic.span),
                **fields_of(diagnostic, "message hint"),
            }
            for diagnostic in report.diagnostics
        ],
    }


def _place(span: Span) -> dict[str, int | None]:
    known = span != NOWHERE
    return {"line": span.line if known else None, "column": span.column if known else None}
