"""Which of the possible values of a coordinate u the motion passes, and with which u'.

Decided by numbers: with the parameters of the file where it gives all of them, else with
random ones; a place counts when it is passed for some of these.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property

import mpmath
from mpmath import mpf
from sympy import Expr, Rational, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.mechanics.finding.along_the_motion import AlongTheMotion
from lagcli.mechanics.finding.reach import LineOfMotion, Reach, real_value
from lagcli.mechanics.finding.remarks import Remark
from lagcli.mechanics.parameter_values import admissible_values, parameter_values
from lagcli.record import record

_DRAWS = 160  # of random parameters, to find some at which a place is possible at all
_TESTED = 40  # of these, the ones with which the motion is followed at most
_ENOUGH = 4  # when it came there
_SMALL = mpf(10) ** -12
_PARTLY = "for some values of the parameters only, such as "


@record
class Passage:
    """A place u with the velocity u' there, None where either sign will do.

    `asked` is the one of the two that the question is for.
    """

    place: Expr
    velocity: Expr | None = None
    asked: Expr | None = None


class Passing:
    """The motion of one coordinate from the initial state."""

    def __init__(self, along: AlongTheMotion, u: Symbol) -> None:
        self.along = along
        self.system = along.system
        self.u = u
        self.rate = self.system.symbol_of(u.name + "'")
        self.notes: list[Remark] = []  # to the last answer of `passed`
        self.undecided: list[str] = []
        self._reaches: dict[tuple[int, bool], Reach | None] = {}

    @cached_property
    def square(self) -> Expr | None:
        """w(u) = u'^2 by the conservation laws; None where they do not give it."""
        if self.along.initial is None:
            return None
        return self.along.rewritten(self.rate**2, [self.u])

    @cached_property
    def margins(self) -> tuple[Expr, ...]:
        """left - right of every `holds_while`, where it is a function of u."""
        margins = []
        build = self.system.build
        for constraint in self.system.problem.constraints:
            if (condition := constraint.holds_while) is None:
                continue
            larger, smaller = map(build, condition.larger_first)
            formula = self.along.rewritten(larger - smaller, [self.u])
            if formula is None:
                self.undecided.append(f"whether contact '{constraint.name}' lasts was not decided")
            else:
                margins.append(formula)
        return (*margins, *self.assumed)

    @cached_property
    def assumed(self) -> list[Expr]:
        """x >= 0 of each other coordinate that has a sign by assumption and is a function of u."""
        relations, remove = self.along.attempts([self.u])[0]
        found = []
        for x in self.system.q:
            if x is self.u or not relations or not (x.is_nonnegative or x.is_nonpositive):
                continue
            left = self.along.eliminated(x, relations, remove)
            if left.complete and not left.expression.is_nonnegative:
                found.append(left.expression if x.is_nonnegative else -left.expression)
        return found

    @cached_property
    def _draws(self) -> list[dict[Symbol, mpf]]:
        return admissible_values(self.system, _DRAWS)

    @cached_property
    def _possible(self) -> Evaluator:
        assert self.square is not None
        return Evaluator([self.square, *self.margins], DIGITS)

    @cached_property
    def starts_at_equilibrium(self) -> bool:
        """Whether the initial state is one of rest, from which no motion would start."""
        reach = self._reach(0, angle=False)
        return reach is not None and reach.at_equilibrium

    def passed(self, passages: Sequence[Passage], *, angle: bool) -> list[Passage] | None:
        """Those that the motion comes to; None where that was not decided."""
        self.notes = []
        kept: list[Passage] = []
        partly: list[tuple[Passage, Remark]] = []
        decided = len(self._draws) == 1
        for passage in passages:
            draws = self._informative(passage)
            times: list[bool] = []
            for index in draws:
                if self.along.work.over:
                    self.along.why_not = (
                        "which roots the motion reaches was not decided: too much work"
                    )
                    return None
                times.append(self._passes(index, passage, angle=angle))
                if len(times) >= _ENOUGH and any(times):
                    break
            draws = draws[: len(times)]
            decided = decided or bool(times)
            if any(times):
                kept.append(passage)
            elif times and len(self._draws) > 1:
                self.notes.append(
                    ("the root ", *self._named(passage), " is not reached for the values tried")
                )
            if any(times) and not (all(times) and self._possible_if_real(passage, draws)):
                first = draws[times.index(True)]
                partly.append((passage, self._example(first, passage, angle=angle)))
        apart = len({example for _, example in partly}) > 1 or len(partly) < len(kept)
        for passage, example in partly:
            which = (*self._named(passage), " ") if apart else ()
            self.notes.append((*which, _PARTLY, *example))
        self.notes += self._approached(kept)
        self.notes += self.undecided
        if passages and not kept:
            if not decided:
                self.along.why_not = "no parameters were found for which the motion comes there"
                return None
            tested = "values of the file" if len(self._draws) == 1 else "tested parameters"
            self.notes.append(f"with the {tested} the motion reaches no root of the equation")
        return kept

    def _approached(self, passages: Sequence[Passage]) -> list[Remark]:
        """Double roots of w: dt = du/sqrt(w) diverges there."""
        if self.square is None or self.starts_at_equilibrium:
            return []
        slope = self.square.diff(self.u)
        return [
            (*self._named(each), " is approached as ", self.system.t, " → ∞")
            for each in passages
            if all(is_zero(f.xreplace({self.u: each.place})) for f in (self.square, slope))
        ]

    def _possible_if_real(self, passage: Passage, draws: Sequence[int]) -> bool:
        """Whether the draws left out, up to the last, are those with which the answer is not real.

        For which parameters it is real is remarked on the answer itself.
        """
        left_out = (self._draws[k] for k in range(draws[-1]) if k not in draws)
        return not any(
            (place := real_value(passage.place, values)) is not None
            and admissible(self.u, place)
            and (passage.velocity is None or real_value(passage.velocity, values) is not None)
            for values in left_out
        )

    def _informative(self, passage: Passage) -> list[int]:
        """Draws with which the place is possible: w >= 0 and every contact holds there."""
        found = []
        for index, values in enumerate(self._draws):
            place = real_value(passage.place, values)
            if place is None or not admissible(self.u, place):
                continue
            numbers = self._possible.where_defined({**values, self.u: place})
            if numbers is not None and all(
                isinstance(x, mpf) and x > -_SMALL * (1 + abs(place)) for x in numbers
            ):
                found.append(index)
            if len(found) == _TESTED:
                break
        return found

    def _reach(self, index: int, *, angle: bool) -> Reach | None:
        """The reach with one draw of parameters; None where there is no real start."""
        key = (index, angle)
        if key not in self._reaches:
            line = self._line(angle=angle)
            self._reaches[key] = None
            if line is not None:
                with suppress(ArithmeticError, ValueError, TypeError):
                    self._reaches[key] = Reach(line, self._draws[index])
        return self._reaches[key]

    def _line(self, *, angle: bool) -> LineOfMotion | None:
        along = self.along
        acceleration = along.on_motion(self.system.symbol_of(self.u.name + "''"))
        if acceleration is None or self.square is None:
            return None
        return LineOfMotion(
            coordinate=self.u,
            square_of_velocity=self.square,
            margins=self.margins,
            start=along.initially(self.u),
            velocity=along.initially(self.rate),
            acceleration=along.initially(acceleration),
            angle=angle,
        )

    def _passes(self, index: int, passage: Passage, *, angle: bool) -> bool:
        reach = self._reach(index, angle=angle)
        return reach is not None and _passed(reach, passage, self.u)

    def _named(self, passage: Passage) -> tuple[str | Expr, ...]:
        """The root, and the velocity or the place that belongs to it where that counts."""
        if passage.velocity is None or passage.velocity == 0:
            return (passage.place,)
        if passage.asked is passage.velocity:
            return (passage.velocity, " at ", self.u, " = ", passage.place)
        return (passage.place, " with the velocity ", passage.velocity)

    def _example(self, index: int, passage: Passage, *, angle: bool) -> tuple[str | Expr, ...]:
        """Values with which the motion comes there: 1 or of two digits where these do."""
        values, line = dict(self._draws[index]), self._line(angle=angle)
        given = parameter_values(self.system)
        shown = [p for p in values if p not in given]
        for p in shown:
            for simple in (mpf(-1 if p.is_negative else 1), mpf(mpmath.nstr(values[p], 2))):
                if line is None or self.along.work.over:
                    break
                with suppress(ArithmeticError, ValueError, TypeError):
                    near = [{**values, p: simple * (1 + mpf(k) / 16)} for k in (0, 1, -1)]
                    if all(_passed(Reach(line, each), passage, self.u) for each in near):
                        values[p] = simple
                        break
        others = [p for p in shown if values[p] != 1]
        if not others:
            return ("1 for all of them",)
        parts: list[str | Expr] = []
        for p in others:
            parts += [", "] if parts else []
            parts += [p, " = ", Rational(mpmath.nstr(values[p], 6))]
        return tuple(parts) if len(others) == len(shown) else (*parts, " and 1 for the others")


def _passed(reach: Reach, passage: Passage, u: Symbol) -> bool:
    place = real_value(passage.place, reach.values)
    if place is None:
        return False
    signs = reach.signs(place)
    if passage.velocity is None or not signs:
        return bool(signs)
    velocity = real_value(passage.velocity, {**reach.values, u: place})
    if velocity is None:
        return False
    return abs(velocity) < _SMALL or (1 if velocity > 0 else -1) in signs


def admissible(symbol: Symbol, value: mpf) -> bool:
    """Whether a quantity may have this value by what the file assumes."""
    return not (
        (symbol.is_nonnegative and value < 0)
        or (symbol.is_positive and value <= 0)
        or (symbol.is_negative and value >= 0)
        or (symbol.is_nonzero and value == 0)
    )
