r"""Displayed equations: aligned at `=`, broken to the text width of the article class."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

from lagcli.document import Bracket, Equations, Formula, Integral, Label, Matrix, Row
from lagcli.expression import Expression
from lagcli.formatters.latex_math import LatexPrinter
from lagcli.formatters.latex_text import latex_text
from lagcli.formatters.latex_width import BINARY, QUAD, RELATION, TEXT_WIDTH, text_width
from lagcli.formatters.layout import COMMA, Layout, TextPiece, break_lines, joined, width_of
from lagcli.formatters.layout import RELATION as RELATION_RANK
from lagcli.formatters.precedence import Level
from lagcli.formatters.units import latex_unit
from lagcli.record import record
from lagcli.units import Unit

#: A wider left side stands on lines of its own, in points.
_NARROW = 90.0
#: What a line keeps free for the errors of the estimate.
_MARGIN = 4.0
#: No more quads of indentation than this, however many brackets are open.
_DEEPEST = 2
#: Signs between two formulas of a sentence.
_BETWEEN = {
    **{sign: sign for sign in "=<>+"}, "−": "-", "≤": r"\le", "≥": r"\ge", "≠": r"\ne"
}  # fmt: skip
#: amsmath's matrices have ten columns.
_COLUMNS = 10


@record
class _Shown:
    formula: Formula
    left: Layout
    right: Layout
    note: str

    @property
    def narrow(self) -> bool:
        return width_of(self.left) <= _NARROW


@record
class Set:
    """An equation as lines of LaTeX, the first with the left side, each with its `&`."""

    left: Formula
    lines: list[str]


Display = list[Set]


def lines_of(display: Display) -> list[str]:
    """The lines of all equations of a display."""
    return [line for each in display for line in each.lines]


class LatexDisplay:
    """Sets blocks of equations as displays, the rows of one `aligned` or `align*` each."""

    def __init__(self, printer: LatexPrinter) -> None:
        self.printer = printer

    def formula(self, formula: Formula) -> Layout:
        """Set one formula."""
        if isinstance(formula, Label):
            text, width = self.printer.names.label(formula)
            return (TextPiece(text, width),)
        if isinstance(formula, Integral):
            return self._integral(formula)
        if isinstance(formula, Bracket):
            left, right = (self.printer.show(f).pieces for f in (formula.left, formula.right))
            comma = TextPiece(r",\ ", 8.0, rank=COMMA, tail=",")
            opening, closing = TextPiece(r"\{", 5.0, nesting=1), TextPiece(r"\}", 5.0, nesting=-1)
            return (opening, *left, comma, *right, closing)
        if isinstance(formula, Unit):
            return (TextPiece(*latex_unit(formula)),)
        return self.printer.show(formula).pieces

    def _integral(self, integral: Integral) -> Layout:
        before = f"{integral.times} " if integral.times != 1 else ""
        name = self.printer.names.name(integral.variable)
        width = self.printer.names.width(integral.variable)
        inner = self.printer.at(integral.integrand, Level.PRODUCT).pieces
        sign = TextPiece(rf"{before}\int ", 14.0 + 5.0 * len(before))
        return (sign, *inner, TextPiece(rf"\,\mathrm{{d}}{name}", 8.0 + width))

    def sentence(
        self,
        parts: Sequence[str | Formula],
        words: Callable[[str], str],
        finished: Callable[[str], str] = str,
    ) -> str:
        """Words and formulas in running text, one formula where only a sign is between two."""
        shown: list[str] = []
        for before, part, after in zip(("", *parts), parts, (*parts[1:], ""), strict=False):
            if not isinstance(part, str):
                shown.append(f"${finished(joined(self.formula(part)))}$")
            elif isinstance(before, str) or isinstance(after, str) or part.strip() not in _BETWEEN:
                shown.append(words(part))
            else:
                shown.append(f"\0{_BETWEEN[part.strip()]}\0")
        return "".join(shown).replace("$\0", " ").replace("\0$", " ")

    def equations(self, block: Equations) -> Iterator[Display]:
        """Set the displays of a block: rows share one with narrow left sides, or of one line."""
        lefts = [width_of(self.formula(row.left)) for row in block.rows]
        column = max((width for width in lefts if width <= _NARROW), default=0.0)
        shown = [self._shown(row, _room(column)) for row in block.rows]
        for narrow, rows in groupby(shown, key=lambda each: each.narrow):
            if narrow:
                yield self._aligned(list(rows))
                continue
            display = [Set(row.formula, [*self._wide(row)]) for row in rows]
            short = all(len(each.lines) == 1 for each in display)
            yield from [display] if short else ([each] for each in display)

    def matrix(self, matrix: Matrix) -> Iterator[Display]:
        """Set a matrix in brackets, or its entries one by one where it is too wide."""
        boxes = [[self.printer.show(entry) for entry in row] for row in matrix.entries]
        head = self.formula(matrix.label)
        columns = [max(box.width for box in column) for column in zip(*boxes, strict=True)]
        total = width_of(head) + RELATION + sum(columns) + QUAD * len(columns) + 2 * QUAD
        if boxes and len(columns) <= _COLUMNS and total <= TEXT_WIDTH:
            texts = [[box.text for box in row] for row in boxes]
            between = r" \\ "
            if any(r"\frac" in text for row in texts for text in row):
                texts = [[rf"\displaystyle {text}" for text in row] for row in texts]
                between = r" \\[1.5ex] "
            rows = between.join(map(" & ".join, texts))
            line = rf"{joined(head)} &= \begin{{pmatrix}} {rows} \end{{pmatrix}}"
            yield [Set(matrix.label, [line])]
            return
        listed = matrix.listed(lambda entry: self.printer.show(entry).text == "0")
        yield from self.equations(Equations(listed))

    def _shown(self, row: Row, room: float) -> _Shown:
        right = row.right
        if isinstance(right, Expression):
            shown = self.printer.line(right, room - QUAD - BINARY).pieces
        else:
            shown = self.formula(right)
        return _Shown(row.left, self.formula(row.left), shown, row.note)

    def _aligned(self, rows: Sequence[_Shown]) -> Display:
        column = max(width_of(row.left) for row in rows)
        display = []
        for row in rows:
            room = _room(column)
            broken = self._broken(row.right, row.note, room, room - QUAD)
            first, *others = broken
            lines = [f"{joined(row.left)} &= {first}", *(f"&{line}" for line in others)]
            display.append(Set(row.formula, lines))
        return display

    def _wide(self, row: _Shown) -> Iterator[str]:
        equals = TextPiece(" = ", RELATION, rank=RELATION_RANK, broken="= ", broken_width=RELATION)
        room = TEXT_WIDTH - _MARGIN
        for line in self._broken((*row.left, equals, *row.right), row.note, room, room - QUAD):
            yield f"&{line}"

    def _broken(self, layout: Layout, note: str, first: float, others: float) -> list[str]:
        """Lines of a formula; every one but the first begins with its indentation."""
        lines = break_lines(layout, first, others, QUAD, _DEEPEST)
        texts = [lines[0].text]
        texts += [r"\quad" * (1 + line.depth) + f" {line.text}" for line in lines[1:]]
        if note:
            remark = rf"\quad\text{{({latex_text(note)})}}"
            last = lines[-1]
            room = (others if lines[1:] else first) - QUAD * last.depth - last.width
            if text_width(note) + 2 * QUAD <= room:
                texts[-1] += remark
            else:
                texts.append(remark)
        return texts


def _room(column: float) -> float:
    """What is left of a line behind a left side and the relation."""
    return TEXT_WIDTH - _MARGIN - column - RELATION
