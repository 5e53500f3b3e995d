"""The result as JSON, CSV or a table to read."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from lagcli.numerics.asked import Result


def to_json(result: Result) -> str:
    """The machine's view; a stable contract."""
    held = result.certificate
    document: dict[str, Any] = {
        "schema": 1,
        "columns": list(result.columns),
        "rows": [list(row) for row in result.rows],
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
        "events": [{"t": e.t, "name": e.name, "what": e.what} for e in result.events],
        "model": {},
        "warnings": list(result.warnings),
    }
    return json.dumps(document, ensure_ascii=False, allow_nan=False) + "\n"


def to_csv(result: Result) -> str:
    """A header and the rows, every digit of a double; what is not defined is empty."""
    lines = [",".join(map(_quoted, result.columns))]
    lines += [",".join("" if x is None else repr(x) for x in row) for row in result.rows]
    return "".join(f"{line}\n" for line in lines)


def _quoted(name: str) -> str:
    return f'"{name.replace(chr(34), chr(34) * 2)}"' if {",", '"'} & set(name) else name


def to_table(result: Result) -> str:
    """Aligned columns with as many digits as are known, and the certificate under them."""
    held = result.certificate
    digits = _digits(result)
    cells = [list(result.columns)]
    cells += [
        ["–" if x is None else f"{x:.{d}g}" for x, d in zip(row, digits, strict=True)]
        for row in result.rows
    ]
    widths = [max(len(row[j]) for row in cells) for j in range(len(result.columns))]
    lines = [
        "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in cells
    ]
    lines.append("")
    lines += [f"{e.what} at t = {e.t!r} ({e.name})" for e in result.events]
    bound = max(held.global_error.values(), default=0.0)
    word = "reached" if held.reached else f"held until t = {held.holds_until:g} only"
    lines.append(f"accuracy {held.accuracy:g} {word}; global error at most {bound:.1e},")
    lines.append(f"  estimated by {held.estimated_by}")
    lines += [f"charge {name}: drift {drift:.1e}" for name, drift in held.charges.items()]
    for name, (position, rate) in held.constraints.items():
        told = "" if position is None else f"residual {position:.1e}, "
        lines.append(f"constraint {name}: {told}residual of its rate {rate:.1e}")
    work = f"{result.steps} steps, {result.evaluations} evaluations"
    lines.append(f"method {result.method}: {work}")
    lines.append(f"  {result.reason}")
    lines += [f"warning: {warning}" for warning in result.warnings]
    return "".join(f"{line}\n" for line in lines)


def _digits(result: Result) -> list[int]:
    """As many significant digits as the accuracy tells of, for each column."""
    errors = result.certificate.global_error
    known = result.certificate.accuracy
    count = 1
    while count < 15 and 10.0**-count > known / 2:
        count += 1
    return [count if name in errors else 12 for name in result.columns]


WRITERS: dict[str, Callable[[Result], str]] = {
    "table": to_table,
    "json": to_json,
    "csv": to_csv,
}
