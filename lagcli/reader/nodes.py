"""A YAML document as nodes: text, lists and maps, each with its place in the file."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field

from lagcli.diagnostics import Span
from lagcli.reader.positions import Excerpt, offsets_of
from lagcli.reader.text import SourceText


@dataclass(slots=True, eq=False, repr=False)
class DocumentNode:
    """A piece of the document from the offset `start` up to `end`."""

    text: SourceText
    start: int
    end: int
    size: int = field(default=1, kw_only=True)  # with every alias expanded
    anchored: bool = field(default=False, kw_only=True)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is written: `V:` and no value."""
        return False

    @property
    def written(self) -> str:
        """What the file has there."""
        return self.text.source.text[self.start : self.end]

    @property
    def parts(self) -> list[DocumentNode]:
        """The items of a list; none of other nodes."""
        return self.items if isinstance(self, Sequence) else []

    @property
    def pairs(self) -> list[tuple[Scalar, DocumentNode]]:
        """The entries of a map; none of other nodes."""
        return self.entries if isinstance(self, Mapping) else []

    @property
    def listed(self) -> list[str]:
        """The texts in a list."""
        return [each.value for each in self.parts if isinstance(each, Scalar)]

    @property
    def texts(self) -> list[str]:
        """The texts in a list, or the text itself."""
        return [self.value] if isinstance(self, Scalar) else self.listed

    @property
    def span(self) -> Span:
        """The place of the node in the file."""
        return self.text.span(self.start, max(self.end, self.start))


@dataclass(slots=True, eq=False, repr=False)
class Scalar(DocumentNode):
    """Text: a name, a formula, a title.  Never anything but text."""

    value: str
    style: str
    in_flow: bool
    broken: bool = field(default=False, kw_only=True)  # already reported, not to be read

    @property
    def is_empty(self) -> bool:
        """Whether nothing is written: `V:` and no value."""
        return self.style == "" and self.value == ""

    @property
    def label(self) -> str:
        """The text as a key or a name: composed and decomposed letters are one."""
        return unicodedata.normalize("NFC", self.value)

    def excerpt(self) -> Excerpt:
        """The value with the place of each character."""
        offsets = offsets_of(self.value, self.written, self.style, self.start)
        return Excerpt(self.value, self.text, offsets, self.in_flow and not self.style)


@dataclass(slots=True, eq=False, repr=False)
class Sequence(DocumentNode):
    """A list."""

    items: list[DocumentNode]


@dataclass(slots=True, eq=False, repr=False)
class Mapping(DocumentNode):
    """A map in the order of the file, no key twice."""

    entries: list[tuple[Scalar, DocumentNode]]


def kind(node: DocumentNode) -> str:
    """What a node is, in the words of a message."""
    match node:
        case Sequence():
            return "a list"
        case Mapping():
            return "a map"
        case Scalar() if node.is_empty:
            return "nothing"
        case _:
            return "a text"


def nodes_in(node: DocumentNode) -> Iterator[DocumentNode]:
    """Every node of a document, the outer ones first."""
    yield node
    for item in node.parts:
        yield from nodes_in(item)
    for key, value in node.pairs:
        yield key
        yield from nodes_in(value)


def entries_in(node: DocumentNode) -> Iterator[tuple[Scalar, DocumentNode]]:
    """Every entry of every map, the outer ones first."""
    for each in nodes_in(node):
        yield from each.pairs


def lines_of(key: Scalar, value: DocumentNode) -> str:
    """`lines 3 to 5` of an entry of a map, `line 3`."""
    first, last = key.span.line, max(each.span.line for each in nodes_in(value))
    return f"lines {first} to {last}" if last > first else f"line {first}"


def names_in(node: DocumentNode | None) -> list[str]:
    """The names in a list or a map of them."""
    if isinstance(node, Mapping):
        return [key.label for key, _ in node.entries]
    return [each.label for each in (node.parts if node else ()) if isinstance(each, Scalar)]
