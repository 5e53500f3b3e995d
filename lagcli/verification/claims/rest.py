"""States of rest and of steady motion: that they are, and the linear motion near them.

With x = (q, q') the motion near a state that stays is x' = J x, where J holds the derivatives of
the accelerations, here by differences in 320 bits.  Constraints add eigenvalues 0 of motions
that break them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from flint import arb, arb_mat

from lagcli.expression import Expression
from lagcli.motions import Above
from lagcli.problem import Constraint
from lagcli.record import replace
from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import Unclear, least_step, rank, size, solve
from lagcli.verification.reference import Dynamics
from lagcli.verification.states import Environment
from lagcli.verification.sweeps import column

#: States looked at until the printed conditions hold at `WANTED` of them.
LOOKED_AT = 24
WANTED = 5
BITS = PRECISIONS[1]
_STEP = arb(2) ** -100
_NEWTON_STEPS = 30
#: Real parts and differences below this are 0: an eigenvalue of multiplicity 4 is right to 1e-20.
NOTHING = 1e-12


class Place:
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

    def states(self) -> Iterator[Near]:
        """States at this place for random parameters that the conditions allow."""
        count = 0
        for state in self.x.states(LOOKED_AT, BITS):
            near = self.near(state.environment)
            if near is not None:
                count += 1
                yield near
            if count == WANTED:
                return

    def near(self, known: Environment) -> Near | None:
        """The state here for these parameters; None where there is none."""
        reference = self.x.reference
        resting = {(name, 1) for name in reference.names} - self.values.keys()
        environment = {**known, **{key: arb(0) for key in resting}}
        for name, p in zip(reference.names, ball_numbers(len(reference.names)), strict=True):
            environment.setdefault((f"p_{name}", 0), p)
        if not (self._put_in(environment) and self._tied(environment)):
            return None
        if not self._put_in(environment) or not self._carried(environment):
            return None
        at = reference.values(environment)
        allowed = all(at(place) > 0 for place in self.where)
        signs = all(_has_sign(c.assume, environment[c.name, 0]) for c in self.x.problem.coordinates)
        return Near(self.x, environment) if allowed and signs else None

    def _put_in(self, environment: Environment) -> bool:
        """Give the printed values; whether all are real."""
        at = self.x.reference.values(dict(environment))
        found = {key: at(place) for key, place in self.values.items()}
        environment |= {key: value.mid() for key, value in found.items()}
        return all(value.is_finite() for value in found.values())

    def _tied(self, environment: Environment) -> bool:
        """Move the coordinates without values of their own onto the equation and constraints."""
        reference = self.x.reference
        free = [n for n in reference.names if (n, 0) not in self.values]
        places = self.on + [row.value for row in reference.rows if row.holonomic]
        return not free or self._solved(environment, places, [(n, 0) for n in free])

    def _carried(self, environment: Environment) -> bool:
        """Give the velocities that are not given the values that the constraints leave them.

        Those of a motor, as phi = w t, and those that follow from velocity constraints.
        """
        reference = self.x.reference
        places = [row.velocity for row in reference.rows]
        given = {name for name, _ in self.values} - set(self.eliminated)
        free = [(n, 1) for n in reference.names if n not in given]
        return not free or self._solved(environment, places, free)

    def _solved(
        self, environment: Environment, places: list[int], free: list[tuple[str, int]]
    ) -> bool:
        """Newton's method for what is free."""
        reference = self.x.reference
        symbols = [reference.program.symbol(*key) for key in free]
        if not places:
            return True
        for _ in range(_NEWTON_STEPS):
            at = reference.values(environment)
            residual = [at(place) for place in places]
            if max(map(size, residual)) < NOTHING**3:
                return True
            rows = [column(at.gradient(place), symbols) for place in places]
            try:
                step = least_step(rows, residual)
            except Unclear:
                return False
            for key, d in zip(free, step, strict=True):
                environment[key] = (environment[key] + d).mid()
        return False


def with_closed_contacts(x: Examination, place: Place) -> Examination:
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


def _has_sign(assume: str, x: arb) -> bool:
    return not ((assume == "positive" and x <= 0) or (assume == "negative" and x >= 0))


