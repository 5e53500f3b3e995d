"""The section `reduction` in the shape in which it is read."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import shape, simplify, terms
from lagcli.algebra.build import free_of, symbol
from lagcli.algebra.conjugate_roots import written_alike
from lagcli.algebra.decimals import written
from lagcli.algebra.factors import square_part
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import fraction
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Product,
    Quotient,
    Sum,
    factors_of,
    operation_count,
    opposite,
    power_of,
    quotient_of,
    sum_of,
    terms_of,
    walk,
)
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.readable import Readable
from lagcli.mechanics.reduction.effective_potential import effective_potential, without_momenta
from lagcli.mechanics.reduction.one_freedom import ReducedFreedom as Motion
from lagcli.mechanics.reduction.one_freedom import free_name
from lagcli.mechanics.reduction.period import AmplitudeSeries as Found
from lagcli.mechanics.reduction.period import Periods
from lagcli.mechanics.reduction.routh import Routh
from lagcli.notation.ordering import negative_of
from lagcli.rewriting import put_in, rebuilt
from lagcli.statements.answers import EquationsSection, LagrangeEquation, ReductionSection
from lagcli.statements.motions import Irreducible, OneFreedom, PeriodSeries

_EXCESS = "#E - V"  # no name of a file
#: How many times as long one fraction may be as a bracket with fractions.
_WHOLE = 1.5
_ONCE = Fraction(1)
_HALF = Fraction(1, 2)

#: What was requested and not found, and why.
Missing = list[tuple[str, str]]


def reduction(derivation: Derivation) -> tuple[ReductionSection, Missing]:
    """The reduction by all cyclic coordinates, and what of it was not found."""
    routh = Routh(derivation)
    return _Statement(routh, derivation.system.names).section()


class _Statement:
    def __init__(self, routh: Routh, given: Sequence[str]) -> None:
        self.routh, self.given = routh, given
        self.missing: Missing = []
        self.names = (system := routh.system).names
        momenta = tuple(p.name for p in routh.momenta)
        cyclic = {system.q[j].name for j in routh.cyclic}
        self.order = (
            tuple(name for name in system.order if name not in (*momenta, *cyclic)) + momenta
        )
        self.fast = frozenset(v.name for v in (*system.qdot, *system.qddot, *system.multipliers))

    def section(self) -> tuple[ReductionSection, Missing]:
        routh = self.routh
        full = routh.full.dynamics
        momenta = {
            self.names[j]: Readable(full).linear(full.lagrange.momenta[j]) for j in routh.cyclic
        }
        reduced = routh.reduced
        if reduced is None or routh.velocities is None:
            self.missing.append(("the reduction", routh.reason))
            section = ReductionSection(
                momenta=momenta, routhian=None, reason=routh.reason,
                eliminated=self.eliminated, irreducible=self.irreducible,
            )  # fmt: skip
            return section, self.missing
        from lagcli.mechanics.statements import Statements

        equations = Statements(reduced).answers(["equations"]).sections["equations"]
        assert isinstance(equations, EquationsSection)
        lines = equations.equations or ()
        potential, gyroscopic = None, {}
        if routh.quadratic or self._other_freedom:
            potential = self._potential()
        if routh.quadratic:
            gyroscopic = {
                q.name: self._shape(g)
                for q, g in zip(reduced.system.q, routh.gyroscopic, strict=True)
                if g != 0
            }
            if not any(g.has(routh.system.t) for g in routh.gyroscopic):
                lines = self._by_parts(lines)
        return (
            ReductionSection(
                momenta=momenta,
                routhian=self._routhian(potential if routh.quadratic else None),
                equations=lines,
                constraints=equations.constraints,
                reconstruction={
                    self.names[j]: self._shape(v)
                    for j, v in zip(routh.cyclic, routh.velocities, strict=True)
                },
                effective_potential=potential,
                potential=routh.potential_name,
                gyroscopic=gyroscopic,
                gyroscopic_forces=bool(gyroscopic) and routh.gyroscopic_forces,
                gyroscopic_change=bool(gyroscopic) and routh.gyroscopic_change,
                one_freedom=self._one_freedom(potential),
                eliminated=self.eliminated,
                irreducible=self.irreducible,
                when=routh.when_constant,
            ),
            self.missing,
        )

    @property
    def eliminated(self) -> tuple[str, ...]:
        """The coordinates for which the constraints are solved."""
        return tuple(name for name in self.given if name not in self.names)

    @property
    def irreducible(self) -> dict[str, Irreducible]:
        """By name."""
        found = self.routh.irreducible
        return {self.names[j]: Irreducible(*each) for j, each in found.items()}

    def _by_parts(self, lines: tuple[LagrangeEquation, ...]) -> tuple[LagrangeEquation, ...]:
        """The left sides as what the velocities give and dU_eff/dq."""
        reduced, writer = self.routh.reduced, Writer(self.order)
        assert reduced is not None
        potential = self.routh.effective_potential
        made = []
        for line, q, left in zip(
            lines, reduced.system.q, reduced.dynamics.lagrange.left_sides, strict=True
        ):
            slope = potential.diff(q)
            parts = [terms(left - slope, self.order, self.fast), terms(slope, self.order, ())]
            made.append(
                LagrangeEquation(
                    coordinate=line.coordinate,
                    left=writer.sum([part for part in parts if part != ZERO]),
                    right=line.right,
                )
            )
        return tuple(made)

    def _shape(self, expression: Expr) -> Expression:
        return shape(expression, self.order)

    def _routhian(self, potential: Expression | None) -> Expression:
        """The kinetic and gyroscopic terms, then -U_eff as it is read by itself."""
        R = self.routh.function
        assert R is not None
        if potential is None:
            given = R if self.routh.cyclic else self.routh.system.L
            return terms(given, self.order, self.fast, as_given=not self.routh.cyclic)
        writer = Writer(self.order)
        assert self.routh.reduced is not None
        still = dict.fromkeys(self.routh.reduced.system.qdot, S.Zero)
        moving = sympy.expand(R - R.xreplace(still))
        parts = [writer.negative(potential)]
        if len(still) == 1:
            [v] = still
            if self._freedom.mass != 0:
                parts.insert(0, self._kinetic(self._freedom))
            moving = v * moving.coeff(v)
        if moving != 0:
            parts.insert(-1, terms(moving, self.order, self.fast))
        return writer.sum(parts)

    def _potential(self) -> Expression:
        """U_eff; without momenta and constraints as it stands in h."""
        routh, V = self.routh, self.routh.full.system.V
        if not (routh.momenta or self.eliminated):
            return without_momenta(routh.full)
        return effective_potential(routh.effective_potential, routh.momenta, self.order, V)

    # -- one degree of freedom --------------------------------------------------------------------

    @cached_property
    def _freedom(self) -> Motion:
        return Motion(self.routh)

    @property
    def _other_freedom(self) -> bool:
        """Whether q' of one coordinate follows from E where R is not quadratic in it."""
        reduced = self.routh.reduced
        one = reduced is not None and len(reduced.system.q) == 1
        return one and not self.routh.quadratic and self._freedom.pace is not None

    def _kinetic(self, motion: Motion) -> Expression:
        """M q'^2/2, or its shortest form where M has a bracket such as 1/3 + sin(q)^2.

        1 + r^2/a^2 stays: it is that of ds = sqrt(1 + z'^2) dr.
        """
        mass = _inertia(motion.mass, self.order)
        sums = (part for part in walk(mass) if isinstance(part, Sum) and ONE not in part.terms)
        if any(any(map(_is_fraction, part.terms)) for part in sums):
            return terms(motion.energy - motion.potential, self.order, self.fast)
        return Writer(self.order).product(
            _HALF, [(mass, _ONCE), (Name(motion.q.name, 1), 2 * _ONCE)]
        )

    def _one_freedom(self, potential: Expression | None) -> OneFreedom | None:
        reduced = self.routh.reduced
        if reduced is None or potential is None or len(reduced.system.q) != 1:
            return None
        if reduced.dynamics.constraints.equations:
            return None
        motion = self._freedom
        order = (*self.order, motion.E.name)
        if motion.why_not_conserved or (motion.mass == 0 and motion.quadratic):
            return None
        periods = Periods(motion)
        found = tuple(self._period(each) for each in periods.series)
        if periods.failed:
            self.missing.append(("the period as a series", periods.reason))
        points = motion.turning_points
        writer = Writer(order)
        return OneFreedom(
            coordinate=motion.q.name,
            constant=motion.E.name,
            energy=terms(motion.energy, order, self.fast)
            if motion.pace is not None
            else writer.sum([self._kinetic(motion), potential]),
            turning_points=None if points is None else self._turning(points, motion.E, order),
            rate=_rate(motion, potential, order) if motion.pace is None else _pace(motion, order),
            periods=found,
            positive=bool(motion.q.is_positive),
            turning_period=None if motion.length is None else shape(motion.length, order),
            leaves_out=motion.leaves_out,
            turning_finite=conditions(motion.finite_where, order),
            turning_energies=tuple(
                (shape(lower, order), shape(upper, order))
                for lower, upper in motion.turning_energies
            ),
            turning_where=tuple(
                conditions(each, order, motion.bounds) for each in motion.turning_where
            ),
            one_sided=motion.contacts.one_sided,
            signed=motion.contacts.signed,
            regular=motion.pace is not None or sign(motion.mass) == 1,
            oscillates=not periods.excluded,
            when=self.routh.when_constant.get("", ""),
            reason=periods.reason.replace("U_eff", self.routh.potential_name),
        )

    def _turning(
        self, points: Sequence[Expr], E: Symbol, order: Sequence[str]
    ) -> tuple[Expression, ...]:
        """The turning points, with the constant energy last under a root: sqrt(b^2 + 4 a E)."""
        assert self.routh.reduced is not None
        build = self.routh.reduced.system.build.knowing({E.name: E})

        def energy_last(tree: Expression) -> Expression:
            match tree:
                case Call(
                    function="sqrt", arguments=(Sum() | Quotient() | Negative() as radicand,)
                ):
                    whole = build(radicand)
                    slope = simplify(whole.diff(E))
                    if slope == 0 or not free_of(slope, [E]):
                        return rebuilt(tree, energy_last)
                    first = shape(whole.xreplace({E: S.Zero}), order)
                    if isinstance(first, Negative) and isinstance(first.operand, Sum):
                        first = negative_of(first.operand)
                    if first == ZERO or isinstance(first, Negative):
                        return tree
                    found = sum_of((*terms_of(first), *terms_of(shape(slope * E, order))))
                    longer = operation_count(found) > operation_count(radicand)
                    return tree if longer else Call("sqrt", (found,))
                case _:
                    return rebuilt(tree, energy_last)

        return tuple(map(energy_last, written_alike(points, order)))

    def _period(self, found: Found) -> PeriodSeries:
        """2 pi sqrt(M/U'') (1 + c_2 a^2 + …)."""
        name = free_name(self.routh, ("a", "A", "a_0", "A_0"))
        amplitude, order = symbol(name, "positive"), (*self.order, name)
        corrections = [
            _over_one(c * amplitude ** (k + 1), order)
            for k, c in enumerate(found.coefficients)
            if c != 0
        ]
        period = _two_pi_times(_over_one_root(found.root, order))
        if corrections:
            period = Product((period, Sum((ONE, *corrections))))
        q = self.routh.reduced.system.q[0] if self.routh.reduced else None
        return PeriodSeries(
            at={}
            if found.point is None
            else {q.name: written(value, self.order) for q, value in found.point.values.items()},
            root_of=self._shape(self.routh.effective_potential.diff(q))
            if found.point is None
            else None,
            amplitude=name if corrections else "",
            order=len(found.coefficients),
            isochronous=found.isochronous,
            squared=found.squared,
            straight=found.straight,
            period=period,
            where=conditions(found.where, self.order),
            by_energy=None if found.by_energy is None else self._shape(found.by_energy),
            energies=conditions(found.energies, self.order),
        )


