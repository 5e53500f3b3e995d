"""Bytes to text, and offsets in the text to lines and columns."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from typing import NamedTuple

from lagcli.diagnostics import Diagnostic, Source, Span
from lagcli.reader.limits import FILE_BYTES

BYTE_ORDER_MARK = b"\xef\xbb\xbf"


class Mistake(Exception):
    """The mistakes that end the reading of an expression or of the whole file."""

    def __init__(self, diagnostic: Diagnostic, *further: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostics = (diagnostic, *further)


class SourceText(NamedTuple):
    """The text of a file with the offsets at which its lines begin."""

    source: Source
    line_starts: tuple[int, ...]

    @classmethod
    def of(cls, source: Source) -> SourceText:
        """Count the lines of `source`, which are ended by line feeds alone."""
        starts = [0]
        at = source.text.find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = source.text.find("\n", at + 1)
        return cls(source, tuple(starts))

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column, from 1, of the character at `offset`."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def offsets(self, span: Span) -> tuple[int, int]:
        """The offsets of the begin and the end of a stretch."""
        start = self.line_starts[span.line - 1] + span.column - 1
        return start, self.line_starts[span.end_line - 1] + span.end_column - 1

    def written(self, span: Span) -> str:
        """What the file has in a stretch."""
        return self.source.text[slice(*self.offsets(span))]

    def written_sum(self, spans: Iterable[Span]) -> str:
        """The texts of terms as one sum."""
        whole = as_sum(map(self.written, spans))
        return f"-{whole[1:].lstrip()}" if whole[:1] == "-" else whole

    def span(self, start: int, end: int) -> Span:
        """The stretch from offset `start` up to, not including, `end`."""
        return Span(*self.position(start), *self.position(end))


def as_sum(terms: Iterable[str]) -> str:
    """`a - b` for a and -b."""
    return " + ".join(terms).replace("+ -", "- ")


def numbered(name: str, texts: Iterable[str]) -> str:
    """`a_1: x, a_2: y` for the texts x and y."""
    return ", ".join(f"{name}_{place}: {each}" for place, each in enumerate(texts, start=1))


def also_in_lines(numbers: Iterable[int]) -> str:
    """`, also in lines 5 and 6`; nothing for no line."""
    lines = [*map(str, numbers)]
    listed = " and ".join(filter(None, [", ".join(lines[:-1]), *lines[-1:]]))
    return f", also in line{'s' * bool(lines[1:])} {listed}" if lines else ""


def decode(name: str, data: bytes) -> tuple[Source, list[Diagnostic]]:
    """The text of a file: UTF-8, without byte-order mark, lines ended by line feeds.

    Where it is not acceptable it is cut, so that a diagnostic can show the line.
    """
    message = hint = ""
    if len(data) > FILE_BYTES:
        message = f"the file has {len(data):,} bytes, the limit is 1 MiB ({FILE_BYTES:,} bytes)"
    elif data.startswith((b"\xff\xfe", b"\xfe\xff")):
        message, hint = "the file is UTF-16; only UTF-8 can be read", "save it as UTF-8"
    elif b"\0" in data[:1024]:
        message, hint = "this is not a text file", "a problem is a page of YAML"
    if message:
        return Source(name, ""), [Diagnostic(message, Span(1, 1, 1, 1), hint)]
    data = data.removeprefix(BYTE_ORDER_MARK)
    data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    try:
        return Source(name, data.decode("utf-8")), []
    except UnicodeDecodeError as problem:
        source = Source(name, data.decode("utf-8", "replace"))
        offset = len(data[: problem.start].decode("utf-8"))
        message = f"the byte 0x{data[problem.start]:02x} is not UTF-8"
        span = SourceText.of(source).span(offset, offset + 1)
        return source, [Diagnostic(message, span, "save the file as UTF-8")]
