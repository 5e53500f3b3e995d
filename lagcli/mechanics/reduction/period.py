"""The period of one degree of freedom as a series in the amplitude.

The series in the amplitude a, half the distance between the turning points, is compared with the
integral itself by quadrature.

Where U = U0 + w^2 s^2/2 with the arc s, ds = sqrt(M) dx, the period is that of a harmonic
oscillator at every amplitude.  As U' = w^2 s sqrt(M), this is so where

    U'^2 = 2 w^2 M (U - U0).

So it is where U = A s^2 + B/s^2 + C, with w^2 = 8 A: there s^2 is that of a harmonic oscillator.
As with D = d/ds then 3 DU = (w^2 - D^2 U) s, this is so where h = s^2 = (3 DU/(w^2 - D^2 U))^2
obeys

    h' = 6 U'/(w^2 - D^2 U).

Where W with W' = p = sqrt(2 M (E - U)) is elementary, the action J = 2 (W(q_2) - W(q_1)) between
the turning points, where p = 0, comes from c arctan(X/p) alone, which is c pi/2 times the sign of X
there.  Then T = dJ/dE, compared with the integral as well.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (problem 1 for the pendulum), 28 and 49
(T = dJ/dE).
Chalykh, Veselov, J. Nonlinear Math. Phys. 12 Suppl. 1 (2005) 179 (which potentials those are).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import mpmath
import sympy
from mpmath import mpf
from sympy import Abs, Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.elimination import remainder
from lagcli.algebra.entry import Field
from lagcli.algebra.numeric import Evaluator, vanishes_at_random
from lagcli.algebra.place import at
from lagcli.algebra.polynomial_roots import coefficients
from lagcli.algebra.positivity import deciding, weak_sign
from lagcli.algebra.signs import sign
from lagcli.mechanics.inequalities import never_together
from lagcli.mechanics.parameter_values import admissible_values
from lagcli.mechanics.reduction.one_freedom import ReducedFreedom
from lagcli.mechanics.reduction.quadrature import closed_forms
from lagcli.mechanics.reduction.ratio_series import ORDER, ratio_series
from lagcli.mechanics.reduction.root_integrals import ROOT
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.record import record, replace
from lagcli.statements.plus_minus import put_together

_WORKING = 140
_AMPLITUDE = mpf(10) ** -8
_NODES = 12
_MARGIN = mpf(10) ** 7  # for the next coefficient
_READABLE = 45  # operations of a coefficient
_WORKABLE = 150  # operations of all Taylor coefficients together
_TRIED = 48


@record
class AmplitudeSeries:
    """T = 2 pi root (1 + sum of coefficients[k] a^(k + 1)) about one equilibrium.

    `point` None: about every place at which the derivative of U_eff vanishes.  Where the motion is
    `isochronous` the period is 2 pi root at every amplitude: the arc, or its square where that is
    `squared`, is that of a harmonic oscillator.  It is `straight` where the arc is a
    multiple of the coordinate.  The period `by_energy` holds for positive `energies`.
    """

    point: RestPoint | None
    root: Expr
    coefficients: tuple[Expr, ...]
    where: tuple[Expr, ...]
    isochronous: bool = False
    squared: bool = False
    straight: bool = False
    by_energy: Expr | None = None
    energies: tuple[Expr, ...] = ()


def _of_either_sign(one: AmplitudeSeries, other: AmplitudeSeries) -> AmplitudeSeries | None:
    """sqrt(|p|) for sqrt(p) where p > 0 and sqrt(-p) where p < 0, of one period."""
    if one.point is None or other.point is None or one.coefficients != other.coefficients:
        return None
    [(q, place)], [there] = one.point.values.items(), other.point.values.values()
    conditions, opposites = ({deciding(x) for x in each.where} for each in (one, other))
    if len(conditions) != 1 or len(opposites) != 1:
        return None
    [condition], [opposite] = conditions, opposites
    same = [place**2 + there**2, condition + opposite, one.root - other.root]
    if place == there or not all(is_zero(simplify(each)) is True for each in same):
        return None
    either = simplify(condition**2)
    values = {q: sympy.sqrt(Abs(simplify(place**2)))}
    return replace(
        one, point=replace(one.point, values=values, positive=(either,)), where=(either,)
    )


class Periods:
    """The series about every minimum of U_eff.

    Attributes
    ----------
    reason
        Why there is none, in a sentence; empty otherwise.
    failed
        Whether one was found and is not the integral.
    """

    def __init__(self, motion: ReducedFreedom) -> None:
        self.motion = motion
        self.reason = ""
        self.failed = False

    @cached_property
    def _mass(self) -> Expr:
        """The M of dt/dq = sqrt(M/(2 (E - U)))."""
        motion = self.motion
        if motion.pace is None:
            return motion.mass
        # with E = U + d: the factor d of (dq/dt)² cancels, also where U has a root
        d = sympy.Dummy()
        rise = motion.E - motion.potential
        mass = simplify(2 * at(motion.pace, {motion.E: motion.potential + d}) * d)
        return at(mass, {d: rise})

    @cached_property
    def _rest(self) -> RestPoints:
        return RestPoints(self.motion.dynamics)

    @property
    def excluded(self) -> bool:
        """Whether U_eff has maxima only, or no place of rest: nothing goes to and fro."""
        rest, motion = self._rest, self.motion
        if rest.points is None or not rest.complete or motion.negative or rest.is_of_one_turn:
            return False
        curvature = motion.potential.diff(motion.q, 2)
        return all(
            sign(simplify(at(curvature, point.values)), point.positive) == -1
            for point in rest.points
        )

    @cached_property
    def series(self) -> tuple[AmplitudeSeries, ...]:
        """One series for each equilibrium that is a minimum, or may be one."""
        rest = self._rest
        points = rest.points
        if self.motion.negative:
            self.reason = "no period is given where the kinetic energy is negative"
            return ()
        if points is None:
            return self._anywhere()
        found, curvature = [], self.motion.potential.diff(self.motion.q, 2)
        for point in points:
            pressed = self.motion.contacts.where_pressed(point.values)
            if pressed is None and sign(simplify(at(curvature, point.values))) != -1:
                contacts = self.motion.contacts.routh.given.problem.contacts
                several = self.motion.contacts.one_sided > 1
                held = "constraints do not hold" if several else "constraint does not hold"
                held = "contacts are not open" if contacts else f"one-sided {held}"
                self.reason = f"the {held} at a minimum of U_eff"
            if point.free or pressed is None:
                continue
            if not free_of(sympy.Add(*pressed), [self.motion.system.t]):
                self.reason = "a one-sided constraint moves"
                continue
            point = replace(point, positive=(*point.positive, *pressed))
            try:
                series = self._about(point)
            except ZeroDivisionError:
                continue
            if series is not None:
                found.append(series)
        if not found and not rest.complete:
            return self._anywhere()
        if found and not rest.complete:
            self.reason = "there may be other minima of U_eff, which were not found"
        elif not found and not self.reason:
            turn = "within one turn " if rest.is_of_one_turn else ""
            self.reason = f"U_eff has no minimum {turn}at which its second derivative is positive"
        return tuple(put_together(self._like_mirror_images(found), _of_either_sign))

    def _like_mirror_images(self, found: Sequence[AmplitudeSeries]) -> list[AmplitudeSeries]:
        """The series; where U(−q) = U(q) and M(−q) = M(q), −q0 has the period by E that q0 has."""
        motion, q = self.motion, self.motion.q
        places = [sympy.Add(*s.point.values.values()) if s.point else S.Zero for s in found]
        exact = {p: s for p, s in zip(places, found, strict=True) if s.by_energy is not None}
        if len(exact) in (0, len(found)):
            return [*found]
        even = all(is_zero(x - x.xreplace({q: -q})) is True for x in (motion.potential, self._mass))
        images = [exact.get(-p) if even else None for p in places]
        return [
            s if image is None or s.by_energy is not None
            else replace(s, by_energy=image.by_energy, energies=image.energies)
            for s, image in zip(found, images, strict=True)
        ]  # fmt: skip

    def _anywhere(self) -> tuple[AmplitudeSeries, ...]:
        """2 pi sqrt(M/U'') at a place that is given by U' = 0 only."""
        motion = self.motion
        curvature = simplify(motion.potential.diff(motion.q, 2))
        pressed = motion.contacts.where_pressed({})
        if sign(curvature) in (0, -1) or pressed is None:
            return ()
        pressed = tuple(x for x in pressed if not _follows(x, motion.potential.diff(motion.q)))
        mass = simplify(at(self._mass, {motion.E: motion.potential}))
        return (AmplitudeSeries(None, _root(mass, curvature), (), pressed),)

    def _about(self, point: RestPoint) -> AmplitudeSeries | None:
        motion = self.motion
        q, [place] = motion.q, [*point.values.values()]
        if any(is_zero(at(n.args[0], {q: place})) is True for n in motion.potential.atoms(Abs)):
            self.reason = "a derivative of U_eff jumps at its minimum, where it has no power series"
            return None
        slopes = [at(motion.potential.diff(q, k), {q: place}) for k in range(2, ORDER + 3)]
        curvature = min(slopes[0], 1 / simplify(1 / slopes[0]), key=sympy.count_ops)
        known = sign(curvature, point.positive)
        never = never_together((*point.positive, curvature))
        if known in (0, -1) or never:
            return None
        bottom = {motion.E: at(motion.potential, {q: place})}
        by_energy = [self._mass]
        while len(by_energy) <= ORDER // 2 and not free_of(by_energy[-1], [motion.E]):
            by_energy.append(by_energy[-1].diff(motion.E))
        masses = [
            [at(at(mass.diff(q, k), {q: place}), bottom) for k in range(ORDER + 1)]
            for mass in by_energy
        ]
        lowest = masses[0][0]
        if is_zero(lowest) is True or sign(lowest, point.positive) == -1:
            return None
        # U = U0 + u x²/2 (1 + α_1 x + …),   M = M0 (1 + β_01 x + … + Z² (β_10 + β_11 x + …) + …)
        alpha = [
            simplify(2 * s / (sympy.factorial(k + 2) * curvature)) for k, s in enumerate(slopes)
        ]
        beta = [
            [
                simplify(
                    m * (curvature / 2) ** j / (sympy.factorial(j) * sympy.factorial(k) * lowest)
                )
                for k, m in enumerate(row)
            ]
            for j, row in enumerate(masses)
        ]
        coefficients = [_on_branch(c, point.positive) for c in _readable(alpha, beta)]
        root = _on_branch(_root(lowest, curvature), point.positive)
        where = (*point.positive, *(() if known == 1 else (curvature,)))
        constant, w2 = not any(coefficients), curvature / lowest
        harmonic = constant and self._is_harmonic(place, w2)
        squared = constant and not harmonic and self._is_harmonic_squared(w2)
        alike = harmonic or squared
        straight = free_of(self._mass, [q])
        series = AmplitudeSeries(point, root, tuple(coefficients), where, alike, squared, straight)
        agrees = self._agrees(series)
        if agrees:
            return series if alike else self._with_energy(series)
        if agrees is None:
            self.reason = "no values were found at which a series could be compared"
            return None
        self.reason, self.failed = "a series did not agree with its integral", True
        return None

    def _is_harmonic(self, place: Expr, w2: Expr) -> bool:
        motion = self.motion
        U, q = motion.potential, motion.q
        rise = U - at(U, {q: place})
        return _vanishes(U.diff(q) ** 2 - 2 * w2 * self._mass * rise)

    def _is_harmonic_squared(self, w2: Expr) -> bool:
        U, q, M = self.motion.potential, self.motion.q, self._mass
        left = w2 - U.diff(q, 2) / M + U.diff(q) * M.diff(q) / (2 * M**2)
        square = (3 * U.diff(q) / left) ** 2 / M
        return _vanishes(square.diff(q) - 6 * U.diff(q) / left)

    # -- by the energy ----------------------------------------------------------------------------

    def _with_energy(self, series: AmplitudeSeries) -> AmplitudeSeries:
        """The same with T = dJ/dE, where the action is elementary and agrees with the integral."""
        motion = self.motion
        assert series.point is not None
        [place] = series.point.values.values()
        if motion.pace is not None or not free_of(self._mass, [motion.E]):
            return series
        momentum = sympy.sqrt(2 * self._mass * (motion.E - motion.potential))
        for form in closed_forms(_as_one_root(momentum, motion.q), motion.q, series.where):
            angles = _arctangents(form.terms)
            energies = tuple(x for x in form.positive if free_of(x, [motion.q]))
            local = [at(x, {motion.q: place}) for x in form.positive if x not in energies]
            if angles is None or any(sign(x, series.where) != 1 for x in local):
                continue
            found = self._by_energy(series, angles, energies)
            if found is not None:
                return replace(series, by_energy=found, energies=energies)
        return series

    def _by_energy(
        self,
        series: AmplitudeSeries,
        angles: Sequence[tuple[Expr, Expr]],
        energies: Sequence[Expr],
    ) -> Expr | None:
        """dJ/dE, None where it is not the integral."""
        motion = self.motion
        inside = Evaluator([x for _, x in angles], _WORKING)
        held = Evaluator(list(energies), _WORKING)
        for values in admissible_values(motion.system, _TRIED):
            with mpmath.workdps(_WORKING):
                try:
                    swing = self._swing(series, values)
                    known = {**values, motion.E: swing.energy}
                    if not all(x > 0 for x in held(known)):
                        continue
                    ends = [
                        inside({**known, motion.q: q, ROOT: _AMPLITUDE**8})
                        for q in (swing.middle - swing.half, swing.middle + swing.half)
                    ]
                    turns = [
                        int(mpmath.sign(b) - mpmath.sign(a)) for a, b in zip(*ends, strict=True)
                    ]
                    action = sympy.pi * sympy.Add(
                        *(n * c for n, (c, _) in zip(turns, angles, strict=True))
                    )
                    period = _simplified(action.diff(motion.E), energies)
                    [stated] = Evaluator([period], _WORKING)(known)
                    off = abs(swing.period / abs(stated) - 1)
                except (ArithmeticError, ValueError, TypeError):
                    continue  # no real motion there
                if off > _AMPLITUDE**5:
                    return None
                return -period if stated < 0 else period
        return None

    # -- the integral itself ----------------------------------------------------------------------

    def _agrees(self, series: AmplitudeSeries) -> bool | None:
        """Whether the series is the integral at an amplitude of 1e-8, to 40 digits.

        None where no values of the parameters were found at which it is there.
        """
        for values in admissible_values(self.motion.system, _TRIED):
            with mpmath.workdps(_WORKING):
                try:
                    off = abs(self._ratio(series, values) - 1)
                except (ArithmeticError, ValueError, TypeError):
                    continue  # no real motion there
                # the next coefficient times the next even power of a
                return bool(off < _MARGIN * _AMPLITUDE ** (len(series.coefficients) + 2))
        return None

    def _ratio(self, series: AmplitudeSeries, values: Mapping[Symbol, mpf]) -> mpf:
        swing = self._swing(series, values)
        a = swing.half
        stated = swing.root * (1 + sum(c * a ** (k + 1) for k, c in enumerate(swing.coefficients)))
        return swing.period / (2 * mpmath.pi * stated)

    def _swing(self, series: AmplitudeSeries, values: Mapping[Symbol, mpf]) -> _Swing:
        motion = self.motion
        assert series.point is not None
        [place] = series.point.values.values()
        evaluate = Evaluator([place, series.root, *series.coefficients, *series.where], _WORKING)
        middle, root, *others = evaluate(values)
        if motion.q.is_positive and not middle > 0:
            raise ValueError
        n = len(series.coefficients)
        if not all(isinstance(x, mpf) for x in (middle, root, *others)):
            raise ValueError
        if min([*others[n:], mpf(1)]) <= mpf(10) ** -6:
            raise ValueError
        a = _AMPLITUDE
        potential_of, mass_of = (Evaluator([f], _WORKING) for f in (motion.potential, self._mass))

        def potential(q: mpf) -> mpf:
            return potential_of({**values, motion.q: q})[0]

        def tilt(m: mpf) -> mpf:
            return potential(m + a) - potential(m - a)

        middle = mpmath.findroot(
            tilt, (middle, middle + a * a), solver="secant", tol=mpf(10) ** -200, verify=False
        )
        energy = (potential(middle + a) + potential(middle - a)) / 2
        total = mpf(0)
        for k in range(_NODES):
            s = (mpf(k) + mpf(1) / 2) * mpmath.pi / _NODES - mpmath.pi / 2
            q = middle + a * mpmath.sin(s)
            [mass] = mass_of({**values, motion.q: q, motion.E: energy})
            total += mpmath.sqrt(mass / (2 * (energy - potential(q)))) * a * mpmath.cos(s)
        period = 2 * total * mpmath.pi / _NODES
        return _Swing(middle, a, energy, period, root, tuple(others[:n]))


