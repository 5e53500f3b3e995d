"""Where coordinates rest or turn at constant rates, from the printed values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice
from random import Random

from flint import arb

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.problem_data import Constraint
from lagcli.record import replace
from lagcli.statements.motions import Above
from lagcli.verification.claims.near import NOTHING, LinearMotion
from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import rank, size
from lagcli.verification.newton import settled
from lagcli.verification.phase_points import Environment
from lagcli.verification.program import Key

#: States looked at until the printed conditions hold at `WANTED` of them.
LOOKED_AT = 24
WANTED = 5
#: How often each is looked at with parameters of other sizes.
_ROUNDS = 4
#: States from which each condition is made to fail: not all allow what the others ask.
_MOVED = 6
BITS = PRECISIONS[1]
_NEWTON_STEPS = 30
#: Of a condition's change with its parameter: how far beside its bound stability is tried.
_BESIDE = arb(2) ** -10


class RestPlace:
    """Where coordinates rest, with the conditions for it.

    Attributes
    ----------
    values
        The printed values of coordinates and of velocities `q'`, in parameters and free ones.
    on
        The printed equation that ties coordinates, if there is one.
    where
        The printed inequalities.
    eliminated
        Coordinates whose velocities follow from velocity constraints.
    """

    def __init__(
        self,
        x: Examination,
        what: str,
        at: Mapping[str, Expression],
        rates: Mapping[str, Expression],
        on: tuple[Expression, Expression] | None,
        where: Sequence[Above],
        eliminated: Sequence[str] = (),
    ) -> None:
        self.x = x
        self.eliminated = eliminated
        values = {(name, 0): e for name, e in at.items()}
        values |= {(name, 1): e for name, e in rates.items()}
        found = x.places(what, list(values.values()))
        self.readable = found is not None
        self.values = dict(zip(values, found or (), strict=True)) if found is not None else {}
        ties = x.places(what, on or ())
        program = x.reference.program
        self.on = [program.sum(ties[0], program.negative(ties[1]))] if ties else []
        self.where = conditions(x, what, where)

    def states(self) -> Iterator[LinearMotion]:
        """States at this place for random parameters that the conditions allow."""
        count = 0
        for state in self.x.states(LOOKED_AT, BITS):
            near = self.near(state.environment)
            if near is not None:
                count += near.defined
                yield near
            if count == WANTED:
                return
        if not count and self.where:
            yield from islice(chain(self._just_inside(), self.spread(_ROUNDS)), WANTED)

    def _just_inside(self) -> Iterator[LinearMotion]:
        """States where one of the conditions just holds: x > 30 is met by none that is drawn."""
        for state in self.x.states(WANTED, BITS):
            known = {**self._momenta, **state.environment}
            for bound in self.where:
                inside = self._moved(known, bound, 1)
                near = None if inside is None else self.near(inside)
                if near is not None:
                    yield near

    def spread(self, rounds: int = 1) -> Iterator[LinearMotion]:
        """States here with parameters of other sizes and signs: what always holds holds there."""
        yield from filter(None, map(self.near, self._spread(rounds)))

    def _spread(self, rounds: int) -> Iterator[Environment]:
        random = Random(3)
        parameters = [p for p in self.x.problem.parameters if not p.integer]
        signs = {p.name: (1, -1) if p.assume == "real" else (1,) for p in parameters}
        for state in self.x.states(LOOKED_AT, BITS) * rounds:
            scaled = {
                (n, 0): state.environment[n, 0] * random.choice(s) * arb(2) ** random.randint(-3, 3)
                for n, s in signs.items()
            }
            momenta = {key: p * random.choice((1, -1)) for key, p in self._momenta.items()}
            yield {**momenta, **state.environment, **scaled}

    def unreal(self) -> bool:
        """Whether a printed value is not real for parameters that its conditions allow."""
        for known in self._spread(1):
            at = self.x.reference.values(known)
            real = all(at(place).is_finite() for place in self.values.values())
            if not real and all(at(place) > 0 for place in self.where):
                return True
        return False

    def beside(self, bounds: Sequence[int]) -> Iterator[LinearMotion]:
        """States a little to both sides of where a condition on the parameters just holds."""
        first = next(self.states(), None)
        for bound in bounds if first is not None else ():
            for side in (1, -1):
                known = self._moved(first.environment, bound, side)  # type: ignore[union-attr]
                near = None if known is None else self.near(known)
                if near is not None:
                    yield near

    def beyond(self) -> Iterator[LinearMotion]:
        """States here with parameters for which a printed condition fails: none that stays."""
        states = self.x.states(LOOKED_AT, BITS) if self.where else []
        sizes = [arb(2) ** (k % 7 - 3) for k in range(len(states))]
        known = [
            {**{key: p * larger for key, p in self._momenta.items()}, **state.environment}
            for larger, state in zip(sizes, states, strict=True)
        ]
        moved = (self._moved(k, bound, -1) for bound in self.where for k in known[:_MOVED])
        for each in (*filter(None, moved), *known):
            near = self.near(each, allowed=False)
            if near is not None:
                yield near

    def _moved(self, known: Environment, bound: int, side: int) -> Environment | None:
        """A parameter, coordinate or momentum moved until left - right is near 0, so signed."""
        reference, problem = self.x.reference, self.x.problem
        signs = {p.name: p.assume for p in problem.parameters if not p.integer}
        signs |= {name: "real" for name, _ in self._momenta if (name, 0) in known}
        signs |= {q.name: q.assume for q in problem.coordinates if (q.name, 0) not in self.values}
        by = reference.values(known).gradient(bound)
        slopes = {n: by.get(reference.program.symbol(n), arb(0)) for n in signs}
        weights = {n: size(slope * known[n, 0]) for n, slope in slopes.items()}
        for name in sorted(weights, key=weights.__getitem__, reverse=True):
            if 0 < weights[name] < float("inf"):
                goal = arb(side * weights[name]) * _BESIDE
                there = self._with(known, name, bound, goal)
                if there is not None and has_sign(signs[name], there[name, 0]):
                    return there
        return None

    def _with(self, known: Environment, name: str, place: int, goal: arb) -> Environment | None:
        """The parameter for which a value is the goal, by Newton's method."""
        reference, there = self.x.reference, dict(known)
        symbol = reference.program.symbol(name)
        for _ in range(_NEWTON_STEPS):
            at = reference.values(there)
            slope = at.gradient(place).get(symbol, arb(0))
            step = ((goal - at(place)) / slope).mid() if not slope.contains(0) else arb("nan")
            if not step.is_finite() or size(step) > 1e3:
                return None
            there[name, 0] = (there[name, 0] + step).mid()
            if size(step) < NOTHING:
                return there
        return None

    def near(self, known: Environment, *, allowed: bool = True) -> LinearMotion | None:
        """The state here, if there is one and the conditions hold there, or do not hold."""
        reference = self.x.reference
        resting = {(name, 1) for name in reference.names} - self.values.keys()
        environment = {**self._momenta, **known, **{key: arb(0) for key in resting}}
        if not (self._put_in(environment) and self._tied(environment)):
            return None
        if not self._put_in(environment) or not self._carried(environment):
            return None
        at = reference.values(environment)
        if allowed is any(at(place) < 0 for place in self.where):
            return None
        sure = not allowed or all(at(place) > 0 for place in self.where)
        signs = all(has_sign(c.assume, environment[c.name, 0]) for c in self.x.problem.coordinates)
        return LinearMotion(self.x, environment) if sure and signs else None

    def contains(self, near: LinearMotion) -> bool:
        """Whether a state of rest is one of these."""
        listed, names = self.near(near.environment), self.x.reference.names
        return listed is not None and all(
            size(listed.environment[n, 0] - near.environment[n, 0]) < NOTHING for n in names
        )

    def dimension(self, near: LinearMotion) -> int:
        """Of the family of such places at one of them."""
        reference = self.x.reference
        program = reference.program
        symbols = [program.symbol(name) for name in reference.names]
        ties = self.on + [row.value for row in reference.rows if row.holonomic]
        for symbol, name in zip(symbols, reference.names, strict=True):
            if (name, 0) in self.values:
                ties.append(program.sum(symbol, program.negative(self.values[name, 0])))
        at = reference.values(near.environment)
        slopes = map(at.gradient, ties)
        return len(symbols) - rank(
            [[by.get(s, arb(0)) for s in symbols] for by in slopes], len(symbols)
        )

    @property
    def _momenta(self) -> Environment:
        """Those that are free."""
        names = self.x.reference.names
        pairs = zip(names, ball_numbers(len(names)), strict=True)
        return {(f"p_{name}", 0): p for name, p in pairs}

    def _put_in(self, environment: Environment) -> bool:
        """Give the printed values; whether all are real."""
        at = self.x.reference.values(dict(environment))
        found = {key: at(place) for key, place in self.values.items()}
        environment |= {key: value.mid() for key, value in found.items()}
        return all(value.is_finite() for value in found.values())

    def _tied(self, environment: Environment) -> bool:
        """Move the coordinates without values of their own onto the equation and constraints."""
        reference = self.x.reference
        free = [(n, 0) for n in reference.names if (n, 0) not in self.values]
        places = self.on + [row.value for row in reference.rows if row.holonomic]
        return not free or self._solved(environment, places, free)

    def _carried(self, environment: Environment) -> bool:
        """Give the velocities that are not given the values that the constraints leave them.

        Those of a motor, as phi = w t, and those that follow from velocity constraints.
        """
        reference = self.x.reference
        places = [row.velocity for row in reference.rows]
        given = {name for name, _ in self.values} - set(self.eliminated)
        free = [(n, 1) for n in reference.names if n not in given]
        return not free or self._solved(environment, places, free)

    def _solved(self, environment: Environment, places: list[int], free: list[Key]) -> bool:
        steps, near = _NEWTON_STEPS, NOTHING**3
        return settled(self.x.reference, environment, places, free, steps=steps, near=near)


