"""Tables as HTML: first and last rows, and of a motion the certificate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from lagcli.pictures.run import short

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.result import Result

_SHOWN = 5  # rows at the beginning and at the end


def motion_as_html(result: Result, title: str) -> str:
    """The table, folded, with its certificate below."""
    return "\n".join(_lines(result, title)) + "\n"


def table_as_html(
    columns: Sequence[str], rows: Sequence[Sequence[float | None]], title: str
) -> str:
    """The first and the last rows under the names of their columns."""
    many = len(rows) > 2 * _SHOWN + 1
    shown = [*rows[:_SHOWN], None, *rows[-_SHOWN:]] if many else rows
    cells = [["…"] * len(columns) if row is None else [_cell(x) for x in row] for row in shown]
    head = "".join(f"<th>{escape(name)}</th>" for name in columns)
    body = "".join(f"<tr>{''.join(f'<td>{x}</td>' for x in row)}</tr>\n" for row in cells)
    return f"<table><caption>{escape(title)}</caption>\n<tr>{head}</tr>\n{body}</table>"


def _lines(result: Result, title: str) -> Iterator[str]:
    yield f"<details><summary>{len(result.rows)} rows</summary>"
    yield table_as_html(result.columns, result.rows, title)
    yield "</details>"
    held = result.certificate
    word = "reached" if held.reached else f"holds until t = {held.holds_until:g}"
    error = max(held.global_error.values(), default=0.0)
    yield f"<p>Accuracy {short(held.accuracy)} {word}; global error at most {short(error)}.</p>"
    for line in (*result.warnings, result.refusal):
        if line:
            yield f"<p>{escape(line)}</p>"


def _cell(value: float | None) -> str:
    return "" if value is None else f"{value:.10g}"
