"""One run of a method: rows at the times asked for, events, and what was seen on the way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.events import Condition, Event, Watch
from lagcli.numerics.motion import Motion
from lagcli.numerics.steps import CannotGoOn, Method, Step, Tolerance
from lagcli.numerics.surface import Surface

Vector = list[Any]

#: Steps of one run: beyond this the answer would take minutes.
STEP_LIMIT = 200_000
#: Weyl's sequence of the golden ratio: places as even as can be, the same in every run.
_GOLDEN = 0.6180339887498949


class Run:
    """What came of one run.

    Attributes
    ----------
    times, states : list
        The rows: times, and (q, q') there.
    event : Event or None
        What stopped it.
    stop : CannotGoOn or None
        Why it could not go on.
    steps, evaluations : int
        The work.
    peaks : list of float
        The largest magnitude of each component.
    defect : float
        The largest error rate found inside a step, in units of the scale of a velocity.
    """

    def __init__(
        self,
        motion: Motion,
        method: Method,
        surface: Surface | None,
        tolerance: Tolerance,
        conditions: Sequence[Condition] = (),
    ) -> None:
        self.motion, self.method, self.surface = motion, method, surface
        self.tolerance = tolerance
        self._watch = Watch(conditions, self._state_in)
        self.times: list[float] = []
        self.states: list[tuple[Vector, Vector]] = []
        self.event: Event | None = None
        self.stop: CannotGoOn | None = None
        self.steps = 0
        self.defect = 0.0
        self._probes = 0
        self.step_limit = STEP_LIMIT

    @property
    def peaks(self) -> list[float]:
        """The largest magnitude of each component."""
        return self.tolerance.peaks

    @property
    def evaluations(self) -> int:
        """How often the accelerations were worked out."""
        return self.method.evaluations

    def go(
        self,
        q: Vector,
        v: Vector,
        times: Sequence[float],
        *,
        probe_every: int = 0,
        progress: Callable[[float], None] | None = None,
    ) -> Run:
        """Run through the times, of which the last is the end."""
        self._row(times[0], q, v)
        if self.surface is not None:
            self.surface.measure(0.0, q, v)
        self.event = self._watch.begin(q, v)
        if self.event is not None:
            return self
        pending = 1
        try:
            for step in self.method.steps(q, v, times[-1], self.tolerance):
                self.steps += 1
                if self.surface is not None:
                    self.surface.measure(step.end, step.q, step.v)
                    self.surface.note(step.end, step.q, step.v)
                self.event = self._watch.first(step) if self._watch.conditions else None
                end = step.end if self.event is None else self.event.t
                while pending < len(times) and times[pending] <= end:
                    self._row(times[pending], *self._state_in(step, times[pending]))
                    pending += 1
                if self.event is not None:
                    if self.times[-1] < end:
                        self._row(end, *self._state_in(step, end))
                    break
                if probe_every and self.steps % probe_every == 0:
                    self._probe(step)
                if progress is not None and self.steps % 64 == 0:
                    progress(step.end / times[-1])
                if self.steps >= self.step_limit:
                    reason = f"it takes more than {self.step_limit:,} steps"
                    self.stop = CannotGoOn(step.end, step.q, step.v, reason)
                    break
        except CannotGoOn as stop:
            self.stop = stop
        return self

    def _row(self, t: float, q: Vector, v: Vector) -> None:
        self.times.append(t)
        self.states.append((q, v))

    def _state_in(self, step: Step, t: float) -> tuple[Vector, Vector]:
        """The state at a time of the step, on the constraints."""
        if t >= step.end:
            return step.q, step.v
        q, v, _ = step.inside(t)
        if self.surface is not None:
            q, v = self.surface.project(t, q, v)
        return q, v

    def _probe(self, step: Step) -> None:
        """The defect q'' - f(t, q, q') of the dense output at a place that no stage knows."""
        self._probes += 1
        t = step.start + step.h * (self._probes * _GOLDEN % 1.0)
        q, v, slope = step.inside(t)
        try:
            rate = self.motion.accelerations(t, *q, *v)
        except (ArithmeticError, ValueError):
            self.defect = float("inf")
            return
        scales = self.tolerance.scales[self.motion.n :]
        for a, b, scale in zip(rate, slope, scales, strict=True):
            self.defect = max(self.defect, step.h * abs(float(a - b)) / scale)