def without_open(x: Examination, names: Sequence[str]) -> Examination:
    """The examination without the constraints that are open."""
    kept = tuple(c for c in x.problem.constraints if c.name not in names)
    if len(kept) == len(x.problem.constraints):
        return x
    return x.of(replace(x.problem, constraints=kept))


def with_closed_contacts(x: Examination, place: RestPlace) -> Examination:
    """The examination in which the contacts that are closed at a place are constraints."""
    near = next(place.states(), None) if place.readable else None
    if near is None or not x.problem.contacts:
        return x
    closed = []
    for contact in x.problem.contacts:
        sides = (contact.equation.left, contact.equation.right)
        left, right = (near.at(x.reference.place(side)) for side in sides)
        if size(left - right) < NOTHING:
            closed.append(
                Constraint(
                    name=contact.name, equation=contact.equation, multiplier=contact.multiplier
                )
            )
    if not closed:
        return x
    return x.of(replace(x.problem, constraints=(*x.problem.constraints, *closed)))


def ball_numbers(count: int) -> list[arb]:
    """Numbers for momenta that are free."""
    return [arb(7 + 3 * k) / 8 for k in range(count)]


def conditions(x: Examination, what: str, where: Sequence[Above]) -> list[int]:
    """The steps of left - right of printed inequalities."""
    program = x.reference.program
    sides = x.places(what, [side for each in where for side in (each.left, each.right)]) or []
    pairs = zip(sides[::2], sides[1::2], strict=True)
    return [program.sum(a, program.negative(b)) for a, b in pairs]


def held_at(x: Examination, what: str, near: LinearMotion, where: Sequence[Above]) -> list[bool]:
    """Which printed inequalities hold there, each with those beside it."""
    places = [conditions(x, what, (each, *each.besides)) for each in where]
    return [bool(each) and all(near.at(place) > 0 for place in each) for each in places]


def has_sign(assume: str, x: arb) -> bool:
    """Whether a number is surely not what an assumption excludes."""
    excluded = {
        "positive": x <= 0,
        "negative": x >= 0,
        "nonnegative": x < 0,
        "nonzero": x == 0,
    }
    return not excluded.get(assume, False)


def not_confirmed(what: str) -> str:
    """Why a list is not given."""
    return f"{what} that was derived does not hold at random states"


def named(at: Mapping[str, Expression], on: tuple[Expression, Expression] | None) -> str:
    """A place in words."""
    parts = [f"{name} = {to_grammar(value)}" for name, value in at.items()]
    if on is not None:
        parts.append(" = ".join(map(to_grammar, on)))
    return ", ".join(parts) or "everywhere"


def may_lose_contact(x: Examination) -> bool:
    """Whether a contact may just touch: the motion near it is not linear then."""
    return bool(x.problem.contacts) or any(c.holds_while for c in x.problem.constraints)
