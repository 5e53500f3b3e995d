"""The motion along one coordinate u for one choice of the parameters, between roots.

Where u'^2 = w(u), u keeps to the interval around u(0) in which w > 0.  It turns at a
simple root of w and comes to a multiple one only after an infinite time.  Between two
neighbouring roots no function along the motion changes its sign, so that one value tells it.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (motion in one dimension).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import mpmath
from flint import arb, ctx, fmpq, fmpq_poly
from mpmath import mpf
from mpmath.libmp import to_rational
from sympy import Expr, Symbol

from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.mechanics.finding.line import FunctionsOnLine
from lagcli.record import record

_SAME = mpf(10) ** -18  # of places: a double root is known to half of the digits
_SMALL = mpf(10) ** -60  # measured: zeros are below 6e-90, others above 6e-3

HOLDS, FAILS, UNKNOWN, TURNS, ENDS = "holds", "fails", "unknown", "turns", "ends"


@record
class Start:
    """u(0), u'(0), u''(0), and the place in question, None for a condition."""

    place: Expr
    velocity: Expr
    acceleration: Expr
    target: Expr | None = None

    @property
    def formulas(self) -> list[Expr]:
        """All of them."""
        target = [] if self.target is None else [self.target]
        return [self.place, self.velocity, self.acceleration, *target]

    def with_values(self, values: Mapping[Symbol, Expr]) -> Start:
        """With numbers in place of parameters."""
        return Start(*(formula.xreplace(values) for formula in self.formulas))


@record
class PassedPlace:
    """A place on the way: the powers with which the functions vanish there, by their number."""

    distance: mpf
    zeros: Mapping[int, int]
    is_target: bool = False


