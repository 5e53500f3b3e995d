"""The motion from a state by the rule of Runge and Kutta of fourth order."""

from __future__ import annotations

from flint import arb

from lagcli.verification.phase_points import Environment
from lagcli.verification.reference import Reference
from lagcli.verification.states import State


class SteppedMotion:
    """A state that moves on.

    Attributes
    ----------
    environment
        t, q and q' now, and what does not move.
    """

    def __init__(self, reference: Reference, start: Environment) -> None:
        self.reference = reference
        self.environment: Environment = dict(start)
        self._keys = [(n, primes) for primes in (0, 1) for n in reference.names]

    @property
    def state(self) -> State:
        """What the laws say now."""
        return State(self.reference, dict(self.environment))

    def rates(self, state: State | None = None) -> list[arb]:
        """q' and q'', now or in a state."""
        laws = (state or self.state).laws
        return [*laws.velocities, *laws.accelerations]

    def advance(self, step: arb, first: list[arb] | None = None) -> None:
        """One step; `first` are the rates now, where they are known."""
        slopes = [self.rates() if first is None else first]
        for part in (step / 2, step / 2, step):
            pairs = zip(self._keys, slopes[-1], strict=True)
            there = {key: (self.environment[key] + part * rate).mid() for key, rate in pairs}
            there["t", 0] = self.environment["t", 0] + part
            slopes.append(self.rates(State(self.reference, {**self.environment, **there})))
        for key, (a, b, c, d) in zip(self._keys, zip(*slopes, strict=True), strict=True):
            moved = self.environment[key] + (a + 2 * b + 2 * c + d) * step / 6
            self.environment[key] = moved.mid()
        self.environment["t", 0] = (self.environment["t", 0] + step).mid()
