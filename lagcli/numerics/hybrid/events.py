"""Where along the motion something happens: a contact is lost or closes, `--stop-when`.

A condition is a margin that is not negative while it holds.  Each step is looked at in
several places, so that a margin that dips below 0 and comes back is seen; where it comes
near without being seen below, its least value within the step is sought.  A least value
that nobody can tell from 0, because errors as large as the accuracy change it as much, is
a touch: a root of even multiplicity.

A margin that begins at 0 (a contact that has just been left) counts from where it has
risen above rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

from lagcli.numerics.hybrid.extrema import crossing, least, lowest_of
from lagcli.numerics.integrators.steps import Step
from lagcli.record import field, record

Vector = Sequence[Any]
Margin = Callable[[float, Vector, Vector], float]
State = tuple[list[Any], list[Any]]
#: stop: `--stop-when`; loss, gap: of a contact; slip: of what friction holds.
Kind = Literal["stop", "loss", "gap", "slip"]

_PLACES = (0.25, 0.5, 0.75, 1.0)
#: A margin whose polynomial falls below this part of its variation is looked at closely.
_NEAR = 0.1
#: Margins within this multiple of the rounding of the state are 0.
_ROUNDINGS = 100.0
_NUDGE = 1e-6
#: Within this part of a step two things happen together: stopping comes first.
_TOGETHER = 1e-9


@record
class Event:
    """What happened, and when.

    Attributes
    ----------
    error
        Of the time, as measured by the two runs.
    energy_lost
        By an impact.
    before, after : mapping
        The columns on both sides, where the motion goes on.
    """

    t: float
    name: str
    what: str
    error: float = 0.0
    energy_lost: float | None = None
    before: Mapping[str, float | None] = field(default_factory=dict)
    after: Mapping[str, float | None] = field(default_factory=dict)


@record
class Condition:
    """Holds while its margin is >= 0.

    Attributes
    ----------
    index
        Of the constraint or kink that it is about.
    two_sided
        Whether it is the change of sign that counts, from whichever side.
    """

    name: str
    what: str
    margin: Margin
    kind: Kind = "stop"
    index: int = -1
    two_sided: bool = False
    exact_margin: Margin | None = None

    def exactly(self, t: float, q: Vector, v: Vector) -> float:
        """The margin of a state that is taken as exact, where its formula allows that."""
        return float((self.exact_margin or self.margin)(t, q, v))


@record
class Occurrence:
    """A condition that fails, or only touches 0."""

    t: float
    condition: Condition
    touches: bool = False
    band: float = 0.0  # a margin as near to 0 as this is not told from it


class Watch:
    """Looks at the conditions step by step.

    Parameters
    ----------
    state_at
        The state inside a step, on the constraints.
    allowed
        The error that each component may have, at any time.
    rounding
        That of each component at a time.
    """

    def __init__(
        self,
        state_at: Callable[[Step, float], State],
        allowed: Callable[[], Sequence[float]],
        rounding: Callable[[float], Sequence[float]],
    ) -> None:
        self._state_at, self._allowed, self._rounding = state_at, allowed, rounding
        #: what is looked at in a few places is no longer than this
        self.window = math.inf
        self.conditions: Sequence[Condition] = ()
        self._before: list[float] = []
        self._noise: list[float] = []
        self._armed: list[bool] = []
        self._falling: list[bool] = []
        self._sign: dict[str, float] = {}

    def begin(
        self,
        conditions: Sequence[Condition],
        t: float,
        q: Vector,
        v: Vector,
        touched: Occurrence | None = None,
    ) -> Occurrence | None:
        """Look at other conditions from here on; one that does not even hold here.

        `touched` is what has just been at 0 and counts from where it has risen again.
        """
        self.conditions = conditions
        self._before, self._noise, self._armed = [], [], []
        self._falling = [False] * len(conditions)
        failed = None
        rounding = self._rounding(t)
        for condition in conditions:
            raw = float(condition.margin(t, q, v))
            noise = _ROUNDINGS * self.felt(condition, t, q, v, rounding)
            if touched is not None and touched.condition.name == condition.name:
                noise = max(noise, touched.band)
            if condition.two_sided and condition.name not in self._sign and abs(raw) > noise:
                self._choose(condition, raw)
            value = self._value(condition, raw)
            self._before.append(value)
            self._noise.append(noise)
            self._armed.append(value > noise)
            if value < -noise and failed is None:
                failed = Occurrence(t, condition)
        return failed

    def _choose(self, condition: Condition, value: float) -> None:
        """The side from which a condition is looked at: where it is found first."""
        self._sign[condition.name] = 1.0 if value > 0 else -1.0

    def _value(self, condition: Condition, margin: float) -> float:
        return self._sign.get(condition.name, 1.0) * float(margin)

    def first(self, step: Step) -> Occurrence | None:
        """The first condition that fails or touches within a step."""
        if not self.conditions:
            return None
        # a series takes long steps: it is looked at as closely as short ones
        count = max(1, math.ceil(step.h / self.window))
        for k in range(count):
            part = step if count == 1 else self._part(step, k, count)
            found = self._first(part)
            if found is not None:
                return found
        return None

    def _part(self, step: Step, k: int, count: int) -> Step:
        start, end = step.start + step.h * k / count, step.start + step.h * (k + 1) / count
        end = step.end if k == count - 1 else end
        return Step(start, end - start, end, *self._state_at(step, end), step.inside)

    def _first(self, step: Step) -> Occurrence | None:
        states: dict[float, tuple[float, State]] = {0.0: (step.start, ([], []))}
        for x in _PLACES:
            t = step.end if x == 1 else step.start + x * step.h
            states[x] = (t, (step.q, step.v) if x == 1 else self._state_at(step, t))
        found = []
        for k, condition in enumerate(self.conditions):
            occurrence = self._look(k, condition, step, states)
            if occurrence is not None:
                found.append(occurrence)
        if not found:
            return None
        earliest = min(found, key=lambda one: one.t)
        limit = earliest.t + _TOGETHER * step.h
        return min(
            (one for one in found if one.t <= limit),
            key=lambda one: (one.touches, one.condition.kind != "stop", one.t),
        )

    def _look(
        self, k: int, condition: Condition, step: Step, states: Mapping[float, tuple[float, State]]
    ) -> Occurrence | None:
        def at(x: float) -> float:
            if x in states and x > 0:
                t, (q, v) = states[x]
            else:
                t = step.start + x * step.h
                q, v = self._state_at(step, t)
            return self._value(condition, condition.margin(t, q, v))

        places, values = [0.0], [self._before[k]]
        armed, noise = self._armed[k], self._noise[k]
        risen = 0  # from here on it counts
        for x in _PLACES:
            value = at(x)
            if not armed and abs(value) > noise and condition.two_sided:
                if condition.name not in self._sign:
                    self._choose(condition, value)
                    value = abs(value)
                armed, risen = True, len(places)
            if value < (0.0 if armed else -noise):
                start = places[-1]
                if not armed:
                    return Occurrence(step.start + start * step.h, condition)
                found = crossing(at, start, x, values[-1], value)
                return self._failed(condition, step, at, found)
            if not armed and value > noise:
                armed = True
                risen = len(places)
            places.append(x)
            values.append(value)
        self._before[k], self._armed[k] = values[-1], armed
        if not armed:
            return None
        return self._dip(k, condition, step, at, places[risen:], values[risen:])

    def _failed(
        self, condition: Condition, step: Step, at: Callable[[float], float], x: float
    ) -> Occurrence:
        """It fails at x, unless it comes back before anybody can tell it from a touch."""
        high = min(1.0, x + 0.25)
        if high > x and at(high) > 0:
            place, value = least(at, x, high)
            band = self._band(condition, step, place)
            if abs(value) <= band:
                # a gap may have closed as soon as it is 0
                place = x if condition.kind == "gap" else place
                return Occurrence(step.start + place * step.h, condition, True, band)
        return Occurrence(step.start + x * step.h, condition)

    def _dip(
        self,
        k: int,
        condition: Condition,
        step: Step,
        at: Callable[[float], float],
        places: Sequence[float],
        values: Sequence[float],
    ) -> Occurrence | None:
        """Whether it dips to 0 between the places."""
        was_falling = self._falling[k]
        self._falling[k] = len(values) > 1 and values[-1] < values[-2]
        if len(values) < 3:
            return None
        spread = max(values) - min(values)
        if not min(values) < spread < math.inf:
            return None
        x = lowest_of(places, values)
        low, high = places[0], places[-1]
        if x == high or (x == low and not was_falling):
            return None
        place, value = x, values[0]
        if x > low:
            width = (high - low) / 8
            if at(x) > _NEAR * spread:
                return None
            place, value = least(at, max(low, x - width), min(high, x + width))
        touches, band = False, self._band(condition, step, place)
        if abs(value) <= band:
            touches = True
        elif not value < 0:
            return None
        if value < 0 and (condition.kind == "gap" or not touches):
            place = crossing(at, low, place, values[0], value)
        return Occurrence(step.start + place * step.h, condition, touches, band * touches)

    # -- what is 0 -----------------------------------------------------------------------------

    def _band(self, condition: Condition, step: Step, x: float) -> float:
        """How much the margin changes when each component errs by what is allowed."""
        t = step.start + x * step.h
        q, v = self._state_at(step, t)
        return self.felt(condition, t, q, v, self._allowed())

    def felt(
        self, condition: Condition, t: float, q: Vector, v: Vector, errors: Sequence[float]
    ) -> float:
        """Sum over the components of |d margin/d x_j| error_j."""
        n, state = len(q), [*q, *v]
        value = float(condition.margin(t, q, v))
        if not math.isfinite(value):
            return 0.0
        total = 0.0
        for j, error in enumerate(errors):
            change = max(error, _NUDGE * abs(float(state[j])))
            if change == 0.0:
                continue
            moved = list(state)
            moved[j] += change
            try:
                other = float(condition.margin(t, moved[:n], moved[n:]))
            except (ArithmeticError, ValueError):
                continue
            total += abs(other - value) / change * error
        return total
