"""Paths in space, with equal lengths along all axes; three dimensions as two views."""

from __future__ import annotations

from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import (
    Axis,
    CannotDraw,
    Curve,
    Drawn,
    DrawnName,
    Item,
    Marks,
    Panel,
    Picture,
    Point,
    extent,
    symbol,
    widened,
    words,
)
from lagcli.pictures.labels import with_unit
from lagcli.pictures.points import AXES, Track, column_name, components, tracks
from lagcli.pictures.run import PicturedRun, run_with
from lagcli.problem_data import Problem

#: A view is at least so wide beside its length.
_LEAST = 0.25
#: From the side, and below that from above, as in a technical drawing.
_VIEWS = (("x", "z"), ("x", "y"))


def path(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The paths of all points.

    Raises
    ------
    CannotDraw
        Where there are no points, or they move along one axis.
    """
    found = tracks(problem)
    used = [axis for axis in AXES if any(axis in track.axes for track in found)]
    if len(used) < 2:
        raise CannotDraw(
            f"the points of this file have one component, {used[0]}: a path in space needs two; "
            "--kind series draws it over the time"
        )
    run = run_with(problem, request, components(found), progress)
    views = [tuple(used[:2])] if len(used) == 2 else list(_VIEWS)
    panels = tuple(_view(run, found, *view, named=not k) for k, view in enumerate(views))
    picture = Picture(title=problem.title, panels=panels, notes=run.notes())
    return picture, run.result.refusal


def _view(
    run: PicturedRun, found: tuple[Track, ...], across: str, up: str, *, named: bool
) -> Panel:
    items: list[Item] = []
    everything: list[Point] = []
    shown = [track for track in found if {across, up} <= set(track.axes)]
    for colour, track in enumerate(shown):
        x, y = (run.names.index(column_name(track, axis)) for axis in (across, up))
        pieces = run.curve(x, y)
        label = words(track.name) if named and len(shown) > 1 else None
        items.append(Curve(pieces=pieces, role="motion", colour=colour, label=label))
        first = Marks(
            points=pieces[0][:1],
            role="start",
            colour=colour,
            label=_once("start", colour, named=named),
        )
        items.append(first)
        jumps = tuple(piece[0] for piece in pieces[1:])
        if jumps:
            items.append(
                Marks(
                    points=jumps,
                    role="impact",
                    colour=colour,
                    label=_once("event", colour, named=named),
                )
            )
        everything += [point for piece in pieces for point in piece]
    if not everything:
        raise CannotDraw("no point has a place that is defined")
    x_axis, y_axis = _axes(everything)
    track = shown[0]
    unit = run.labels.unit(track.position[track.axes.index(across)])
    return Panel(
        x=Axis(label=with_unit(symbol(across), unit), low=x_axis[0], high=x_axis[1]),
        y=Axis(label=with_unit(symbol(up), unit), low=y_axis[0], high=y_axis[1]),
        items=tuple(items),
        equal=True,
    )


def _once(text: str, colour: int, *, named: bool) -> DrawnName | None:
    """The key names the signs of the first path only."""
    return words(text) if named and colour == 0 else None


def _axes(points: list[Point]) -> tuple[tuple[float, float], tuple[float, float]]:
    """The extents, neither much narrower than the other."""
    first, second = widened([extent([p[k] for p in points], room=0.08) for k in (0, 1)], _LEAST)
    return first, second