class Near:
    """One state that stays, and the linear motion near it."""

    def __init__(self, x: Examination, environment: Environment) -> None:
        self.x = x
        self.environment = environment
        self.laws = self._laws(environment)
        self.at = self.laws.at
        self.size = len(x.reference.names)

    def _laws(self, environment: Environment) -> Dynamics:
        reference = self.x.reference
        return Dynamics(reference, reference.values(environment))

    # -- that it stays --------------------------------------------------------------------------

    @cached_property
    def defined(self) -> bool:
        """Whether all forces have values there."""
        return all(value.is_finite() for value in (*self.laws.drift, *self.laws.applied))

    @cached_property
    def pull(self) -> list[arb]:
        """d/dt(dL/dq') - dL/dq - Q where q'' = 0."""
        return [e - f for e, f in zip(self.laws.drift, self.laws.applied, strict=True)]

    @cached_property
    def residual(self) -> float:
        """How far the state is from staying: constraints, and forces that none of them bears."""
        at, laws = self.at, self.laws
        reference = self.x.reference
        gaps = [at(row.value) for row in reference.rows if row.holonomic]
        gaps += [at(row.velocity) for row in reference.rows]
        pull = self.pull
        carried = list(zip(*laws.jacobian, strict=True)) or [()] * self.size
        solution = solve([list(row) for row in carried], pull, len(laws.jacobian))
        for j, row in enumerate(carried):
            left = pull[j]
            for a, m in zip(row, solution.x, strict=True):
                left = left - a * m
            gaps.append(left)
        scale = max([1.0, *map(size, pull), *map(size, laws.slopes)])
        return max([0.0, *map(size, gaps)]) / scale

    # -- the linear motion near it ------------------------------------------------------------

    @cached_property
    def regular(self) -> bool:
        """Whether the accelerations are determined there."""
        try:
            return self.laws.regular and all(a.is_finite() for a in self.laws.motion.x)
        except Unclear:
            return False

    @cached_property
    def slopes(self) -> tuple[list[list[arb]], list[list[arb]]]:
        """dq''/dq and dq''/dq', rows by acceleration."""
        columns: list[list[list[arb]]] = [[], []]
        here = self.laws.accelerations
        for primes in (0, 1):
            for name in self.x.reference.names:
                moved = {**self.environment}
                moved[name, primes] = moved[name, primes] + _STEP
                there = self._laws(moved).accelerations
                gaps = [(b - a) / _STEP for a, b in zip(here, there, strict=True)]
                columns[primes].append(gaps)
        by_q, by_v = ([list(r) for r in zip(*c, strict=True)] for c in columns)
        return by_q, by_v

    @cached_property
    def eigenvalues(self) -> list[complex]:
        """Those of J that no constraint adds."""
        n = self.size
        by_q, by_v = self.slopes
        rows = [[arb(0)] * n + [arb(int(i == j)) for j in range(n)] for i in range(n)]
        rows += [[*a, *b] for a, b in zip(by_q, by_v, strict=True)]
        found = eigenvalues(rows)
        extra = self._added
        return sorted(found, key=abs)[extra:]

    @cached_property
    def _added(self) -> int:
        rows = self.x.reference.rows
        pairs = list(zip(rows, self.laws.jacobian, strict=True))
        holonomic = [a for row, a in pairs if row.holonomic]
        return rank(self.laws.jacobian, self.size) + rank(holonomic, self.size)

    @cached_property
    def stiffness(self) -> list[float]:
        """Eigenvalues of the second derivatives of V - T_0 along the constraints, at rest."""
        n, tangent = self.size, self._tangent()
        here = self._static(self.environment)
        columns = []
        for name in self.x.reference.names:
            moved = {**self.environment}
            moved[name, 0] = moved[name, 0] + _STEP
            gaps = zip(here, self._static(moved), strict=True)
            columns.append([(b - a) / _STEP for a, b in gaps])
        K = [
            [sum((columns[j][i] * v[j] for j in range(n)), arb(0)) for v in tangent]
            for i in range(n)
        ]
        rows = [
            [sum((u[i] * K[i][k] for i in range(n)), arb(0)) for k in range(len(tangent))]
            for u in tangent
        ]
        return [value.real for value in eigenvalues(rows)]

    @property
    def is_bowl(self) -> bool:
        """Whether V - T_0 surely has a minimum there, and nothing but L and constraints acts."""
        given = self.x.problem
        pushed = given.forces or given.dissipation or any(p.force for p in given.points)
        definite = all(z.real > NOTHING for z in eigenvalues(self.laws.mass_matrix))
        return not pushed and definite and all(k > 1e-8 for k in self.stiffness)

    def _tangent(self) -> list[tuple[arb, ...]]:
        jacobian = self.laws.jacobian
        return list(solve(jacobian, [arb(0)] * len(jacobian), self.size).kernel)

    def _static(self, environment: Environment) -> list[arb]:
        """d(V - T_0)/dq - Q - sum lambda a with the multipliers of the state of rest."""
        laws = self._laws(environment)
        found = [e - f for e, f in zip(laws.drift, laws.applied, strict=True)]
        for m, row in zip(self.laws.multipliers, laws.jacobian, strict=True):
            found = [r - m * a for r, a in zip(found, row, strict=True)]
        return found


def eigenvalues(rows: Sequence[Sequence[arb]]) -> list[complex]:
    """Approximate eigenvalues of a square matrix."""
    if not rows:
        return []
    middle = [[entry.mid() for entry in row] for row in rows]
    found = arb_mat(middle).eig(algorithm="approx", nonstop=True)
    return [complex(float(z.real.mid()), float(z.imag.mid())) for z in found]
