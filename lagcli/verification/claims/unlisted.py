"""Equilibria and steady motions that are not listed, searched for by Newton's method.

Where q'' = 0 and the other velocities are constant,

    dL/dq_j - d/dt(dL/dq_j') + Q_j - dD/dq_j' + sum_k lambda_k a_kj = 0

with the constraints; for steady motions the rates of the cyclic coordinates are sought as well,
with given momenta.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from math import ceil, pi
from random import Random

from flint import arb, ctx

from lagcli.problem_data import Inequality, Parameter, Quantity
from lagcli.verification.claims.near import LinearMotion
from lagcli.verification.claims.rest import RestPlace
from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import Unclear, least_step, size
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State
from lagcli.verification.sweeps import StepValues, column

#: Starts of Newton's method at each of `_STATES` choices of the parameters.
_STARTS = 10
_STATES = 2
_STEPS = 25
_ARRIVED = 1e-24
#: How near two places are the same.
_SAME = 1e-9
#: Distances to a pole: between them a square that vanishes falls by 2^-14, another by nothing.
#: An M that falls with the square of the distance still has clear pivots there, above 2^-36.
_NEAR, _NEARER, _FALLS, _WAYS = arb(2) ** -8, arb(2) ** -15, arb(2) ** -7, 3
_SIGNS = {"positive": 1, "nonnegative": 1, "negative": -1}


class Balance:
    """The conditions of rest, or of steady motion.

    Parameters
    ----------
    x
        The examination.
    turning
        The coordinates that turn at constant rates: their momenta are given.
    parameters
        Those whose values are sought, too.
    """

    def __init__(
        self, x: Examination, turning: Sequence[str] = (), parameters: Sequence[Parameter] = ()
    ) -> None:
        self.x, self.turning, self.parameters = x, tuple(turning), tuple(parameters)
        program, reference = x.reference.program, x.reference
        forces = list(reference.forces)
        for j, (q, v) in enumerate(zip(reference.q, reference.v, strict=True)):
            p = reference.momenta[j]
            seeds = {
                **dict(zip(reference.q, reference.v, strict=True)),
                reference.time: program.one,
            }
            slope = reference.by(reference.lagrangian, q)
            terms = [slope, program.negative(program.derivative(p, seeds)), forces[j]]
            if reference.dissipation is not None:
                drag = reference.by(reference.dissipation, v)
                terms.append(program.negative(drag))
            for row in reference.rows:
                arm = reference.by(row.velocity, v)
                terms.append(program.product(program.symbol(row.constraint.multiplier), arm))
            forces[j] = program.sum(*terms)
        names = reference.names
        self.conditions = [f for n, f in zip(names, forces, strict=True) if n not in self.turning]
        for name, p in zip(names, reference.momenta, strict=True):
            if name in self.turning:
                given = program.negative(program.symbol(f"p_{name}"))
                self.conditions.append(program.sum(p, given))
        self.conditions += [row.value for row in reference.rows]
        still = [n for n in names if n not in self.turning]
        self.sought = [(n, 0) for n in still] + [(n, 1) for n in self.turning]
        self.multipliers = [(row.constraint.multiplier, 0) for row in reference.rows]
        self.sought += [*self.multipliers, *((each.name, 0) for each in self.parameters)]
        self.symbols = [program.symbol(*key) for key in self.sought]

    def found(self) -> Iterator[LinearMotion]:
        """Regular places where it stays, from random starts.

        The search needs fewer bits than the derivatives at what is found: each is a new value.
        """
        random = Random(5)
        for state in self.x.states(_STATES):
            for k in range(_STARTS):
                with ctx.workprec(PRECISIONS[0]):
                    near = self._from(self._start(state, random, 1 + k % 2))
                    counts = near is not None and self._counts(near)
                if near is not None and counts:
                    yield LinearMotion(self.x, near.environment)

    def _start(self, state: State, random: Random, turns: int) -> Environment:
        environment = dict(state.environment)
        for coordinate in self.x.problem.coordinates:
            value = turns * arb(random.randint(-3300, 3300)) / 1024
            sign = _SIGNS.get(coordinate.assume)
            environment[coordinate.name, 0] = value if sign is None else abs(value) * sign
            environment[coordinate.name, 1] = arb(0)
        for key in self.multipliers:
            environment[key] = arb(random.randint(-1024, 1024)) / 1024
        for name in self.turning:
            environment[name, 1] = arb(random.randint(-2048, 2048)) / 1024
            environment[f"p_{name}", 0] = arb(random.randint(-1536, 1536)) / 1024
        return environment

    def _from(self, environment: Environment) -> LinearMotion | None:
        """Newton's method; the last step is no longer than rounding."""
        reference = self.x.reference
        for _ in range(_STEPS):
            at = reference.values(environment)
            residual = [at(place) for place in self.conditions]
            if not all(each.is_finite() for each in residual):
                return None
            rows = [column(at.gradient(place), self.symbols) for place in self.conditions]
            try:
                step = least_step(rows, residual)
            except Unclear:
                return None
            longest = max(map(size, step), default=0.0)
            if max(map(size, residual)) < _ARRIVED and longest < _SAME:
                return LinearMotion(self.x, environment)
            if not longest < 1e6:
                return None
            shorter = arb(1 if longest < 1 else 1 / longest)
            for key, d in zip(self.sought, step, strict=True):
                environment[key] = (environment[key] + d * shorter).mid()
        return None

    def _counts(self, near: LinearMotion) -> bool:
        """Whether it is a regular place that the file allows, within two turns of the origin.

        What is a whole number of turns away from a place in (-pi, pi] counts as that place.
        """
        x = self.x
        turned = self._within_a_turn(near)
        if turned is not None and self.is_period(near, turned):
            return False
        places = (float(near.environment[n, 0].mid()) for n in x.reference.names)
        if not all(abs(place) < 4 * pi for place in places):
            return False
        if not near.defined or near.without_lagrangian:
            return False
        if near.at_a_pole and (self.turning or not _rests_at_a_pole(near)):
            return False
        if any(_is_outside(near, c) for c in (*x.problem.coordinates, *self.parameters)):
            return False
        held = (c.holds_while for c in x.problem.constraints)
        return all(h is None or _holds(x, near, h) for h in held)

    def _within_a_turn(self, near: LinearMotion) -> LinearMotion | None:
        """The same with each coordinate in (-pi, pi]; None where all are."""
        environment = dict(near.environment)
        for n in self.x.reference.names:
            turns = ceil((float(environment[n, 0].mid()) - pi - _SAME) / (2 * pi))
            if turns:
                environment[n, 0] = environment[n, 0] - 2 * turns * arb.pi()
        same = all(environment[key] is value for key, value in near.environment.items())
        return None if same else LinearMotion(self.x, environment)

    def is_period(self, near: LinearMotion, listed: LinearMotion) -> bool:
        """Whether the laws at places this far from each other are the same."""
        reference = self.x.reference
        with ctx.workprec(PRECISIONS[0]):
            here = dict(near.environment)
            for k, key in enumerate(self.sought):
                here[key] = here.get(key, arb(0)) + arb(2 * k + 3) / 16
            there = dict(here)
            for n in reference.names:
                change = listed.environment[n, 0] - near.environment[n, 0]
                there[n, 0] = here[n, 0] + change
            one, other = reference.values(here), reference.values(there)
            return all(size(one(f) - other(f)) < _SAME for f in self.conditions)