@record
class _Swing:
    """A motion between middle - half and middle + half, and the numbers of its series."""

    middle: mpf
    half: mpf
    energy: mpf
    period: mpf
    root: mpf
    coefficients: tuple[mpf, ...]


def _vanishes(expression: Expr) -> bool:
    """Whether it is 0, which numbers deny at once where roots in it would make the proof long."""
    return vanishes_at_random(expression) and is_zero(expression) is True


def _as_one_root(momentum: Expr, q: Symbol) -> Expr:
    """The momentum with the whole radicand under one root, a factor without q before it."""
    factor, radicand = simplify(momentum**2).as_independent(q, as_Add=False)
    return sympy.sqrt(factor) * sympy.sqrt(sympy.expand(radicand))


def _arctangents(terms: Sequence[Expr]) -> list[tuple[Expr, Expr]] | None:
    """(c, X/p) of each c arctan(X/p); None where something else stays where p is 0."""
    found = []
    for term in terms:
        factors = sympy.Mul.make_args(term)
        angles = [f for f in factors if isinstance(f, sympy.atan)]
        if term.has(sympy.log) or len(angles) > 1:
            return None
        if angles:
            found.append((term / angles[0], angles[0].args[0]))
        elif is_zero(term.xreplace({ROOT: S.Zero})) is not True:
            return None
    return found