def _over_one(term: Expr, order: Sequence[str]) -> Expression:
    """The term, as one fraction where its brackets would hold others."""
    shown = shape(term, order)
    sums = (part for part in walk(shown) if isinstance(part, Sum))
    nested = any(isinstance(part, Quotient) for each in sums for part in walk(each))
    whole = fraction(term, order) if nested else shown
    return whole if operation_count(whole) <= _WHOLE * operation_count(shown) else shown


def _inertia(mass: Expr, order: Sequence[str]) -> Expression:
    """m (1 + r^2/a^2) for m r^2/a^2 + m, and one fraction where a sum would have one over a sum."""
    tree = shape(mass, order)
    sums = (part for part in walk(tree) if isinstance(part, Sum))
    if any(isinstance(t, Quotient) and _has_sum(t.denominator) for s in sums for t in s.terms):
        return fraction(mass, order)
    letters = [s for s in mass.free_symbols if free_of(simplify(mass / s), [s])]
    for letter in sorted(letters, key=str) if isinstance(tree, Sum) else ():
        rest = shape(simplify(mass / letter), order)
        if isinstance(rest, Sum) and ONE in rest.terms:
            return Product((Name(letter.name), rest))
    return tree


def _rate(motion: Motion, potential: Expression, order: Sequence[str]) -> Expression:
    """sqrt(M/(2 (E - U_eff))), U_eff term by term as it stands above, squares before the root."""
    outside = S.One
    for factor in sympy.Mul.make_args(motion.mass / 2):
        base, power = factor.as_base_exp()
        if factor.is_Rational:
            outside *= square_part(sympy.Integer(factor.p))[0]  # sqrt(3 m/(4 (E - V)))
        elif base.is_positive and power.is_Integer:
            outside *= base ** int(power / 2)
    writer = Writer(order)
    rest = map(writer.negative, terms_of(potential))
    excess = sum_of((Name(motion.E.name), *(term for term in rest if term != ZERO)))
    inside = _inertia(motion.mass / outside**2, order)
    root = Call("sqrt", (writer.product(_HALF, [(inside, _ONCE), (excess, -_ONCE)]),))
    return writer.product(_ONCE, [(shape(outside, order), _ONCE), (root, _ONCE)])


