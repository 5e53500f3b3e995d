"""Where each character of a scalar's value stands in the file.

A scalar's value differs from its writing by quotes, escapes, indentation and folded
lines.  Only blanks are ever joined or dropped, so every other character of the value is
found again by reading the writing from left to right.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

from lagcli.diagnostics import Source, Span
from lagcli.reader.regex import regex
from lagcli.reader.text import SourceText

Style = Literal["", "'", '"', "|", ">"]

BLANKS = frozenset(" \t\n\x85\u2028\u2029")

#: An anchor or a tag before the value belongs to the scalar's stretch of the file.
_PROPERTIES = regex(r"(?:[&!]\S*[ \t\n]+)*")

#: How many hexadecimal digits follow an escape of a double-quoted scalar.
_ESCAPE_DIGITS = {"x": 2, "u": 4, "U": 8}


class Excerpt(NamedTuple):
    """A piece of text and, character by character, its place in the file."""

    value: str
    text: SourceText
    offsets: Sequence[int]  # of each character of the value, and one more for the end
    in_flow: bool = False  # inside [ ] or { }, where a comma ends it

    @classmethod
    def whole(cls, source: Source) -> Excerpt:
        """A text that stands for itself, such as an argument of the command line."""
        return cls(source.text, SourceText.of(source), range(len(source.text) + 1))

    def span(self, start: int, end: int) -> Span:
        """The place in the file of `value[start:end]`."""
        last = self.offsets[end - 1] + 1 if end > start else self.offsets[start]
        return self.text.span(self.offsets[start], last)

    @property
    def everything(self) -> Span:
        """The place of the whole value."""
        return self.span(0, len(self.value))


def offsets_of(value: str, raw: str, style: str, start: int) -> Sequence[int]:
    """The file offset of each character of `value`, and of its end.

    Parameters
    ----------
    value : str
        The value as the YAML parser gives it.
    raw : str
        The scalar as written, with anchor, tag, quotes and block header.
    style : str
        `'`, `"`, `|`, `>`, or empty for a plain scalar.
    start : int
        The file offset of `raw`.
    """
    at = _PROPERTIES.match(raw).end() if raw[:1] in {"&", "!"} else 0  # type: ignore[union-attr]
    if style in {"'", '"'}:
        at += 1
    elif style in {"|", ">"}:
        at = raw.find("\n", at) + 1
    escaped = style in {"'", '"'} and ("'" in value or "\\" in value)
    if raw.startswith(value, at) and not escaped:  # one line, as it stands
        return range(start + at, start + at + len(value) + 1)
    offsets: list[int] = []
    for character in value:
        at, width = _find(character, raw, at, style)
        offsets.append(start + min(at, len(raw)))
        at += width
    offsets.append(offsets[-1] + 1 if offsets else start)
    return offsets


def _find(character: str, raw: str, at: int, style: str) -> tuple[int, int]:
    """Where `character` is written at or after `at`, and how many characters that takes."""
    while at < len(raw):
        written = raw[at]
        if style == '"' and written == "\\":
            if raw[at + 1 : at + 2] == "\n":  # an escaped line break joins two lines
                at += 2
                continue
            return at, 2 + _ESCAPE_DIGITS.get(raw[at + 1 : at + 2], 0)
        if style == "'" and written == "'":
            return at, 2
        if written == character:
            return at, 1
        if written in BLANKS:
            if character in BLANKS:
                return at, 1
            at += 1
            continue
        # The value has a blank (a folded line) where the writing already has the next word.
        return at, 0
    return len(raw), 0
