"""Random states that the constraints and the assumptions of a file allow.

Parameters, time, coordinates and velocities are exact random numbers; where there are
constraints, Newton's method with the shortest steps moves q onto f(q, t) = 0, and one linear
step q' onto A q' + b = 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from math import inf
from random import Random

from flint import arb, ctx

from lagcli.expression import Expression
from lagcli.problem_data import Coordinate, Parameter, Problem
from lagcli.verification.functions import ball
from lagcli.verification.linear import Unclear
from lagcli.verification.newton import settled
from lagcli.verification.phase_points import Environment, PhasePoint, PhaseState, with_momenta
from lagcli.verification.reference import DynamicsAtState, Reference
from lagcli.verification.sweeps import Unknown

_NEWTON_STEPS = 40
#: Attempts for each state: a linkage closes for some one in five of random lengths.
_ATTEMPTS = 24
#: States with parameters of one order, before every second has others: m^2 g > 4 a c^2 is rare.
OF_ONE_ORDER = 9


class State:
    """A state with the motion that the laws give it there.

    Attributes
    ----------
    at : Values
        Of every formula of parameters, t, q, q', q'', multipliers and momenta `p_x`.
    laws : Dynamics
        What the laws say there.
    """

    def __init__(self, reference: Reference, environment: Environment) -> None:
        self.reference = reference
        self.environment = environment
        self.at = reference.values(Completed(self))
        self.laws = DynamicsAtState(reference, self.at)

    @cached_property
    def following(self) -> Environment:
        """Momenta, accelerations and multipliers, where the laws give them."""
        laws, names = self.laws, self.reference.names
        constraints = self.reference.problem.constraints
        found = {(f"p_{n}", 0): p for n, p in zip(names, laws.momenta, strict=True)}
        found |= {(n, 2): a for n, a in zip(names, laws.accelerations, strict=True)}
        forces = zip(constraints, laws.multipliers, strict=True)
        return found | {(c.multiplier, 0): m for c, m in forces}

    @cached_property
    def phase(self) -> PhasePoint:
        """Its point of phase space: dH/dq = -dL/dq, dH/dp = q'."""
        slopes = [-slope for slope in self.laws.slopes], self.laws.velocities
        known = {**self.environment, **self.following}
        return PhasePoint(self.reference, known, self.laws.energy, slopes)

    @cached_property
    def loose(self) -> Loose:
        """The same state with q'' and multipliers that no law gave."""
        return Loose(self)


class Completed:
    """The environment of a state; what follows from the laws is computed when needed."""

    def __init__(self, state: State) -> None:
        self._state = state

    def get(self, key: tuple[str, int]) -> arb | None:
        """The value of a symbol; None where it has none."""
        state = self._state
        known = state.environment.get(key)
        if known is None and key in state.reference.following:
            known = state.following[key]
        return known


class Loose:
    """A state with random q'' and multipliers.

    Attributes
    ----------
    at : Values
        Of every formula there.
    residuals : list of arb
        d/dt(dL/dq_j') - dL/dq_j - Q_j - sum_k lambda_k a_kj.
    """

    def __init__(self, state: State) -> None:
        random = Random(2)
        names = state.reference.names
        constraints = state.reference.problem.constraints
        self.accelerations = [_number(random, 1.0) for _ in names]
        multipliers = [_number(random, 1.0) for _ in constraints]
        given = {(n, 2): x for n, x in zip(names, self.accelerations, strict=True)}
        given |= {(c.multiplier, 0): m for c, m in zip(constraints, multipliers, strict=True)}
        self.at = state.reference.values({**state.environment, **given})
        laws = state.laws
        pairs = zip(laws.inertia(self.accelerations), laws.applied, strict=True)
        self.residuals = [inertia - force for inertia, force in pairs]
        for multiplier, row in zip(multipliers, laws.jacobian, strict=True):
            self.residuals = [r - multiplier * a for r, a in zip(self.residuals, row, strict=True)]
        self._flow = {
            **state.laws.flow,
            **dict(zip(state.reference.v, self.accelerations, strict=True)),
        }

    def rate(self, place: int) -> arb:
        """d/dt of a function of t, q, q' with these q''."""
        return self.at.rates([place], self._flow).get(place, arb(0))


def random_states(reference: Reference, seed: int = 1) -> Iterator[State]:
    """States on the constraints at which everything has a value, the same ones every time."""
    for number in range(100):
        found = None
        for attempt in range(_ATTEMPTS):
            random = Random(f"{seed} {number} {attempt}")
            found = _state(reference, random, number, attempt)
            if found is not None:
                break
        if found is None:
            return
        yield found


