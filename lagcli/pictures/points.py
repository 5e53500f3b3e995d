"""The points of a picture in space: those of the file, or coordinates with Cartesian names."""

from __future__ import annotations

import re

from lagcli.expression import ONE, Expression, Name
from lagcli.pictures.drawing import CannotDraw
from lagcli.pictures.labels import Labels
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.record import record

AXES = "xyz"
#: x, y2, z_ball: one of the axes, and what is common to the coordinates of one point.
_CARTESIAN = re.compile(r"([xyzXYZ])_?([0-9]*|_\w+)")


@record(kw_only=True)
class Track:
    """A point whose path is drawn.

    Attributes
    ----------
    axes
        Which component is which: a coordinate `y` alone is drawn upwards.
    position
        As many expressions as there are axes.
    mass, force
        As the file has them.
    """

    name: str
    axes: str
    position: tuple[Expression, ...]
    mass: Expression | None = None
    force: tuple[Expression, ...] | None = None


def tracks(problem: Problem) -> tuple[Track, ...]:
    """The points of the file, or those that its Cartesian coordinates make.

    Raises
    ------
    CannotDraw
        Where there are neither, with what to add to the file.
    """
    found = tuple(
        Track(
            name=point.name,
            axes=AXES[: len(point.position)],
            position=point.position,
            mass=point.mass,
            force=point.force,
        )
        for point in problem.points
    )
    found = found or _cartesian(problem)
    if not found:
        raise CannotDraw(_missing(problem))
    return found


def _cartesian(problem: Problem) -> tuple[Track, ...]:
    points: dict[tuple[str, bool], dict[str, str]] = {}
    for coordinate in problem.coordinates:
        match = _CARTESIAN.fullmatch(coordinate.name)
        if match:
            letter, rest = match[1], match[2]
            points.setdefault((rest, letter.isupper()), {})[letter.lower()] = coordinate.name
    return tuple(
        Track(
            name=", ".join(names[axis] for axis in sorted(names)),
            axes="".join(sorted(names)),
            position=tuple(Name(names[axis]) for axis in sorted(names)),
        )
        for names in points.values()
    )


def _missing(problem: Problem) -> str:
    names = ", ".join(coordinate.name for coordinate in problem.coordinates)
    labels = Labels(problem)
    angles = [c.name for c in problem.coordinates if labels.is_angle(Name(c.name))]
    lengths = [c.name for c in problem.coordinates if c.name not in angles]
    lengths += [p.name for p in problem.parameters if p.unit == "m"]
    length, angle = (*lengths, "l")[0], (*angles, "theta")[0]
    example = f"points: {{P: {{position: [{length}*sin({angle}), -{length}*cos({angle})]}}}}"
    if not angles:
        example = f"points: {{P: {{position: [{length}, 0]}}}}"
    return (
        f"the file does not state where its bodies are: the coordinates {names} are not Cartesian "
        f"(x, y, z, x1, y1, ...) and there are no points; add them, for example {example}"
    )


def mass_of(track: Track) -> Expression:
    """The mass; 1 where the file gives none."""
    return ONE if track.mass is None else track.mass


def column_name(track: Track, axis: str) -> str:
    """The column of one component: `bob.x`."""
    return f"{track.name}.{axis}"


def components(found: tuple[Track, ...]) -> list[Column]:
    """The columns of all components."""
    return [
        Column(column_name(track, axis), formula)
        for track in found
        for axis, formula in zip(track.axes, track.position, strict=True)
    ]
