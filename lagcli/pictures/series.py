"""Columns over the time: a panel for each unit, velocities apart from coordinates."""

from __future__ import annotations

from lagcli.expression import Name
from lagcli.pictures.drawing import Axis, CannotDraw, Curve, DrawnName, Item, Panel, Picture
from lagcli.pictures.labels import Labels, with_unit
from lagcli.pictures.run import PicturedRun
from lagcli.reader.columns import Column

#: More curves than these are not told apart in one panel.
_MOST = 7


def series(run: PicturedRun) -> Picture:
    """The picture of all columns of a run.

    Raises
    ------
    CannotDraw
        Where no column has a value.
    """
    panels = []
    groups = _groups(run)
    for place, group in enumerate(groups):
        panels.append(_panel(run, group, named=place == 0))
    if not panels:
        raise CannotDraw("there is no column to draw: give --show x,y")
    return Picture(title=run.problem.title, panels=tuple(panels), notes=run.notes())


def _groups(run: PicturedRun) -> list[list[int]]:
    """The places of the columns of each panel."""
    groups: dict[object, list[int]] = {}
    for place, column in enumerate(run.columns, start=1):
        if run.values(place):
            groups.setdefault(_kind(column, run.labels), []).append(place)
    return [
        group[start : start + _MOST]
        for group in groups.values()
        for start in range(0, len(group), _MOST)
    ]


def _kind(column: Column, labels: Labels) -> object:
    """What the columns of one panel have in common."""
    unit = labels.unit(column.expression)
    expression = column.expression
    if unit is None and isinstance(expression, Name):
        return (expression.primes, labels.is_angle(expression))
    return unit or column.name


def _panel(run: PicturedRun, places: list[int], *, named: bool) -> Panel:
    columns = [run.columns[place - 1] for place in places]
    labels = [run.labels.of(column.expression, column.name) for column in columns]
    items: list[Item] = list(run.over_time(named=named))
    for colour, (place, label) in enumerate(zip(places, labels, strict=True)):
        shown = label if len(places) > 1 else None
        items.append(Curve(pieces=run.curve(0, place), role="series", colour=colour, label=shown))
    low, high = run.shown(places)
    label = with_unit(_together(labels), run.labels.unit(columns[0].expression))
    angle = all(run.labels.is_angle(column.expression) for column in columns)
    y = Axis(label=label, low=low, high=high, angle=angle)
    return Panel(x=run.time_axis(), y=y, items=tuple(items))


def _together(labels: list[DrawnName]) -> DrawnName:
    """`x, y`; of many the first and the last."""
    shown = labels if len(labels) <= 3 else [labels[0], labels[-1]]
    between = ", " if len(labels) <= 3 else " … "
    return DrawnName(
        plain=between.join(label.plain for label in shown),
        ascii=between.replace("…", "...").join(label.ascii for label in shown),
        tex=between.join(label.tex for label in shown),
    )
