"""Steady motions under velocity constraints: a disk that rolls in a circle, a top that rolls.

With as many velocities as there are degrees of freedom for quasi-velocities u, the equations of
motion are u' = F(r, u), where r are the coordinates that F depends on.  A steady motion has
r' = 0 and u constant: F(r, u) = 0.  With fewer equations than unknowns it is a family; the
linearised equations then have as many roots s = 0, and the others decide.

References
----------
Neimark, Fufaev, *Dynamics of Nonholonomic Systems*, chapter VI.
Routh, *Advanced Part of a Treatise on the Dynamics of a System of Rigid Bodies*, 6th ed.,
chapter V.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import combinations, islice

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant, determinant_in
from lagcli.algebra.factors import factors_of
from lagcli.algebra.linear import rank, solve_linear
from lagcli.algebra.place import NO_VALUE, at, lies_in
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.algebra.vanishing_factors import squares_divided_by
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.minimal import integrated, minimal
from lagcli.mechanics.oscillations.small_oscillations import SmallOscillations
from lagcli.mechanics.reduction.steady_contacts import Demand, demands_on_motion, pressed
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.exceptions import without_unknowns
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.mechanics.stability.judge import GRAZES, judge
from lagcli.mechanics.stability.roots import by_polynomial
from lagcli.mechanics.stability.uniform import by_uniform_acceleration
from lagcli.mechanics.stability.verdict import Stability, undecided
from lagcli.record import record, replace

_UNIFORM = "these velocities are constant in every motion"
_DRIFTING = "the velocities that are 0 in all of it are constant in every motion"
_MOST_CHOICES = 40  # three of six coordinates have 20, of seven 35
_MOST_TRIED = 6  # measured: the second or the fourth
_MOST_DEPTH = 6  # measured: at most 2 conditions one after the other


#: The coordinates whose velocities are the u, and the other velocities by these.
Chart = tuple[tuple[int, ...], dict[Expr, Expr]]


@record
class RollingMotion:
    """A steady motion or a family: values of coordinates r and of velocities u."""

    values: Mapping[Symbol, Expr]
    positive: tuple[Expr, ...]

    @property
    def known_positive(self) -> tuple[Expr, ...]:
        """What is positive there: `positive`, and the squares of what is divided by."""
        return tuple(dict.fromkeys((*self.positive, *squares_divided_by(self.values.values()))))


class RollingMotions:
    """The steady motions of a system with velocity constraints.

    Parameters
    ----------
    derivation
        Of a system with velocity constraints, or with a force along what L does not contain.
    choice
        Which of the possible u is taken, the best one first.

    Attributes
    ----------
    reason
        Why none were looked for, in a sentence; empty otherwise.
    complete
        Whether there can be no other with these r and u.
    """

    def __init__(self, derivation: Derivation, choice: int = 0) -> None:
        self.given = derivation
        self.derivation = minimal(derivation, rolling=True)
        self.choice = choice
        self.dynamics = self.derivation.dynamics
        self.system = self.dynamics.system
        self.reason = ""
        self.complete = True

    @property
    def drives(self) -> bool:
        """Whether a constraint makes rest impossible, as phi' = w does."""
        equations = self.dynamics.constraints.equations
        return any(not e.holonomic and is_zero(e.drift) is not True for e in equations)

    # -- the equations u' = F(r, u) ---------------------------------------------------------------

    @cached_property
    def chart(self) -> Chart | None:
        """The one that is chosen."""
        return next(islice(self._charts(), self.choice, None), None)

    def _charts(self) -> Iterator[Chart]:
        """The coordinates with u for velocity, and the other velocities by these.

        Those whose matrix in the constraints has a constant determinant are eliminated, so that
        u is regular everywhere, also where the axes of the constraints turn; without any, those
        of another block: then only motions with constant axes are found.
        """
        system, constraints = self.system, self.dynamics.constraints
        rows = [constraints.equations[k] for k in self.dynamics.independent_constraints]
        n = len(system.q)
        choices = sorted(combinations(range(n), len(rows)), key=self._turns)[:_MOST_CHOICES]
        blocks = {gone: [[e.row[j] for j in gone] for e in rows] for gone in choices}
        wholes = {gone: determinant(block) for gone, block in blocks.items()}
        regular = [g for g, x in wholes.items() if x is not None and is_zero(x) is False]
        everywhere = [g for g in regular if self._constant(wholes[g] or S.Zero)]
        self.complete = bool(everywhere)  # a blade that turns: y' = x' tan(phi), but x' varies
        for gone in everywhere or regular[::-1]:
            kept = tuple(j for j in range(n) if j not in gone)
            right = [-sympy.Add(e.drift, *(e.row[j] * system.qdot[j] for j in kept)) for e in rows]
            solution = solve_linear(blocks[gone], right)
            if solution is not None and all(x is not None for x in solution.values):
                found = zip(gone, solution.values, strict=True)
                yield kept, {system.qdot[j]: x for j, x in found if x is not None}

    @cached_property
    def _chart_determinant(self) -> Expr:
        """det of the constraints in the velocities that they give: not 0 where they do."""
        constraints, kept = self.dynamics.constraints, self.chart[0] if self.chart else ()
        rows = [constraints.equations[k].row for k in self.dynamics.independent_constraints]
        gone = [j for j in range(len(self.system.q)) if j not in kept]
        return simplify(determinant([[row[j] for j in gone] for row in rows]) or S.One)

    def _turns(self, columns: Sequence[int]) -> bool:
        """Whether the factors of these velocities in the constraints change on the motion."""
        moving, equations = (*self.system.q, self.system.t), self.dynamics.constraints.equations
        return not all(free_of(e.row[j], moving) for e in equations for j in columns)

    def _constant(self, expression: Expr) -> bool:
        return free_of(simplify(expression), (*self.system.q, self.system.t))

    @cached_property
    def _equations(self) -> tuple[Expr, ...] | None:
        """F(r, u); None with a reason."""
        motion, chart = self.dynamics.motion, self.chart
        if motion is None:
            self.reason = "the accelerations were not found"
            return None
        if any(e.holonomic for e in self.dynamics.constraints.equations):
            self.reason = "a constraint on the positions is not solved"
            return None
        if chart is None:
            self.reason = "the constraints give no velocities that determine the others everywhere"
            return None
        kept, others = chart
        found = tuple(simplify(motion.accelerations[j].xreplace(others)) for j in kept)
        if not all(free_of(f, [self.system.t]) for f in found):
            self.reason = "the system depends explicitly on the time"
            return None
        return found

    @cached_property
    def coordinates(self) -> tuple[int, ...]:
        """r: the coordinates that F depends on."""
        return tuple(
            j
            for j, q in enumerate(self.system.q)
            if not all(free_of(f, [q]) for f in self._equations or ())
        )

    @cached_property
    def velocities(self) -> tuple[int, ...]:
        """u, by its coordinates."""
        assert self.chart is not None
        return self.chart[0]

    @cached_property
    def turning(self) -> tuple[int, ...]:
        """The u that need not vanish."""
        return tuple(j for j in self.velocities if j not in self.coordinates)

    @property
    def _still(self) -> dict[Symbol, Expr]:
        """r' = 0."""
        return {self.system.qdot[j]: S.Zero for j in self.coordinates}

    @cached_property
    def conditions(self) -> dict[int, Expr]:
        """What vanishes in a steady motion, by the coordinate of the equation.

        d'Alembert's principle with u' = 0: B^T (M B' u - forcing), where q' = B u.
        """
        if self.chart is None or self._equations is None:
            return {}
        system, lagrange = self.system, self.dynamics.lagrange
        kept, others = self.chart
        along = [others.get(v, v).xreplace(self._still) for v in system.qdot]
        bent = [dot((v.diff(q) for q in system.q), along) for v in along]
        left = [
            dot(row, bent) - force
            for row, force in zip(lagrange.mass_matrix, lagrange.forcing, strict=True)
        ]
        flow = {system.qdot[j]: v for j, v in enumerate(along)}
        left = [each.xreplace(flow) for each in left]
        free = [system.qdot[j] for j in kept]
        slopes = [[others.get(v, v).diff(u) for v in system.qdot] for u in free]
        return {j: simplify(dot(slope, left)) for j, slope in zip(kept, slopes, strict=True)}

    @property
    def unless(self) -> tuple[Expr, ...] | None:
        """What only values of the parameters make 0, so that there may be a steady motion."""
        return without_unknowns(list(self.conditions.values()), (*self.system.q, *self.system.qdot))

    # -- the motions ------------------------------------------------------------------------------

    @cached_property
    def motions(self) -> tuple[RollingMotion, ...] | None:
        """All that were found, each by substitution; None with a reason."""
        if self._equations is None:
            return None
        assert self.chart is not None
        _, others = self.chart
        still = {j for j, v in enumerate(self.system.qdot) if others.get(v) == 0}
        if not set(self.coordinates) <= {*self.velocities, *still}:
            self.reason = "the equations depend on coordinates whose velocities are eliminated"
            return None
        found: list[RollingMotion] = []
        solved = self._solved(list(self.conditions.values()), {}, (), 0)
        standing = (self._standing(each) for each in solved if self._holds(each.values))
        for each in standing:
            if each is not None and not any(_within(each, other) for other in found):
                found = [other for other in found if not _within(other, each)] + [each]
        if not found and not self.complete:
            self.reason = "the conditions could not be solved"
            return None
        return tuple(found)

    def _solved(
        self,
        conditions: Sequence[Expr],
        values: Mapping[Symbol, Expr],
        positive: tuple[Expr, ...],
        depth: int,
    ) -> Iterator[RollingMotion]:
        """The branches, a velocity that is linear in a condition solved for first."""
        open_ = [c for c in dict.fromkeys(self._put(values, conditions)) if c != 0]
        if any(c.has(*NO_VALUE) for c in open_):  # no value there
            return
        if not open_:
            there = tuple(self._put(values, positive))
            if not {0, -1} & set(map(sign, there)):
                yield RollingMotion(values, there)
            return
        if depth > _MOST_DEPTH:
            self.complete = False
            return
        first = min(open_, key=lambda c: int(sympy.count_ops(c)))
        rest = [c for c in open_ if c is not first]
        turning = [self.system.qdot[j] for j in self.turning]
        for factor, power in factors_of(first):
            if power < 0 or sign(factor) in (1, -1):
                continue
            linear = [(u, simplify(factor.diff(u))) for u in turning if not free_of(factor, [u])]
            linear = [(u, slope) for u, slope in linear if free_of(slope, [u])]
            if linear:
                u, slope = min(linear, key=lambda pair: int(sympy.count_ops(pair[1])))
                constant = simplify(factor.xreplace({u: S.Zero}))
                yield from self._solved(
                    rest, self._with(values, {u: simplify(-constant / slope)}), positive, depth + 1
                )
                if sign(slope) not in (1, -1) and not slope.is_number:
                    more = [slope, constant, *rest]
                    yield from self._solved(more, values, positive, depth + 1)
                continue
            yield from self._by_coordinates(factor, rest, values, positive, depth)

    def _by_coordinates(
        self,
        factor: Expr,
        rest: Sequence[Expr],
        values: Mapping[Symbol, Expr],
        positive: tuple[Expr, ...],
        depth: int,
    ) -> Iterator[RollingMotion]:
        system = self.system
        unknowns = [system.qdot[j] for j in self.turning] + [system.q[j] for j in self.coordinates]
        present = [x for x in unknowns if not free_of(factor, [x])]
        for x in present:
            solved = solve_system([factor], [x])
            if not solved.complete:
                continue
            for each in solved.solutions:
                conditions = (*positive, *each.positive)
                yield from self._solved(
                    rest, self._with(values, each.values), conditions, depth + 1
                )
            return
        self.complete &= not present

    def _put(self, values: Mapping[Symbol, Expr], conditions: Sequence[Expr]) -> list[Expr]:
        try:
            return [at(c, values) for c in conditions]
        except ZeroDivisionError:
            return [S.One]  # the equations are singular there

    def _with(
        self, values: Mapping[Symbol, Expr], new: Mapping[Symbol, Expr]
    ) -> dict[Symbol, Expr]:
        return {**{x: at(value, new) for x, value in values.items()}, **new}

    def _holds(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether F vanishes there; not known where the coordinates are singular.

        At a pole, where F has no derivatives, only rest counts: a rate may turn nothing there.
        """
        try:
            rates = [at(f.xreplace(self._still), values) for f in self._equations or ()]
        except ZeroDivisionError:
            rates = [S.NaN]
        self.complete &= not any(f.has(*NO_VALUE) for f in rates)
        if not all(is_zero(f) is True for f in rates):
            return False
        if self._moves(values) and self._jacobian(values) is None:
            self.complete = False
            return False
        return True

    def _standing(self, motion: RollingMotion) -> RollingMotion | None:
        """The motion where the chart is regular and all contacts hold; None where one does not."""
        assert self.chart is not None
        constant = {self.system.q[j] for j in self.coordinates} | {*self.system.parameters}
        factors = (f for f, _ in factors_of(at(self._chart_determinant, motion.values)))
        squares = [f**2 for f in factors if f.free_symbols <= constant and not f.is_number]
        regular = [f for f in squares if sign(f) != 1 and f not in motion.known_positive]
        positive = pressed(self._pressing(motion.values), (*motion.positive, *regular))
        return None if positive is None else replace(motion, positive=positive)

    def _pressing(self, values: Mapping[Symbol, Expr]) -> list[Demand]:
        """What the one-sided contacts demand there, where it has a value."""
        assert self.chart is not None
        try:
            found = [
                (at(x.xreplace(self.chart[1]).xreplace(self._still), values), strict)
                for x, strict in self._demands
            ]
        except ZeroDivisionError:
            return []
        return [(x, strict) for x, strict in found if not x.has(*NO_VALUE)]

    @cached_property
    def _demands(self) -> tuple[Demand, ...]:
        return demands_on_motion(self.given.dynamics)

    def _moves(self, values: Mapping[Symbol, Expr]) -> bool:
        return any(values.get(self.system.qdot[j]) != 0 for j in self.turning)

    # -- stability --------------------------------------------------------------------------------

    def verdict(self, motion: RollingMotion) -> tuple[Stability, tuple[Expr, ...]]:
        """By the roots s of the linearised equations, those that are not 0 along the family.

        By energy, too, where the constraints can be integrated and put into L.
        """
        if not any(self._equations or ()):
            return Stability(stable=True, reason=_UNIFORM), ()
        if self._drifts_uniformly:
            return Stability(stable=True, reason=_DRIFTING, across=True), ()
        if any(is_zero(value) is True for value, _ in self._pressing(motion.values)):
            return undecided(GRAZES), ()
        jacobian = self._jacobian(motion.values)
        powers = None if jacobian is None else _characteristic(jacobian)
        if powers is None:
            found = undecided("the linearised equations were not found")
            return self._at_rest(motion, found) or found, ()
        found, squares = by_polynomial(
            powers, motion.known_positive, dimension=self._dimension(motion)
        )
        if found.is_open and (leaving := by_uniform_acceleration(self.dynamics)):
            return leaving, squares
        return self._by_energy(motion) or self._at_rest(motion, found) or found, squares

    @property
    def _drifts_uniformly(self) -> bool:
        """Whether F(r, u) is 0 where r' = 0, and r'' is 0 everywhere.

        Then the distance |r'| of a motion to the steady ones is constant.
        """
        rates = zip(self.velocities, self._equations or (), strict=True)
        return not any(self.conditions.values()) and not any(
            f != 0 for j, f in rates if j in self.coordinates
        )

    def _at_rest(self, motion: RollingMotion, found: Stability) -> Stability | None:
        """The verdict on the equilibrium that it is, unless the roots alone decide."""
        moves = self._moves(motion.values)
        rest = None if moves else self._equilibria.verdict_at(motion.values)
        return None if rest is None or (rest.is_open and not found.is_open) else rest

    @cached_property
    def _equilibria(self) -> SmallOscillations:
        return SmallOscillations(self.dynamics)

    def _by_energy(self, motion: RollingMotion) -> Stability | None:
        """The verdict on rest in the coordinates that are left; None of other motions."""
        if self.turning or self._integrated is None:
            return None
        point = RestPoint(motion.values, (), motion.positive)
        return judge(Linearization(RestPoints(self._integrated.dynamics), point))

    @cached_property
    def _integrated(self) -> Derivation | None:
        return integrated(self.derivation)

    def _dimension(self, motion: RollingMotion) -> int:
        """Of the steady motions near it: a manifold where the conditions have full rank."""
        system = self.system
        unknowns = [system.q[j] for j in self.coordinates]
        unknowns += [system.qdot[j] for j in self.turning]
        conditions = [c for c in self.conditions.values() if c != 0]
        slopes = [[at(c.diff(x), motion.values) for x in unknowns] for c in conditions]
        if slopes and rank(slopes) == len(conditions):
            return len(unknowns) - len(conditions)
        return sum(1 for x in unknowns if x not in motion.values)

    def _jacobian(self, values: Mapping[Symbol, Expr]) -> list[list[Expr]] | None:
        """J of the linearised equations of r and u; None where F has no derivatives."""
        system = self.system
        state = [system.q[j] for j in self.coordinates] + [system.qdot[j] for j in self.velocities]
        flow = [system.qdot[j] for j in self.coordinates] + list(self._equations or ())
        slopes = [[f.diff(x).xreplace(self._still) for x in state] for f in flow]
        with suppress(ZeroDivisionError):
            there = [[at(slope, values) for slope in row] for row in slopes]
            return None if any(s.has(*NO_VALUE) for row in there for s in row) else there
        return None


def rolling_motions(derivation: Derivation) -> RollingMotions:
    """With the first u by which steady motions are found, else with the best one."""
    best = RollingMotions(derivation)
    if best.motions is None and best.chart is not None:
        for choice in range(1, _MOST_TRIED):
            other = RollingMotions(derivation, choice)
            if other.chart is None:
                break
            if other.motions is not None:
                return other
    return best


def _characteristic(jacobian: Sequence[Sequence[Expr]]) -> list[Expr] | None:
    """The coefficients of det(s - J) by powers of s, simplified."""
    s = Symbol("#s", real=True)
    matrix = [
        [(s if a == b else S.Zero) - entry for b, entry in enumerate(row)]
        for a, row in enumerate(jacobian)
    ]
    powers = determinant_in(s, matrix)
    return None if powers is None else [simplify(c) for c in powers]


def _within(one: RollingMotion, other: RollingMotion) -> bool:
    """Whether a motion is one of a family, or that family solved for something else."""
    if len(one.values) < len(other.values) or not {*other.positive} <= {*one.positive}:
        return False
    try:
        return lies_in(other.values, one.values)
    except ZeroDivisionError:
        return False
