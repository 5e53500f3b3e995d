"""HTML with MathML, which browsers set without a script."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from string import Template

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
from lagcli.expression import (
    Expression,
    Negative,
    Quotient,
    Sum,
    factors_of,
    operation_count,
    product_of,
)
from lagcli.formatters.mathml import MathmlPrinter, enclosed
from lagcli.formatters.options import Options
from lagcli.formatters.page import to_document
from lagcli.formatters.plain import harmless, with_spaces_of
from lagcli.formatters.units import mathml_unit
from lagcli.statements.answers import Answers
from lagcli.units import Unit

_PAGE = Path(__file__).with_name("page.html")
_DISPLAY = (
    '<div class="display" style="overflow: auto hidden; padding: 0.2em 0; margin-bottom: 0.7em">'
    '<math display="block">'
    '<mtable displaystyle="true" columnalign="right center left">'
)
_END_DISPLAY = "</mtable></math></div>"
#: Chromium wants its own name of a side, Firefox the table's `columnalign`.
_CELL = '<mtd style="text-align: -webkit-{side}; padding: {above} 0.2em 0.1em">{content}</mtd>'
_ENTRY = '<mtd style="padding: 0.3em 0.4em">{}</mtd>'
_WHOLE_ROW = (
    '<mtr><mtd columnspan="3" columnalign="left" '
    'style="text-align: -webkit-left; padding: {above} 0.2em 0.1em">{content}</mtd></mtr>'
)
#: Above the first line of an equation, and above those that go on with it.
_NEXT, _GOES_ON = "0.9em", "0.4em"
#: A key of a file, quoted as in Markdown.
_CODE = re.compile("`([^`]+)`")
#: A formula with a sign and another behind it, or with a punctuation mark.
_FORMULA = "<math>(?:(?!</math>).)*</math>"
_TORN = re.compile(rf"{_FORMULA}(?: [-+−=·] {_FORMULA})*[.,;:)]|{_FORMULA}(?: [-+−=·] {_FORMULA})+")
#: A side of an equation is broken where its terms reach this number of operations.
_LONG = 24
_WIDE = 30  # operations of a numerator that a line has room for


def render(answers: Sequence[Answers], options: Options) -> str:
    """HTML with MathML: a fragment, or a whole page."""
    return pages([to_document(each) for each in answers], options)


def pages(documents: Sequence[Document], options: Options) -> str:
    """Set documents, one under another."""
    below = [*options.below, *[""] * (len(documents) - len(options.below))]
    articles = zip(documents, below, strict=True)
    body = "\n".join(line for each, more in articles for line in _article(each, more)) + "\n"
    if not options.standalone:
        return body
    title = ", ".join(escaped(document.title) for document in documents)
    return Template(_PAGE.read_text("utf-8")).substitute(title=title, body=body)


def escaped(text: str) -> str:
    """Escape a text for the content of an element."""
    return html.escape(harmless(text))


def _article(document: Document, below: str) -> Iterator[str]:
    printer = MathmlPrinter()
    yield "<article>"
    yield f"<h1>{escaped(document.title)}</h1>"
    for block in document.blocks:
        yield from _block(block, printer)
    if below:
        yield below
    yield "</article>"


def _block(block: Block, printer: MathmlPrinter) -> Iterator[str]:
    match block:
        case Heading(text=text, level=level, formula=formula):
            about = "" if formula is None else _part(formula, printer)
            named = f"{escaped(text)} {about}".strip()
            yield f"<h{level + 1}>{named}</h{level + 1}>"
        case Paragraph(parts=parts):
            yield f"<p>{_sentence(parts, printer)}</p>"
        case Items(items=items):
            yield "<ul>"
            for item in items:
                yield f"<li>{_sentence(item, printer)}</li>"
            yield "</ul>"
        case Equations(rows=rows):
            yield _DISPLAY
            for row in rows:
                yield from _row(row, printer)
            yield _END_DISPLAY
        case Matrix():
            yield _DISPLAY
            yield _cells(_show(block.label, printer), "<mo>=</mo>", _matrix(block, printer))
            yield _END_DISPLAY


def _sentence(parts: Sequence[str | Formula], printer: MathmlPrinter) -> str:
    """Words and formulas; no line ends before a full stop, nor within `T + V`."""
    return _TORN.sub(
        r'<span style="white-space: nowrap">\g<0></span>',
        "".join(_part(part, printer) for part in parts),
    )


def _part(part: str | Formula, printer: MathmlPrinter) -> str:
    if isinstance(part, str):
        return with_spaces_of(part, _CODE.sub(r"<code>\1</code>", escaped(part)))
    return f"<math>{_show(part, printer)}</math>"


def _row(row: Row, printer: MathmlPrinter) -> Iterator[str]:
    """An equation; a long sum goes over several rows, its signs in front."""
    *above, last = _lines(row.left, printer)
    first, *below = _lines(row.right, printer)
    if row.note:
        note = f"<mspace width='1em'/><mtext>({escaped(row.note)})</mtext>"
        if below:
            below[-1] += note
        else:
            first += note
    if above:
        for number, line in enumerate(above):
            content = f"<mrow><mspace width='1em'/>{line}</mrow>" if number else line
            yield _WHOLE_ROW.format(content=content, above=_GOES_ON if number else _NEXT)
        content = f"<mrow><mspace width='1em'/>{last}<mo>=</mo>{first}</mrow>"
        yield _WHOLE_ROW.format(content=content, above=_GOES_ON)
    else:
        yield _cells(last, "<mo>=</mo>", first)
    for line in below:
        yield _cells("", "", f"<mspace width='1em'/>{line}", _GOES_ON)


def _lines(formula: Formula, printer: MathmlPrinter) -> list[str]:
    if not isinstance(formula, Sum):
        parted = _parted(formula)
        return [_show(formula, printer)] if parted is None else _beside(*parted, printer)
    lines: list[str] = []
    room = 0
    for term, shown in zip(formula.terms, printer.signed_terms(formula), strict=True):
        size = operation_count(term) + 1
        if not lines or size > room:
            lines.append("")
            room = _LONG
        lines[-1] += shown
        room -= size
    first, *others = (f"<mrow>{line}</mrow>" for line in lines)
    # a sign at the start of a row would be set close to its term, as in -x
    return [first, *(line.replace("<mo>", "<mo form='infix'>", 1) for line in others)]


def _parted(formula: Formula) -> tuple[Expression, Sum] | None:
    """a/D and the sum of a fraction a (b + c + …)/D that no line has room for."""
    minus = isinstance(formula, Negative)
    node = formula.operand if isinstance(formula, Negative) else formula
    if not isinstance(node, Quotient) or operation_count(node.numerator) <= _WIDE:
        return None
    factors = factors_of(node.numerator)
    wide = max(factors, key=operation_count)
    if not isinstance(wide, Sum):
        return None
    rest = Quotient(product_of(f for f in factors if f is not wide), node.denominator)
    return (Negative(rest) if minus else rest), wide


def _beside(front: Expression, wide: Sum, printer: MathmlPrinter) -> list[str]:
    """The rows of a/D (b + c + …), the bracket open from the first to the last."""
    lines = _lines(wide, printer)
    lines[0] = f"<mrow>{printer.show(front)}<mo stretchy='false'>(</mo>{lines[0]}</mrow>"
    lines[-1] = f"<mrow>{lines[-1]}<mo stretchy='false'>)</mo></mrow>"
    return lines


def _cells(left: str, middle: str, right: str, above: str = _NEXT) -> str:
    sides = zip(("right", "center", "left"), (left, middle, right), strict=True)
    cells = (_CELL.format(side=side, content=each, above=above) for side, each in sides)
    return f"<mtr>{''.join(cells)}</mtr>"


def _matrix(matrix: Matrix, printer: MathmlPrinter) -> str:
    rows = "".join(
        "<mtr>" + "".join(_ENTRY.format(printer.show(entry)) for entry in row) + "</mtr>"
        for row in matrix.entries
    )
    return enclosed("(", f'<mtable displaystyle="true">{rows}</mtable>', ")")


def _show(formula: Formula, printer: MathmlPrinter) -> str:
    match formula:
        case Label():
            return printer.label(formula)
        case Integral():
            return printer.integral(formula)
        case Bracket(left=left, right=right):
            inner = f"{printer.show(left)}<mo>,</mo>{printer.show(right)}"
            return enclosed("{", inner, "}")
        case Unit():
            return mathml_unit(formula)
        case _:
            return printer.show(formula)