def _pace(motion: Motion, order: Sequence[str]) -> Expression:
    """dt/dq of a relativistic motion, by E - V, which exceeds m c²."""
    assert motion.pace is not None
    excess, V = symbol(_EXCESS, "positive"), motion.potential.as_independent(motion.q)[1]
    pace = simplify(motion.pace.xreplace({motion.E: excess + V}))
    whole = sum_of((Name(motion.E.name), *map(opposite, terms_of(shape(V, order)))))
    if not free_of(pace, [motion.q]):
        pace, whole = motion.pace, Name(_EXCESS)
    parts = sympy.fraction(sympy.together(pace))
    if sympy.sqrt(parts[0]).has(sympy.I):  # -E²/(p² c² - E²) is E²/(E² - p² c²)
        parts = [simplify(-part) for part in parts]
    if (by_square := _by_squared_energy(parts, motion.E, order)) is not None:
        return by_square
    above, below = (
        put_in(shape(sympy.sqrt(part), order), {Name(_EXCESS): whole}) for part in parts
    )
    return Writer(order).product(_ONCE, [(above, _ONCE), (below, -_ONCE)])


def _by_squared_energy(parts: Sequence[Expr], E: Symbol, order: Sequence[str]) -> Expression | None:
    """|E|/(c sqrt(E² - (m c² + k x²/2)²)), not over a root of the factors of the difference."""
    above, below = parts
    polynomial = sympy.expand(below).as_poly(E)
    if polynomial is None or {*polynomial.as_dict()} != {(2,), (0,)}:
        return None
    slope, rest = (simplify(polynomial.coeff_monomial(E**n)) for n in (2, 0))
    if sign(slope) != 1 or E in rest.free_symbols:
        return None
    square = power_of(Name(E.name), 2)
    root = Call("sqrt", (sum_of((square, opposite(shape(simplify(-rest / slope), order)))),))
    outside = shape(sympy.sqrt(simplify(above / slope)), order)
    return Writer(order).product(_ONCE, [(outside, _ONCE), (root, -_ONCE)])


