"""Which values of one coordinate u the motion comes to, from the square of its velocity.

Where the conservation laws give u'^2 = w(u), the motion stays in the interval around
u(0) in which w >= 0 and turns where w changes sign.  It ends where a one-sided contact
is lost.  From rest where u'' = 0 it may depart either way (a top released upright).

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 11 (motion in one dimension).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.evaluation import bisected
from lagcli.record import record

_SAMPLES = 96  # of a turn: every 3.75 degrees
_SMALL = mpf(10) ** -18  # measured: what is not 0 is above 1e0
_HORIZON = 10**4  # sizes of the start to which it is followed, and the part with which it begins

FREE, TURNS, LOST = "free", "turns", "lost"


@record
class LineOfMotion:
    """The formulas in u and the parameters: w = u'^2, and margins >= 0 while contacts hold."""

    coordinate: Symbol
    square_of_velocity: Expr
    margins: tuple[Expr, ...]
    start: Expr  # u(0)
    velocity: Expr  # u'(0)
    acceleration: Expr  # u''(0)
    angle: bool


class Reach:
    """The values reached for one choice of the parameters.

    Raises
    ------
    ArithmeticError, ValueError
        When the formulas have no real value at the start.
    """

    def __init__(self, line: LineOfMotion, values: Mapping[Symbol, mpf]) -> None:
        self.line = line
        self.values = dict(values)
        self._ends: dict[int, str] = {}
        self._plan = Evaluator([line.square_of_velocity, *line.margins])
        with mpmath.workdps(DIGITS):
            start, velocity, acceleration = Evaluator(
                [line.start, line.velocity, line.acceleration], DIGITS
            )(self.values)
            self.start = start
            self._size = max(mpf(1), abs(start))
            self.at_equilibrium = bool(abs(velocity) < _SMALL and abs(acceleration) < _SMALL)
            self.directions = self._directions(velocity, acceleration)

    def _directions(self, velocity: mpf, acceleration: mpf) -> tuple[int, ...]:
        """The directions of travel; the second one only after a turn, unless at rest."""
        if self.at_equilibrium:
            return (1, -1)
        driven = velocity if abs(velocity) >= _SMALL else acceleration
        first = 1 if driven > 0 else -1
        if self._end(first) == TURNS:
            return (first, -first)
        return (first,)

    def signs(self, place: mpf) -> set[int]:
        """The signs of u' with which the motion passes a place; empty where it never does."""
        with mpmath.workdps(DIGITS):
            if abs(place - self.start) < _SMALL * self._size:
                return {*self.directions, -self.directions[0]}
            passed: set[int] = set()
            for direction in self.directions:
                target = self._ahead(place, direction)
                if target is None or not self._open_until(target):
                    continue
                passed.add(direction)
                if self._end(direction) == TURNS:
                    passed.add(-direction)
            return passed

    def _ahead(self, place: mpf, direction: int) -> mpf | None:
        """The place as it is met in a direction: angles return after 2 pi."""
        if self.line.angle:
            turn = 2 * mpmath.pi
            return self.start + direction * (direction * (place - self.start) % turn)
        return place if (place - self.start) * direction > 0 else None

    def _open_until(self, target: mpf) -> bool:
        """Whether w >= 0 and every contact holds on the way."""
        way = target - self.start
        return all(self._state(self.start + way * k / _SAMPLES) == FREE for k in range(1, _SAMPLES))

    def _state(self, u: mpf) -> str:
        found = self._plan.where_defined({**self.values, self.line.coordinate: u})
        if found is None or not all(isinstance(x, mpf) for x in found):
            return TURNS
        w, *margins = found
        if any(margin < -_SMALL for margin in margins):
            return LOST
        return TURNS if w < -_SMALL else FREE

    def _end(self, direction: int) -> str:
        """How travel in one direction ends first: free for ever, at a turn, or off contact."""
        if direction not in self._ends:
            self._ends[direction] = self._found_end(direction)
        return self._ends[direction]

    def _found_end(self, direction: int) -> str:
        before = mpf(0)
        for distance in self._distances():
            state = self._state(self.start + direction * distance)
            if state != FREE:
                return self._refined(direction, before, distance)
            before = distance
        return FREE

    def _distances(self) -> Sequence[mpf]:
        if self.line.angle:
            return [2 * mpmath.pi * k / _SAMPLES for k in range(1, _SAMPLES + 1)]
        ratio = mpf(_HORIZON) ** (mpf(2) / _SAMPLES)
        return [self._size * ratio**k / _HORIZON for k in range(1, _SAMPLES + 1)]

    def _refined(self, direction: int, inside: mpf, outside: mpf) -> str:
        """What fails first between two distances, by bisection."""

        def free(distance: mpf) -> bool:
            return self._state(self.start + direction * distance) == FREE

        return self._state(self.start + direction * bisected(free, inside, outside, 40)[1])


def real_value(expression: Expr, values: Mapping[Symbol, mpf], digits: int = DIGITS) -> mpf | None:
    """The value of a formula, None where it is not a finite real number."""
    found = Evaluator([expression], digits).where_defined(values)
    if found is None:
        return None
    [value] = found
    if abs(value.imag) > _SMALL * (1 + abs(value)) or not mpmath.isfinite(value):
        return None
    return value.real
