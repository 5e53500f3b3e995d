"""Where along the motion a condition fails: a contact is lost, `--stop-when` comes true.

A condition is a margin that is not negative while it holds.  Each step is looked at in
several places, so that a margin that dips below 0 and comes back is seen; where it comes
near without being seen below, its least value within the step is sought.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.steps import Step
from lagcli.record import record

Vector = Sequence[Any]
Margin = Callable[[float, Vector, Vector], float]
State = tuple[list[Any], list[Any]]

_PLACES = (0.25, 0.5, 0.75, 1.0)
_GOLDEN = 0.6180339887498949
_HALVINGS = 60
_NEAR = 0.5
#: A margin that begins below this is taken for 0: contact at its limit.
_AT_LIMIT = -1e-12


@record
class Event:
    """What happened, and when."""

    t: float
    name: str
    what: str


@record
class Condition:
    """Holds while its margin is >= 0."""

    name: str
    what: str
    margin: Margin


class Watch:
    """Looks at the conditions step by step.

    Parameters
    ----------
    conditions
        What to look at.
    state_at
        The state inside a step, on the constraints.
    """

    def __init__(
        self, conditions: Sequence[Condition], state_at: Callable[[Step, float], State]
    ) -> None:
        self.conditions = conditions
        self._state_at = state_at
        self._before = [0.0] * len(conditions)

    def begin(self, q: Vector, v: Vector) -> Event | None:
        """The condition that does not even hold at t = 0."""
        for k, condition in enumerate(self.conditions):
            self._before[k] = margin = float(condition.margin(0.0, q, v))
            if margin < _AT_LIMIT:
                return Event(0.0, condition.name, condition.what)
        return None

    def first(self, step: Step) -> Event | None:
        """The first condition that fails within a step."""
        found = [
            Event(t, condition.name, condition.what)
            for k, condition in enumerate(self.conditions)
            if (t := self._fails(k, condition, step)) is not None
        ]
        return min(found, key=lambda event: event.t) if found else None

    def _fails(self, k: int, condition: Condition, step: Step) -> float | None:
        def at(x: float) -> float:
            t = step.end if x == 1 else step.start + x * step.h
            q, v = (step.q, step.v) if x == 1 else self._state_at(step, t)
            return float(condition.margin(t, q, v))

        places, values = [0.0], [self._before[k]]
        for x in _PLACES:
            places.append(x)
            values.append(at(x))
            if values[-1] < 0:
                return step.start + step.h * _crossing(at, places[-2], x)
        self._before[k] = values[-1]
        for i in range(1, len(values) - 1):
            left, here, right = values[i - 1 : i + 2]
            # a minimum between, and near enough to 0 to reach below it
            if here <= left and here <= right and here < _NEAR * max(left, right):
                x, least = _least(at, places[i - 1], places[i + 1])
                if least < 0:
                    return step.start + step.h * _crossing(at, places[i - 1], x)
        return None


def _crossing(at: Callable[[float], float], good: float, bad: float) -> float:
    """Where a margin passes through 0, by halving."""
    for _ in range(_HALVINGS):
        middle = (good + bad) / 2
        if not good < middle < bad:
            break
        if at(middle) < 0:
            bad = middle
        else:
            good = middle
    return bad


def _least(at: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """The place of the least value, by the golden section."""
    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    below, above = at(a), at(b)
    for _ in range(_HALVINGS // 2):
        if below < above:
            high, b, above = b, a, below
            a = high - _GOLDEN * (high - low)
            below = at(a)
        else:
            low, a, below = a, b, above
            b = low + _GOLDEN * (high - low)
            above = at(b)
    return (a, below) if below < above else (b, above)