def _has_sum(node: Expression) -> bool:
    return any(isinstance(part, Sum) for part in walk(node))


def _is_fraction(term: Expression) -> bool:
    return isinstance(term, Quotient) and all(
        isinstance(part, Number) for part in (term.numerator, term.denominator)
    )


def _over_one_root(root: Expr, order: Sequence[str]) -> Expression:
    """sqrt((a + b)/c) for sqrt(a/c + b/c)."""
    tree = shape(root, order)
    match tree:
        case Call(function="sqrt", arguments=(Sum(terms=parts),)) if any(
            isinstance(part, Quotient) for part in parts
        ):
            return min(tree, Call("sqrt", (fraction(root**2, order),)), key=operation_count)
        case _:
            return tree


def _two_pi_times(root: Expression) -> Expression:
    """2 pi root, as one product or one fraction with one number."""
    above_, below = (
        (root.numerator, root.denominator) if isinstance(root, Quotient) else (root, ONE)
    )
    number, factors = _number_and_rest(above_)
    divisor, divisors = _number_and_rest(below)
    number = 2 * number / divisor
    powers = factors.count(Name("pi")) + 1 - divisors.count(Name("pi"))
    pi = power_of(Name("pi"), powers)
    whole = [*([pi] if powers else []), *(factor for factor in factors if factor != Name("pi"))]
    divisors = [factor for factor in divisors if factor != Name("pi")]
    if number.numerator != 1:
        whole.insert(0, Number(Fraction(number.numerator)))
    if number.denominator != 1:
        divisors.insert(0, Number(Fraction(number.denominator)))
    return quotient_of(whole, divisors)


def _number_and_rest(product: Expression) -> tuple[Fraction, list[Expression]]:
    factors = factors_of(product)
    number = Fraction(1)
    for factor in factors:
        number *= factor.value if isinstance(factor, Number) else 1
    return number, [factor for factor in factors if not isinstance(factor, Number)]
