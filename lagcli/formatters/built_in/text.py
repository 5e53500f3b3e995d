"""For reading in a terminal: aligned equations in Unicode or ASCII, no wider than requested."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.document import (
    Block,
    Bracket,
    Document,
    Equations,
    Formula,
    Heading,
    Integral,
    Items,
    Label,
    Matrix,
    Paragraph,
    Row,
)
from lagcli.formatters.display_width import display_width
from lagcli.formatters.layout import (
    COMMA,
    RELATION,
    Layout,
    TextPiece,
    break_lines,
    joined,
    width_of,
)
from lagcli.formatters.options import Options
from lagcli.formatters.page import to_document
from lagcli.formatters.plain import FIRM_SPACE, filled, harmless, with_spaces_of
from lagcli.formatters.unicode import AsciiPrinter, UnicodePrinter
from lagcli.formatters.units import unicode_unit
from lagcli.notation.greek import romanized
from lagcli.statements.answers import Answers
from lagcli.units import Unit

_EQUALS = " = "
#: Left sides wider than this part of the line stand on lines of their own.
_NARROW = 0.35
#: A line inside brackets is indented by this number of columns for each.
_STEP = 2
#: An inner line keeps at least this much of the width.
_LEAST = 0.5


def render(answers: Sequence[Answers], options: Options) -> str:
    """Aligned equations for reading in a terminal."""
    return pages([to_document(each) for each in answers], options)


def pages(documents: Sequence[Document], options: Options) -> str:
    """Set documents, one under another."""
    page = _TextPage(options.width, unicode=options.unicode)
    return "\n\n".join("\n".join(page.lines(each)) for each in documents) + "\n"


OPENING_BRACE = TextPiece("{", 1, nesting=1)
CLOSING_BRACE = TextPiece("}", 1, nesting=-1)
COMMA_PIECE = TextPiece(", ", 2, rank=COMMA, broken="", tail=",")


class _TextPage:
    """Sets documents as lines of text."""

    def __init__(self, width: int, *, unicode: bool) -> None:
        self.width = max(width, 1)
        self.unicode = unicode
        self.printer = UnicodePrinter() if unicode else AsciiPrinter()

    def lines(self, document: Document) -> Iterator[str]:
        """Give the lines of a page, its title first."""
        title = filled(self.words(document.title), self.width)
        yield from title
        longest = max(map(display_width, title), default=0)
        yield ("═" if self.unicode else "=") * longest
        before: Block | None = None
        indent = 0
        for block in document.blocks:
            if isinstance(block, Heading):
                indent = 2 * (block.level - 1)
                if not (block.level > 1 and isinstance(before, Heading)):
                    yield ""
            inset = 2 * (document.prose and isinstance(block, (Equations, Matrix)))
            yield from (line.rstrip() for line in self.block(block, indent + inset))
            if isinstance(block, Heading):
                indent = 2 * block.level
            before = block

    def block(self, block: Block, indent: int) -> Iterator[str]:
        margin = " " * indent
        match block:
            case Heading(text=text, formula=formula):
                about = [] if formula is None else [self.inline(formula)]
                lines = iter(filled([*self.words(text), *about], self.width - indent))
            case Paragraph(parts=parts):
                lines = iter(filled(self.sentence(parts), self.width - indent))
            case Items(items=items):
                lines = self.items(items, self.width - indent)
            case Equations(rows=rows):
                lines = self.equations(rows, self.width - indent)
            case Matrix():
                lines = self.matrix(block, self.width - indent)
        for line in lines:
            yield (margin + line).replace(FIRM_SPACE, " ")

    def items(self, items: Sequence[Sequence[str | Formula]], width: int) -> Iterator[str]:
        mark = "• " if self.unicode else "- "
        for item in items:
            for number, line in enumerate(filled(self.sentence(item), width - len(mark))):
                yield (" " * len(mark) if number else mark) + line

    def words(self, text: str) -> list[str]:
        """Split a text that comes from outside into harmless words."""
        shown = harmless(text)
        return (shown if self.unicode else romanized(shown)).split()

    def sentence(self, parts: Sequence[str | Formula]) -> list[str]:
        """Give the words of a paragraph; a formula is one word."""
        return "".join(
            self.text(part) if isinstance(part, str) else self.inline(part) for part in parts
        ).split(" ")

    def text(self, part: str) -> str:
        """Make a part of a sentence harmless, keeping the spaces at its ends."""
        words = " ".join(self.words(part))
        return with_spaces_of(part, words, " " if words else "")

    def inline(self, formula: Formula) -> str:
        return joined(self.formula(formula)).replace(" ", FIRM_SPACE)

    def formula(self, formula: Formula) -> Layout:
        if isinstance(formula, Label):
            return self.printer.label(formula)
        if isinstance(formula, Integral):
            return self.printer.integral(formula)
        if isinstance(formula, Bracket):
            inner = (
                *self.printer.show(formula.left),
                COMMA_PIECE,
                *self.printer.show(formula.right),
            )
            return (OPENING_BRACE, *inner, CLOSING_BRACE)
        if isinstance(formula, Unit):
            shown = unicode_unit(formula) if self.unicode else romanized(str(formula))
            return (TextPiece(shown, display_width(shown)),)
        return self.printer.show(formula)

    def equations(self, rows: Sequence[Row], width: int) -> Iterator[str]:
        """Rows aligned at their `=`, except those with a wide left side."""
        shown = [(self.formula(row.left), self.formula(row.right), row.note) for row in rows]
        narrow = [width_of(left) for left, _, _ in shown if width_of(left) <= _NARROW * width]
        column = int(max(narrow, default=0))
        for left, right, note in shown:
            if width_of(left) <= column:
                gap = " " * int(column - width_of(left))
                head = joined(left) + gap + _EQUALS
                yield from self.broken(head, right, note, width)
            else:
                equals = TextPiece(_EQUALS, 3, rank=RELATION, broken="= ", broken_width=2)
                yield from self.broken("", (*left, equals, *right), note, width)

    def broken(self, head: str, layout: Layout, note: str, width: int) -> Iterator[str]:
        """`head` and a formula over as many lines as it needs, then the note."""
        hanging = display_width(head) or 2 * _STEP
        first = width - display_width(head)
        deepest = max(0, int(width * (1 - _LEAST)) - hanging) // _STEP
        lines = break_lines(layout, first, width - hanging, _STEP, deepest)
        texts = [head + lines[0].text]
        texts += [" " * (hanging + _STEP * line.depth) + line.text for line in lines[1:]]
        if note:
            remark = f"({' '.join(self.words(note))})"
            if display_width(texts[-1]) + 3 + display_width(remark) <= width:
                texts[-1] += "   " + remark
            else:
                texts += [" " * hanging + line for line in filled(remark.split(), width - hanging)]
        yield from texts

    def matrix(self, matrix: Matrix, width: int) -> Iterator[str]:
        """Set a matrix in brackets, or a list of its entries where it is too wide."""
        cells = [[joined(self.printer.show(entry)) for entry in row] for row in matrix.entries]
        columns = [max(map(display_width, column)) for column in zip(*cells, strict=True)]
        head = joined(self.printer.label(matrix.label)) + _EQUALS
        if not cells or len(head) + sum(columns) + 2 * len(columns) + 2 > width:
            yield from self.entries(matrix, width)
            return
        for number, row in enumerate(cells):
            padded = [
                cell + " " * (size - display_width(cell))
                for cell, size in zip(row, columns, strict=True)
            ]
            left, right = self.brackets(number, len(cells))
            start = head if number == (len(cells) - 1) // 2 else " " * len(head)
            yield f"{start}{left} {'  '.join(padded)} {right}"

    def brackets(self, row: int, count: int) -> tuple[str, str]:
        if count == 1 or not self.unicode:
            return "[", "]"
        return {0: ("⎡", "⎤"), count - 1: ("⎣", "⎦")}.get(row, ("⎢", "⎥"))

    def entries(self, matrix: Matrix, width: int) -> Iterator[str]:
        rows = matrix.listed(lambda entry: joined(self.printer.show(entry)) == "0")
        if len(rows) < sum(map(len, matrix.entries)):
            name = joined(self.printer.label(matrix.label))
            yield f"{name} is 0 but for" if rows else f"{name} = 0"
        yield from self.equations(rows, width)