def phase_states(reference: Reference) -> Iterator[PhaseState]:
    """States of a system whose H has no Lagrangian."""
    given = (
        _anywhere(reference.problem, Random(f"1 {number}"), 0.4 * (number % 2), wide=False)
        for number in range(100)
    )
    return with_momenta(reference, given)


def _state(reference: Reference, random: Random, number: int, attempt: int) -> State | None:
    # The first is positive where nothing is said; a problem may need that of all.
    negative = 0.4 if number % 2 and attempt < _ATTEMPTS // 2 else 0.0
    near = number % 4 == 3 or attempt % 3 == 2
    environment = _anywhere(reference.problem, random, negative, wide=number % 3 == 2)
    spread = number >= OF_ONE_ORDER and number % 2 == 1
    if spread or attempt > _ATTEMPTS // 2:  # lengths of another order: x = 4 a on x^2 + y^2 = l^2
        environment = with_other_orders(reference.problem, environment, random)
    if near:
        environment |= _near_the_file(reference, random)
    if reference.rows and not onto_constraints(reference, environment):
        return None
    state = State(reference, environment)
    values = list(state.laws.drift)
    if not reference.large:
        try:
            values += state.laws.motion.x
        except Unclear:
            return None
    return state if all(x.is_finite() for x in values) else None


def with_other_orders(problem: Problem, environment: Environment, random: Random) -> Environment:
    """With parameters of other orders of magnitude."""
    known = dict(environment)
    for parameter in problem.parameters:
        if not parameter.integer:
            known[parameter.name, 0] *= arb(2) ** random.randint(-3, 3)
    return known


def _anywhere(problem: Problem, random: Random, negative: float, *, wide: bool) -> Environment:
    known: Environment = {("t", 0): _number(random, 1.6)}
    for parameter in problem.parameters:
        known[parameter.name, 0] = _value(parameter, random, negative)
    for coordinate in problem.coordinates:
        scale = arb(3) if wide else arb(1)
        known[coordinate.name, 0] = _value(coordinate, random, max(negative, 0.2)) * scale
        known[coordinate.name, 1] = _number(random, 1.2)
    return known


def _value(quantity: Parameter | Coordinate, random: Random, negative: float) -> arb:
    if isinstance(quantity, Parameter) and quantity.integer:
        return arb(random.randint(1, 4))
    size = ball(Fraction(random.randint(400, 1900), 1024))
    if quantity.assume in {"positive", "nonnegative"}:
        return size
    if quantity.assume == "negative":
        return -size
    return -size if random.random() < negative else size


def _number(random: Random, scale: float) -> arb:
    return ball(Fraction(round(1024 * scale * random.uniform(-1, 1)), 1024))


def values_of_the_file(reference: Reference) -> Environment:
    """The parameters that have one; it may use other parameters."""
    known: Environment = {}
    left = {p.name: p.value for p in reference.problem.parameters if p.value is not None}
    while True:
        found = {
            (name, 0): number
            for name, value in left.items()
            if (number := _given(reference, value, known)) is not None
        }
        if not found:
            return known
        known |= found
        left = {name: value for name, value in left.items() if (name, 0) not in found}


def _near_the_file(reference: Reference, random: Random) -> Environment:
    """Parameters and initial positions some per cent from those of the file."""
    given = values_of_the_file(reference).items()
    known = {key: number * (1 + _number(random, 0.05)) for key, number in given}
    for name, value in reference.problem.initial.items():
        number = _given(reference, value, known)
        if number is not None and not name.primes:
            known[name.name, 0] = number + _number(random, 0.1)
    return known


def _given(reference: Reference, value: Expression, known: Environment) -> arb | None:
    try:
        return reference.values(known)(reference.place(value)).mid()
    except Unknown:
        return None


def onto_constraints(reference: Reference, environment: Environment) -> bool:
    """Move q and q' onto the constraints; whether that worked."""
    positions = [row.value for row in reference.rows if row.holonomic]
    velocities = [row.velocity for row in reference.rows]
    near = 2.0 ** (24 - ctx.prec)
    for primes, places, far in ((0, positions, 1e9), (1, velocities, inf)):
        keys = [(name, primes) for name in reference.names]
        start = dict(environment)
        for damped in (False, True):  # 1/x = 50 and ln x = 5 need short steps
            environment |= start
            if settled(
                reference,
                environment,
                places,
                keys,
                steps=_NEWTON_STEPS,
                near=near,
                far=far,
                damped=damped,
            ):
                break
        else:
            return False
    return all(_allowed(c, environment[c.name, 0]) for c in reference.problem.coordinates)


def _allowed(coordinate: Coordinate, x: arb) -> bool:
    match coordinate.assume:
        case "positive":
            return bool(x > 0)
        case "negative":
            return bool(x < 0)
        case _:
            return True
