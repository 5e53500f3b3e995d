"""`always: condition, for: p` and `reaches: u = value, for: p`: the values of p.

The condition is rewritten as a function of one coordinate u along the motion, or of no
coordinate at all.  The motion ends where another `holds_while` fails.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import mpmath
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import Builder
from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign
from lagcli.mechanics.finding.line import FunctionsOnLine, NotAlgebraic
from lagcli.mechanics.finding.passing import Passing
from lagcli.mechanics.finding.passings import Passings
from lagcli.mechanics.finding.ranges import Bounds, Undecided, Values, ranges
from lagcli.mechanics.finding.remarks import FOR_GIVEN_VALUES
from lagcli.mechanics.finding.special_values import NoClosedForm, SpecialValues
from lagcli.mechanics.finding.walk import Start, Walk
from lagcli.mechanics.parameter_values import exact_values
from lagcli.problem_data import Inequality, Lasting, Reaching
from lagcli.statements.questions import Range, Ranges

_SMALL = mpf(10) ** -60  # measured: what is not 0 is above 4e-1


class LastingAnswer:
    """One question."""

    def __init__(self, passings: Passings, question: Lasting | Reaching) -> None:
        self.passings, self.along = passings, passings.along
        self.system = self.along.system
        self.question = question
        self.p = self.system.symbol_of(question.unknown.name)
        self.notes: list[str] = []

    def answer(self) -> Ranges:
        """The ranges; None where they were not decided, with the reason in `note`."""
        try:
            found = self._found({})
        except Undecided as reason:
            values = {q: x for q, x in exact_values(self.system).items() if q is not self.p}
            if not set(self.system.parameters) - {self.p} <= values.keys():
                return Ranges(unknown=self.p.name, ranges=None, note=str(reason))
            self.notes = [FOR_GIVEN_VALUES]
            try:
                found = self._found(values)
            except Undecided as again:
                return Ranges(unknown=self.p.name, ranges=None, note=str(again))
        note = "; ".join(dict.fromkeys([*self.notes, *self.along.notes]))
        return Ranges(
            unknown=self.p.name,
            ranges=tuple(map(self._range, found)),
            note=note,
            given_values=FOR_GIVEN_VALUES in self.notes,
        )

    def _range(self, bounds: Bounds) -> Range:
        tree = self.along.tree
        return Range(
            lower=None if bounds.lower is None else tree(bounds.lower),
            upper=None if bounds.upper is None else tree(bounds.upper),
            lower_included=bounds.lower_included,
            upper_included=bounds.upper_included,
        )

    def _found(self, values: dict[Symbol, Expr]) -> list[Bounds]:
        if self.p.is_integer:
            raise Undecided(f"{self.p} is an integer")
        try:
            if isinstance(self.question, Lasting):
                return self._lasting(self.question, values)
            return self._reaching(self.question, values)
        except NotAlgebraic:
            raise Undecided(
                "along the motion it is no rational function of a coordinate, "
                "or of its sine and cosine"
            ) from None
        except NoClosedForm as equation:
            raise Undecided(f"no closed form was found for {self.p} in {equation} = 0") from None

    # -- conditions ----------------------------------------------------------------------------

    def _lasting(self, question: Lasting, values: dict[Symbol, Expr]) -> list[Bounds]:
        strict = "=" not in question.condition.comparison
        margin = margin_of(question.condition, self.system.build)
        known = self._in_every_state(margin, strict=strict)
        if known is not None:
            every = Bounds(None, None, lower_included=False, upper_included=False)
            return [every] if known else []
        relations = self.along.dynamics.constraints.relations
        for u, rate in zip(self.system.q, self.system.qdot, strict=True):
            if is_zero(rate, relations) is True:
                continue
            passing = self.passings[u]
            if passing.square is None or is_zero(passing.square) is True:
                continue
            formula = self.along.rewritten(margin, [u])
            if formula is not None and u in formula.free_symbols:
                return self._along(passing, [formula], None, values, strict=strict)
            if formula is not None:
                return self._constant(formula.xreplace(values), strict=strict)
        formula = self.along.rewritten(margin, [self.system.t])
        if formula is not None and self.system.t not in formula.free_symbols:
            return self._constant(formula.xreplace(values), strict=strict)
        if formula is not None:
            return self._in_time(formula, values, strict=strict)
        raise Undecided(
            self._why_not
            or "it is not a function of one coordinate, or of the time, along the motion"
        )

    def _in_every_state(self, margin: Expr, *, strict: bool) -> bool | None:
        """Whether the condition holds in all states, or in none; None where they differ."""
        there = self.along.on_motion(margin)
        known = None if there is None else sign(there)
        if there is None or known is not None:
            return None if known is None else known == 1 or (known == 0 and not strict)
        return True if not strict and weak_sign(there) == 1 else None

    @property
    def _why_not(self) -> str:
        return "it needs the `initial` state" if self.along.initial is None else self.along.why_not

    def _in_time(self, formula: Expr, values: dict[Symbol, Expr], *, strict: bool) -> list[Bounds]:
        """A condition that depends on the time alone: t goes on from 0, t'^2 = 1."""
        t = self.system.t
        ends = []
        for constraint in self.system.problem.constraints:
            if (condition := constraint.holds_while) is None:
                continue
            end = self.along.rewritten(margin_of(condition, self.system.build), [t])
            if end is None:
                raise Undecided(f"whether contact '{constraint.name}' lasts was not decided")
            ends.append(end)
        start = Start(S.Zero, S.One, S.Zero)
        return self._on_line(t, [S.One, *self._other(ends, [formula]), formula], start, values,
                             strict=strict)  # fmt: skip

    def _other(self, ends: Sequence[Expr], asked: Sequence[Expr]) -> list[Expr]:
        """What ends the motion beside the condition itself."""
        others = [end for end in ends if all(is_zero(end - f) is not True for f in asked)]
        if others and asked:
            self.notes.append("as long as the other conditions hold")
        return others

    def _constant(self, margin: Expr, *, strict: bool) -> list[Bounds]:
        """A condition without coordinates."""
        plan = Evaluator([margin], FINE_DIGITS)

        def verdict(numbers: Values) -> bool | None:
            [value] = plan.where_defined(numbers) or [None]
            if not isinstance(value, mpf) or not mpmath.isfinite(value):
                return None
            return bool(value > _SMALL or (not strict and value >= -_SMALL))

        return self._ranges([], [margin], [margin], verdict)

    # -- places ----------------------------------------------------------------------------------

    def _reaching(self, question: Reaching, values: dict[Symbol, Expr]) -> list[Bounds]:
        u = self.system.symbol_of(question.coordinate.name)
        passing = self.passings[u]
        if passing.square is None:
            raise Undecided(self._why_not or f"the conservation laws do not give {u}'^2")
        target = self.system.build(question.value)
        return self._along(passing, [], target, values, strict=False)

    def _along(
        self,
        passing: Passing,
        asked: list[Expr],
        target: Expr | None,
        values: dict[Symbol, Expr],
        *,
        strict: bool,
    ) -> list[Bounds]:
        """The ranges for the motion in one coordinate: its own end is a place or a condition."""
        assert passing.square is not None
        margins = self._margins(passing)
        if passing.undecided:
            raise Undecided(passing.undecided[0])
        u = passing.u
        acceleration = self.along.on_motion(self.system.symbol_of(u.name + "''"))
        if acceleration is None:
            raise Undecided(self.along.why_not)
        initially = self.along.initially
        start = Start(initially(u), initially(passing.rate), initially(acceleration), target)
        functions = [passing.square, *self._other(margins, asked), *asked]
        return self._on_line(u, functions, start, values, strict=strict)

    def _margins(self, passing: Passing) -> Sequence[Expr]:
        """What ends the motion where it is negative; not the condition in question."""
        contacts = [c.holds_while for c in self.system.problem.constraints if c.holds_while]
        if isinstance(self.question, Lasting) and contacts == [self.question.condition]:
            return passing.assumed
        return passing.margins

    def _on_line(
        self,
        u: Symbol,
        functions: Sequence[Expr],
        start: Start,
        values: dict[Symbol, Expr],
        *,
        strict: bool,
    ) -> list[Bounds]:
        functions = [f.xreplace(values) for f in functions]
        start = start.with_values(values)
        line = FunctionsOnLine(u, functions)
        if line.rate is not None and start.target is not None:
            if line.rate != 1:
                raise Undecided(f"{u} stands in sines and cosines and is no angle")
            self.notes.append("values of the angle that differ by whole turns count as one")
        wall = 1 if u.is_nonnegative else -1 if u.is_nonpositive else 0
        walk = Walk(line, start, strict=strict, wall=wall)
        events = self._events(line, start, wall)
        lengths = [u - place for place in (start.place, start.target) if place is not None]
        return self._ranges([u], [*functions, *lengths, *start.formulas], events, walk.verdict)

    def _events(self, line: FunctionsOnLine, start: Start, wall: int) -> list[Expr]:
        events = [*line.events(), *line.at(start.place), start.velocity, start.acceleration]
        if start.target is not None:
            events += [*line.at(start.target), start.target - start.place]
        if wall:
            events += [*line.at_zero(), start.place]
        return events

    def _ranges(
        self,
        variables: Sequence[Symbol],
        functions: Sequence[Expr],
        events: Sequence[Expr],
        verdict: Callable[[Values], bool | None],
    ) -> list[Bounds]:
        special = SpecialValues(self.p, events, self._positive)
        if special.angle:
            self.notes.append("angles are given to within whole turns")
        present = {symbol for function in functions for symbol in function.free_symbols}
        others = [q for q in self.system.parameters if q is not self.p and q in present]
        scaled = special.scales([*variables, self.p], others, functions)
        return ranges(special, others, verdict, self.along.work, scaled=scaled)

    @property
    def _positive(self) -> list[Expr]:
        """Initial values of coordinates that are positive, which say so of the parameters."""
        build, initial = self.system.build, self.system.problem.initial
        places = {str(name): value for name, value in initial.items()}
        begun = [build(places[q.name]) for q in self.system.q if q.is_positive and q.name in places]
        return [
            place
            for place in begun
            if self.p not in place.free_symbols and place.free_symbols and sign(place) is None
        ]


def margin_of(condition: Inequality, build: Builder) -> Expr:
    """What is >= 0, or > 0, where the condition holds."""
    larger, smaller = map(build, condition.larger_first)
    return larger - smaller
