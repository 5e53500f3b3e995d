"""What is wrong in a file, where, and what would be right.

A user's mistake is a value: every stage returns its diagnostics, the pipeline sorts
them and shows them together.  Nothing here knows what the mistakes are about.
"""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, Any, Literal

from lagcli.record import field, record

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

Severity = Literal["error", "warning"]


@record(order=True)
class Span:
    """A stretch of a text: from (line, column) to (end_line, end_column), exclusive.

    Lines and columns count from 1; a column counts characters, not bytes.
    """

    line: int
    column: int
    end_line: int
    end_column: int

    def to(self, other: Span) -> Span:
        """The stretch from the beginning of this one to the end of `other`."""
        return Span(self.line, self.column, other.end_line, other.end_column)


#: For what has no place in any file, such as an expression made by the program.
NOWHERE = Span(0, 0, 0, 0)


@record
class Diagnostic:
    """One mistake (or warning): the place, the sentence, and the advice."""

    message: str
    span: Span = NOWHERE
    hint: str = ""
    severity: Severity = "error"
    related: tuple[tuple[Span, str], ...] = field(default=())

    @property
    def is_error(self) -> bool:
        """Whether the file cannot be used."""
        return self.severity == "error"


@record
class Source:
    """A text under its name, as the user knows it (`-` is standard input)."""

    name: str
    text: str


class ProblemError(Exception):
    """The file (or a `--set`) cannot be used; carries every diagnostic, sorted."""

    def __init__(self, source: Source, diagnostics: tuple[Diagnostic, ...]) -> None:
        super().__init__(source, diagnostics)
        self.source = source
        self.diagnostics = diagnostics

    def __str__(self) -> str:
        return render(self.source, self.diagnostics).rstrip("\n")

    def __reduce__(self) -> tuple[Any, ...]:
        """Whatever the arguments of a subclass are: it may come from another process."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(
    kind: type[ProblemError], arguments: tuple[Any, ...], state: dict[str, Any]
) -> ProblemError:
    error = kind.__new__(kind)
    error.args = arguments
    error.__dict__.update(state)
    return error


# Showing them.

#: A line of the source longer than this is cut around the place.
SHOWN_WIDTH = 100
_TAB = 4


def render(source: Source, diagnostics: Iterable[Diagnostic], limit: int = 50) -> str:
    """Diagnostics as text, each with its line and carets under the place.

    Parameters
    ----------
    source : Source
        The text that the spans count in.
    diagnostics : iterable of Diagnostic
        What to show, in this order.
    limit : int
        How many at most; the rest is counted.

    Returns
    -------
    str
        Lines, each ended by a line break; empty without diagnostics.  Control characters
        of the source are made visible, so that a file cannot talk to the terminal.
    """
    everything = list(diagnostics)
    lines = source.text.split("\n")
    shown: list[str] = []
    for diagnostic in everything[:limit]:
        label = f"{diagnostic.severity}: {diagnostic.message}"
        shown += _place(source.name, lines, diagnostic.span, label, diagnostic.hint)
        for span, message in diagnostic.related:
            shown += _place(source.name, lines, span, f"note: {message}", "")
    if len(everything) > limit:
        shown.append(f"and {len(everything) - limit} more")
    return "".join(f"{line}\n" for line in shown)


def _place(name: str, lines: list[str], span: Span, label: str, hint: str) -> Iterator[str]:
    """`file:line:column: label`, the line, and the carets with the hint behind them."""
    if span.line < 1:  # no place in the file
        yield f"{printable(name)}: {printable(label)}"
        if hint:
            yield f"      = {printable(hint)}"
        return
    yield f"{printable(name)}:{span.line}:{span.column}: {printable(label)}"
    line = lines[span.line - 1] if span.line <= len(lines) else ""
    start = min(span.column - 1, len(line))
    end = min(span.end_column - 1, len(line)) if span.end_line == span.line else len(line)
    before, marked, after = line[:start], line[start:end], line[end:]
    before, marked, after = _cut(printable(before), printable(marked), printable(after))
    carets = "^" * max(1, _width(marked))
    yield f"{span.line:5} | {before}{marked}{after}".rstrip()
    yield f"      | {' ' * _width(before)}{carets} {printable(hint)}".rstrip()


def _cut(before: str, marked: str, after: str) -> tuple[str, str, str]:
    """The parts of a long line that are nearest to the place."""
    if len(before) + len(marked) + len(after) <= SHOWN_WIDTH:
        return before, marked, after
    if len(marked) > SHOWN_WIDTH // 2:
        marked, after = marked[: SHOWN_WIDTH // 2] + "…", ""
    room = SHOWN_WIDTH - len(marked)
    left = max(room // 2, room - len(after))
    if len(before) > left:
        before = "…" + before[len(before) - left + 1 :]
    right = max(0, room - len(before))
    if len(after) > right:
        after = after[: max(0, right - 1)] + "…"
    return before, marked, after


def printable(text: str) -> str:
    """The text without tabs, and with what a terminal would obey made visible."""
    return "".join(_shown(character) for character in text)


def _shown(character: str) -> str:
    code = ord(character)
    if character == "\t":
        return " " * _TAB
    if code < 0x20:
        return chr(0x2400 + code)  # ␛ for an escape
    if code == 0x7F:
        return "␡"
    # Other controls, line separators, and those that turn the writing direction.
    if unicodedata.category(character) in {"Cc", "Cf", "Cs", "Zl", "Zp"}:
        return "�"
    return character


def _width(text: str) -> int:
    """How many columns of a terminal a text takes: 2 for wide letters, 0 for accents."""
    width = 0
    for character in text:
        if unicodedata.category(character) in {"Mn", "Me"}:
            continue
        width += 2 if unicodedata.east_asian_width(character) in {"W", "F"} else 1
    return width
