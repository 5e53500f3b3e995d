r"""LaTeX for \input or a document of its own, compiled with amsmath alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.document import Block, Document, Equations, Heading, Items, Matrix, Paragraph
from lagcli.formatters.latex_display import LatexDisplay
from lagcli.formatters.latex_environments import Environments
from lagcli.formatters.latex_math import LatexPrinter
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.latex_text import latex_text
from lagcli.formatters.options import Options
from lagcli.formatters.page import to_document
from lagcli.formatters.plain import with_spaces_of
from lagcli.statements.answers import Answers

_PREAMBLE = r"""\documentclass{article}
\usepackage{amsmath}
\begin{document}
"""
_END = r"""\end{document}
"""
_HEADINGS = {1: r"\subsection*", 2: r"\subsubsection*"}
#: Letters that a file's own symbols may use and amsmath does not have.
_BORROWED = {r"\mathbb": r"\mathbf", r"\mathfrak": r"\mathbf"}


def render(answers: Sequence[Answers], options: Options) -> str:
    r"""LaTeX with amsmath: a fragment for \input, or a whole document."""
    return pages([to_document(each) for each in answers], options)


def pages(documents: Sequence[Document], options: Options) -> str:
    """Set documents, one under another."""
    displays = Environments(options.latex)
    body = "\n".join(line for each in documents for line in _lines(each, displays))
    if not options.standalone:
        return body + "\n"
    return _PREAMBLE + body + "\n" + _END


def _lines(document: Document, displays: Environments) -> Iterator[str]:
    variants = displays.options.variants
    names = LatexNames(document.coordinates, document.symbols, variants)
    display = LatexDisplay(LatexPrinter(names))
    for macro, substitute in _BORROWED.items():
        if any(macro in symbol for symbol in document.symbols.values()):
            yield rf"\providecommand{{{macro}}}[1]{{{substitute}{{#1}}}}"
    yield rf"\section*{{\raggedright {latex_text(document.title)}}}"
    before: Block | None = None
    for block in document.blocks:
        if isinstance(block, Paragraph) and isinstance(before, Paragraph):
            yield "\n" + r"\smallskip"
        yield from _block(block, display, displays)
        before = block


def _block(block: Block, display: LatexDisplay, displays: Environments) -> Iterator[str]:
    match block:
        case Heading(text=text, level=level, formula=formula):
            displays.enter(text, level)
            parts = (text,) if formula is None else (f"{text} " * bool(text), formula)
            yield f"{_HEADINGS[level]}{{{display.sentence(parts, _words)}}}"
        case Paragraph(parts=parts):
            yield r"\noindent " + display.sentence(parts, _words)
        case Items(items=items):
            yield r"\begin{itemize}"
            for item in items:
                yield r"\item " + display.sentence(item, _words)
            yield r"\end{itemize}"
        case Equations():
            for each in display.equations(block):
                yield from displays.set(each)
        case Matrix():
            for each in display.matrix(block):
                yield from displays.set(each)


def _words(part: str) -> str:
    """Escaped words, with the spaces at their ends."""
    return with_spaces_of(part, latex_text(part), "~" if part.endswith("= ") else " ")
