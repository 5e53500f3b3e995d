"""The motion that a picture shows: rows with a break at each event, and how far they are certain.

An impact changes velocities at once.  The columns just before and just after it end one piece
of the motion and begin the next, so that no line is drawn between them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.hybrid.events import Event
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.pictures.drawing import (
    Axis,
    Band,
    Curve,
    Item,
    Marks,
    Piece,
    Point,
    Rule,
    extent,
    unbroken,
    words,
)
from lagcli.pictures.labels import Labels
from lagcli.pictures.turning import all_wrapped
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.record import replace

Values = tuple[float | None, ...]

#: Beside 95 % of the values; what is cut short is rarely so large for another reason.
WITHOUT_BOUND = 20.0


class PicturedRun:
    """One motion with its columns; the first is the time.

    Parameters
    ----------
    result : Result, optional
        The motion, where it is known already.
    """

    def __init__(
        self,
        problem: Problem,
        request: RunRequest,
        progress: Progress = None,
        result: Result | None = None,
    ) -> None:
        self.problem, self.request = problem, request
        self.result: Result = simulate(problem, request, progress) if result is None else result
        self.names = self.result.columns
        self.labels = Labels(problem)

    @property
    def columns(self) -> tuple[Column, ...]:
        """Without the time."""
        return self.request.columns[1:]

    @cached_property
    def pieces(self) -> tuple[tuple[Values, ...], ...]:
        """The rows from one event that changes something to the next."""
        pieces: list[list[Values]] = [[]]
        events = [event for event in self.result.events if event.before]
        for row in self.result.rows:
            while events and events[0].t <= (row[0] or 0.0):
                _break(pieces, events.pop(0), self.names)
            pieces[-1].append(row)
        for event in events:
            _break(pieces, event, self.names)
        return tuple(tuple(piece) for piece in pieces if piece)

    def curve(self, x: int, y: int) -> tuple[Piece, ...]:
        """Column y over column x, in pieces; what is not defined breaks the line."""

        def point(row: Values) -> Point | None:
            a, b = row[x], row[y]
            return None if a is None or b is None else (a, b)

        return tuple(line for piece in self.pieces for line in unbroken(map(point, piece)))

    def in_the_plane(self, *, turns: bool = False, named: bool = True) -> list[Item]:
        """The second column over the first, and where it begins; `turns`: over an angle."""
        pieces = self.curve(1, 2)
        if not pieces:
            return []
        if turns:
            pieces = all_wrapped(pieces)
        label = words("motion") if named else None
        return [
            Curve(pieces=pieces, role="motion", label=label),
            Marks(points=pieces[0][:1], role="start", label=words("start")),
        ]

    def values(self, column: int) -> list[float]:
        """All values of a column that are defined."""
        return [x for piece in self.pieces for row in piece if (x := row[column]) is not None]

    def shown(self, columns: Sequence[int]) -> tuple[float, float]:
        """The extent of columns; of what grows without bound as much as leaves the rest visible."""
        values = [value for column in columns for value in self.values(column)]
        sizes = sorted(map(abs, values))
        usual = sizes[int(0.95 * (len(sizes) - 1))]
        if self.is_cut_short and sizes[-1] > WITHOUT_BOUND * usual > 0:
            values = [value for value in values if abs(value) <= 3 * usual]
        return extent(values)

    @property
    def certain_until(self) -> float:
        """Where the certificate ends."""
        return self.result.certificate.holds_until

    @property
    def is_cut_short(self) -> bool:
        """Whether the certificate ends before the requested time."""
        return not self.result.certificate.reached

    def time_axis(self) -> Axis:
        """From 0 to the requested end, or to where an event has stopped the run."""
        end = (
            self.request.until
            if self.is_cut_short
            else (self.values(0) or [self.request.until])[-1]
        )
        return Axis(label=self.labels.axis(None), low=0.0, high=end or self.request.until)

    def over_time(self, *, named: bool = True) -> list[Item]:
        """Events and the end of the certificate, for a panel whose x is the time."""
        items: list[Item] = list(event_rules(self.result.events, named=named))
        if self.is_cut_short and self.certain_until < self.request.until:
            items.append(
                Rule(
                    at=self.certain_until,
                    of="x",
                    role="certificate",
                    label=words("end of the certificate") if named else None,
                )
            )
            items.append(Band(low=self.certain_until, high=self.request.until))
        return items

    def notes(self) -> tuple[str, ...]:
        """What the picture cannot show: the accuracy, and why it ends."""
        held = self.result.certificate
        bound = max(held.global_error.values(), default=0.0)
        if held.reached and not bound:
            return (f"No error found in two runs; requested: {short(held.accuracy)}.",)
        if held.reached:
            return (f"Global error below {_above(bound)}; requested: {short(held.accuracy)}.",)
        until = f"Certified to {short(held.accuracy)} until t = {held.holds_until:.6g}"
        return (f"{until}; nothing is drawn beyond.",)


def short(value: float) -> str:
    """Two digits: `1.2e-14`, `1e-9`."""
    mantissa, _, exponent = f"{value:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}" if value else "0"


def _above(bound: float) -> str:
    """The next power of ten: more of a bound nobody needs to know."""
    return f"1e{math.floor(math.log10(bound)) + 1}"


def _break(pieces: list[list[Values]], event: Event, names: Sequence[str]) -> None:
    """End the last piece before an event and begin another after it."""
    pieces[-1].append(_row(event.t, event.before, names))
    pieces.append([_row(event.t, event.after, names)] if event.after else [])


def _row(t: float, values: object, names: Sequence[str]) -> Values:
    assert hasattr(values, "get")
    return (t, *(values.get(name) for name in names[1:]))


def event_rules(events: Sequence[Event], *, named: bool) -> list[Rule]:
    """A line at each event; the key has each kind of event once, by its colour."""
    kinds: dict[str, int] = {}
    found = []
    for event in events:
        if event.name in {"singularity", "grazes"}:  # where the certificate ends
            continue
        kind = f"{event.name}: {event.what}" if event.name != event.what else event.name
        colour = kinds.setdefault(kind, len(kinds))
        label = words(kind) if named else None
        found.append(Rule(at=event.t, of="x", role="event", colour=colour, label=label))
    return found


def largest_so_far(pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
    """For each time the largest value up to it."""
    largest = -math.inf
    found = []
    for piece in pieces:
        line = []
        for t, value in piece:
            largest = max(largest, value)
            line.append((t, largest))
        found.append(tuple(line))
    return tuple(found)


def run_with(
    problem: Problem,
    request: RunRequest,
    columns: Sequence[Column],
    progress: Progress = None,
    **changed: object,
) -> PicturedRun:
    """A run with other columns than the requested ones; the time is added."""
    return PicturedRun(
        problem, replace(request, columns=(Column("t", None), *columns), **changed), progress
    )
