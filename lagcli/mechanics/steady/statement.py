"""The section `steady_motions` in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from functools import cached_property

import sympy
from sympy import Expr, S

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.decimals import rounded, written
from lagcli.algebra.determinants import determinant
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import deciding, vanishing_part, without_moduli
from lagcli.algebra.signs import sign, sign_beside_zero
from lagcli.algebra.vanishing_factors import may_vanish, squares_divided_by
from lagcli.expression import Expression, Number, Power, operation_count
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.oscillations.discriminant import Rewrite, with_discriminants
from lagcli.mechanics.oscillations.family_statement import relation_sides, shown, untied
from lagcli.mechanics.oscillations.normal_modes import beats, choices, shorter
from lagcli.mechanics.oscillations.reduced_verdict import judge_on_axes
from lagcli.mechanics.oscillations.small_oscillations import SmallOscillations
from lagcli.mechanics.reduction.coinciding_axes import CoincidingAxes
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.statement import Missing
from lagcli.mechanics.reduction.steady import SteadyMotions
from lagcli.mechanics.reduction.steady_motion import Steady
from lagcli.mechanics.rest.characteristic import Characteristic
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.exceptions import (
    Vanishing,
    alternatives_written,
    unless_written,
)
from lagcli.mechanics.rest.family import Family
from lagcli.mechanics.rest.linearization import Linearization, Matrix
from lagcli.mechanics.stability.judge import GRAZES, judge
from lagcli.mechanics.stability.lagrange_dirichlet import by_routh
from lagcli.mechanics.stability.statement import held_by_gyroscopic_terms, potential_of, stated
from lagcli.mechanics.stability.verdict import Stability, undecided
from lagcli.mechanics.steady.moving_frames import moving_frames, plane_of_rotation
from lagcli.mechanics.steady.rolling import rolling_motions
from lagcli.mechanics.steady.rolling_statement import applies, rolling_section
from lagcli.mechanics.steady.two_rates import Turning, with_roots_alike
from lagcli.notation.manner import Manner
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.statements.motions import Above, SteadyMotion, SteadySection, Verdict
from lagcli.statements.wording import while_open


def steady_motions(derivation: Derivation) -> tuple[SteadySection, Missing]:
    """The steady motions with their stability, and what was not found."""
    if applies(derivation):
        rolling = rolling_motions(derivation)
        if rolling.motions is not None:
            return rolling_section(rolling), []
        if rolling.drives:  # what a motor turns does not rest
            return _not_found(rolling.reason)
    routh = Routh(derivation)
    if routh.reduced is None:
        return _not_found(routh.reason)
    section, missing = _SteadyStatement(SteadyMotions(routh), derivation.given).section()
    if section.motions == () and not derivation.problem.contacts:
        drifting = rolling_motions(derivation)  # along what the equations of motion do not contain
        if drifting.motions and drifting.turning:
            return rolling_section(drifting), []
    return section, missing


def _not_found(reason: str) -> tuple[SteadySection, Missing]:
    section = SteadySection(conditions={}, motions=None, reason=reason)
    return section, [("the steady motions", reason)]


class _SteadyStatement:
    def __init__(self, steady: SteadyMotions, given: Problem) -> None:
        self.steady = steady
        self.given = given
        self.routh = steady.routh
        momenta = tuple(p.name for p in self.routh.momenta)
        names = tuple(n for n in steady.full.order if n not in momenta)
        self.order = names + momenta

    def section(self) -> tuple[SteadySection, Missing]:
        steady = self.steady
        found = steady.motions
        cyclic = tuple(steady.full.names[j] for j in self.routh.cyclic)
        manner = Manner(self.given)
        conditions = {
            str(k): manner.vanishing(self._shape(vanishing_part(c)))
            for k, c in enumerate(steady.balance)
        }
        resting = steady.only_rest_is_sought
        plane = plane_of_rotation(RestPoints(self.routh.full.dynamics))
        if found is None:
            return (
                SteadySection(
                    conditions=conditions,
                    motions=None,
                    complete=False,
                    reason=steady.reason,
                    acting=steady.acting,
                    momenta=cyclic,
                    resting=resting,
                    frames=self._frames
                    if steady.everywhere and not steady.full.problem.contacts
                    else (),
                    plane=plane,
                    everywhere=steady.everywhere,
                ),
                [] if steady.everywhere else [("the steady motions", steady.reason)],
            )
        return (
            SteadySection(
                conditions=conditions,
                motions=with_roots_alike(
                    tuple(map(self._motion, found)),
                    tuple(map(self._turning, found)),
                    self.steady.full.parameters,
                    self._shape,
                ),
                # those on a kink of V are not sought
                complete=steady.complete and not (found and self._is_kinked),
                singular_where=()
                if steady.complete
                else tuple(map(self._shape, CoincidingAxes(self.routh).singular_where)),
                acting=steady.acting,
                momenta=cyclic,
                resting=resting,
                unless=() if found else unless_written(steady.unless, self.order),
                void=alternatives_written(self._void if found else [], self.order),
                degenerate=alternatives_written(
                    self._balance.degenerate if found else [], self.order
                ),
                # nor those along a closed contact
                where=(steady.rest.restricted_to if steady.rest.points or not found else "")
                + while_open(steady.full.problem.contacts),
                frames=self._frames if found and not steady.full.problem.contacts else (),
                plane=plane,
            ),
            [],
        )

    @property
    def _void(self) -> list[Expr]:
        """What may be 0, and U_eff is constant then at any momenta."""
        return [] if self.steady.full.problem.contacts else self._balance.void

    @cached_property
    def _balance(self) -> Vanishing:
        """What vanishes in a steady motion, at all positions and momenta; none with forces."""
        steady = self.steady
        unknowns = (*steady.system.q, *steady.routh.momenta)
        conditions = [] if steady.acting else steady.balance
        return Vanishing(conditions, unknowns, steady.routh.given.dynamics.lagrange.mass_matrix)

    @property
    def _is_kinked(self) -> bool:
        """Whether a force jumps where coordinates that do not turn have some value."""
        jumps = {u for f in self.steady.rest.forces_at_rest for u in f.atoms(sympy.sign)}
        return any(not free_of(u.args[0], self.steady.system.q) for u in jumps)

    @property
    def _frames(self) -> tuple[dict[str, Expression], ...]:
        system = self.steady.system
        return tuple(
            {
                q.name: self._shape(x * system.qdot[system.q.index(free)])
                for q, x in zip(system.q, c, strict=True)
                if q != free and x != 0
            }
            for free, c in moving_frames(self.steady.rest).items()
        )

    def _motion(self, motion: Steady) -> SteadyMotion:
        motion = replace(
            motion,
            values={
                x: without_moduli(value, motion.positive) for x, value in motion.values.items()
            },
            rates=None
            if motion.rates is None
            else {j: without_moduli(rate, motion.positive) for j, rate in motion.rates.items()},
        )
        matrices: tuple[Matrix, ...] = ()
        rewrite: Rewrite | None = None
        turning = False
        judged = undecided("the equations of motion are singular there")
        squares: tuple[Expr, ...] = ()
        displaced: tuple[str, ...] = ()
        try:
            if not motion.derivatives:
                linear = Linearization(self.steady.rest, self.steady.point(motion))
                judged = judge(linear)
                if not (linear.drifts or not linear.smooth or self.steady.contacts.grazes(motion)):
                    squares, turning = squares_of(linear), held_by_gyroscopic_terms(linear)
                    matrices = (linear.M, linear.C, linear.K)
                    if linear.dynamics.constraints.equations:
                        displaced = tuple(q.name for q in linear.independent)
                    rewrite = with_discriminants(
                        linear.M, linear.K, self.order, linear.system.build
                    )
                if motion.family is not None:
                    squares, matrices = self._on_all(motion.family, squares, matrices)
            else:
                [[mass]] = self.steady.dynamics.lagrange.mass_matrix
                squares = (simplify(motion.derivatives[0] / at(mass, motion.values)),)
                judged = judge_on_axes(self.steady, motion)
        except ZeroDivisionError:
            pass
        potential = potential_of(self.steady.rest, "U_eff") and self.routh.potential_name
        if self.steady.contacts.grazes(motion):
            judged = self._with_contacts(motion) or undecided(GRAZES)
        elif judged.is_open and (resting := self._at_rest(motion)) is not None:
            judged, potential = resting, potential_of(RestPoints(self.routh.full.dynamics))
        system, names = self.steady.system, self.steady.full.names
        rates = motion.rates
        point = self.steady.point(motion)
        fixed = shown(point)
        coordinates = {q.name: fixed[q] for q in system.q if q in fixed}
        momenta = {
            names[j]: self._whole(motion.values.get(p, p), motion)
            for j, p in zip(self.routh.cyclic, self.routh.momenta, strict=True)
        }
        return SteadyMotion(
            at={name: self._shape(value) for name, value in coordinates.items()},
            free=self._free(motion),
            rates=None
            if rates is None
            else {names[j]: self._shape(self._whole(rate, motion)) for j, rate in rates.items()},
            momenta={name: self._shape(value) for name, value in momenta.items()},
            where=(*self._where(motion), *self._regular_where(motion)),
            mirrored=motion.mirrored,
            rests=self._rests_at_equality(motion),
            verdict=self._verdict(judged, motion, potential, turning=turning),
            frequencies_squared=tuple(
                rewrite(tree) if rewrite else tree
                for w in squares
                for tree in [self._square(without_moduli(w, motion.positive))]
            ),
            mass=self._matrix(matrices[0]) if matrices else (),
            velocity=self._matrix(matrices[1]) if matrices else (),
            stiffness=self._matrix(matrices[2]) if matrices else (),
            displaced=displaced,
            linear_where=conditions(
                squares_divided_by(e for m in matrices for row in m for e in row),
                self.order,
                motion.known_positive,
            ),
            on=relation_sides(point, system.q, self.order),
            may_be_complex=judged.stable is False
            and any(x != 0 for row in (matrices[1] if matrices else ()) for x in row)
            and any(_may_be_complex(square, motion.known_positive) for square in squares),
        )

    def _turning(self, motion: Steady) -> Turning | None:
        """The rates and momenta of the cyclic coordinates; None without rates."""
        if motion.rates is None:
            return None
        names, cyclic = self.steady.full.names, self.routh.cyclic
        pairs = zip(cyclic, self.routh.momenta, strict=True)
        return {
            "rates": {names[j]: self._whole(rate, motion) for j, rate in motion.rates.items()},
            "momenta": {names[j]: self._whole(motion.values.get(p, p), motion) for j, p in pairs},
        }

    def _at_rest(self, motion: Steady) -> Stability | None:
        """The verdict on the equilibrium that it is, where the cyclic coordinates do not move."""
        if motion.rates is None or any(is_zero(x) is not True for x in motion.rates.values()):
            return None
        return self._equilibria.verdict_at(motion.values)

    def _with_contacts(self, motion: Steady) -> Stability | None:
        """The verdict on the equilibrium of the file that it is, whose contacts may open."""
        relations = self._held.dynamics.constraints.relations
        if self.routh.cyclic or relations is None:
            return None
        solved = (relations.solved.get(q, q) for q in self._held.system.q)
        whole = [at(value, motion.values) for value in solved]
        return self._held.verdict_at(dict(zip(self._held.system.q, whole, strict=True)))

    @cached_property
    def _held(self) -> SmallOscillations:
        return SmallOscillations(self.routh.given.dynamics)

    @cached_property
    def _equilibria(self) -> SmallOscillations:
        return SmallOscillations(self.routh.full.dynamics)

    def _where(self, motion: Steady) -> tuple[Above, ...]:
        shortest = sorted(motion.known_positive, key=lambda e: int(e.count_ops()))
        return conditions(shortest, self.order)

    def _regular_where(self, motion: Steady) -> tuple[Above, ...]:
        """Where the free coordinates are regular: not at a pole, where det M = 0."""
        full = self.steady.full
        free = [q for q in full.q if q not in motion.values]
        moving = motion.rates is not None and any(not free_of(self._determinant, [q]) for q in free)
        if not moving or motion.family is not None:
            return ()
        factors = may_vanish(simplify(at(self._determinant, motion.values)))
        poles = [f**2 for f in factors if not free_of(f, free)]
        return conditions(poles, self.order, motion.known_positive)

    @cached_property
    def _determinant(self) -> Expr:
        """det M of all coordinates at rest; 1 where it was not found."""
        found = determinant(self.routh.full.dynamics.lagrange.mass_matrix_at_rest)
        return S.One if found is None else found

    def _rests_at_equality(self, motion: Steady) -> bool:
        """Whether all rates and momenta are a root of what must be positive."""
        open_ = [c for c in map(deciding, motion.positive) if sign(c) is None]
        if (
            not motion.mirrored
            or motion.rates is None
            or {len(open_), len(self._where(motion))} != {1}
        ):
            return False
        parts = [f for f, _ in factors_of(open_[0]) if sign(f) is None]
        if len(parts) != 1:
            return False
        values = (motion.values.get(p, p) for p in self.routh.momenta)
        squares = [simplify(v**2) for v in (*values, *motion.rates.values())]
        return all(
            s == 0 or any(k > 0 and (f == parts[0] or f == -parts[0]) for f, k in factors_of(s))
            for s in squares
        )

    def _verdict(
        self, judged: Stability, motion: Steady, potential: str, *, turning: bool
    ) -> Verdict:
        cyclic = bool(self.routh.cyclic)
        return stated(
            by_routh(judged) if cyclic else judged,
            self.order,
            motion.known_positive,
            potential=potential,
            gyroscopic=turning,
            given=[v**2 for v in self.steady.full.qdot if v in motion.free_rates],
        )

    def _free(self, motion: Steady) -> tuple[str, ...]:
        """Coordinates, rates and momenta that the state is a function of."""
        full = self.steady.full
        values = [*motion.values.values(), *(motion.rates or {}).values()]
        used = {s for value in values for s in value.free_symbols}
        places = untied(self.steady.point(motion), self.steady.system.q)
        if motion.rates is None:  # momenta that neither are given nor give others
            used |= {p for p in self.routh.momenta if p not in motion.values}
        others = [s for s in (*full.qdot, *self.routh.momenta) if s in used]
        return tuple(s.name for s in (*places, *others))

    def _on_all(
        self, family: Family, squares: Sequence[Expr], matrices: Sequence[Matrix]
    ) -> tuple[tuple[Expr, ...], tuple[Matrix, ...]]:
        """What was found on a branch and holds on the whole family."""
        back = [family.written_back(square) for square in squares]
        known = tuple(s for s in back if s is not None and free_of(s, self.steady.system.q))
        whole = [[[family.written_back(e) for e in row] for row in m] for m in matrices]
        if any(e is None for m in whole for row in m for e in row):
            return known, ()
        return known, tuple([[e for e in row if e is not None] for row in m] for m in whole)

    def _whole(self, value: Expr, motion: Steady) -> Expr:
        """A rate or a momentum, of a family in all coordinates where it can be."""
        back = None if motion.family is None else motion.family.written_back(value)
        return value if back is None else back

    def _matrix(self, matrix: Matrix) -> tuple[tuple[Expression, ...], ...]:
        return tuple(tuple(map(self._shape, row)) for row in matrix)

    def _shape(self, expression: Expr) -> Expression:
        return written(expression, self.order)

    def _square(self, expression: Expr) -> Expression:
        """(Ω ± sqrt(k/m))² as the square of what it is the square of."""
        squares = [f for f in sympy.Mul.make_args(expression) if f.is_Pow and f.exp == 2]
        square = next((f for f in squares if f.base.is_Add), None)
        if square is None or not (outside := expression / square).is_positive:
            return self._shape(expression)
        root = sympy.sqrt(outside) * square.base
        shown = [self._shape(each) for each in (simplify(root), sympy.expand(root))]
        return Power(min(shown, key=operation_count), Number(Fraction(2)))


def _may_be_complex(square: Expr, positive: Sequence[Expr]) -> bool:
    """Whether a root in it may have a negative radicand."""
    radicands = (p.base for p in square.atoms(sympy.Pow) if p.exp == sympy.S.Half)
    return any(sign_beside_zero(r) is None and sign(r, positive) is None for r in radicands)


def squares_of(linear: Linearization) -> tuple[Expr, ...]:
    """ω² of the small oscillations, where they have a closed form."""
    if linear.damped:
        return ()
    factors = Characteristic(linear).squares
    found: list[Expr] = []
    for roots, multiplicity, _ in factors or ():
        if roots is None or any(root.has(sympy.I) for root in roots):
            return ()
        found += _squared_sums(linear, roots) * multiplicity
    return tuple(found)


def _squared_sums(linear: Linearization, roots: Sequence[Expr]) -> list[Expr]:
    """(p ± q)² where that is shorter than a ± sqrt(b), else the roots."""
    with suppress(ZeroDivisionError):
        if sums := beats(roots, choices(linear)):
            parts = ((each, *each.as_content_primitive()) for each in sums)
            return [shorter(each**2, number**2 * rest**2) for each, number, rest in parts]
    return [shorter(rounded(simplify(root)), root) for root in roots]
