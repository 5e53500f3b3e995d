"""Random states that the constraints allow, and the motion that the laws give them there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from random import Random

from mpmath import mpf

from lagcli.problem_data import Coordinate, Parameter, Problem

from .evaluate import Moment
from .jets import Number, OutsideDomain, real_part
from .linear import Solution, least_step, solve
from .reference import Reference, gradient

#: A state that Newton's method has brought this near to the constraints is on them.
ON_SURFACE = mpf(10) ** -30
ATTEMPTS = 200


@dataclass(frozen=True)
class State:
    """A moment on the constraints with the accelerations that the equations give."""

    moment: Moment
    motion: Solution  # of (q'', lambda)
    reference: Reference

    @property
    def accelerations(self) -> list[mpf]:
        """q''."""
        return self.motion.x[: self.reference.size]

    @property
    def multipliers(self) -> list[mpf]:
        """One choice of the lambdas (not unique where constraints are redundant)."""
        return self.motion.x[self.reference.size :]

    @property
    def regular(self) -> bool:
        """Whether the equations determine the accelerations."""
        size = self.reference.size
        return self.motion.consistent and all(map(self.motion.determined, range(size)))


def reals(numbers: Sequence[Number]) -> list[mpf]:
    """Plain numbers."""
    return [real_part(x) for x in numbers]


def random_states(reference: Reference, count: int, seed: int = 1) -> list[State]:
    """States on the constraint surface with their motion."""
    return [with_motion(reference, m) for m in random_moments(reference, count, seed)]


def random_moments(
    reference: Reference, count: int, seed: int = 1, *, constrained: bool = True
) -> list[Moment]:
    """Moments (t, q, q') with random parameters, on the constraints unless told otherwise."""
    found: list[Moment] = []
    random = Random(seed)
    for attempt in range(ATTEMPTS):
        if len(found) == count:
            return found
        # Real quantities take either sign, but a problem may need them positive after all.
        negative = 0.4 if len(found) % 2 and attempt < ATTEMPTS // 2 else 0.0
        try:
            moment = anywhere(reference.problem, random, negative)
            if constrained:
                moment = on_constraints(reference, moment)
            reference.inertia(_with_accelerations(moment, random))  # real there?
        except (OutsideDomain, ZeroDivisionError):
            continue
        found.append(moment)
    raise AssertionError(f"{len(found)} of {count} states found on the constraints")


def anywhere(problem: Problem, random: Random, negative: float) -> Moment:
    """A moment with random parameters; a share of the unrestricted ones is negative."""
    constants = {p.name: _value(p, random, negative) for p in problem.parameters}
    q = tuple(_value(c, random, 0.5 if negative else 0.1) for c in problem.coordinates)
    v = tuple(_decimal(random, -1.2, 1.2) for _ in q)
    still = tuple(mpf(0) for _ in q)
    return Moment(_decimal(random, 0.2, 1.6), (q, v, still), constants)


def _value(quantity: Parameter | Coordinate, random: Random, negative: float) -> mpf:
    if isinstance(quantity, Parameter) and quantity.integer:
        return mpf(random.randint(1, 4))
    size = _decimal(random, 0.4, 1.9)
    match quantity.assume:
        case "positive" | "nonnegative":
            return size
        case "negative":
            return -size
        case _:
            return -size if random.random() < negative else size


def _decimal(random: Random, low: float, high: float) -> mpf:
    return mpf(round(random.uniform(low, high), 6))


def _with_accelerations(moment: Moment, random: Random) -> Moment:
    a = tuple(_decimal(random, -1, 1) for _ in moment.chain[0])
    return replace(moment, chain=(*moment.chain[:2], a))


def with_random_accelerations(moment: Moment, seed: int) -> Moment:
    """The moment with q'' that no law gave."""
    return _with_accelerations(moment, Random(seed))


def on_constraints(reference: Reference, moment: Moment) -> Moment:
    """The moment moved onto f(q, t) = 0, then its velocities onto A q' + b = 0."""
    constraints = reference.problem.constraints
    positions = [reference.value(c) for c in constraints if reference.holonomic(c)]
    velocities = [reference.velocity_form(c) for c in constraints]
    for level, functions in ((0, positions), (1, velocities)):
        for _ in range(60 if functions else 0):
            residual = reals([f(moment) for f in functions])
            if max(map(abs, residual)) < ON_SURFACE:
                break
            rows = [reals(gradient(f, moment, level)) for f in functions]
            step = least_step(rows, residual, reference.size)
            longest = max(map(abs, step))
            if longest > 1:
                step = [d / longest for d in step]
            moment = moment.shifted(level, dict(enumerate(step)))
        else:
            if functions:
                raise OutsideDomain("no state on the constraints near this one")
    for c, x in zip(reference.problem.coordinates, moment.chain[0], strict=True):
        if (c.assume == "positive" and x <= 0) or (c.assume == "negative" and x >= 0):
            raise OutsideDomain(f"{c.name} has the wrong sign")
    return moment


def with_motion(reference: Reference, moment: Moment) -> State:
    """Solve M q'' - A^T lambda = F, A q'' = -bias."""
    size = reference.size
    constraints = reference.problem.constraints
    still = replace(moment, chain=(*moment.chain[:2], tuple(mpf(0) for _ in range(size))))
    mass = [reals(row) for row in reference.mass_matrix(still)]
    inertia = reals(reference.inertia(still))
    applied = reals(reference.applied(still))
    jacobian = [reals(reference.row(c, still)) for c in constraints]
    biases = [real_part(reference.bias(c, still)) for c in constraints]
    rows = [[*mass[j], *(-a[j] for a in jacobian)] for j in range(size)]
    rows += [[*a, *(mpf(0) for _ in constraints)] for a in jacobian]
    right = [f - e for f, e in zip(applied, inertia, strict=True)] + [-b for b in biases]
    motion = solve(rows, right, size + len(constraints))
    moving = replace(still, chain=(*still.chain[:2], tuple(motion.x[:size])))
    return State(moving, motion, reference)


def moments_of(states: Sequence[State]) -> Iterator[Moment]:
    """The moments of states."""
    return (state.moment for state in states)