def _is_outside(near: LinearMotion, given: Quantity) -> bool:
    """Whether a quantity is not what it is said to be: r = 0 is no place of a positive r."""
    value, assume = float(near.environment[given.name, 0]), given.assume
    if abs(value) < _SAME:
        return assume in {"positive", "negative", "nonzero"}
    return value * _SIGNS.get(assume, 0) < 0


def _rests_at_a_pole(near: LinearMotion) -> bool:
    """Whether a^T M a of the acceleration from rest falls to 0 with the distance to the place."""
    random = Random(7)
    ways = [[arb(random.randint(-1024, 1024)) / 1024 for _ in near.x.reference.names]
            for _ in range(_WAYS)]  # fmt: skip
    try:
        return all(
            _square(near, way, _NEARER) <= _FALLS * _square(near, way, _NEAR) for way in ways
        )
    except Unclear:
        return False


def _square(near: LinearMotion, way: Sequence[arb], distance: arb) -> arb:
    names = near.x.reference.names
    moved = {(n, 0): near.environment[n, 0] + distance * d for n, d in zip(names, way, strict=True)}
    laws = near.laws_at({**near.environment, **moved})
    a, M = laws.accelerations, laws.mass_matrix
    terms = (a[i] * M[i][j] * a[j] for i in range(len(a)) for j in range(len(a)))
    return abs(sum(terms, arb(0))).mid()


