"""The frames of an animation: where the points are at each time, and what joins them.

A rod is drawn where the file says so (`picture`), and where two points keep their distance while
the line between them turns.  Between the origin and a point that is only a thin line: the file
does not state that there is a body.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, starmap

from lagcli.expression import Expression, Name
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.drawing import Piece, widened
from lagcli.pictures.forces import Arrow, arrows
from lagcli.pictures.points import AXES, mass_of, tracks
from lagcli.pictures.run import WITHOUT_BOUND, PicturedRun
from lagcli.pictures.surfaces import one_sided, surfaces
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.record import record, replace

Place = tuple[float, ...]

ORIGIN = "origin"
#: Distances that change by less than this part are constant; a line turns by more than this.
_CONSTANT, _TURNS = 1e-6, 1e-3
#: Radii of the heaviest and of the lightest point, in parts of the picture's width.
_LARGEST, _SMALLEST = 0.022, 0.011


@record(kw_only=True)
class Body:
    """A point: its places by frame, its radius beside the picture's width, its trail."""

    name: str
    places: tuple[Place, ...]
    radius: float
    trail: bool


@record(kw_only=True)
class Link:
    """What joins two bodies or places by name: a rod, a spring, or a thin line."""

    first: str
    second: str
    kind: str


@record(kw_only=True)
class Vector:
    """A force: the body it acts on, its components by frame, None where not determined."""

    name: str
    on: str
    values: tuple[Place | None, ...]


@record(kw_only=True)
class Happening:
    """An event with its time, in words."""

    t: float
    text: str


@record(kw_only=True)
class Scene:
    """All that an animation shows.

    Attributes
    ----------
    axes
        The axes in use, such as `xy`; places have as many components.
    times
        Of the frames, in the unit `unit` (empty where the file has none).
    bodies, places
        What moves as a point of the file, and the further places by frame.
    closed
        By contact, whether it acts, by frame.
    low, high
        The corners of what is shown.
    certain, until
        Until when the motion is certain, and until when it was to be.
    """

    title: str
    axes: str
    length: str
    times: tuple[float, ...]
    unit: str
    bodies: tuple[Body, ...]
    places: Mapping[str, tuple[Place, ...]]
    links: tuple[Link, ...]
    vectors: tuple[Vector, ...]
    surfaces: Mapping[str, tuple[Piece, ...]]
    closed: Mapping[str, tuple[bool, ...]]
    happenings: tuple[Happening, ...]
    low: Place
    high: Place
    certain: float
    until: float
    notes: tuple[str, ...]


def scene(
    problem: Problem, request: RunRequest, progress: Progress = None, *, forces: bool = False
) -> tuple[Scene, str]:
    """The animation of a motion, and why it ends early; empty where it does not.

    Raises
    ------
    CannotDraw
        Where the file does not state where its bodies are.
    """
    return _Maker(problem, request, progress, forces=forces).made()


