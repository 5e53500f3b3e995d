"""The study as text, JSON and CSV."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from textwrap import fill
from typing import Any

from lagcli.formatters.json_values import fields_of
from lagcli.numerics.tables.writing import records_as_csv
from lagcli.studies.tradeoff.front import AS_GOOD, AccuracyVerdict, RunPoint
from lagcli.studies.tradeoff.inside import trades
from lagcli.studies.tradeoff.study import Study

_WIDTH = 80
_HEAD = (
    "method", "tolerance", "true error", "integration", "total", "evaluations", "drift", "residual",
)  # fmt: skip
_WORDS = {"total": "total time", "integration": "integration time", "evaluations": "evaluations"}
_COLUMNS = (
    "kind", "method", "taken", "tolerance", "accuracy", "error", "integration", "total",
    "evaluations", "steps", "drift", "residual", "front", "reached", "why",
)  # fmt: skip


def to_text(study: Study) -> str:
    """Tables of at most 80 columns."""
    known = study.reference
    lines = [
        f"{study.name}: what accuracy costs until t = {study.until:g}, at {study.samples} times",
        f"reference: {known.kind},",
        f"  error at most {_size(known.bound)}, made in {_seconds(known.seconds)}",
        "",
    ]
    front = study.front
    cells = [["", *_HEAD]]
    cells += [["*" if point in front else "", *_cells(point, study)] for point in study.points]
    lines += _aligned(cells)
    lines += [f"* nothing is both as exact and cheaper ({_WORDS[study.cost]})", ""]
    lines += [
        f"{point.method} at {point.tolerance:.0e}: {point.why}"
        for point in study.points
        if point.why
    ]
    lines += [f"{name} is not for this problem: {why}" for name, why in study.unsuited.items()]
    lines += ["", "with its certificate, a fresh process:"]
    lines += _aligned(
        [
            ["accuracy", "cheapest", "total", "auto takes", "total", "ratio", "true error"],
            *(_verdict(each) for each in study.verdicts),
        ]
    )
    lines += ["", *(f"{trade.name}: {trade.sentence}" for trade in trades(study))]
    lines += [
        f"warning: {point.method} claims {point.accuracy:g} and errs by {point.error:.1e}"
        for point in study.broken
    ]
    lines += [f"warning: {warning}" for warning in known.warnings]
    shown = [line for each in _without_double_blanks(lines) for line in each.split("\n")]
    return "".join(f"{_within_a_terminal(line.rstrip())}\n" for line in shown)


def _within_a_terminal(line: str) -> str:
    if len(line) <= _WIDTH:
        return line
    return fill(
        line, _WIDTH, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def line_of(point: RunPoint) -> str:
    """What is known of one run before the others are made."""
    request = point.tolerance if point.accuracy is None else point.accuracy
    what = "tolerance" if point.accuracy is None else "certified,"
    error = "" if point.error is None else f"true error {_size(point.error)} in "
    return f"{point.method}, {what} {request:.0e}: {error}{point.why or _seconds(point.total)}"


def _size(error: float) -> str:
    return f"{error:.1e}" if error else "0"


def _cells(point: RunPoint, study: Study) -> list[str]:
    error = "–"
    if point.error is not None:
        below = point.error <= study.resolved
        error = f"< {study.resolved:.1e}" if below and study.resolved else _size(point.error)
    return [
        point.method,
        f"{point.tolerance:.0e}",
        error,
        _seconds(point.integration),
        _seconds(point.total),
        str(point.evaluations or "–"),
        _small(point.drift),
        _small(point.residual),
    ]


def _verdict(verdict: AccuracyVerdict) -> list[str]:
    none = RunPoint(method="none", taken="none")
    best, auto, ratio = verdict.best or none, verdict.auto or none, verdict.ratio
    return [
        f"{verdict.accuracy:.0e}",
        best.taken,
        _seconds(best.total),
        auto.taken,
        _seconds(auto.total),
        "–" if ratio is None else f"{ratio:.2f}{'' if verdict.agrees else f' > {AS_GOOD:g}'}",
        _small(auto.error),
    ]


def _seconds(value: float | None) -> str:
    if value is None:
        return "–"
    for scale, unit in ((1.0, "s"), (1e-3, "ms")):
        if value >= scale:
            return f"{value / scale:.3g} {unit}"
    return f"{value / 1e-6:.3g} µs"


def _small(value: float | None) -> str:
    return "–" if value is None else "0" if value == 0 else f"{value:.1e}"


def _aligned(cells: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return [
        " ".join(
            cell.ljust(width) if j < 2 and not cell[:1].isdigit() else cell.rjust(width)
            for j, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in cells
    ]


def _without_double_blanks(lines: Sequence[str]) -> list[str]:
    return [line for k, line in enumerate(lines) if line or (k and lines[k - 1])]


def to_json(study: Study) -> str:
    """The machine's view; times in seconds of processor time."""
    known, front = study.reference, study.front
    document: dict[str, Any] = {
        "schema": 1,
        "problem": study.name,
        **fields_of(study, "until samples cost"),
        "reference": {"kind": known.kind, "error_bound": known.bound, "seconds": known.seconds},
        "runs": [{**_document(point), "front": point in front} for point in study.points],
        "certified": [
            {**_document(point), "accuracy": point.accuracy, "reached": point.reached}
            for point in study.certified
        ],
        "cheapest": [
            {
                "accuracy": each.accuracy,
                "method": each.best.taken if each.best is not None else None,
                "total": each.best.total if each.best is not None else None,
                "auto": each.auto.taken if each.auto is not None else None,
                "ratio": each.ratio,
                "auto_agrees": each.agrees,
            }
            for each in study.verdicts
        ],
        "trades": [
            {"name": trade.name, "told": trade.sentence, **trade.numbers} for trade in trades(study)
        ],
        "not_suitable": dict(study.unsuited),
        "warnings": list(known.warnings),
    }
    return json.dumps(document, ensure_ascii=False, allow_nan=False) + "\n"


def _document(point: RunPoint) -> dict[str, Any]:
    numbers = "tolerance error integration total evaluations steps drift residual"
    return {
        "method": point.method,
        "taken": point.taken or None,
        **fields_of(point, numbers),
        "why": point.why or None,
    }


def to_csv(study: Study) -> str:
    """One line for each run."""
    front = study.front
    runs = [("single", point) for point in study.points]
    runs += [("certified", point) for point in study.certified]
    records = (
        {
            **_document(point),
            "kind": kind,
            "front": int(point in front),
            "accuracy": point.accuracy,
            "reached": int(point.reached),
        }
        for kind, point in runs
    )
    return records_as_csv(_COLUMNS, records)


WRITERS: dict[str, Callable[[Study], str]] = {"text": to_text, "json": to_json, "csv": to_csv}