class Walk:
    """Whether a condition holds along the whole motion, or a place is reached.

    Parameters
    ----------
    line
        w first, then what ends the motion where it is negative; last the condition, where
        one is asked.
    start
        Where the motion begins.
    strict
        Whether the condition is > 0 and not >= 0.
    wall
        The sign that u has by assumption, 0 without one: the motion ends at 0.
    """

    def __init__(self, line: FunctionsOnLine, start: Start, *, strict: bool, wall: int) -> None:
        self.line = line
        self.strict = strict
        self.wall = wall
        self._asks_place = start.target is not None
        self._last = len(line.functions) - (0 if self._asks_place else 1)
        self._functions = Evaluator(line.functions, FINE_DIGITS)
        self._coefficients = [Evaluator(f.coefficients, FINE_DIGITS) for f in line.factors]
        rate: list[Expr] = [] if line.rate is None else [line.rate]
        self._start = Evaluator([*rate, *start.formulas], FINE_DIGITS)

    def verdict(self, values: Mapping[Symbol, mpf]) -> bool | None:
        """Whether it is so; None where these numbers do not decide it."""
        with mpmath.workdps(FINE_DIGITS):
            try:
                return self._verdict(dict(values))
            except (ArithmeticError, ValueError, TypeError, mpmath.mp.NoConvergence):
                return None

    def _verdict(self, values: dict[Symbol, mpf]) -> bool | None:
        self._values = values
        numbers = self._start(values)
        self._rate = None if self.line.rate is None else numbers.pop(0)
        self.u0, velocity, acceleration, *target = numbers
        self._target = target[0] if target else None
        zeros = self._zeros()
        here = self._check(self._place_at(mpf(0), zeros), None)
        if here in (HOLDS, FAILS, UNKNOWN):
            return {HOLDS: True, FAILS: False}.get(here)
        if here == ENDS:
            return not self._asks_place
        at_equilibrium = _sign(velocity) == _sign(acceleration) == 0
        for direction in _directions(velocity, acceleration):
            outcome = self._walk(direction, zeros)
            if outcome in (HOLDS, FAILS, UNKNOWN):
                return {HOLDS: True, FAILS: False}.get(outcome)
            if outcome == ENDS and not at_equilibrium:
                break
        return not self._asks_place

    # -- places ------------------------------------------------------------------------------

    def _zeros(self) -> list[tuple[mpf, int, int]]:
        """(place, function, multiplicity), negative for a pole; angles k u on a circle."""
        found = []
        at_infinity = [0] * len(self.line.functions)
        for factor, plan in zip(self.line.factors, self._coefficients, strict=True):
            coefficients = plan(self._values)
            size = max(map(abs, coefficients))
            while coefficients and abs(coefficients[-1]) < _SMALL * size:
                coefficients.pop()
            at_infinity[factor.function] -= factor.exponent * (len(coefficients) - 1)
            for root in _real_roots(coefficients):
                place = root if self._rate is None else 2 * mpmath.atan(root)
                found.append((place, factor.function, factor.exponent))
        if self._rate is not None:
            found += [(+mpmath.pi, f, power) for f, power in enumerate(at_infinity) if power]
        return found

    def _places(self, direction: int, zeros: Sequence[tuple[mpf, int, int]]) -> list[PassedPlace]:
        """What is met in a direction, in its order; back at the start on a circle."""
        distances: list[mpf] = []
        for place in [*(z[0] for z in zeros), *self._marks()]:
            distance = self._ahead(place, direction)
            if distance is not None and all(abs(distance - d) > _SAME for d in distances):
                distances.append(distance)
        return [self._place_at(direction * d, zeros) for d in sorted(distances)]

    def _marks(self) -> Iterator[mpf]:
        rate = 1 if self._rate is None else self._rate
        if self._target is not None:
            yield self._target * rate
        if self.wall:
            yield mpf(0)

    def _ahead(self, place: mpf, direction: int) -> mpf | None:
        if self._rate is None:
            distance = (place - self.u0) * direction
            return distance if distance > _SAME else None
        turn = 2 * mpmath.pi
        distance = direction * (place - self.u0 * self._rate) % turn
        return distance if _SAME < distance < turn - _SAME else None

    def _place_at(self, offset: mpf, zeros: Sequence[tuple[mpf, int, int]]) -> PassedPlace:
        rate = 1 if self._rate is None else self._rate
        here = self.u0 * rate + offset
        powers: dict[int, int] = {}
        for place, function, power in zeros:
            if self._apart(place, here) < _SAME:
                powers[function] = powers.get(function, 0) + power
        target = self._target is not None and self._apart(self._target * rate, here) < _SAME
        return PassedPlace(abs(offset), powers, target)

    def _apart(self, one: mpf, other: mpf) -> mpf:
        distance = abs(one - other)
        if self._rate is None:
            return distance
        turn = 2 * mpmath.pi
        distance = distance % turn
        return min(distance, turn - distance)

    # -- the way -----------------------------------------------------------------------------

    def _walk(self, direction: int, zeros: Sequence[tuple[mpf, int, int]]) -> str:
        places = self._places(direction, zeros)
        before = mpf(0)
        for place in [*places, None]:
            ahead = self._end(before) if place is None else place.distance
            middle = self.u0 + direction * (before + ahead) / 2 / (self._rate or 1)
            signs = [_sign(f) for f in self._functions({**self._values, self.line.u: middle})]
            if signs[0] < 0:
                return TURNS
            if self.wall and _sign(middle) == -self.wall:
                return ENDS
            passed = self._between(signs)
            if passed is not None:
                return passed
            if place is None:
                break
            if place.zeros.get(0, 0) > 1:
                return ENDS  # after an infinite time
            if self._falls_in(place, direction):
                return ENDS
            outcome = self._check(place, signs)
            if outcome is not None:
                return outcome
            before = place.distance
        if self._rate is not None and not self._asks_place:
            return HOLDS  # the whole circle
        return ENDS

    def _falls_in(self, place: PassedPlace, direction: int) -> bool:
        """Whether a distance becomes 0 there with an infinite velocity: a centre is hit."""
        at_the_wall = self.wall and abs(self.u0 + direction * place.distance) < _SAME
        return bool(at_the_wall) and self._rate is None and place.zeros.get(0, 0) < 0

    def _end(self, before: mpf) -> mpf:
        return 2 * mpmath.pi if self._rate is not None else 3 * before + 1

    def _between(self, signs: Sequence[int]) -> str | None:
        """What a stretch without roots decides."""
        if not self._asks_place:
            asked = signs[self._last]
            if asked < 0 or (asked == 0 and self.strict):
                return FAILS
        return ENDS if any(sign < 0 for sign in signs[1 : self._last]) else None

    def _check(self, place: PassedPlace, signs: Sequence[int] | None) -> str | None:
        """What a place decides that is reached; None to go on."""
        if any(power < 0 for power in place.zeros.values()):
            return UNKNOWN
        if signs is None:  # the start, where nothing is known of the way to it
            values = self._functions({**self._values, self.line.u: self.u0})
            signs = [_sign(f) for f in values]
        at = [0 if place.zeros.get(k, 0) else sign for k, sign in enumerate(signs)]
        passed = self._between(at)
        if passed is not None:
            return passed
        if place.is_target:
            return HOLDS
        if place.zeros.get(0, 0) == 1 and place.distance:
            return TURNS
        return None


def _directions(velocity: mpf, acceleration: mpf) -> tuple[int, ...]:
    """The first direction of travel and the one after a turn; either way from an equilibrium."""
    driven = velocity if abs(velocity) > _SMALL else acceleration
    first = -1 if driven < -_SMALL else 1
    return (first, -first)


def _sign(value: mpf) -> int:
    if not isinstance(value, mpf) or not mpmath.isfinite(value):
        raise ValueError("no real value")
    return 0 if abs(value) < _SMALL else 1 if value > 0 else -1


def _real_roots(coefficients: Sequence[mpf]) -> list[mpf]:
    """The real roots of a polynomial by its coefficients, constant term first."""
    exact = fmpq_poly([fmpq(*map(int, to_rational(c._mpf_))) for c in coefficients])
    with ctx.workdps(2 * FINE_DIGITS):
        return [
            mpf(tuple(map(int, root.real.mid().man_exp())))
            for root, multiplicity in exact.complex_roots()
            for _ in range(multiplicity)
            if abs(root.imag) < arb(str(_SAME)) * (1 + abs(root))
        ]
