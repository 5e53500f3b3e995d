"""The rows of a proof: enclosures of the columns at the times that are written, and its events."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.rigorous.enclosure import NotEnclosed
from lagcli.numerics.rigorous.modes import ProofMode
from lagcli.numerics.rigorous.piece import Piece
from lagcli.numerics.rigorous.result import Enclosure, ProvedEvent

#: Impacts that come sooner and sooner are taken to accumulate.
_SOONER = 8


class Rows:
    """What is enclosed so far.

    Parameters
    ----------
    setup : Setup
    arithmetic : Balls

    Attributes
    ----------
    times : list of arb
        Of all rows.
    found : list of tuples of arb
        Those that are enclosed.
    events : list of ProvedEvent
    """

    def __init__(self, setup: Setup, arithmetic: Any) -> None:
        self.setup, self.request = setup, setup.request
        self.arithmetic, self.ball = arithmetic, arithmetic.ball
        self.found: list[Enclosure] = []
        self.events: list[ProvedEvent] = []
        #: as exactly as they are written
        self.times = setup.written_times(arithmetic)

    @property
    def complete(self) -> bool:
        """Whether none is lacking."""
        return len(self.found) == len(self.times)

    def end_at(self, t: Any) -> None:
        """Let the next row be the last one."""
        self.times[len(self.found) :] = [t]

    def good(self) -> tuple[int, float]:
        """How many are as thin as requested, and by how much the next one is wider; see `_good`."""
        return _good(self.found, self.request.accuracy)

    def impacts_accumulate(self) -> bool:
        """Whether the last ones come sooner and sooner."""
        times = [float(event.t) for event in self.events if event.what == "impact"][-_SOONER:]
        between = [b - a for a, b in pairwise(times)]
        return len(times) == _SOONER and all(b < a for a, b in pairwise(between))

    def happened(self, t: Any, name: str, what: str, mode: ProofMode, x: Sequence[Any]) -> None:
        """An event, with the columns just before it."""
        columns = [column.name for column in self.request.columns]
        before = dict(zip(columns, self._values(mode, t, x), strict=True))
        self.events.append(ProvedEvent(t, name, what, before))

    def within(self, tau: Any, *sides: tuple[ProofMode, Sequence[Any]]) -> None:
        """Rows within the enclosure of the time of an event: None in columns that jump."""
        while not self.complete and not self.times[len(self.found)] > tau:
            t = self.times[len(self.found)]
            if not tau.contains(t):
                raise NotEnclosed(f"whether t = {float(t):.6g} is before an event is not decided")
            before, after = (self._values(mode, t, x) for mode, x in sides)
            self.found.append(tuple(map(_joined, before, after)))

    def over(self, piece: Piece, mode: ProofMode, event: Any) -> None:
        """Those of a step, up to the time of an event in it, or all of them where that is None."""
        until = piece.end if event is None else event.lower()
        while not self.complete:
            t = self.times[len(self.found)]
            if t > until or (event is not None and not t < until):
                return
            self.take(mode, t, piece.at(t))

    def take(self, mode: ProofMode, t: Any, x: Sequence[Any]) -> None:
        """One row."""
        self.found.append(tuple(self._values(mode, t, x)))

    def _values(self, mode: ProofMode, t: Any, x: Sequence[Any]) -> list[Any]:
        n = mode.motion.n
        found = mode.values(t, list(x[:n]), list(x[n:]))
        return [None if value is None else self.ball(value) for value in found]


def _joined(before: Any, after: Any) -> Any:
    """What contains both sides of an event; None where they are apart."""
    if before is None or after is None or not before.overlaps(after):
        return None
    return before.union(after)


def _good(rows: Sequence[Enclosure], accuracy: float) -> tuple[int, float]:
    """How many rows are as thin as requested, beside the largest magnitude of their column.

    A column whose enclosures all contain 0 is compared with the largest of the others.  The second
    number is by how much the first row that is wider exceeds that; 0 where there is none.
    """
    scales: list[float] = []
    for good, row in enumerate(rows):
        sizes = [0.0 if x is None else float(x.abs_lower()) for x in row]
        scales = [max(pair) for pair in zip(sizes, scales or sizes, strict=True)]
        largest = max(scales[1:], default=0.0) or 1.0
        for x, scale in zip(row[1:], scales[1:], strict=True):
            allowed = accuracy * (scale or largest)
            if x is not None and not (x.is_finite() and _radius(x) <= allowed):
                return good, _radius(x) / allowed
    return len(rows), 0.0


def _radius(x: Any) -> float:
    found = float(x.rad())
    return found if math.isfinite(found) else math.inf