class _Maker:
    def __init__(
        self, problem: Problem, request: RunRequest, progress: Progress, *, forces: bool
    ) -> None:
        self.problem = problem
        self.tracks = tracks(problem)
        self.axes = "".join(a for a in AXES if any(a in track.axes for track in self.tracks))
        self.arrows: tuple[Arrow, ...] = arrows(problem, self.tracks) if forces else ()
        #: what has a value in each frame: column name -> formula
        self.formulas: dict[str, Expression] = {}
        self._gather()
        columns = (Column("t", None), *starmap(Column, self.formulas.items()))
        self.run = PicturedRun(problem, replace(request, columns=columns), progress)
        self.rows = [row for piece in self.run.pieces for row in piece]

    def _gather(self) -> None:
        for track in self.tracks:
            self._vector(f"{track.name} at", track.position)
            self.formulas[f"{track.name} mass"] = mass_of(track)
        for name, position in self.problem.picture.places.items():
            self._vector(f"{name} at", position)
        for arrow in self.arrows:
            self._vector(f"{arrow.name} on {arrow.on}", arrow.components)
        for contact in self._one_sided():
            self.formulas[f"{contact[0]} force"] = contact[1]

    def _vector(self, name: str, components: Sequence[Expression]) -> None:
        for k, formula in enumerate(components):
            self.formulas[f"{name} {k}"] = formula

    def _one_sided(self) -> list[tuple[str, Expression]]:
        """The contacts and the force of each, which is 0 while it is open."""
        return [(c.name, Name(c.multiplier)) for c in one_sided(self.problem)]

    def _values(self, name: str) -> list[float | None]:
        place = self.run.names.index(name)
        return [row[place] for row in self.rows]

    def _vectors(self, name: str, axes: str) -> Iterator[Place | None]:
        """A vector in all axes of the picture; None where it is not defined."""
        given = [self._values(f"{name} {k}") for k in range(len(axes))]
        for values in zip(*given, strict=True):
            by_axis = dict(zip(axes, values, strict=True))
            place = tuple(by_axis.get(axis, 0.0) for axis in self.axes)
            defined = tuple(x for x in place if x is not None)
            yield defined if len(defined) == len(place) else None

    def _places(self, name: str, axes: str) -> tuple[Place, ...]:
        """The same of a place: what is not defined stays where it was."""
        last: Place = (0.0,) * len(self.axes)
        return tuple(last := place or last for place in self._vectors(name, axes))

    def made(self) -> tuple[Scene, str]:
        places = {track.name: self._places(f"{track.name} at", track.axes) for track in self.tracks}
        fixed = {
            name: self._places(f"{name} at", AXES[: len(position)])
            for name, position in self.problem.picture.places.items()
        }
        links = self._links(places, fixed)
        if any(ORIGIN in (link.first, link.second) for link in links):
            fixed[ORIGIN] = ((0.0,) * len(self.axes),) * len(self.rows)
        corners = [p for many in (*places.values(), *fixed.values()) for p in many]
        if self.run.is_cut_short:
            corners = _without_flight(corners)
        low, high = _corners(corners)
        labels = self.run.labels
        unit = labels.unit(None)
        length = labels.unit(self.tracks[0].position[0])
        held = self.run.result.certificate
        events = self.run.result.events
        return Scene(
            title=self.problem.title,
            axes=self.axes,
            length="" if length is None else str(length),
            times=tuple(row[0] or 0.0 for row in self.rows),
            unit="" if unit is None else str(unit),
            bodies=self._bodies(places),
            places=fixed,
            links=links,
            vectors=tuple(map(self._arrow, self.arrows)),
            surfaces=surfaces(self.problem, self.tracks, low, high),
            closed={
                name: tuple(bool(value) for value in self._values(f"{name} force"))
                for name, _ in self._one_sided()
            },
            happenings=tuple(
                Happening(t=e.t, text=f"{e.name}: {e.what}" if e.name != e.what else e.name)
                for e in events
            ),
            low=low,
            high=high,
            certain=held.holds_until,
            until=self.run.time_axis().high,
            notes=self.run.notes(),
        ), self.run.result.refusal

    def _bodies(self, places: Mapping[str, tuple[Place, ...]]) -> tuple[Body, ...]:
        masses = {t.name: abs(self._values(f"{t.name} mass")[0] or 0.0) for t in self.tracks}
        heaviest = max(masses.values()) or 1.0
        trails = self.problem.picture.trails
        return tuple(
            Body(
                name=name,
                places=many,
                radius=max(_SMALLEST, _LARGEST * math.cbrt(masses[name] / heaviest)),
                trail=trails is None or name in trails,
            )
            for name, many in places.items()
        )

    def _arrow(self, arrow: Arrow) -> Vector:
        name = f"{arrow.name} on {arrow.on}"
        track = next(track for track in self.tracks if track.name == arrow.on)
        return Vector(name=arrow.name, on=arrow.on, values=tuple(self._vectors(name, track.axes)))

    def _links(
        self, places: Mapping[str, tuple[Place, ...]], fixed: Mapping[str, tuple[Place, ...]]
    ) -> tuple[Link, ...]:
        given = self.problem.picture
        links = [Link(first=a, second=b, kind="rod") for a, b in given.rods]
        links += [Link(first=a, second=b, kind="spring") for a, b in given.springs]
        if links:
            return tuple(links)
        found = [
            Link(first=a, second=b, kind="rod")
            for a, b in combinations((*places, *fixed), 2)
            if (a in places or b in places)
            and _is_rigid(_of(a, places, fixed), _of(b, places, fixed))
        ]
        if not self._one_sided() and len(self.axes) > 1:
            middle = ((0.0,) * len(self.axes),) * len(self.rows)
            found += [
                Link(first=ORIGIN, second=name, kind="line")
                for name, many in places.items()
                if _is_rigid(middle, many)
            ]
        return tuple(found)


def _of(
    name: str, places: Mapping[str, tuple[Place, ...]], fixed: Mapping[str, tuple[Place, ...]]
) -> tuple[Place, ...]:
    return places[name] if name in places else fixed[name]


def _is_rigid(first: Sequence[Place], second: Sequence[Place]) -> bool:
    """Whether the distance stays and the direction does not."""
    lines = [
        tuple(b - a for a, b in zip(p, q, strict=True)) for p, q in zip(first, second, strict=True)
    ]
    lengths = [math.hypot(*line) for line in lines]
    length = lengths[0]
    if not length or any(abs(other - length) > _CONSTANT * length for other in lengths):
        return False
    start = lines[0]
    return any(math.dist(line, start) > _TURNS * length for line in lines)


def _without_flight(places: Sequence[Place]) -> list[Place]:
    """Without what is so far away that the rest would not be seen beside it."""
    sizes = sorted(math.hypot(*place) for place in places)
    usual = sizes[int(0.95 * (len(sizes) - 1))]
    if not sizes[-1] > WITHOUT_BOUND * usual > 0:
        return list(places)
    return [place for place in places if math.hypot(*place) <= 3 * usual]


def _corners(places: Iterable[Place]) -> tuple[Place, Place]:
    """The least box with room around; as wide as a quarter of its length at least."""
    spans = [(min(values), max(values)) for values in zip(*places, strict=True)]
    low, high = zip(*widened(spans, 0.3, 0.1), strict=True)
    return low, high
