"""The picture of an ensemble: curves over what was varied, dots, or a map over a plane.

One quantity varied: the columns at the end of each motion over it; with every row of each
motion, dots, which is the bifurcation diagram when the rows are a period apart.  Two varied on
a grid: a map of each column; of a column with few values, `sign(x)` for example, the basins of
attraction.  Drawn at random: dots over the first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from lagcli.expression import Name
from lagcli.pictures.drawing import (
    Axis,
    CannotDraw,
    Cells,
    Curve,
    DrawnName,
    Item,
    Marks,
    Panel,
    Picture,
    Point,
    extent,
    unbroken,
)
from lagcli.pictures.labels import Labels, with_unit
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.record import record, replace

#: More panels do not fit on a page.
_MOST = 6

Row = Sequence[float | None]


@record(kw_only=True)
class Motions:
    """The rows of an ensemble.

    Attributes
    ----------
    varied : sequence of str
        Names of parameters, coordinates (`x`) and velocities (`x'`).
    is_grid : bool
        Whether all combinations were run, the last name varying fastest; else drawn at random.
    columns : sequence of Column
        Those of a motion.
    rows : sequence
        The values of what was varied, then the columns.
    are_right : sequence of bool
        Which rows have the accuracy; the others are left out.
    along : bool
        Every row of each motion, not its end.
    """

    varied: Sequence[str]
    is_grid: bool
    columns: Sequence[Column]
    rows: Sequence[Row]
    are_right: Sequence[bool]
    along: bool

    def of(self, place: int) -> list[tuple[Row, float]]:
        """The rows that count, and their values of a column."""
        found = []
        for row, right in zip(self.rows, self.are_right, strict=True):
            value = row[len(self.varied) + place]
            if right and value is not None:
                found.append((row, value))
        return found

    def notes(self, labels: Labels) -> Iterator[str]:
        """When the motions end, if all do at once, and how many rows do not count."""
        clock = [k for k, each in enumerate(self.columns) if each.expression is None]
        ends = {row[len(self.varied) + k] for row in self.rows for k in clock}
        if not self.along and len(ends) == 1:
            yield f"At t = {ends.pop():.6g} {labels.unit(None) or ''}".rstrip() + "."
        if count := len(self.are_right) - sum(self.are_right):
            yield f"{count} of {len(self.rows)} rows do not reach the accuracy"


def ensemble(problem: Problem, motions: Motions) -> Picture:
    """The picture of all columns but the time.

    Raises
    ------
    CannotDraw
        With more than two quantities varied, too many columns, or no row that counts.
    """
    shown = [k for k, column in enumerate(motions.columns) if column.expression is not None]
    _check(motions, shown)
    labels = Labels(problem)
    with_map = len(motions.varied) == 2 and motions.is_grid and not motions.along
    make = _map if with_map else _over_the_first
    panels = tuple(make(labels, motions, place) for place in shown)
    return Picture(title=problem.title, panels=panels, notes=tuple(motions.notes(labels)))


def _check(motions: Motions, shown: Sequence[int]) -> None:
    if motions.is_grid and len(motions.varied) > 2:
        raise CannotDraw("a picture shows one or two quantities that vary: fix the others by --set")
    if not shown or len(shown) > _MOST:
        raise CannotDraw(f"a picture shows one to {_MOST} columns: choose them by --show")
    if not any(motions.of(place) for place in shown):
        raise CannotDraw("no row reaches the accuracy: there is nothing to draw")


def _over_the_first(labels: Labels, motions: Motions, place: int) -> Panel:
    """A column over the quantity that was varied first."""
    found = motions.of(place)
    points = tuple((float(row[0] or 0.0), value) for row, value in found)
    item: Item = Marks(points=points, role="dots")
    if motions.is_grid and not motions.along:
        item = Curve(pieces=unbroken(_line(motions, place)), role="series")
    column = motions.columns[place]
    span = extent([value for _, value in found] or [0.0])
    y = labels.axis_over(column, span)
    x = _axis(labels, motions.varied[0], [row[0] for row in motions.rows])
    return Panel(x=x, y=y, items=(item,))


def _line(motions: Motions, place: int) -> Iterator[Point | None]:
    """The curve; None for a row that does not count."""
    for row, right in zip(motions.rows, motions.are_right, strict=True):
        value = row[len(motions.varied) + place]
        yield (float(row[0] or 0.0), value) if right and value is not None else None


def _map(labels: Labels, motions: Motions, place: int) -> Panel:
    known = {(row[0], row[1]): value for row, value in motions.of(place)}
    x, y = (sorted({float(row[k] or 0.0) for row in motions.rows}) for k in (0, 1))
    column = motions.columns[place]
    edges = tuple(map(_edges, (x, y)))
    cells = Cells(
        x=edges[0],
        y=edges[1],
        values=tuple(tuple(known.get((a, b)) for a in x) for b in y),
        label=labels.axis(column.expression, column.name),
    )
    first, second = (
        replace(_axis(labels, name, values), low=ends[0], high=ends[-1])
        for name, values, ends in zip(motions.varied, (x, y), edges, strict=True)
    )
    return Panel(x=first, y=second, items=(cells,))


def _edges(middles: Sequence[float]) -> tuple[float, ...]:
    """What lies half-way between the middles, and as far beyond the first and the last."""
    if _in_equal_ratios(middles):
        return tuple(math.exp(x) for x in _edges([math.log(x) for x in middles]))
    between = [(a + b) / 2 for a, b in pairwise(middles)]
    if not between:
        return middles[0] - 0.5, middles[0] + 0.5
    return 2 * middles[0] - between[0], *between, 2 * middles[-1] - between[-1]


def _axis(labels: Labels, name: str, values: Sequence[float | None]) -> Axis:
    quantity = Name(name.rstrip("'"), len(name) - len(name.rstrip("'")))
    given = sorted({float(x or 0.0) for x in values})
    low, high = extent(given)
    state = any(c.name == quantity.name for c in labels.problem.coordinates)
    label = labels.of(quantity, name)
    label = with_unit(_at_start(label) if state else label, labels.unit(quantity))
    if _in_equal_ratios(given):
        return Axis(label=label, low=given[0], high=given[-1], logarithmic=True)
    return Axis(label=label, low=low, high=high, angle=labels.is_angle(quantity))


def _in_equal_ratios(values: Sequence[float]) -> bool:
    """Whether these were given as `1e-3:1:50:log`."""
    if len(values) < 4 or values[0] <= 0:
        return False
    ratios = [b / a for a, b in pairwise(values)]
    return max(ratios) - min(ratios) < 1e-9 * ratios[0]


def _at_start(label: DrawnName) -> DrawnName:
    return DrawnName(
        plain=f"{label.plain}(0)", ascii=f"{label.ascii}(0)", tex=f"{label.tex.rstrip('$')}(0)$"
    )
