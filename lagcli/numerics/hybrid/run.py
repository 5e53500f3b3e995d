"""One run of a method: rows at the requested times, events, and what was seen on the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import groupby
from operator import attrgetter
from typing import Any

from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.events import Condition, Event, Occurrence, Watch
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Mode
from lagcli.numerics.hybrid.request import Progress
from lagcli.numerics.hybrid.transitions import Transitions, Turn
from lagcli.numerics.integrators.sight import seen_steps
from lagcli.numerics.integrators.steps import (
    SMALL,
    CannotGoOn,
    Method,
    Step,
    StopWithReason,
    Stretch,
    Tolerance,
    component_scales,
)
from lagcli.numerics.integrators.switching import displaced, lateness, later
from lagcli.record import record, replace

Vector = list[Any]

#: Steps of one run: beyond this the answer would take minutes.
STEP_LIMIT = 200_000
#: Weyl's sequence of the golden ratio: places as even as can be, the same in every run.
_GOLDEN = 0.6180339887498949
_EPSILON = 2.2e-16
#: A row so soon after an event is before it, whatever the accuracy: who asks for 1e-2 does
#: not want the ball below its floor for so long.
_COINCIDES = 1e-9
#: A step that is a larger part of the span is looked at in pieces.
_WINDOWS = 200
#: So many changes of mode at one time are an end.
_AT_ONCE = 20
#: The first of this number of parts of the rows; growth by this factor is another scale there.
_BEGINNING, _GROWN = 20, 1e3
#: A part of the span over which the rate of a margin is found.
_RATE_OVER = 1e-7


@record
class Phase:
    """A stretch of time in one mode."""

    mode: Mode
    surface: Surface | None
    begin: float


class Run:
    """What came of one run.

    Attributes
    ----------
    marks : list of Mark
        The rows.
    phases : list of Phase
        The modes gone through.
    events : list of (phase, Event)
        What happened at the end of which phase (-1: at the very beginning).
    event : Event or None
        What stopped it.
    stop : CannotGoOn or None
        Why it could not go on.
    steps, evaluations : int
        The work.
    apart : tuple of tuple of str
        The coordinates of each subsystem that took steps of its own.
    peaks : list of float
        The largest magnitude of each component.
    defect : float
        The largest error rate found inside a step, in units of the scale of a velocity.
    """

    def __init__(
        self, transitions: Transitions, tolerance: Tolerance, allowed: float = 0.0
    ) -> None:
        self.transitions = transitions
        self.tolerance = tolerance
        self._allowed = allowed
        self.marks: list[Mark] = []
        self.phases: list[Phase] = []
        self.events: list[tuple[int, Event]] = []
        self.event: Event | None = None
        self.stop: CannotGoOn | None = None
        #: makes the same run once more, with rows at these times
        self.again: Callable[[Sequence[float]], Run] = lambda _: self
        self.steps = 0
        self.defect = 0.0
        #: where the steps are shortest
        self.narrowest: Mark | None = None
        #: steps that would have passed over something narrow
        self.shortened = 0
        self.evaluations = 0
        self.method_name = ""
        self.apart: tuple[tuple[str, ...], ...] = ()
        self._probes = 0
        self.step_limit = STEP_LIMIT
        self._changes: list[float] = []

    @property
    def peaks(self) -> list[float]:
        """The largest magnitude of each component."""
        return self.tolerance.peaks

    @property
    def scales(self) -> list[float]:
        """The peaks; of a coordinate that grows with its velocity, those of the beginning."""
        marks = self.marks[: max(2, len(self.marks) // _BEGINNING)]
        columns = zip(*((*mark.q, *mark.v) for mark in marks), strict=True)
        first = [max(abs(float(x)) for x in column) for column in columns]
        grown = [peak > _GROWN * a > 0 for a, peak in zip(first, self.peaks, strict=True)]
        n = len(grown) // 2
        both = [a and b for a, b in zip(grown[:n], grown[n:], strict=True)] * 2
        return [a if g else peak for a, peak, g in zip(first, self.peaks, both, strict=True)]

    @property
    def times(self) -> list[float]:
        """Of the rows."""
        return [mark.t for mark in self.marks]

    def rows(self) -> list[list[Any]]:
        """The columns and charges at the marks."""
        found: list[list[Any]] = []
        for phase, marks in groupby(self.marks, key=attrgetter("phase")):
            found += self.phases[phase].mode.tabulate.along([mark[:3] for mark in marks])
        return found

    def go(
        self,
        q: Vector,
        v: Vector,
        times: Sequence[float],
        *,
        probe_every: int = 0,
        progress: Progress = None,
    ) -> Run:
        """Run through the times, of which the last is the end."""
        self._times, self._pending = times, 0
        # here, since they refer to the run: one in machine code is freed when it is done with
        self.transitions.rounding = self._rounding
        self.transitions.moved = self.tolerance.moved * self.tolerance.unit
        self._watch = Watch(self._state_in, self._errors, self._rounding)
        self._watch.window = times[-1] / _WINDOWS
        self._probe_every, self._progress = probe_every, progress
        t = float(times[0])
        try:
            turn = self.transitions.begin(q, v)
            while True:
                self._note(turn, t)
                if turn.mode is None:
                    break
                t, following = self._phase(turn, t)
                if following is None:
                    break
                turn = following
        except CannotGoOn as stop:
            self.stop = stop
        return self

    def _note(self, turn: Turn, t: float) -> None:
        """The events of a turn, and the state after it."""
        last = len(self.phases) - 1
        self.events += [(last, event) for event in turn.events]
        if turn.mode is None:
            self.event = turn.events[-1]
            if last < 0:
                first = self.transitions.modes.first
                self.phases.append(Phase(first, first.surface(), t))
                self.marks.append(Mark(t, turn.q, turn.v, 0, 0))
            return
        if last >= 0:
            self._changes.append(t)
            recent = self._changes[-_AT_ONCE:]
            if len(recent) == _AT_ONCE and recent[0] == t:
                reason = "event follows event without time passing"
                raise StopWithReason(t, turn.q, turn.v, reason)
        surface = turn.mode.surface()
        if surface is not None:
            surface.measure(t, turn.q, turn.v)
        self.phases.append(Phase(turn.mode, surface, t))
        if last >= 0:
            state = turn.right_after or (turn.q, turn.v)
            self.marks.append(Mark(t, *state, last + 1, begins=True))

    def _phase(self, turn: Turn, t: float) -> tuple[float, Turn | None]:
        """Go on in one mode up to what ends it; None at the end of the run."""
        mode, q, v = turn.mode, turn.q, turn.v
        assert mode is not None
        times = self._times
        if self._pending == 0:
            self._mark(t, q, v)
        due, skipped = turn.due if turn.due is not None else (times[-1], -1)
        conditions = [c for c in mode.conditions if c.kind != "gap" or c.index != skipped]
        found = self._watch.begin(conditions, t, q, v, turn.touched)
        if found is not None:
            return t, self._turned(mode, found, q, v)
        method = mode.method(self.phases[-1].surface)
        self.method_name = method.name
        before = self.evaluations
        for step in self._steps(method, turn, due, t):
            self.evaluations = before + method.evaluations
            q, v, t = step.q, step.v, step.end
            self._see(step)
            found = self._watch.first(step)
            if found is not None and not found.touches:
                found = replace(found, t=later(self.tolerance, found.t, step.end))
            end = t if found is None else found.t
            self._mark_until(step, end)
            if found is not None:
                following, sides = self._following(mode, found, *self._state_in(step, end))
                if following.mode is not None:  # a sample that nobody can tell from it: before it
                    self._mark_until(step, end * (1 + min(self._allowed, _COINCIDES)))
                self._end(end, *sides)
                return end, following
            self._look(step)
        if method.reached is not None:
            self._end(t, q, v)
            return t, self.transitions.sticks(mode, t, method.reached, q, v)
        if skipped >= 0:
            self._end(t, q, v)
            return t, self.transitions.closes(mode, t, skipped, q, v)
        return t, None

    def _following(
        self, mode: Mode, found: Occurrence, q: Vector, v: Vector
    ) -> tuple[Turn, tuple[Vector, Vector]]:
        """What follows an occurrence, as if it had been met at the time itself; the state before.

        Doubles find the margin u of a contact u/u' late: the state goes back by that time
        before what happens, and forth by it after.  A run that is moved finds it later, and has
        what the rounding of the state makes of that time.
        """
        condition, t = found.condition, found.t
        late = 0.0 if found.touches else self._lateness(mode, condition, t, q, v)
        if condition.kind not in {"gap", "loss"} or not late:
            return self.transitions.after(mode, found, q, v), (q, v)
        resolves = not mode.motion.arithmetic.ordered
        before = moved_state(mode, t, q, v, -late)
        if resolves:  # the time, as doubles do not
            found = replace(found, t=Fraction(t) - Fraction(late))
        following = self.transitions.after(mode, found, *before)
        events = tuple(replace(event, t=float(event.t)) for event in following.events)
        following = replace(following, events=events)
        if following.mode is None:
            return replace(following, q=q, v=v), (q, v)
        after = following.q, following.v
        moved = moved_state(following.mode, t, *after, late)
        following = replace(following, q=moved[0], v=moved[1])
        if resolves:
            return replace(following, right_after=after), before
        return following, (q, v)

    def _lateness(self, mode: Mode, condition: Condition, t: float, q: Vector, v: Vector) -> float:
        def at(time: float) -> float:
            return float(condition.margin(t + time, *moved_state(mode, t, q, v, time)))

        h = _RATE_OVER * self._times[-1]
        try:
            rate = (at(h) - at(-h)) / (2 * h)
            late = lateness(t, condition.exactly(t, q, v), rate)
            noise = self._watch.felt(condition, t, q, v, self._rounding_since(t, q, v))
            late += displaced(self.tolerance, t, len(self.events), noise, rate)
        except (ArithmeticError, ValueError):
            return 0.0
        return late

    def _steps(self, method: Method, turn: Turn, until: float, begin: float) -> Iterator[Step]:
        """The steps of a phase; none is longer than what a bounce takes to its highest point."""
        q, v = turn.q, turn.v
        if turn.apex < min(until, begin + self.tolerance.longest):
            for step in self._seen(method, Stretch(q, v, turn.apex, begin)):
                q, v, begin = step.q, step.v, step.end
                yield step
            if method.reached is not None:
                return
        if begin < until:
            yield from self._seen(method, Stretch(q, v, until, begin))

    def _seen(self, method: Method, stretch: Stretch) -> Iterator[Step]:
        """Steps that pass over nothing."""
        if method.sees:
            return method.steps(stretch, self.tolerance)
        sight = self.phases[-1].mode.sight
        return seen_steps(method, sight, stretch, self.tolerance, self._shorter)

    def _shorter(self) -> None:
        self.shortened += 1

    def _turned(self, mode: Mode, found: Occurrence, q: Vector, v: Vector) -> Turn:
        self._end(found.t, q, v)
        return self.transitions.after(mode, found, q, v)

    def _mark_until(self, step: Step, end: float) -> None:
        """The requested times, up to one."""
        times = self._times
        while self._pending < len(times) and times[self._pending] <= end:
            at = times[self._pending]
            self._mark(at, *self._state_in(step, at))

    def _mark(self, t: float, q: Vector, v: Vector) -> None:
        """The next of the requested times."""
        self.marks.append(Mark(float(t), q, v, len(self.phases) - 1, self._pending))
        self._pending += 1

    def _end(self, t: float, q: Vector, v: Vector) -> None:
        self.marks.append(Mark(t, q, v, len(self.phases) - 1))

    def _see(self, step: Step) -> None:
        self.steps += 1
        surface = self.phases[-1].surface
        if surface is not None:
            surface.measure(step.end, step.q, step.v)
            surface.note(step.end, step.q, step.v)

    def _look(self, step: Step) -> None:
        """Probe the defect, tell the progress, stop where it takes too long."""
        if self._probe_every and self.steps % self._probe_every == 0:
            self._probe(step)
        if self._progress is not None and self.steps % 64 == 0:
            self._progress(step.end / self._times[-1])
        if self.steps >= self.step_limit:
            reason = f"it takes more than {self.step_limit:,} steps"
            raise StopWithReason(step.end, step.q, step.v, reason)

    def _errors(self) -> list[float]:
        """What each component may err by."""
        return [self._allowed * each for each in component_scales(self.peaks, self._times[-1])]

    def _rounding(self, t: float) -> list[float]:
        """Of each component: of its size, and of the time in which it changes."""
        peaks = self.peaks
        n = len(peaks) // 2
        return [
            _EPSILON * (max(peak, t * peaks[n + j]) if j < n else peak)
            for j, peak in enumerate(peaks)
        ]

    def _rounding_since(self, t: float, q: Vector, v: Vector) -> list[float]:
        """Of each component, of its size since the last event: low bounces are rounded less."""
        time = t - self.phases[-1].begin
        sizes = [*(abs(x) + time * abs(u) for x, u in zip(q, v, strict=True)), *map(abs, v)]
        return [_EPSILON * min(pair) for pair in zip(sizes, self.peaks, strict=True)]

    def _state_in(self, step: Step, t: float) -> tuple[Vector, Vector]:
        """The state at a time of the step, on the constraints."""
        if t >= step.end:
            return step.q, step.v
        q, v, _ = step.inside(t)
        surface = self.phases[-1].surface
        if surface is not None:
            q, v = surface.project(t, q, v)
        return q, v

    def _probe(self, step: Step) -> None:
        """The defect q'' - f(t, q, q') of the dense output at a place that no stage knows."""
        self._probes += 1
        t = step.start + step.h * (self._probes * _GOLDEN % 1.0)
        try:
            q, v, slope = (step.probe or step.inside)(t)
            rate = self.phases[-1].mode.motion.accelerations(t, *q, *v)
        except (ArithmeticError, ValueError):
            self.defect = float("inf")
            return
        scales = self.tolerance.scales[len(q) :]
        least = SMALL * max(scales, default=0.0)
        for a, b, scale in zip(rate, slope, scales, strict=True):
            self.defect = max(self.defect, step.h * abs(float(a - b)) / max(least, scale))


def moved_state(mode: Mode, t: float, q: Vector, v: Vector, time: Any) -> tuple[Vector, Vector]:
    """The state a time later that is nothing beside the motion's own."""
    rates = mode.motion.accelerations(t, *q, *v)
    half = time / 2
    places = [x + time * (u + half * a) for x, u, a in zip(q, v, rates, strict=True)]
    return places, [u + time * a for u, a in zip(v, rates, strict=True)]
