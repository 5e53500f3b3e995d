"""What is wrong in a file, where, and what would be right.

A user's mistake is a value: every stage returns its diagnostics, the pipeline sorts
them and shows them together.  Nothing here knows what the mistakes are about.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Severity = Literal["error", "warning"]


@dataclass(frozen=True, slots=True, order=True)
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


@dataclass(frozen=True, slots=True)
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


@dataclass(frozen=True, slots=True)
class Source:
    """A text under its name, as the user knows it (`-` is standard input)."""

    name: str
    text: str


class ProblemError(Exception):
    """The file (or a `--set`) cannot be used; carries every diagnostic, sorted."""

    def __init__(self, source: Source, diagnostics: tuple[Diagnostic, ...]) -> None:
        super().__init__(f"{source.name}: {len(diagnostics)} mistake(s)")
        self.source = source
        self.diagnostics = diagnostics
