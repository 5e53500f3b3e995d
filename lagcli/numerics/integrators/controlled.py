"""Steps whose length follows from an error that is estimated in each of them.

References
----------
Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.4.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import reason_of
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.steps import (
    CannotGoOn,
    Inside,
    Step,
    StepSize,
    StopWithReason,
    Stretch,
    Tolerance,
)
from lagcli.numerics.integrators.switching import Kinks

Vector = list[float]
#: q, q' and q''
State = tuple[Vector, Vector, Sequence[float]]


class Trial(NamedTuple):
    """A step that was tried: its error in units of the tolerance, and its end where that is <= 1.

    `estimates` are the errors of the components, `kept` is what the method takes along.
    """

    error: float
    end: State | None = None
    estimates: Sequence[float] = ()
    kept: Any = None


class Controlled(ABC):
    """The steps of one run.

    Parameters
    ----------
    motion
        In doubles.
    surface
        The constraints, or None.

    Attributes
    ----------
    power : int
        Of the length of a step, with which its error goes.
    first : float
        The least length of the first step, as a part of the longest.
    """

    name: str
    sees = even = False
    power: int
    first: float

    def __init__(self, motion: Motion, surface: Surface | None) -> None:
        self.motion, self.surface, self.n = motion, surface, motion.n
        self.calls = 0
        self.reached: int | None = None

    @property
    def evaluations(self) -> int:
        """Of the accelerations, so far."""
        return self.calls

    @abstractmethod
    def begin(self) -> None:
        """Nothing of `stretch` has been tried."""

    @abstractmethod
    def tried(self, t: float, h: float, state: State) -> Trial:
        """A step.

        Raises
        ------
        CannotGoOn
            Where steps lead nowhere.
        ArithmeticError, ValueError
            Where this one is not defined.
        """

    @abstractmethod
    def inside(self, t: float, h: float, state: State, trial: Trial) -> Inside:
        """The state within a step that was tried."""

    @abstractmethod
    def accepted(self, trial: Trial, ratio: float) -> None:
        """Take along what a step has left; the next one is to be `ratio` as long."""

    def rate(self, t: float, q: Sequence[float], v: Sequence[float]) -> tuple[float, ...]:
        """q'' at a state."""
        self.calls += 1
        return self.motion.accelerations(t, *q, *v)

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Accepted steps to the end, or to where friction sticks (`reached`).

        Raises
        ------
        CannotGoOn
            Where the step becomes shorter than rounding, with the reason.
        """
        q, v, until, t = stretch
        kinks = Kinks(self.motion, tolerance)
        self.reached = None
        if self.motion.kinks:
            kinks.begin(t, q, v)
        state: State = q, v, self.rate(t, q, v)
        size = StepSize(tolerance.first_step(stretch, state[2], self.first), self.power, until)
        self.stretch, self.tolerance, self.size = stretch, tolerance, size
        self.begin()
        while t < until:
            h, last = size.from_time(t)
            reason = ""
            try:
                trial = self.tried(t, h, state)
            except CannotGoOn:
                raise
            except (ArithmeticError, ValueError) as failure:
                trial, reason = Trial(math.inf), reason_of(failure)
            if trial.end is None:
                if size.is_nothing(trial.error, t):
                    raise CannotGoOn(t, *state[:2], reason)
                if trial.estimates:
                    tolerance.rejected(trial.estimates)
                tolerance.forget()
                continue
            tolerance.accepted()
            q, v, rate = trial.end
            inside = self.inside(t, h, state, trial)
            if self.motion.kinks:
                shorter = kinks.first(t, h, q, v, inside)
                if shorter is not None:  # the step is made again, up to the kink
                    size.h = shorter
                    if kinks.stuck(t + shorter, until):
                        raise StopWithReason(t, *state[:2], kinks.why())
                    continue
            start, t = t, until if last else t + h
            state = q, v, rate
            yield Step(start, h, t, q, v, inside)
            if kinks.reached is not None:
                if kinks.sticks(t, q, v):
                    self.reached = kinks.reached
                    return
                v = kinks.pass_through(t, q, v)
                state = q, v, self.rate(t, q, v)
            size.grow(trial.error, tolerance.longest)
            self.accepted(trial, size.h / h)
