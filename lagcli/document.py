"""A page before it has a notation: headings, sentences and equations in order.

The sections word the answers as such a page, `mechanics.explaining` a derivation;
the formatters `text`, `latex`, `markdown` and `html` set it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from lagcli.expression import ZERO, Expression, without_minus
from lagcli.record import field, record
from lagcli.units import Unit


@record
class Label:
    """A symbol of the page itself, such as L, Q_x, M[x, theta] or Delta x.

    Attributes
    ----------
    letter : str
        The symbol, or the name of the coordinate that changes.
    index : tuple of str
        Names or numbers that it is labelled with.
    matrix : bool
        Set in bold, its index in brackets.
    change : bool
        The change of the coordinate `letter` under a symmetry.
    unit : bool
        The unit of what is labelled, in brackets: [x].
    """

    letter: str
    index: tuple[str, ...] = ()
    matrix: bool = False
    change: bool = False
    unit: bool = False


@record
class Integral:
    """An integral without bounds, times a whole number.

    Attributes
    ----------
    integrand : Expression
    variable : str
        The coordinate that is integrated over.
    times : int
        What stands before the sign when it is not 1.
    """

    integrand: Expression
    variable: str
    times: int = 1


@record
class Bracket:
    """The Poisson bracket {left, right}."""

    left: Expression
    right: Expression


Formula = Expression | Label | Integral | Bracket | Unit


@record
class Heading:
    """The start of a section (`level` 1) or of a part of it (2), perhaps on one formula."""

    text: str
    level: int = 1
    formula: Formula | None = None


class Sentence(str):
    """A sentence that knows the formulas between its words; as a string they are in the grammar."""

    __slots__ = ("parts",)

    parts: tuple[str | Formula, ...]

    @classmethod
    def of(cls, text: str, parts: tuple[str | Formula, ...]) -> Sentence:
        """The sentence that a page sets as these parts."""
        made = cls(text)
        made.parts = parts
        return made


@record
class Paragraph:
    """Sentences, with formulas between the words."""

    parts: tuple[str | Formula, ...]


@record
class Items:
    """A list, each item a sentence with formulas between the words."""

    items: tuple[tuple[str | Formula, ...], ...]


@record
class Row:
    """`left = right`, with a word on what it is."""

    left: Formula
    right: Formula
    note: str = ""


@record
class Equations:
    """Equations that belong together and are aligned at their `=`."""

    rows: tuple[Row, ...]


def equations_of(
    sides: Iterable[tuple[Formula, Formula] | tuple[Formula, Formula, str]],
) -> Equations:
    """A display with one equation for each pair of sides, with a word on it or without."""
    return Equations(tuple(Row(*each) for each in sides))


def vanishing(values: Iterable[Expression]) -> Equations:
    """A display of 0 = each value, without a minus before all of it."""
    return equations_of((ZERO, value) for value in dict.fromkeys(map(without_minus, values)))


@record
class Matrix:
    """`label = (entries)`; its rows and columns are labelled where it is too wide to set."""

    label: Label
    entries: tuple[tuple[Expression, ...], ...]
    row_names: tuple[str, ...]
    column_names: tuple[str, ...]

    def entry_label(self, row: int, column: int) -> Label:
        """Label one entry, where the matrix is listed and not set."""
        index = [self.row_names[row]]
        if self.column_names:
            index.append(self.column_names[column])
        return Label(self.label.letter, tuple(index), matrix=True)

    def listed(self, is_zero: Callable[[Expression], bool]) -> tuple[Row, ...]:
        """The entries that are not 0, one by one."""
        return tuple(
            Row(self.entry_label(i, j), entry)
            for i, row in enumerate(self.entries)
            for j, entry in enumerate(row)
            if not is_zero(entry)
        )


Block = Heading | Paragraph | Items | Equations | Matrix


@record
class Document:
    """One file's answers as a page; `coordinates` and `symbols` say how names are set.

    In `prose` the displays stand between sentences, from which they are set off.
    """

    title: str
    blocks: tuple[Block, ...]
    coordinates: tuple[str, ...] = ()
    symbols: Mapping[str, str] = field(default_factory=dict)
    prose: bool = False