def _simplified(period: Expr, positive: Sequence[Expr]) -> Expr:
    """The same in its shortest form, where -E or D - E is positive by that."""
    for condition in positive:
        for symbol in sorted(condition.free_symbols, key=str):
            slope = condition.diff(symbol)
            if slope in (1, -1) and symbol.is_positive is not True:
                size = sympy.Dummy(positive=True)
                value = slope * (size - condition.xreplace({symbol: S.Zero}))
                return simplify(period.xreplace({symbol: value})).xreplace({size: condition})
    return simplify(period)


def _follows(value: Expr, vanishing: Expr) -> bool:
    """Whether the value is not negative wherever the other one, U', is 0.

    As the remainder of the division of the one by the other in some letter is not: with
    N = m (U' + g) it is m g.
    """
    field = Field([value, vanishing])
    try:
        element, divisor = field(value), field(vanishing).numerator
    except ZeroDivisionError:
        return False
    below = field.polynomial(element.denominator)
    for letter in sorted(vanishing.free_symbols, key=str):
        number = field.number_of(letter)
        if number is not None and len(coefficients(field, divisor, number)) > 1:
            rest = remainder(field, element.numerator, divisor, number) / below
            if weak_sign(field.to_sympy(rest)) == 1:
                return True
    return False


def _root(mass: Expr, curvature: Expr) -> Expr:
    """sqrt(M/U''), the shorter way round."""
    first = simplify(sympy.sqrt(simplify(mass / curvature)))
    second = 1 / simplify(sympy.sqrt(simplify(curvature / mass)))
    return second if sympy.count_ops(second) < sympy.count_ops(first) else first


def _on_branch(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """|x| as x or -x, where the conditions of an equilibrium decide its sign."""
    signs = {m: sign(m.args[0], positive) for m in expression.atoms(sympy.Abs)}
    known: dict[Expr, Expr] = {m: s * m.args[0] for m, s in signs.items() if s in (1, -1)}
    return simplify(expression.xreplace(known)) if known else expression


def _readable(alpha: Sequence[Expr], beta: Sequence[Sequence[Expr]]) -> tuple[Expr, ...]:
    """The coefficients to the highest order at which they can still be read."""
    found: tuple[Expr, ...] = ()
    for order in range(2, ORDER + 1, 2):
        taylor = (*alpha[: order + 1], *(b for row in beta for b in row[: order + 1]))
        if sum(int(sympy.count_ops(c)) for c in taylor) > _WORKABLE:
            break
        coefficients = tuple(map(simplify, ratio_series(alpha, beta, order)))
        if max(int(sympy.count_ops(c)) for c in coefficients) > _READABLE:
            break
        found = coefficients
    return found
