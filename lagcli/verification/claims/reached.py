"""States on the constraints with the initial values of the charges."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

from flint import arb

from lagcli.statements.answers import Charge
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import Examination
from lagcli.verification.linear import rank
from lagcli.verification.newton import settled
from lagcli.verification.phase_points import Environment
from lagcli.verification.program import Key
from lagcli.verification.states import State, values_of_the_file
from lagcli.verification.stepped_motion import SteppedMotion
from lagcli.verification.sweeps import column

_STEPS = 60
_STARTS = 4
#: Newton's method has arrived: at a turning point it converges by halves, to some 2^-60.
_ARRIVED = 1e-17


class Reached:
    """States with the constraints and the initial values of the charges."""

    def __init__(self, x: Examination, charges: Sequence[Charge]) -> None:
        self.x = x
        self.reference = reference = x.reference
        self.everything = [(n, primes) for primes in (0, 1) for n in reference.names]
        self.constraints = [row.value for row in reference.rows if row.holonomic]
        self.velocities = [row.velocity for row in reference.rows]
        printed = [place for c in charges for place in x.places("", [c.charge]) or ()]  # type: ignore[list-item]
        self.charges = self._independent([*self._evident(), *printed])

    def _evident(self) -> list[int]:
        """The energy function and the momenta that are conserved."""
        program, reference = self.reference.program, self.reference
        h, p, v = reference.energy, reference.momenta, reference.v
        states = self.x.states()
        driven = (program.negative(program.product(v[j], p[j])) for j in self._driven(states))
        return [
            place
            for place in dict.fromkeys((h, *p, program.sum(h, *driven)))
            if states and all(is_zero(s.laws.rate(place)) for s in states)
        ]

    def _driven(self, states: Sequence[State]) -> list[int]:
        """Coordinates whose velocities the constraints give: phi = w t takes h to h - w p_phi."""
        if not states or not self.velocities:
            return []
        rows, size_ = states[0].laws.jacobian, len(self.reference.names)
        units = [[arb(int(i == j)) for i in range(size_)] for j in range(size_)]
        known = rank(rows, size_)
        return [j for j, unit in enumerate(units) if rank([*rows, unit], size_) == known]

    def _independent(self, places: Sequence[int]) -> list[int]:
        """Those whose gradients do not depend on the constraints' and on earlier ones."""
        kept: list[int] = []
        states = self.x.states()
        if not states:
            return kept
        symbols = [self.reference.program.symbol(*key) for key in self.everything]
        rows = [
            column(states[0].at.gradient(place), symbols)
            for place in (*self.constraints, *self.velocities)
        ]
        known = rank(rows, len(symbols))
        for place in dict.fromkeys(places):
            more = [*rows, column(states[0].at.gradient(place), symbols)]
            if rank(more, len(symbols)) > known:
                rows, known = more, known + 1
                kept.append(place)
        return kept

    def still(self, state: State, *, given_values: bool = False) -> Environment:
        """What does not move in a state, with the parameters of the file where these are meant."""
        known = {k: x for k, x in state.environment.items() if k not in self.everything}
        return {**known, **values_of_the_file(self.reference)} if given_values else known

    def initial(self, known: Environment) -> Environment | None:
        """The state at t = 0; what is not given is 0, or what the constraints leave."""
        start = {**known, ("t", 0): arb(0), **{key: arb(0) for key in self.everything}}
        given = {(n.name, n.primes): value for n, value in self.x.problem.initial.items()}
        at = self.reference.values(dict(start))
        start |= {key: at(self.reference.place(value)).mid() for key, value in given.items()}
        free = [key for key in self.everything if key not in given]
        if not self._solved(start, self.constraints, [k for k in free if not k[1]]):
            return None
        return start if self._solved(start, self.velocities, [k for k in free if k[1]]) else None

    def states(self, known: Environment, pinned: Sequence[int] = ()) -> Iterator[State]:
        """Random states with the initial charges at which the pinned steps are 0."""
        start = self.initial(known)
        if start is None:
            return
        before = self.reference.values(start)
        program = self.reference.program
        offsets = {place: before(place) for place in self.charges}
        if not all(value.is_finite() for value in offsets.values()):
            return
        names = {place: program.symbol(f"initial {k}") for k, place in enumerate(offsets)}
        kept = {(f"initial {k}", 0): v.mid() for k, v in enumerate(offsets.values())}
        gaps = [program.sum(p, program.negative(names[p])) for p in offsets]
        random = Random(11)
        for _ in range(_STARTS):
            there = {**known, **kept}
            for key in self.everything:
                there[key] = arb(random.randint(-1500, 1500)) / 1024
            places = [*self.constraints, *self.velocities, *gaps, *pinned]
            moments = [("t", 0)] if pinned else []
            if self._solved(there, places, [*self.everything, *moments]):
                yield State(self.reference, there)

    def passed(self, known: Environment, step: arb, steps: int) -> Iterator[State]:
        """States of the motion from the initial one."""
        start = self.initial(known)
        if start is None:
            return
        motion = SteppedMotion(self.reference, start)
        for _ in range(steps):
            state = motion.state
            yield state
            motion.advance(step, motion.rates(state))

    def _solved(self, environment: Environment, places: Sequence[int], free: Sequence[Key]) -> bool:
        return settled(
            self.reference, environment, places, free, steps=_STEPS, near=_ARRIVED, far=1e6
        )
