"""What a picture consists of, whoever draws it: panels with axes, curves, marks and lines.

Coordinates are those of the problem, in its own units.  Roles say what a part means; each
writer has its own colours, dashes and characters for them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Literal

from lagcli.record import field, record

Point = tuple[float, float]
Piece = tuple[Point, ...]

#: series: one of several, told apart by `colour`; motion: the one that the file asks for.
CurveRole = Literal["series", "motion", "level", "separatrix", "potential", "surface"]
MarkRole = Literal["stable", "unstable", "turning", "start", "event", "dots", "impact"]
RuleRole = Literal["event", "bound", "certificate", "energy", "zero"]


@record(kw_only=True)
class DrawnName:
    """A name in the notations of the writers.

    Attributes
    ----------
    plain, ascii
        In Unicode and in ASCII.
    tex
        As Matplotlib's mathtext has it, with the dollar signs around its formulas.
    """

    plain: str
    ascii: str
    tex: str


def words(text: str) -> DrawnName:
    """A label without formulas."""
    ascii_ = text.replace("\N{MINUS SIGN}", "-")
    return DrawnName(plain=text, ascii=ascii_, tex=text.replace("$", r"\$"))


def symbol(letter: str) -> DrawnName:
    """A letter set as a formula."""
    return DrawnName(plain=letter, ascii=letter, tex=f"${letter}$")


@record(kw_only=True)
class Axis:
    """An axis from `low` to `high`; an angle has its marks at multiples of pi."""

    label: DrawnName
    low: float
    high: float
    logarithmic: bool = False
    angle: bool = False


@record(kw_only=True)
class Curve:
    """A line in pieces; between two pieces nothing is drawn."""

    pieces: tuple[Piece, ...]
    role: CurveRole
    colour: int = 0
    label: DrawnName | None = None


@record(kw_only=True)
class Marks:
    """Points with a sign at each."""

    points: Piece
    role: MarkRole
    colour: int = 0
    label: DrawnName | None = None


@record(kw_only=True)
class Rule:
    """A straight line over the whole panel where x, or y, has a value."""

    at: float
    of: Literal["x", "y"]
    role: RuleRole
    colour: int = 0
    label: DrawnName | None = None


@record(kw_only=True)
class Band:
    """The part of a panel where x lies between two values: beyond the certificate."""

    low: float
    high: float
    label: DrawnName | None = None


@record(kw_only=True)
class Cells:
    """A value in each cell of a grid, as a colour.

    Attributes
    ----------
    x, y : tuple of float
        The edges of the columns and of the rows, rising: one more than there are.
    values : tuple of tuples
        From the lowest row up; None is left blank.
    label : Label
    """

    x: tuple[float, ...]
    y: tuple[float, ...]
    values: tuple[tuple[float | None, ...], ...]
    label: DrawnName


Item = Curve | Marks | Rule | Band | Cells


@record(kw_only=True)
class Panel:
    """Axes with what is drawn in them; `equal`: lengths along x and y are the same."""

    x: Axis
    y: Axis
    items: tuple[Item, ...]
    equal: bool = False


@record(kw_only=True)
class Picture:
    """Panels under one title, below each other or beside each other."""

    title: str
    panels: tuple[Panel, ...]
    beside: bool = False
    notes: tuple[str, ...] = field(default=())


#: A picture, and why its motion ends early; empty where it does not.
Drawn = tuple[Picture, str]

#: A width as small as this beside the values is their rounding.
_ROUNDING = 1e-12


class CannotDraw(Exception):
    """Why there is no such picture of this problem, and what to do: a sentence for the user."""


def unbroken(points: Iterable[Point | None]) -> tuple[Piece, ...]:
    """The pieces of a line that is broken where a point is missing."""
    parts = groupby(points, key=lambda point: point is not None)
    return tuple(tuple(p for p in part if p is not None) for is_point, part in parts if is_point)


def drawn_by(panel: Panel) -> list[Curve | Marks | Rule]:
    """The parts that a key of the panel lists: those with a label, each label once."""
    found: dict[str, Curve | Marks | Rule] = {}
    for item in panel.items:
        if not isinstance(item, Band | Cells) and item.label is not None:
            found.setdefault(item.label.plain, item)
    return sorted(found.values(), key=lambda item: not isinstance(item, Curve))


def equilibria(
    marked: Sequence[tuple[MarkRole, Sequence[float], int]], span: tuple[float, float]
) -> list[Item]:
    """Signs on the axis q' = 0: by role the places within a range, and their colour."""
    items: list[Item] = []
    for role, places, colour in marked:
        points = tuple((q, 0.0) for q in places if span[0] - 0.02 <= q <= span[1] + 0.02)
        if points:
            label = words(f"{role} equilibrium")
            items.append(Marks(points=points, role=role, colour=colour, label=label))
    return items


def widened(
    spans: Sequence[tuple[float, float]], least: float, room: float = 0.0
) -> list[tuple[float, float]]:
    """Spans none of which is narrower than this part of the longest, and room of a part of it."""
    longest = max(high - low for low, high in spans) or 1.0
    found = []
    for low, high in spans:
        missing = max(0.0, least * longest - (high - low)) / 2 + room * longest
        found.append((low - missing, high + missing))
    return found


def extent(values: list[float], room: float = 0.05) -> tuple[float, float]:
    """The least and the largest value with some room; a width that is never 0."""
    low, high = min(values), max(values)
    width = high - low
    if width <= _ROUNDING * max(abs(low), abs(high)):  # a constant stands in the middle
        width = 0.2 * (max(abs(low), abs(high)) or 1.0)
        low, high = low - width / 2, high + width / 2
    return low - room * width, high + room * width
