"""`where left = right for unknown`: the roots, and which of them the motion comes to."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.decimals import is_decimal
from lagcli.algebra.equations import Roots, solve_for
from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.mechanics.finding.passing import Passage, Passing, admissible
from lagcli.mechanics.finding.passings import Passings
from lagcli.mechanics.finding.reach import real_value
from lagcli.mechanics.finding.remarks import (
    FOR_GIVEN_VALUES,
    Remark,
    as_parts,
    in_words,
    positive_where,
    real_where,
)
from lagcli.mechanics.parameter_values import admissible_values, exact_values
from lagcli.problem_data import Where as WhereQuestion
from lagcli.statements.questions import Solutions

_CHOICES = 24  # of parameter values, where the file gives none
_VERIFIED = 3  # of these, at which a root is substituted
_EXACTLY = mpf(10) ** -40
_ROUNDED = mpf(10) ** -10  # for roots given as decimals


class WhereSearch:
    """One question."""

    def __init__(self, passings: Passings, question: WhereQuestion) -> None:
        self.passings, self.along = passings, passings.along
        self.system = self.along.system
        self.unknown = self.system.symbol_of(str(question.unknown))
        build = self.system.build
        self.equation = build(question.equation.left) - build(question.equation.right)
        self.notes: list[Remark] = []

    def solutions(self) -> Solutions:
        """The answer; `solutions` is None where none was found, with the reason in `note`."""
        if self.unknown in self.system.q:
            roots = self._coordinate()
        elif self.unknown in self.system.qdot:
            roots = self._velocity()
        elif self.unknown == self.system.t:
            roots = self._time()
        else:
            roots = self._parameter()
        if roots is None:
            return self._answer(None, [self.along.why_not])
        bounds = [*real_where(roots)]
        if self.unknown.is_nonnegative or self.unknown == self.system.t:
            bounds += positive_where(roots)
        return self._answer(roots, [*bounds, *self.notes, *self.along.notes])

    def _answer(self, roots: Sequence[Expr] | None, notes: Sequence[Remark]) -> Solutions:
        trees = None if roots is None else tuple(map(self.along.tree, roots))
        return Solutions(
            unknown=self.unknown.name,
            solutions=trees,
            note=in_words(notes),
            remarks=as_parts(notes, self.along.tree),
            given_values=FOR_GIVEN_VALUES in notes,
        )

    # -- a coordinate -----------------------------------------------------------------------

    def _coordinate(self) -> list[Expr] | None:
        passing = self.passings[self.unknown]
        places = self._places(passing)
        if places is None:
            return None
        found, equation, velocity = places
        roots = list(found.values)
        if self.along.initial is None:
            self.notes.append("without an initial state all roots are listed")
            return self._sorted(roots)
        if passing.square is None:
            self.notes.append("whether the motion comes there was not decided")
            return self._sorted(roots)
        kept = passing.passed([Passage(r, velocity) for r in roots], angle=found.angle)
        if kept is None:
            return None
        self.notes += passing.notes
        reached = [passage.place for passage in kept]
        if passing.starts_at_equilibrium and reached:
            reached = self._departing(reached, equation, passing.square)
        return self._sorted(reached)

    def _places(self, passing: Passing) -> tuple[Roots, Expr, Expr | None] | None:
        """Roots u of the equation, the equation in u alone, and u' where it speaks of u'."""
        line = self._in_one(passing)
        if line is None:
            return None
        equation, velocity = line
        found = self._roots(equation, passing.u)
        return None if found is None else (found, equation, velocity)

    def _in_one(self, passing: Passing) -> tuple[Expr, Expr | None] | None:
        """The equation in the one coordinate u, and u' where it speaks of u'."""
        u, rate = passing.u, passing.rate
        equation = self.along.rewritten(self.equation, [u])
        if equation is not None:
            return equation, None
        both = self.along.rewritten(self.equation, [u, rate])
        square = passing.square
        if both is None or square is None:
            return None
        split = _split(both, rate, square)
        if split is None:
            self.along.why_not = f"the equation could not be solved together with {rate}^2"
            return None
        # A + B u' = 0 with u'^2 = w:  A^2 = B^2 w
        a, b = split
        return simplify(a**2 - b**2 * square), simplify(-a / b)

    def _departing(self, roots: list[Expr], equation: Expr, square: Expr) -> list[Expr]:
        """From rest at an equilibrium: mirror images are listed once."""
        u = self.unknown
        at_zero = is_zero(self.along.initially(u)) is True
        one_side = at_zero and bool(u.is_nonnegative or u.is_nonpositive)
        counted = "the departure from it counts" if one_side else "both departures from it count"
        self.notes.append(f"the initial state is an equilibrium: {counted}")
        if one_side or not at_zero:
            return roots
        mirrored = {u: -u}
        even = is_zero(square - square.xreplace(mirrored)) is True and any(
            is_zero(equation + sign * equation.xreplace(mirrored)) is True for sign in (1, -1)
        )
        negative = [r for r in roots if self._number(r) < 0]
        if not even or not negative:
            return roots
        self.notes.append("the roots are mirror images in pairs: the positive ones are listed")
        return [r for r in roots if r not in negative]

    # -- a velocity or a parameter ----------------------------------------------------------

    def _velocity(self) -> list[Expr] | None:
        """u' where the equation holds: at the places u that solve it, else by elimination."""
        u = self.system.q[self.system.qdot.index(self.unknown)]
        passing = self.passings[u]
        if passing.square is not None:
            places = self._places(passing)
            if places is not None and places[0].values:
                return self._velocities(passing, places)
        found = self._eliminated_to_velocity()
        if found is not None:
            self.notes.append("whether the motion comes there was not decided")
        return found

    def _velocities(
        self, passing: Passing, places: tuple[Roots, Expr, Expr | None]
    ) -> list[Expr] | None:
        found, _, velocity = places
        square = passing.square
        assert square is not None
        passages = []
        for place in found.values:
            put = {passing.u: place}
            root = sympy.sqrt(simplify(square.xreplace(put)))
            rates = [-root, root] if velocity is None else [velocity.xreplace(put)]
            passages += [Passage(place, rate, asked=rate) for rate in map(simplify, rates)]
        kept = passing.passed(passages, angle=found.angle)
        if kept is None:
            return None
        self.notes += passing.notes
        return self._sorted(list(dict.fromkeys(p.velocity for p in kept if p.velocity is not None)))

    def _eliminated_to_velocity(self) -> list[Expr] | None:
        """The equation together with all relations, freed of everything but u'."""
        v = self.unknown
        equation = self.along.on_motion(self.equation)
        if equation is None:
            return None
        for relations, remove in self.along.attempts([v]):
            left = self.along.eliminated(v, (*relations, equation), remove)
            for relation in (*left.relations, v - left.expression):
                present = relation.free_symbols
                if v in present and not present & {*remove, self.system.t}:
                    found = self._roots(relation, v)
                    return None if found is None else self._sorted(list(found.values))
        return self._with_coordinates([v])

    def _time(self) -> list[Expr] | None:
        """The roots t >= 0, where the motion is known as a function of the time."""
        t = self.unknown
        formula = self.along.rewritten(self.equation, [t])
        found = None if formula is None else self._roots(formula, t)
        if found is None:
            self.along.why_not += "; the time of an event in a run: lagcli simulate --stop-when"
            return None
        if found.angle:
            self.notes.append("whole periods later as well")
        return self._sorted([root for root in found.values if self._may_be_later(root)])

    def _may_be_later(self, time: Expr) -> bool:
        numbers = (real_value(time, values) for values in self._choices)
        return any(number is not None and number > -_EXACTLY for number in numbers)

    def _parameter(self) -> list[Expr] | None:
        """A value for the whole motion, else for the start, else one for each place."""
        formula = self.along.rewritten(self.equation, [])
        if formula is None or self.unknown not in formula.free_symbols:
            at_start = self._at_start()
            if at_start:
                self.notes = ["in the initial state"]
                return at_start
        return self._with_coordinates([])

    def _at_start(self) -> list[Expr] | None:
        """The roots of the equation in the initial state."""
        equation = self.along.on_motion(self.equation)
        if equation is None or self.along.initial is None:
            return None
        equation = simplify(self.along.initially(equation))
        if self.unknown not in equation.free_symbols:
            return None
        found = self._roots(equation, self.unknown)
        return None if found is None else self._sorted(list(found.values))

    def _with_coordinates(self, keep: list[Symbol]) -> list[Expr] | None:
        """The roots with as few coordinates in them as there must be."""
        q = self.system.q
        for others in ((), *((x,) for x in q), q):
            formula = self.along.rewritten(self.equation, [*keep, *others])
            if formula is None and len(others) == 1 and not keep:
                line = self._in_one(self.passings[others[0]])
                formula = None if line is None else line[0]
            if formula is not None and self.unknown in formula.free_symbols:
                found = self._roots(formula, self.unknown)
                return None if found is None else self._sorted(list(found.values))
            if self.along.work.over:
                break
        known = self.along.relations
        self.along.why_not = f"no formula of {self.unknown} was found from {known}"
        return None

    # -- roots --------------------------------------------------------------------------------

    def _roots(self, equation: Expr, unknown: Symbol) -> Roots | None:
        """All real roots, verified; None with the reason."""
        if unknown not in equation.free_symbols:
            holds = is_zero(equation)
            where = "everywhere" if holds is True else "nowhere"
            self.along.why_not = f"the equation does not depend on {unknown}: it holds {where}"
            self.notes.append(self.along.why_not)
            return Roots((), angle=False) if holds is False else None
        found = solve_for(equation, unknown)
        if found is None and (given := self._with_values(equation)) is not None:
            self.notes.append(FOR_GIVEN_VALUES)
            equation, found = given, solve_for(given, unknown)
        if found is None:
            self.along.why_not = f"no closed form was found for {unknown}"
            return None
        kept = []
        for root in map(simplify, found.values):
            verdict = self._satisfies(equation, unknown, root)
            if verdict is None:
                continue
            if verdict is False:
                self.along.why_not = "a root could not be verified"
                return None
            kept.append(root)
        return Roots(tuple(kept), found.angle)

    def _with_values(self, equation: Expr) -> Expr | None:
        """The equation with the values of the file; None where it does not give all of them."""
        values = exact_values(self.system)
        if not equation.free_symbols & set(self.system.parameters) <= values.keys():
            return None
        put = simplify(equation.xreplace(values))
        return None if put == equation else put

    def _satisfies(self, equation: Expr, unknown: Symbol, root: Expr) -> bool | None:
        """Substitution at 50 digits, wherever the root is real and admissible.

        None where it is so for none of the tested parameters.
        """
        limit = _ROUNDED if is_decimal(root) else _EXACTLY
        tested = 0
        for values in self._states(equation.free_symbols | root.free_symbols):
            value = real_value(root, values, digits=60)
            if value is None or not admissible(unknown, value):
                continue
            with mpmath.workdps(FINE_DIGITS):
                plan = Evaluator([equation, *sympy.Add.make_args(equation.expand())], FINE_DIGITS)
                parts = plan.where_defined({**values, unknown: value})
                if parts is None:
                    continue  # the root of a denominator
                if not abs(parts[0]) < limit * max(mpf(1), *map(abs, parts[1:])):
                    return False
            tested += 1
            if tested == _VERIFIED:
                break
        return True if tested else None

    def _states(self, present: set[Symbol]) -> list[dict[Symbol, mpf]]:
        """Values of the parameters, and of the other quantities that occur."""
        others = sorted(present - set(self.system.parameters), key=lambda s: s.name)
        count = 1 if not others else 8
        return [
            {**values, **{s: mpf(5 * (-1) ** k * (k + 1) + i + 1) / 13
                          for i, s in enumerate(others)}}
            for values in self._choices
            for k in range(count)
        ]  # fmt: skip

    @cached_property
    def _choices(self) -> list[dict[Symbol, mpf]]:
        return admissible_values(self.system, _CHOICES)

    def _number(self, root: Expr) -> mpf:
        """A value by which roots are ordered."""
        for values in self._states(root.free_symbols):
            number = real_value(root, values)
            if number is not None:
                return number
        return mpf(0)

    def _sorted(self, roots: list[Expr]) -> list[Expr]:
        return sorted(roots, key=lambda r: (self._number(r), str(r)))


def _split(expression: Expr, velocity: Symbol, square: Expr) -> tuple[Expr, Expr] | None:
    """A and B of A + B u', higher powers reduced by u'^2 = w."""
    numerator, _ = sympy.fraction(sympy.together(expression))
    try:
        powers = sympy.Poly(numerator, velocity).all_coeffs()[::-1]
    except sympy.PolynomialError:
        return None
    a = sympy.Add(*(c * square ** (k // 2) for k, c in enumerate(powers) if k % 2 == 0))
    b = sympy.Add(*(c * square ** (k // 2) for k, c in enumerate(powers) if k % 2))
    if is_zero(b) is True:
        return None
    return simplify(a), simplify(b)
