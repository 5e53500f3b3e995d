"""The result as JSON, CSV or a table to read."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from lagcli.numerics.hybrid.events import Event
from lagcli.numerics.hybrid.result import Cut, Result

#: Of many events this number is listed at the beginning and at the end.
_LISTED = 5
#: Marks a row of a table, and names the column that marks it elsewhere.
_BEYOND, _CERTIFIED = "  ~", "certified"
#: Of what is told under a table.
_WIDTH = 80


def to_json(result: Result) -> str:
    """The machine's view; a stable contract."""
    return to_text(document_of(result)) + "\n"


def to_text(document: dict[str, Any]) -> str:
    """JSON; what is not a number is null and never nan."""
    return json.dumps(document, ensure_ascii=False, allow_nan=False)


def document_of(result: Result) -> dict[str, Any]:
    """The result as maps, lists and numbers."""
    held = result.certificate
    beyond = {} if result.beyond is None else {"beyond_rows": [list(row) for row in result.beyond]}
    refused = {"reason": result.refusal, "at": held.holds_until}
    return {
        "schema": 1,
        "columns": list(result.columns),
        "rows": [list(row) for row in result.rows],
        **beyond,
        "certificate": {
            "accuracy": held.accuracy,
            "reached": held.reached,
            "holds_until": held.holds_until,
            "global_error": dict(held.global_error),
            "estimated_by": held.estimated_by,
            "charges": {name: {"drift": drift} for name, drift in held.charges.items()},
            "constraints": {
                name: {"residual": position, "rate_residual": rate}
                for name, (position, rate) in held.constraints.items()
            },
        },
        "method": {
            "name": result.method,
            "reason": result.reason,
            "steps": result.steps,
            "evaluations": result.evaluations,
        },
        "events": [_event(event) for event in result.events],
        "model": {} if result.cut is None else _model(result.cut),
        "warnings": list(result.warnings),
        **({"refused": refused} if result.refusal else {}),
    }


def _model(cut: Cut) -> dict[str, Any]:
    return {
        "kept": list(cut.kept),
        "eliminated": {each.coordinate: each.formula for each in cut.eliminated},
        "dropped": list(cut.dropped),
        "ignorable": list(cut.ignorable),
        "reason": {
            **{each.coordinate: f"constraint {each.constraint}" for each in cut.eliminated},
            **dict.fromkeys(cut.dropped, "no column depends on it"),
            **dict.fromkeys(cut.ignorable, "kept: its velocity is needed, Routh spares nothing"),
        },
    }


def _event(event: Event) -> dict[str, Any]:
    found: dict[str, Any] = {"t": event.t, "name": event.name, "what": event.what}
    found["error"] = event.error if event.error < math.inf else None
    if event.energy_lost is not None:
        found["energy_lost"] = event.energy_lost
    if event.before:
        found["before"] = dict(event.before)
    if event.after:
        found["after"] = dict(event.after)
    return found


def to_csv(result: Result) -> str:
    """A header and the rows, every digit of a double; what is not defined is empty."""
    return as_csv(*with_column_certified(result))


def with_column_certified(result: Result) -> tuple[Sequence[str], Sequence[Sequence[float | None]]]:
    """Columns and rows; those beyond the certified ones are told by a last column, 1 or 0."""
    if result.beyond is None:
        return result.columns, result.rows
    marked = [(*row, 1.0) for row in result.rows] + [(*row, 0.0) for row in result.beyond]
    return (*result.columns, _CERTIFIED), marked


def as_csv(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A header and rows; None is empty."""
    import csv
    import io

    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([columns, *rows])
    return text.getvalue()


def records_as_csv(columns: Sequence[str], records: Iterable[Mapping[str, Any]]) -> str:
    """A header and records, of which other entries are left out; None is empty."""
    return as_csv(columns, ([record.get(name) for name in columns] for record in records))


def aligned(cells: Sequence[Sequence[str]]) -> list[str]:
    """Rows as lines, the cells of each column as wide as the widest."""
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return ["  ".join(f"{x:>{w}}" for x, w in zip(row, widths, strict=True)) for row in cells]


def to_table(result: Result) -> str:
    """Aligned columns with as many digits as are known, and the certificate under them."""
    held = result.certificate
    digits = _digits(result)
    cells = [list(result.columns)]
    cells += [
        ["–" if x is None else f"{x + 0.0:.{d}g}" for x, d in zip(row, digits, strict=True)]
        for row in (*result.rows, *(result.beyond or ()))
    ]
    certified = len(result.rows) + 1
    lines = aligned(cells)
    lines[certified:] = [line + _BEYOND for line in lines[certified:]]
    if result.beyond:
        lines.append(f"{_BEYOND.strip()} after t = {held.holds_until:.6g}: not certified")
    return "".join(f"{line}\n" for line in (*lines, "", *_certificate(result)))


def _certificate(result: Result) -> list[str]:
    """What holds of the rows, in lines of 80 columns."""
    from textwrap import wrap

    held = result.certificate
    lines = _told(result.events)
    bound = max(held.global_error.values(), default=0.0)
    word = "reached" if held.reached else f"held until t = {held.holds_until:g} only"
    lines.append(f"accuracy {held.accuracy:g} {word}; global error at most {bound:.1e},")
    lines.append(f"  estimated by {held.estimated_by}")
    lines += [f"charge {name}: drift {drift:.1e}" for name, drift in held.charges.items()]
    for name, (position, rate) in held.constraints.items():
        words = "" if position is None else f"residual {position:.1e}, "
        lines.append(f"constraint {name}: {words}residual of its rate {rate:.1e}")
    if result.cut is not None:
        lines += _model_lines(result.cut)
    work = f"{result.steps} steps, {result.evaluations} evaluations"
    lines.append(f"method {result.method}: {work}")
    lines.append(f"  {result.reason}")
    lines += [f"warning: {warning}" for warning in result.warnings]
    return [part for line in lines for part in wrap(line, _WIDTH, subsequent_indent="  ")]


def _model_lines(cut: Cut) -> list[str]:
    lines = [
        f"model: {each.coordinate} = {each.formula} by constraint {each.constraint}"
        for each in cut.eliminated
    ]
    if cut.dropped:
        lines.append(f"model: without {', '.join(cut.dropped)}, which no column depends on")
    return lines


def _told(events: Sequence[Event]) -> list[str]:
    """A line for each event; of many impacts the first and the last."""
    lines = [_line(event) for event in events]
    if len(lines) > 2 * _LISTED + 1:
        left_out = len(lines) - 2 * _LISTED
        lost = sum(event.energy_lost or 0.0 for event in events[_LISTED:-_LISTED])
        words = f"… {left_out} more events" + (f", energy lost {lost:.6g}" if lost else "")
        lines = [*lines[:_LISTED], words, *lines[-_LISTED:]]
    return lines


def _line(event: Event) -> str:
    lost = "" if event.energy_lost is None else f", energy lost {event.energy_lost:.6g}"
    return f"{event.what} at t = {event.t!r} ({event.name}){lost}"


def _digits(result: Result) -> list[int]:
    """As many significant digits as the accuracy tells of, for each column."""
    errors = result.certificate.global_error
    known = result.certificate.accuracy
    count = 1
    while count < 15 and 10.0**-count > known / 2:
        count += 1
    return [count if name in errors else 12 for name in result.columns]
