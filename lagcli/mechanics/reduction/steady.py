"""Steady motions (relative equilibria): the cyclic coordinates turn at constant rates.

The others rest where dU_eff/dq = 0 at the momenta p of the cyclic ones, whose rates are
q_c' = dU_eff/dp_c.  The conditions are polynomials in one rate (or momentum) u, the other
quantities given: solved for u, they are a family over the places q; a factor without u
gives places for every u.

References
----------
Routh, *Stability of a Given State of Motion*, chapter IV.
Whittaker, *Analytical Dynamics*, 4th ed., sections 38, 83 and 84.
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 3.6 and 5.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for
from lagcli.algebra.factors import factors_of
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import SystemSolution, solve_system
from lagcli.mechanics.oscillations.characteristic import determinant
from lagcli.mechanics.oscillations.equilibria import (
    NO_VALUE_AT_REST,
    TIMED,
    RestPoint,
    RestPoints,
    at,
)
from lagcli.mechanics.oscillations.exceptions import without_unknowns
from lagcli.mechanics.oscillations.family import Family
from lagcli.mechanics.oscillations.held import held, one_sided
from lagcli.mechanics.reduction.readable import deciding, weak_sign
from lagcli.mechanics.reduction.routh import Routh
from lagcli.record import record, replace

_AT_SINGULAR = "the conditions hold only where the coordinates are singular"
_UNSOLVED = "the conditions of a steady motion have no closed solution"
_HIGHEST = 4  # derivative of U_eff at a singular place
_ROOT_COST = 6  # operations that a root is worth


@record
class Steady:
    """One steady motion, or a family of them.

    Attributes
    ----------
    values
        The coordinates that are fixed, and the momenta p_c, in what is free.
    rates
        q_c' by coordinate index; None where the coordinates are singular.
    positive
        It is there where each of these is > 0.
    mirrored
        It is there with all rates and momenta reversed, too.
    derivatives
        The second and higher derivatives of U_eff, of a singular place; empty elsewhere.
    family
        What ties the coordinates where the values are one branch of a family.
    """

    values: Mapping[Symbol, Expr]
    rates: Mapping[int, Expr] | None
    positive: tuple[Expr, ...] = ()
    mirrored: bool = False
    derivatives: tuple[Expr, ...] = ()
    family: Family | None = None

    @property
    def free_rates(self) -> set[Expr]:
        """Rates that are given as themselves: any value will do."""
        return {rate for rate in (self.rates or {}).values() if rate.is_Symbol}


class SteadyMotions:
    """The steady motions of a reduced system.

    Attributes
    ----------
    reason
        Why none were found, in a sentence; empty otherwise.
    complete
        Whether there can be no other, beside those at singular coordinates.
    """

    def __init__(self, routh: Routh) -> None:
        assert routh.reduced is not None
        self.routh = routh
        self.full, self.system = routh.system, routh.reduced.system
        self.dynamics = routh.reduced.dynamics
        self.rest = RestPoints(self.dynamics)
        self.reason = ""
        self.complete = True
        self._singular = False  # all that were found are where the coordinates are singular

    @cached_property
    def motions(self) -> tuple[Steady, ...] | None:
        """All that were found, each by substitution; None with a reason."""
        if self.rest.depends_on_time:
            self.reason = TIMED
            return None
        if self._sticks:
            self.reason = "static friction holds the body at rest where it can (see the equilibria)"
            return None
        if self.rest.has_no_value:
            self.reason = NO_VALUE_AT_REST
            return None
        given = self._given()
        if self.routh.cyclic and self._free:
            found = self._families()
            rest = [each for each in found if each.rates and not any(each.rates.values())]
            found += [
                place
                for place in self._at_singular_places()
                if not any(self._within(place, family) for family in rest)
            ]
        else:
            found = self._by_momenta()
        if given is not None and not any(self._is_member(given, g) for g in found):
            found.insert(0, given)
        found = [each for motion in found if (each := self._standing(motion)) is not None]
        if not found and (self._singular or not self.complete):
            self.reason = _AT_SINGULAR if self._singular else _UNSOLVED
            return None
        self.reason = ""
        return tuple(found)

    @property
    def _free(self) -> bool:
        """Without constraints, forces that have no potential, and roots in the velocities."""
        return (
            not self.dynamics.constraints.equations
            and self.routh.quadratic
            and not self._fed_by_time
            and all(is_zero(f) is True for f in self.system.applied_forces)
        )

    @property
    def _fed_by_time(self) -> bool:
        """Whether dg/dt, of the terms linear in the velocities, is a force beside -dU_eff/dq."""
        t = self.system.t
        return any(is_zero(g.diff(t)) is not True for g in self.routh.gyroscopic)

    @cached_property
    def conditions(self) -> tuple[Expr, ...]:
        """dU_eff/dq, shape (n,)."""
        return tuple(simplify(self.routh.effective_potential.diff(q)) for q in self.system.q)

    @property
    def balance(self) -> list[Expr]:
        """What vanishes, with all that acts: dU_eff/dq less the forces, along the constraints."""
        if self.rest.depends_on_time or self._sticks or self.rest.has_no_value:
            return []
        if self._free:
            return list(self.conditions)
        if self.dynamics.constraints.equations:
            return self.rest.equations
        return [simplify(-force) for force in self.rest.forces_at_rest]

    @property
    def unless(self) -> tuple[Expr, ...] | None:
        """What only values of the parameters make 0, so that there may be a steady motion."""
        return without_unknowns(self.balance, (*self.system.q, *self.routh.momenta))

    @property
    def acting(self) -> tuple[str, ...]:
        """What stands in the balance beside dU_eff/dq."""
        forces = self._fed_by_time or any(
            is_zero(f) is not True for f in self.system.applied_forces
        )
        constrained = bool(self.dynamics.constraints.equations)
        return ("forces",) * forces + ("constraints",) * constrained

    # -- one-sided contacts and dry friction ------------------------------------------------------

    @cached_property
    def _sticks(self) -> bool:
        return any(each.sticking for each in held(self.dynamics))

    @cached_property
    def _demands(self) -> tuple[tuple[Expr, bool], ...]:
        """What is not negative on the motion, and what is not 0 either, in q and q' of `full`."""
        given, constraints = self.routh.given.dynamics, self.routh.given.dynamics.constraints
        demands: list[tuple[Expr, bool]] = []
        for each in one_sided(given):
            parts = each.demands if each.given else (each.gap,)
            found = [given.on_motion(part) for part in parts if part is not None]
            demands += [(part, not each.given) for part in found if part is not None]
        solved = {} if constraints.relations is None else dict(constraints.relations.solved)
        demands += [(q, bool(q.is_positive)) for q in solved if q.is_nonnegative]
        flow = dict(zip(given.system.q, given.system.qdot, strict=True))
        for q, value in reversed([(q, v) for q, v in solved.items() if q in flow]):
            put_in = {q: value, flow[q]: given.system.total_derivative(value)}
            demands = [(part.xreplace(put_in), strict) for part, strict in demands]
        return tuple(demands)

    @property
    def singular_where(self) -> tuple[Expr, ...]:
        """What vanishes where the coordinates are singular: factors of det M."""
        full = self.routh.full
        still = dict.fromkeys(self.full.qdot, S.Zero)
        rows = [[x.xreplace(still) for x in row] for row in full.dynamics.lagrange.mass_matrix]
        whole = determinant(rows)
        factors = sympy.Mul.make_args(S.One if whole is None else whole)
        bases = [f.base if isinstance(f, sympy.Pow) else f for f in factors]
        return tuple(f for f in bases if isinstance(f, (sympy.sin, sympy.cos)))

    def _standing(self, motion: Steady) -> Steady | None:
        """The motion where every one-sided contact holds; None where one does not."""
        positive = list(motion.positive)
        for value, strict in self._pressing(motion):
            known = sign(value, positive)
            if known == -1 or (known == 0 and strict) or weak_sign(value, positive) == -1:
                return None
            positive += [value] if known is None else []
        return replace(motion, positive=tuple(dict.fromkeys(positive)))

    def _pressing(self, motion: Steady) -> list[tuple[Expr, bool]]:
        """What is not negative on it, and whether it is not 0; none where that is not known."""
        rates = motion.rates
        if rates is None:
            if any(is_zero(motion.values.get(p, p)) is not True for p in self.routh.momenta):
                return []
            rates = dict.fromkeys(self.routh.cyclic, S.Zero)
        still: dict[Expr, Expr] = dict.fromkeys(self.system.qdot, S.Zero)
        still |= {self.full.qdot[j]: rate for j, rate in rates.items()}
        try:
            found = [(at(x.xreplace(still), motion.values), strict) for x, strict in self._demands]
        except ZeroDivisionError:
            return []
        return [] if any(x.has(S.NaN, S.ComplexInfinity) for x, _ in found) else found

    def where_pressed(self, values: Mapping[Symbol, Expr]) -> tuple[Expr, ...] | None:
        """What must be positive for all one-sided contacts to press; None where one does not.

        `values` are a place, at the momenta of the cyclic coordinates.
        """
        try:
            anywhere, there = (self._pressing(Steady(x, self._rates(x))) for x in ({}, values))
        except ZeroDivisionError:
            return ()
        known = {k for k, (value, _) in enumerate(anywhere) if sign(value) == 1}
        open_ = [value for k, (value, _) in enumerate(there) if k not in known and sign(value) != 1]
        if any(sign(value) in (0, -1) or weak_sign(value) == -1 for value in open_):
            return None
        return tuple(open_)

    def grazes(self, motion: Steady) -> bool:
        """Whether nothing presses on something that is closed, so that it may open."""
        return any(is_zero(value) is True for value, _ in self._pressing(motion))

    # -- without families -------------------------------------------------------------------------

    def _by_momenta(self) -> list[Steady]:
        """The equilibria of the reduced system at given momenta."""
        points = self.rest.points
        real = [p for p in points or () if not any(x.has(sympy.I) for x in p.values.values())]
        regular = [point for point in real if self._regular(point.values)]
        self._singular = bool(points) and not regular
        # under velocity constraints others turn at rates that are no momenta's
        kinds = self.dynamics.constraints.kinds.values()
        known = points is not None and self.rest.complete
        self.complete = known and all(kind == "holonomic" for kind in kinds)
        return [
            Steady(point.values, self._rates(point.values), point.positive, family=point.family)
            for point in regular
            if -1 not in map(weak_sign, point.positive)
        ]

    def _given(self) -> Steady | None:
        """The state `initial` of the file, where it is steady."""
        build, system = self.system.build, self.system
        given = {str(name): value for name, value in self.routh.full.problem.initial.items()}
        if not given or any(q.name not in given for q in system.q):
            return None
        state = {q: build(given[q.name]) for q in system.q}
        rates = {v: build(given[v.name]) if v.name in given else S.Zero for v in self.full.qdot}
        if any(is_zero(rates[v]) is not True for v in system.qdot):
            return None
        momenta = self.routh.full.dynamics.lagrange.momenta
        values = dict(state)
        for p, j in zip(self.routh.momenta, self.routh.cyclic, strict=True):
            values[p] = at(momenta[j].xreplace(rates), state)
        try:
            if not self.rest.balanced(values) or not self._regular(values):
                return None
        except ZeroDivisionError:
            return None
        return Steady(values, self._rates(values))

    def _rates(self, values: Mapping[Symbol, Expr]) -> dict[int, Expr]:
        assert self.routh.velocities is not None
        still = dict.fromkeys(self.system.qdot, S.Zero)
        return {
            j: at(v.xreplace(still), values)
            for j, v in zip(self.routh.cyclic, self.routh.velocities, strict=True)
        }

    def _regular(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether the mass matrix of all coordinates can be inverted there."""
        still = dict.fromkeys(self.full.qdot, S.Zero)
        matrix = [
            [at(entry.xreplace(still), values) for entry in row]
            for row in self.routh.full.dynamics.lagrange.mass_matrix
        ]
        whole = determinant(matrix)
        return whole is not None and is_zero(whole) is not True

    # -- families ---------------------------------------------------------------------------------

    def _families(self) -> list[Steady]:
        """Those of the choice of the unknown with the shortest answer."""
        best: list[Steady] | None = None
        least = 0
        for unknown, chart in self._charts():
            found = self._solved(unknown, chart)
            if found is None:
                continue
            cost = sum(_cost(v) for each in found for v in each.values.values())
            if best is None or cost < least:
                best, least = found, cost
        if best is None:
            return self._by_momenta()
        return [one for one in best if not any(self._within(one, other) for other in best)]

    def _within(self, one: Steady, other: Steady) -> bool:
        """Whether a motion is one of a family in which more coordinates are free."""
        q = self.system.q
        if sum(s in one.values for s in q) <= sum(s in other.values for s in q):
            return False
        power = 2 if other.mirrored else 1
        return all(
            is_zero(one.values.get(s, s) ** power - at(value, one.values) ** power) is True
            for s, value in other.values.items()
        )

    def _is_member(self, one: Steady, family: Steady) -> bool:
        """Whether a motion is another at the same coordinates but for momenta that are free."""
        values, same = family.values, set(self.system.q) <= set(family.values)
        try:
            return same and all(
                is_zero(one.values.get(s, s) - at(value, one.values)) is True
                for s, value in values.items()
            )
        except ZeroDivisionError:
            return False

    def _charts(self) -> Iterator[tuple[Symbol, dict[Expr, Expr]]]:
        """What to solve for, and p_c by the rate of c where the rate is what is given."""
        potential = self.routh.effective_potential
        momenta, cyclic = self.routh.momenta, self.routh.cyclic
        entering = [p for p in momenta if not all(free_of(f, [p]) for f in self.conditions)]
        for p, j in zip(momenta, cyclic, strict=True):
            if p not in entering:
                continue
            rate, slope = self.full.qdot[j], simplify(potential.diff(p))
            stiffness = simplify(slope.diff(p))
            if is_zero(stiffness) is not False or not free_of(stiffness, momenta):
                continue
            chart = {p: simplify((rate - slope.xreplace({p: S.Zero})) / stiffness)}
            yield rate, chart
            for other in entering:
                if other != p:
                    yield other, chart

    def _solved(self, unknown: Symbol, chart: Mapping[Expr, Expr]) -> list[Steady] | None:
        """All steady motions by one unknown; None where a closed form is missing."""
        conditions = [simplify(c.xreplace(dict(chart))) for c in self.conditions]
        conditions = [c for c in conditions if c != 0]
        within = [c for c in conditions if not free_of(c, [unknown])]
        if not within:
            return None
        first = min(within, key=lambda c: int(sympy.count_ops(c)))
        rest = [c for c in conditions if c is not first]
        found: list[Steady] = []
        for factor, power in factors_of(first):
            if power < 0 or sign(factor) in (1, -1):
                continue
            if free_of(factor, [unknown]):
                if free_of(factor, self.system.q):
                    continue
                solved = solve_system([factor, *rest], self.system.q)
                if not solved.complete:
                    return None
                for each in solved.solutions:
                    found += self._checked(each.values, chart, each.positive)
                continue
            roots = solve_for(factor, unknown)
            if roots is None:
                return None
            for root, mirrored in _without_mirrors(roots.values, self.routh.momenta):
                root = simplify(root)
                put_in = {unknown: root}
                others = self._others([c.xreplace(put_in) for c in rest])
                if others is None:
                    return None
                for each in others:
                    value = at(root, each.values)
                    values = {**each.values, unknown: value}
                    positive = (*each.positive, *_radicands(value))
                    found += self._checked(values, chart, positive, mirrored=mirrored)
        return found

    def _others(self, conditions: list[Expr]) -> Sequence[SystemSolution] | None:
        """The other conditions solved for as many coordinates, the rest of them given."""
        for chosen in combinations(self.system.q, len(conditions)):
            solved = solve_system(conditions, chosen)
            if solved.complete and solved.solutions:
                return solved.solutions
        return None

    def _checked(
        self,
        values: Mapping[Symbol, Expr],
        chart: Mapping[Expr, Expr],
        positive: Sequence[Expr],
        *,
        mirrored: bool = False,
    ) -> list[Steady]:
        """The motion with its momenta and rates, put back into dU_eff/dq and q' = dU_eff/dp."""
        state = {q: values[q] for q in self.system.q if q in values}
        rates_given = {v: values[v] for v in self.full.qdot if v in values}
        momenta = {p: values[p] for p in self.routh.momenta if p in values}
        try:
            for p, by_rate in chart.items():
                momenta[p] = at(by_rate.xreplace({**momenta, **rates_given}), state)
            whole = {**state, **momenta}
            if not self._regular(state) or -1 in map(weak_sign, positive):
                return []
            if not all(is_zero(at(c, whole)) is True for c in self.conditions):
                self.complete = False
                return []
            rates = self._rates(whole)
            if any(x.has(sympy.I) for x in (*whole.values(), *rates.values())):
                return []
            for j, rate in rates.items():
                given = values.get(self.full.qdot[j])
                if given is not None and is_zero(rate - given) is True:
                    rates[j] = given
            return [Steady(whole, rates, tuple(positive), mirrored)]
        except ZeroDivisionError:
            return []

    # -- where the coordinates are singular -------------------------------------------------------

    def _at_singular_places(self) -> list[Steady]:
        """Where the axes of two rotations coincide: an upright top, a pendulum that hangs.

        There the mass matrix of the cyclic coordinates has null vectors v with v p = 0, and
        with these momenta U_eff is regular.
        """
        mass, q = self.routh.full.dynamics.lagrange.mass_matrix, self.system.q[0]
        if len(self.system.q) != 1:
            whole = determinant([list(row) for row in mass])
            self.complete &= whole is not None and not self._vanishes_somewhere(whole)
            return []
        block = [[simplify(mass[i][j]) for j in self.routh.cyclic] for i in self.routh.cyclic]
        whole = determinant(block)
        if whole is None or free_of(whole, [q]):
            return []
        found = []
        for factor, power in factors_of(whole):
            roots = solve_for(factor, q) if power > 0 and not free_of(factor, [q]) else None
            for root in roots.values if roots is not None else ():
                if not root.free_symbols and not (q.is_nonzero and root == 0):
                    found += self._regularized(q, root, block)
        return list({tuple(each.values.items()): each for each in found}.values())

    def _vanishes_somewhere(self, expression: Expr) -> bool:
        """Whether a factor of it may be 0 at some values of the coordinates."""
        return any(
            power > 0 and sign(factor) not in (1, -1) and not free_of(factor, self.system.q)
            for factor, power in factors_of(simplify(expression))
        )

    def _regularized(self, q: Symbol, place: Expr, block: list[list[Expr]]) -> list[Steady]:
        momenta = self.routh.momenta
        there = [[at(entry, {q: place}) for entry in row] for row in block]
        if any(entry.has(sympy.zoo, sympy.nan) for row in there for entry in row):
            return []
        rows = nullspace(there)
        conditions = [dot(row, momenta) for row in rows]
        solved = solve_system(conditions, momenta)
        if len(solved.solutions) != 1 or not solved.complete:
            return []
        [solution] = solved.solutions
        half = Symbol("#half", real=True)
        potential = self.routh.effective_potential.xreplace(dict(solution.values))
        try:
            near = simplify(potential.subs(q, place + 2 * half))
            slope, *bends = (
                simplify(at(near.diff(half, k), {half: S.Zero}) / 2**k)
                for k in range(1, _HIGHEST + 1)
            )
        except ZeroDivisionError:
            return []
        if is_zero(slope) is not True or any(b.has(sympy.zoo, sympy.nan) for b in bends):
            return []
        return [Steady({q: place, **solution.values}, None, derivatives=tuple(bends))]

    def point(self, steady: Steady) -> RestPoint:
        """The same as an equilibrium of the reduced system."""
        free = tuple(q for q in self.system.q if q not in steady.values)
        return RestPoint(steady.values, free, steady.positive, steady.family)


def _cost(value: Expr) -> int:
    powers = value.atoms(sympy.Pow)
    roots = sum(1 for power in powers if power.exp.is_Rational and power.exp.q > 1)
    return int(sympy.count_ops(value)) + _ROOT_COST * roots


def _without_mirrors(
    roots: Sequence[Expr], momenta: Sequence[Symbol]
) -> Iterator[tuple[Expr, bool]]:
    """One of x and -x where nothing else changes its sign with them."""
    seen: list[Expr] = []
    for root in sorted(roots, key=lambda root: bool(root.could_extract_minus_sign())):
        if any(is_zero(root + other) is True for other in seen):
            continue
        opposite = any(is_zero(root + other) is True for other in roots if other is not root)
        seen.append(root)
        yield root, opposite and free_of(root, momenta)


def _radicands(value: Expr) -> list[Expr]:
    """What stands under square roots and may be negative."""
    return [
        deciding(power.base)
        for power in value.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q % 2 == 0 and sign(power.base) != 1
    ]
