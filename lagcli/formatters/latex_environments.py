r"""Displays of LaTeX: `align` or `equation`, with labels or without numbers.

A label says where the equation stands and what is on its left: `eq:accelerations:theta`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count

from lagcli.document import Formula, Label
from lagcli.expression import Name
from lagcli.formatters.latex_display import Display, Set
from lagcli.formatters.options import LatexOptions
from lagcli.notation.greek import romanized

_NUMBER = re.compile(r"^\d+\. ")
#: An equation of more lines than this, a third of a page, may go on on the next page.
_TOGETHER = 12
_OTHER = re.compile(r"[^A-Za-z0-9_]+")


class Environments:
    """Sets the displays of a page; no two equations of it have one label."""

    def __init__(self, options: LatexOptions) -> None:
        self.options = options
        self._headings: list[str] = []
        self._taken: set[str] = set()

    def enter(self, heading: str, level: int) -> None:
        """A section, or a part of it, begins."""
        self._headings[level - 1 :] = [_slug(_NUMBER.sub("", heading)).lower()]

    def set(self, display: Display) -> Iterator[str]:
        """The lines of a display."""
        if self.options.separate:
            for each in display:
                yield from self._equation(each)
        else:
            yield from self._align(display)

    def _align(self, display: Display) -> Iterator[str]:
        """Display equations that may go on on the next page."""
        labelled = bool(self.options.labels)
        name = "align" if labelled else "align*"
        tall = len(display) > 1 and any(r"\frac" in line for each in display for line in each.lines)
        yield r"{\allowdisplaybreaks" + (r"\jot=1.6ex" if tall else "")  # fractions do not touch
        yield rf"\begin{{{name}}}"
        yield " \\\\\n".join(_on_one_page(self._numbered(each)) for each in display)
        yield rf"\end{{{name}}}}}%"

    def _numbered(self, each: Set) -> list[str]:
        """The number and the label stand at the last line."""
        if not self.options.labels:
            return each.lines
        *above, last = each.lines
        return [*(rf"{line} \notag" for line in above), rf"{last} {self._label(each.left)}"]

    def _equation(self, each: Set) -> Iterator[str]:
        labelled = bool(self.options.labels)
        name = "equation" if labelled else "equation*"
        yield rf"\begin{{{name}}}" + (self._label(each.left) if labelled else "")
        if len(each.lines) == 1:
            yield each.lines[0].replace("&", "", 1)
        else:
            yield r"\begin{split}"
            yield " \\\\\n".join(each.lines)
            yield r"\end{split}"
        yield rf"\end{{{name}}}%"

    def _label(self, left: Formula) -> str:
        parts = [self.options.labels, *self._headings, _named(left)]
        label = ":".join(filter(None, parts))
        if label in self._taken or not parts[-1]:
            label = next(n for n in (f"{label}:{k}" for k in count(1)) if n not in self._taken)
        self._taken.add(label)
        return rf"\label{{{label}}}"


def _on_one_page(lines: list[str]) -> str:
    """The lines of one equation, which no page break divides unless it is very long."""
    return (" \\\\*\n" if len(lines) <= _TOGETHER else " \\\\\n").join(lines)


def _named(left: Formula) -> str:
    """The symbol on the left of an equation; nothing where it is longer than that."""
    match left:
        case Name(name=name):
            return _slug(name)
        case Label(letter=letter, index=index):
            return _slug("_".join((letter, *index)))
    return ""


def _slug(text: str) -> str:
    return _OTHER.sub("-", romanized(text.replace("'", ""))).strip("-")
