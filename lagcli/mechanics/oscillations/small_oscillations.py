"""Equilibria with their stability, and the normal modes about them.

    (K - omega^2 M) a = 0

Modes are given about every equilibrium that is not unstable, or about the unstable ones
where there is no other.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 6.2 to 6.4.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 23.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import combinations

import sympy
from sympy import Expr, I, S, Symbol, acos, im

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.conjugate_roots import (
    with_number_turned,
    with_positive_factors,
    without_root_below,
)
from lagcli.algebra.decimals import written
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of, vanishing_part
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import fraction
from lagcli.expression import ZERO, Call, Expression, Power, Quotient, length, sum_of, walk
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.oscillations.discriminant import Rewrite, with_discriminants
from lagcli.mechanics.oscillations.family_statement import relation_sides, shown, untied
from lagcli.mechanics.oscillations.normal_modes import (
    NormalMode,
    infinite_where,
    never_oscillates,
    normal_modes,
)
from lagcli.mechanics.oscillations.reduced_verdict import ReducedVerdict
from lagcli.mechanics.rest.characteristic import Characteristic
from lagcli.mechanics.rest.equilibria import (
    EVERYWHERE,
    REACHED,
    TIMED,
    RestPoints,
)
from lagcli.mechanics.rest.exceptions import alternatives_written, unless_written
from lagcli.mechanics.rest.held import HeldCombination, held
from lagcli.mechanics.rest.linearization import Linearization, Matrix
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.mechanics.rest.singular import AtPole, OnMeridians, at_pole, is_singular, singular
from lagcli.mechanics.stability.judge import (
    DRIFTS,
    EXCLUDED,
    GRAZES,
    NEUTRAL,
    NO_MOTION,
    judge,
    judge_on_average,
    judge_on_meridians,
)
from lagcli.mechanics.stability.statement import held_by_gyroscopic_terms, potential_of, stated
from lagcli.mechanics.stability.verdict import Stability, undecided
from lagcli.mechanics.theorems import KELVIN_TAIT_CHETAEV, LAGRANGE_DIRICHLET
from lagcli.record import replace
from lagcli.statements.answers import (
    EquilibriaSection,
    Equilibrium,
    ModesOfFrequency,
    ModesSection,
    Pole,
)

#: How many times as long an amplitude may be with its root above the line.
_ABOVE = 1.25
_STICKS = "static friction holds it with force to spare"
_KINK = f"{{V}} has a strict minimum there ({LAGRANGE_DIRICHLET.name})"
_PRESSED = "it is pressed against what it touches"
_HELD = "contacts, static friction or kinks of the potential hold what is at rest"
_LIMIT = "a force is at its limit there"
_NO_LINEAR_PART = "a force has a kink or a jump at the equilibrium, and no linear part"
_NOT_KNOWN = "no equilibrium is known to expand about"
_NO_MODES = "the equilibria do not exist for the values of the file"
_NO_OSCILLATION = "no root ω² of the characteristic polynomial is real and positive"


def equilibria(dynamics: Dynamics) -> EquilibriaSection:
    """The states of rest with their stability."""
    oscillations = SmallOscillations(dynamics)
    rest, order = oscillations.rest, dynamics.system.order
    places = oscillations.places
    if rest.reason == EVERYWHERE:
        return EquilibriaSection(equilibria=None, reason=EVERYWHERE, everywhere=True)
    alone = rest.is_unsolved and len(oscillations.held) == 1
    is_solved = oscillations.complete or (places is None and not alone)
    unsolved = () if is_solved else rest.conditions
    open_ = tuple(written(vanishing_part(e), order) for e in unsolved)
    if places is None:
        return EquilibriaSection(equilibria=None, reason=rest.reason, open=open_)
    several = [] if places else [each.rest.unless for each in oscillations.held]  # contacts closed
    unless = several[0] if len(several) == 1 else None if any(x != () for x in several) else ()
    return EquilibriaSection(
        equilibria=tuple(map(oscillations.equilibrium, places)),
        periods={
            q.name: written(period, order)
            for q, period in rest.periods.items()
            if any(q in place.point.values for place in places)
        },
        complete=oscillations.complete,
        reason=TIMED if rest.depends_on_time else "",
        at_all_times=rest.depends_on_time,
        void=alternatives_written(_void(oscillations) if places else [], order),
        degenerate=alternatives_written(rest.balance.degenerate if places else [], order),
        edge=() if places else rest.edge,
        where=rest.restricted_to,
        open=open_,
        unless=unless_written(unless, order),
    )


def _void(oscillations: SmallOscillations) -> list[Expr]:
    """What may be 0, and every position is an equilibrium then, without contacts or friction."""
    rest = oscillations.rest
    limited = len(oscillations.held) > 1 or any(
        place.held.firmly for place in oscillations.places or ()
    )
    return [] if limited or rest.restricted_to else rest.balance.void


def modes(dynamics: Dynamics) -> ModesSection:
    """The normal modes about the equilibria that are not unstable, else about all."""
    oscillations = SmallOscillations(dynamics)
    places = oscillations.places
    if oscillations.rest.reason == EVERYWHERE:  # with every frequency 0
        return ModesSection(modes=(), reason=EVERYWHERE)
    if places is None:
        return ModesSection(
            modes=None, reason=f"no equilibrium is known ({oscillations.rest.reason})"
        )
    if not places:
        if not oscillations.complete:
            return ModesSection(modes=None, reason=_NOT_KNOWN)
        general = "in general " * any(each.rest.unless != () for each in oscillations.held)
        rest = oscillations.rest
        here = " in these coordinates" * bool(rest.edge or rest.restricted_to)
        none = f"{general}there is no equilibrium{here} to expand about"
        return ModesSection(modes=(), reason=none)
    chosen = [p for p in places if p.verdict.stable is not False] or places
    found = [mode for place in chosen for mode in oscillations.modes(place)]
    if not found and all(not place.linear.M and not place.held.firmly for place in places):
        return ModesSection(modes=(), reason=EXCLUDED)
    if not found and all(place.held.firmly and not place.linear.M for place in chosen):
        return ModesSection(modes=(), reason=_HELD)
    if oscillations.rest.depends_on_time:
        return ModesSection(modes=(), reason=TIMED)
    if not found and all(place.held.grazes(place.point) for place in chosen):
        return ModesSection(modes=(), reason=GRAZES)
    if not found:
        reason = _why_none(chosen)
        return ModesSection(modes=() if reason == _NO_OSCILLATION else None, reason=reason)
    unshaped = any(place.unshaped for place in chosen)
    return ModesSection(modes=tuple(found), complete=oscillations.complete, unshaped=unshaped)


def _why_none(places: Sequence[Place]) -> str:
    if any(place.linear.drifts for place in places):
        return DRIFTS
    if all(place.at_singular_coordinates for place in places):
        return f"{singular(places[0].linear.dynamics)} singular at the equilibria"
    if not all(place.linear.smooth for place in places):
        return _NO_LINEAR_PART
    if any(place.verdict.reason == NO_MOTION for place in places):
        return NO_MOTION
    pairs = [(r, p.point.positive) for p in places for r, *_ in p.characteristic.squares or ()]
    open_ = [r for r, positive in pairs if r is None or not never_oscillates(r, positive)]
    if pairs and all(r is not None and all(W.has(I) for W in r) for r in open_):
        known = all(sign(im(W)) in (1, -1) for r in open_ for W in r or ())
        return "in general " * (not known) + _NO_OSCILLATION
    return _NO_MODES


class Place:
    """One equilibrium with the motion near it."""

    def __init__(self, held: HeldCombination, point: RestPoint, apart: HeldCombination) -> None:
        self.held, self.point, self._apart = held, point, apart  # `apart`: no contact is closed
        self.linear = Linearization(held.rest, point)

    @cached_property
    def near(self) -> Linearization:
        """The linear motion in regular coordinates, where they are known."""
        pole = at_pole(self.linear) if self.at_singular_coordinates else None
        return pole or self.linear

    @cached_property
    def characteristic(self) -> Characteristic:
        """Of the linear motion."""
        return Characteristic(self.near)

    @property
    def matrices(self) -> tuple[Matrix, Matrix, Matrix]:
        """M, C and K, of a family in all coordinates where they can be."""
        linear, known = self.near, self.point.family
        if known is None:
            return linear.M, linear.C, linear.K
        M, C, K = (
            [[known.written_back(e) or e for e in row] for row in matrix]
            for matrix in (linear.M, linear.C, linear.K)
        )
        return M, C, K

    @cached_property
    def verdict(self) -> Stability:
        """Whether it is stable."""
        if self.held.rest.depends_on_time:
            return judge_on_average(self.linear) or undecided(TIMED)
        if self.point.depends_on_time(self.linear.system.t):
            return undecided(REACHED)
        if self.held.grazes(self.point):
            found = self._without_contacts or self._without_forces or self._along_contacts
            return found or undecided(_LIMIT if self.held.kinked else GRAZES)
        if (held := self.held).firmly and not self.linear.M:
            reason = _STICKS if held.sticking else _KINK if held.kinked else _PRESSED
            return Stability(stable=True, reason=reason)
        if self.at_singular_coordinates:
            return judge_on_meridians(OnMeridians(self.linear))
        found = judge(self.linear, self.characteristic)
        return replace(found, asymptotic=False) if self.held.firmly else found

    @property
    def _without_contacts(self) -> Stability | None:
        """At a strict minimum of V it is stable with walls, too, which feed no energy."""
        if self.held.sticking or self.held.kinked or self._apart.demands:
            return None
        found = Place(self._apart, self.point, self._apart).verdict
        minimum = found.stable and found.by in (LAGRANGE_DIRICHLET, KELVIN_TAIT_CHETAEV)
        return replace(found, asymptotic=False) if minimum else None

    @property
    def _without_forces(self) -> Stability | None:
        """Where nothing pulls anywhere, what strikes a wall moves on, no faster than before."""
        if self.held.sticking or self.held.kinked or self._apart.demands:
            return None
        for point in self._apart.points() or ():
            found = Place(self._apart, point, self._apart).verdict
            if not point.values and found.stable:
                return Stability(stable=True, reason=NEUTRAL, released=True, neutral=True)
        return None

    @property
    def _along_contacts(self) -> Stability | None:
        """Unstable where a motion leaves to one side on which all contacts press to first order."""
        linear, held = self.linear, self.held
        if held.sticking or held.kinked or len(linear.basis) != 1:
            return None
        found, system = judge(linear), linear.system
        signs: set[int | None] = set()
        state = {**dict.fromkeys(system.qdot, S.Zero), **self.point.values}
        for demand in held.demands:
            on_motion = linear.dynamics.on_motion(demand)
            if on_motion is None or found.stable is not False:
                return None
            if is_zero(at(on_motion, state)) is True:
                rates = [at(on_motion.diff(v), state) for v in system.qdot]
                slope = dot(linear.basis[0], [at(on_motion.diff(q), state) for q in system.q])
                signs.add(None if any(rates) else sign_of(slope, self.point.positive))
        return found if signs in ({1}, {-1}) else None

    @property
    def at_singular_coordinates(self) -> bool:
        """Whether the mass matrix has null vectors there."""
        try:
            return is_singular(self.linear)
        except ZeroDivisionError:
            return False

    @property
    def indeterminate(self) -> frozenset[Symbol]:
        """Coordinates that have no value there, as the azimuth at a pole."""
        if not self.at_singular_coordinates:
            return frozenset()
        gone = OnMeridians(self.linear).indeterminate
        return frozenset(self.linear.system.q[j] for j in gone)

    @property
    def without_indeterminate(self) -> Mapping[Symbol, Expr] | None:
        """The values without an azimuth that a pole has not; None where it has none of these."""
        values, gone = self.point.values, self.indeterminate
        rest = {q: value for q, value in values.items() if q not in gone}
        return rest if len(rest) < len(values) else None

    @cached_property
    def modes(self) -> list[NormalMode]:
        """The normal modes, each verified; empty where the motion is singular."""
        try:
            if (
                self.held.rest.depends_on_time
                or not self.near.regular
                or not self.linear.smooth
                or self.linear.drifts
                or self.held.grazes(self.point)
            ):
                return []
            return normal_modes(self.near, self.characteristic)
        except ZeroDivisionError:
            return []

    @property
    def unshaped(self) -> bool:
        """Whether the shape of a mode is real and was not found."""
        if self.near.gyroscopic:
            return False
        known = (mode for mode in self.modes if mode.square is not None and not mode.damped)
        return any(not mode.shapes and not mode.square.has(acos) for mode in known if mode.square)


class SmallOscillations:
    """Equilibria and modes as statements."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system
        self.held = held(dynamics)
        self.rest = self.held[0].rest
        self.reduced = ReducedVerdict(dynamics, self.rest)

    @cached_property
    def places(self) -> list[Place] | None:
        """The equilibria; None where the equations could not be solved."""
        found = [(each, each.points()) for each in self.held]
        if all(points is None for _, points in found):
            return None
        places = [
            Place(each, point, self.held[0]) for each, points in found for point in points or ()
        ]
        known = [place.point.values for place in places]
        return [place for place in places if place.without_indeterminate not in known]

    @property
    def excluded(self) -> tuple[Mapping[str, Expression], ...]:
        """Where forces balance, and a contact would have to pull."""
        kept = [place.point.values for place in self.places or ()]
        found = (point for each in self.held for point in each.excluded())
        places = (self._at(p) for p in found if p.values not in kept and p.family is None)
        return tuple({tuple(at.items()): at for at in places if at}.values())

    @property
    def complete(self) -> bool:
        """Whether there can be no other."""
        return all(each.rest.complete and each.rest.points is not None for each in self.held)

    def equilibrium(self, place: Place) -> Equilibrium:
        """One equilibrium as a statement."""
        verdict, potential = place.verdict, potential_of(RestPoints(self.dynamics))
        bound = place.held.firmly or place.held.grazes(place.point)
        one_sided = verdict.across and bool(verdict.minimum) and not verdict.reverses
        sought = (verdict.is_open or one_sided or verdict.neutral) and not bound
        reduced = self.reduced.of(place.point) if sought else None
        if reduced is not None:
            verdict, potential = reduced, "U_eff" if self.reduced.cyclic else potential
        linear, order = place.linear, self.system.order
        free, gone = untied(place.point, self.system.q), place.indeterminate
        return Equilibrium(
            at=self._at(place.point),
            on=relation_sides(place.point, self.system.q, order),
            verdict=stated(
                verdict,
                order,
                place.point.positive,
                potential=potential,
                gyroscopic=held_by_gyroscopic_terms(linear),
            ),
            where=conditions(place.point.positive, order),
            free=tuple(q.name for q in free if q not in gone),
            indeterminate=tuple(q.name for q in free if q in gone),
            touching=place.held.closed,
            taut=tuple(name for name in place.held.closed if name in self._strings),
            open=place.held.open,
            sticking=place.held.sticking,
            kinked=place.held.kinked,
        )

    @property
    def _strings(self) -> set[str]:
        return {c.name for c in self.system.problem.constraints if c.acts_as == "tension"}

    def modes(self, place: Place) -> list[ModesOfFrequency]:
        """The modes about one equilibrium as statements."""
        if not place.modes:
            return []
        linear = place.near
        known = with_discriminants(linear.M, linear.K, self.system.order, self.system.build)

        def positive(tree: Expression) -> Expression:
            return with_positive_factors(known(tree), self.system.build, place.point.positive)

        alike = self._alike(place.modes)
        pole = self._pole(linear) if isinstance(linear, AtPole) else None
        return [
            ModesOfFrequency(
                at=self._at(place.point),
                on=relation_sides(place.point, self.system.q, self.system.order),
                frequency=self._below_damping(mode)
                or alike.get(k)
                or self._tree_or_none(mode.frequency, positive),
                frequency_squared=None if mode.damped else self._tree_or_none(mode.square, known),
                decay=None if mode.decay is None else self._tree(mode.decay),
                exponents=tuple(map(self._tree, mode.exponents)),
                shape=self._shape(mode.shapes[0], known, pole) if mode.shapes else None,
                more_shapes=tuple(
                    self._shape(each, known, pole)
                    for each in dict.fromkeys(mode.shapes[1:])
                    if each != mode.shapes[0]
                ),
                pole=pole,
                multiplicity=mode.multiplicity,
                negative=mode.negative,
                damped=mode.damped,
                open=place.held.open,
                kinked=place.held.kinked,
                open_sign=mode.open_sign and (mode.damped or place.verdict.stable is not True),
                shaped_where=conditions(
                    [d**2 for shape in mode.shapes for d in infinite_where(shape)],
                    self.system.order,
                    place.point.positive,
                ),
            )
            for k, mode in enumerate(place.modes)
        ]

    def _below_damping(self, mode: NormalMode) -> Expression | None:
        """sqrt(k/m - c²/(4 m²)), the frequency without damping and the decay in their shapes."""
        if mode.decay is None or mode.square is None:
            return None
        parts = (mode.square, -(mode.decay**2))
        terms = [sympy.Add.make_args(sympy.expand(e)) for e in (sympy.Add(*parts), *parts)]
        cancel = len(terms[0]) < len(terms[1]) + len(terms[2])
        if cancel and mode.decay != 0:  # (c² + s²)/m² - c²/m²
            return self._tree(sympy.sqrt(simplify(sympy.Add(*parts))))
        return Call("sqrt", (sum_of(part for part in map(self._tree, parts) if part != ZERO),))

    def _alike(self, modes: Sequence[NormalMode]) -> dict[int, Expression]:
        """The frequencies that differ in the sign of sqrt(2) or of another number's root."""
        found: dict[int, Expression] = {}
        for (k, one), (j, other) in combinations(enumerate(modes), 2):
            if one.frequency is None or other.frequency is None or {k, j} & set(found):
                continue
            pair = with_number_turned(one.frequency, other.frequency, self.system.order)
            if pair is not None:
                found[k], found[j] = pair
        return found

    def _at(self, point: RestPoint) -> dict[str, Expression]:
        return {q.name: self._tree(value) for q, value in shown(point).items()}

    def _pole(self, linear: AtPole) -> Pole:
        names, order = self.system.names, self.system.order
        rates = zip(names, linear.turning, strict=True)
        turning = {name: written(rate, order) for name, rate in rates if rate != 0}
        return Pole(names[linear.radius], turning)

    def _shape(
        self, displacements: Sequence[Expr], known: Rewrite, pole: Pole | None
    ) -> dict[str, Expression]:
        pairs = dict(zip(self.system.names, displacements, strict=True))
        if pole is not None and len(pole.turning) == 1:
            del pairs[next(iter(pole.turning))]  # along any meridian
        return {name: known(self._amplitude(value)) for name, value in pairs.items()}

    def _amplitude(self, value: Expr) -> Expression:
        """One fraction where that is shorter to read, and has no (a + b)^(3/2)."""
        above = without_root_below(value)
        if length(self._tree(above)) <= _ABOVE * length(self._tree(value)):
            value = above
        tree, whole = self._tree(value), fraction(value, self.system.order)
        halves = any(isinstance(p, Power) and isinstance(p.exponent, Quotient) for p in walk(whole))
        return tree if halves else min(tree, whole, key=length)

    def _tree(self, expression: Expr) -> Expression:
        return written(expression, self.system.order)

    def _tree_or_none(self, expression: Expr | None, known: Rewrite) -> Expression | None:
        return None if expression is None else known(self._tree(expression))

    def verdict_at(self, values: Mapping[Symbol, Expr]) -> Stability | None:
        """The verdict on the equilibrium at these values of the coordinates, where there is one."""
        for place in self.places or ():
            there = place.point.values
            if all(is_zero(there.get(q, q) - values.get(q, q)) is True for q in self.system.q):
                return place.verdict
        return None
