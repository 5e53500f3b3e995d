"""Markdown for GitHub and Pandoc, the mathematics in $$ blocks of LaTeX."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagcli.document import Block, Document, Equations, Heading, Items, Matrix, Paragraph
from lagcli.formatters.latex_display import Display, LatexDisplay, lines_of
from lagcli.formatters.latex_math import LatexPrinter
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.options import Options
from lagcli.formatters.page import to_document
from lagcli.formatters.plain import harmless, with_spaces_of
from lagcli.statements.answers import Answers

#: Characters that mean something to HTML or to GitHub, and those that a backslash disarms.
_ENTITIES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "$": "&#36;", "@": "&#64;"}
_MARKS = frozenset("\\`*_[]#|~^{}!")
#: `:smile:`, `https://`.
_COLON = re.compile(r":(?=[\w/+-])")
#: What would start a list, a rule or a heading at the start of a line.
_LINE_START = re.compile(r"^([-+=]|\d+(?=[.)]))")

_OPERATOR = re.compile(r"\\operatorname\{([A-Za-z0-9]+)\}")
_TEXT = re.compile(r"\\text\{[^{}]*\}")
_UNDERSCORE = re.compile(r"\\_")


def render(answers: Sequence[Answers], options: Options) -> str:
    """Markdown for GitHub and Pandoc, with LaTeX in $$ blocks."""
    return pages([to_document(each) for each in answers], options)


def pages(documents: Sequence[Document], options: Options) -> str:  # noqa: ARG001 - all alike
    """Set documents, one under another."""
    blocks = [block for each in documents for block in _blocks(each)]
    return "\n\n".join(blocks) + "\n"


def escaped(text: str) -> str:
    """Escape a text for a line of Markdown: it shows as it is and means nothing."""
    shown = "".join(_ENTITIES.get(c, f"\\{c}" if c in _MARKS else c) for c in harmless(text))
    return _COLON.sub("&#58;", shown)


def _blocks(document: Document) -> Iterator[str]:
    display = LatexDisplay(LatexPrinter(LatexNames(document.coordinates, document.symbols)))
    yield f"# {escaped(document.title)}"
    for block in document.blocks:
        yield from _block(block, display)


def _block(block: Block, display: LatexDisplay) -> Iterator[str]:
    match block:
        case Heading(text=text, level=level, formula=formula):
            parts = (text,) if formula is None else (f"{text} " * bool(text), formula)
            yield f"{'#' * (level + 1)} {display.sentence(parts, _words, _inline)}"
        case Paragraph(parts=parts):
            yield _LINE_START.sub(r"\\\1", display.sentence(parts, _words, _inline))
        case Items(items=items):
            yield "\n".join(f"- {display.sentence(item, _words, _inline)}" for item in items)
        case Equations():
            yield from map(_display, display.equations(block))
        case Matrix():
            yield from map(_display, display.matrix(block))


def _display(display: Display) -> str:
    """A display; no line in it starts with a sign that would start a list."""
    body = _for_mathjax(" \\\\\n".join(lines_of(display)))
    return f"$$\n\\begin{{aligned}}\n{body}\n\\end{{aligned}}\n$$"


def _for_mathjax(latex: str) -> str:
    r"""LaTeX that GitHub takes: no \operatorname, no escapes within \text."""
    upright = _OPERATOR.sub(r"\\mathop{\\mathrm{\1}}", latex)
    return _TEXT.sub(lambda match: _UNDERSCORE.sub(r"}\\_\\text{", match[0]), upright)


def _inline(latex: str) -> str:
    r"""A formula in a sentence, where Markdown may read `\,` as a comma, two `_` as emphasis."""
    shown = _for_mathjax(latex.strip())
    return shown.replace(r"\,", r"\thinspace ").replace("}_{", "}_ {")


def _words(part: str) -> str:
    return with_spaces_of(part, escaped(part))