def _holds(x: Examination, near: LinearMotion, condition: Inequality) -> bool:
    at = x.reference.values(near.environment)
    larger, smaller = map(x.reference.place, condition.larger_first)
    return bool(at(larger) > at(smaller))


def unlisted(
    balance: Balance, places: Sequence[RestPlace], *, mirrored: Sequence[bool] = ()
) -> Iterator[LinearMotion]:
    """The places found that none of these is, up to periods and reversed rates."""
    both = list(zip(places, mirrored or [False] * len(places), strict=True))
    for near in balance.found():
        if not any(_is_at(balance, near, place, mirror=mirror) for place, mirror in both):
            yield near


def repeated(balance: Balance, places: Sequence[RestPlace], mirrored: Sequence[bool]) -> set[int]:
    """The numbers of places that are an earlier one, up to whole turns and reversed rates."""
    both, found = list(zip(places, mirrored, strict=True)), set()
    for number, place in enumerate(places):
        there = list(islice(place.states(), _STATES)) if number else []
        for other, mirror in both[:number] if there else ():
            if all(_is_at(balance, near, other, mirror=mirror, turns=True) for near in there):
                found.add(number)
    return found


def at_special_values(
    x: Examination, unless: Sequence[int], turning: Sequence[str] = ()
) -> LinearMotion | None:
    """A place that is there for special values of the parameters only; None where none was found.

    Of such places the conditions in `unless` hold.  Parameters with a sign keep their values: to
    be positive excludes few values, so that what is there for one is there nearby.
    """
    loose = without_sign(x)
    for near in Balance(x, turning, loose).found() if loose else ():
        at = x.reference.values(near.environment)
        if near.regular and not (unless and all(_vanishes(at, place) for place in unless)):
            return near
    return None


def without_sign(x: Examination) -> list[Parameter]:
    """The parameters that may be 0, or have either sign."""
    given = (p for p in x.problem.parameters if not p.integer)
    return [p for p in given if p.assume not in {"positive", "negative"}]


def _vanishes(at: StepValues, place: int) -> bool:
    scale = 1 + max(map(size, at.gradient(place).values()), default=0.0)
    return size(at(place)) < _SAME * scale


def _is_at(
    balance: Balance, near: LinearMotion, place: RestPlace, *, mirror: bool, turns: bool = False
) -> bool:
    """Whether a listed motion is the one found, or with `mirror` the one reversed.

    With `turns` no other periods of the laws than whole turns count.
    """
    sign = -1 if mirror else 1
    reversed_ = {key for n in balance.turning for key in ((f"p_{n}", 0), (n, 1))}
    known = {key: v * sign if key in reversed_ else v for key, v in near.environment.items()}
    with ctx.workprec(PRECISIONS[0]):
        listed = place.near(known)
    if listed is None:
        return mirror and _is_at(balance, near, place, mirror=False, turns=turns)
    still = [n for n in balance.x.reference.names if n not in balance.turning]
    gaps = [abs(_gap(near, listed, (n, 0))) for n in still]
    turned = [abs(_gap(near, listed, (n, 1), sign)) for n in balance.turning]
    same = all(gap < _SAME for gap in turned) and (
        all(gap < _SAME for gap in gaps)
        or (all(map(_is_whole, gaps if turns else ())) and balance.is_period(near, listed))
    )
    return same or (mirror and _is_at(balance, near, place, mirror=False, turns=turns))


def _is_whole(gap: float) -> bool:
    """Whether it is a number of turns."""
    return abs(gap / (2 * pi) - round(gap / (2 * pi))) < _SAME


def _gap(a: LinearMotion, b: LinearMotion, key: tuple[str, int], sign: int = 1) -> float:
    return float((a.environment[key] - sign * b.environment[key]).mid())


def shown(near: LinearMotion, turning: Sequence[str] = (), parameters: Sequence[str] = ()) -> str:
    """Where a place is, and for which values."""
    names = near.x.reference.names
    parts = [f"{n} = {float(near.environment[n, 0]):.6g}" for n in names if n not in turning]
    parts += [f"{n}' = {float(near.environment[n, 1]):.6g}" for n in turning]
    parts += [f"{n} = {float(near.environment[n, 0]):.6g}" for n in parameters]
    return ", ".join(parts)


__all__ = ["Balance", "at_special_values", "repeated", "shown", "unlisted", "without_sign"]
