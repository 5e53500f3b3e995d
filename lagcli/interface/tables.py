"""A motion as a table of HTML: its first and last rows, and the certificate."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lagcli.numerics.asked import Result

_SHOWN = 5  # rows at the beginning and at the end


def motion_as_html(result: Result, title: str) -> str:
    """The table with its certificate below."""
    return "\n".join(_lines(result, title)) + "\n"


def _lines(result: Result, title: str) -> Iterator[str]:
    yield f"<table><caption>{escape(title)}</caption>"
    yield "<tr>" + "".join(f"<th>{escape(name)}</th>" for name in result.columns) + "</tr>"
    rows = list(result.rows)
    many = len(rows) > 2 * _SHOWN + 1
    shown = [*rows[:_SHOWN], None, *rows[-_SHOWN:]] if many else rows
    for row in shown:
        cells = ["…"] * len(result.columns) if row is None else [_cell(x) for x in row]
        yield "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
    yield "</table>"
    held = result.certificate
    word = "reached" if held.reached else f"holds until t = {held.holds_until:g}"
    error = max(held.global_error.values(), default=0.0)
    made = f"{escape(result.method)}, {len(rows)} rows"
    yield f"<p>Accuracy {held.accuracy:g} {word}; global error at most {error:.1e} ({made}).</p>"
    for line in (*result.warnings, result.refusal):
        if line:
            yield f"<p>{escape(line)}</p>"


def _cell(value: float | None) -> str:
    return "" if value is None else f"{value:.10g}"
