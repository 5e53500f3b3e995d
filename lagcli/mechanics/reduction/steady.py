"""Steady motions (relative equilibria): the cyclic coordinates turn at constant rates.

The others rest where dU_eff/dq = 0 at the momenta p of the cyclic ones, whose rates are
q_c' = dU_eff/dp_c.

References
----------
Routh, *Stability of a Given State of Motion*, chapter IV.
Whittaker, *Analytical Dynamics*, 4th ed., section 38.
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 3.6 and 5.7.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy
from sympy import Expr, S

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.determinants import determinant
from lagcli.algebra.place import at, lies_in
from lagcli.mechanics.reduction.coinciding_axes import CoincidingAxes
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady_contacts import SteadyContacts
from lagcli.mechanics.reduction.steady_families import SteadyFamilies
from lagcli.mechanics.reduction.steady_motion import Steady
from lagcli.mechanics.rest.equilibria import (
    EVERYWHERE,
    NO_VALUE_AT_REST,
    REACHED,
    TIMED,
    RestPoints,
    not_specified,
)
from lagcli.mechanics.rest.exceptions import with_a_value, without_unknowns
from lagcli.mechanics.rest.held import held
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.rest_conditions import RestPoint, given_formulas
from lagcli.mechanics.rest.singular import singular

_UNSOLVED = "no closed solution of the conditions of a steady motion was found"
_STEADY_EVERYWHERE = "no force acts then, so every position that the constraints allow is steady"
_ONLY_AT_REST = "under velocity constraints only states of rest were sought, and {} is none"


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
        self.contacts = SteadyContacts(routh)
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
        by_rates = self.routh.cyclic and self._without_forces and not self.only_rest_is_sought
        found = self._families() if by_rates else self._by_momenta()
        if given is not None and not any(given.member_of(each, self.system.q) for each in found):
            found.insert(0, given)
        standing = map(self.contacts.standing, found)
        found = [each for each in standing if each is not None]
        if any(self.point(each).depends_on_time(self.system.t) for each in found):
            self.reason = REACHED
            return None
        if not found and self.everywhere:
            self.reason = _STEADY_EVERYWHERE if self.routh.cyclic else EVERYWHERE
            return None
        if not found and (self._singular or not self.complete):
            unsolved = not_specified(self.system, self.rest.equations) or _UNSOLVED
            if self._solved and self.only_rest_is_sought:
                unsolved = _ONLY_AT_REST.format("in general there" if self.unless else "there")
            where = f"the conditions hold only where {singular(self.dynamics)} singular"
            self.reason = where if self._singular else unsolved
            return None
        self.reason = ""
        return tuple(found)

    @property
    def everywhere(self) -> bool:
        """Whether every position that the constraints allow is one of a steady motion."""
        return self.rest.points is None and self.rest.reason == EVERYWHERE

    @property
    def _solved(self) -> bool:
        """Whether all states of rest are known."""
        return self.rest.points is not None and self.rest.complete

    @property
    def only_rest_is_sought(self) -> bool:
        """Under velocity constraints: some states turn at rates that are no momenta's."""
        return any(kind != "holonomic" for kind in self.dynamics.constraints.kinds.values())

    def _is_alone(self, point: RestPoint) -> bool:
        """Whether, on its surface of integrable constraints, no state of rest is next to it.

        The constraints are then those of positions, and nothing turns or glides through rest.
        """
        constraints = self.dynamics.constraints
        if constraints.nonholonomic:
            return False
        if any(is_zero(e.drift) is not True for e in constraints.equations):
            return False
        try:
            stiffness = determinant(Linearization(self.rest, point).K)
        except ZeroDivisionError:
            return False
        return stiffness is not None and is_zero(stiffness) is False

    @property
    def _without_forces(self) -> bool:
        """Without forces that have no potential, and roots in the velocities."""
        return (
            self.routh.quadratic
            and not self._fed_by_time
            and all(is_zero(f) is True for f in self.system.applied_forces)
        )

    @property
    def _fed_by_time(self) -> bool:
        """Whether dg/dt, of the terms linear in the velocities, is a force beside -dU_eff/dq."""
        t = self.system.t
        return any(is_zero(g.diff(t)) is not True for g in self.routh.gyroscopic)

    @property
    def balance(self) -> list[Expr]:
        """What vanishes, with all that acts: dU_eff/dq less the forces, along the constraints."""
        if self.rest.depends_on_time or self._sticks or self.rest.has_no_value:
            return []
        if self.dynamics.constraints.equations:
            return self.rest.equations
        if self._without_forces:
            return list(self.routh.balance)
        return [simplify(-force) for force in self.rest.forces_at_rest]

    @property
    def unless(self) -> tuple[Expr, ...] | None:
        """What only values of the parameters make 0, so that there may be a steady motion."""
        found = without_unknowns(
            (*self.balance, *self.rest.sums), (*self.system.q, *self.routh.momenta)
        )
        return with_a_value(found, given_formulas(self.routh.given.dynamics))

    @property
    def acting(self) -> tuple[str, ...]:
        """What stands in the balance beside dU_eff/dq."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        forces = self._fed_by_time or any(
            is_zero(f.xreplace(still)) is not True for f in self.system.applied_forces
        )
        constrained = bool(self.dynamics.constraints.equations)
        return ("forces",) * forces + ("constraints",) * constrained

    @cached_property
    def _sticks(self) -> bool:
        return any(each.sticking for each in held(self.dynamics))

    def _families(self) -> list[Steady]:
        """Those at given places or rates, and where the coordinates are singular."""
        families = SteadyFamilies(self.routh, self.balance)
        found = families.motions()
        self.complete = families.complete
        if found is None:
            found = self._by_momenta()
        if self.dynamics.constraints.equations:
            return found
        found += self._rest_without_forces(found)
        rest = [each for each in found if each.rates and not any(each.rates.values())]
        axes = CoincidingAxes(self.routh)
        found += [
            place
            for place in axes.motions()
            if not any(place.within(family, self.system.q) for family in rest)
        ]
        self.complete &= axes.complete
        return found

    def _rest_without_forces(self, found: Sequence[Steady]) -> list[Steady]:
        """Rest at every position where no force acts at rest, unless it is in a family found."""
        none = dict.fromkeys((*self.routh.momenta, *self.full.qdot), S.Zero)
        if not all(is_zero(c.xreplace(none)) is True for c in self.balance):
            return []
        everywhere = [m for m in found if not (m.positive or set(m.values) & set(self.system.q))]
        if any(lies_in(motion.values, none) for motion in everywhere):
            return []
        momenta = dict.fromkeys(self.routh.momenta, S.Zero)
        rates = self.routh.rates_at(momenta)
        return [] if any(rates.values()) else [Steady(momenta, rates)]

    def _by_momenta(self) -> list[Steady]:
        """The equilibria of the reduced system at given momenta."""
        points = self.rest.points
        real = [p for p in points or () if not any(x.has(sympy.I) for x in p.values.values())]
        regular = [point for point in real if self.routh.regular_at(point.values)]
        self._singular = bool(points) and not regular
        alone = bool(regular) and all(map(self._is_alone, regular))
        sought = alone or not self.only_rest_is_sought
        self.complete = self._solved and sought and len(regular) == len(real)
        return [
            Steady(
                point.values, self.routh.rates_at(point.values), point.positive, family=point.family
            )
            for point in regular
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
            if not self.rest.balanced(values) or not self.routh.regular_at(values):
                return None
        except ZeroDivisionError:
            return None
        return Steady(values, self.routh.rates_at(values))

    def point(self, steady: Steady) -> RestPoint:
        """The same as an equilibrium of the reduced system."""
        free = tuple(q for q in self.system.q if q not in steady.values)
        return RestPoint(steady.values, free, steady.known_positive, steady.family)
