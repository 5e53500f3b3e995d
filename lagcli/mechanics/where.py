"""`where left = right for unknown`: the roots, and which of them the motion comes to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.equations import Roots, solve_for
from lagcli.algebra.numeric import Evaluator
from lagcli.answers import Solutions
from lagcli.mechanics.find import AlongTheMotion
from lagcli.mechanics.parameter_values import admissible_values
from lagcli.mechanics.reach import LineOfMotion, Reach, real_value
from lagcli.problem import Where as WhereQuestion

_CHOICES = 8  # of parameter values, where the file gives none
_ZERO = mpf(10) ** -12
_EXACTLY = mpf(10) ** -40


@dataclass(frozen=True, slots=True)
class Root:
    """A root of the equation with the other unknown it was solved together with.

    `velocity` is u' at the root, where the equation speaks of it.
    """

    value: Expr
    velocity: Expr | None = None


class Where:
    """One question."""

    def __init__(self, along: AlongTheMotion, question: WhereQuestion) -> None:
        self.along = along
        self.system = along.system
        self.question = question
        self.unknown = self.system.symbol_of(str(question.unknown))
        equation = question.equation
        build = self.system.build
        self.equation = build(equation.left) - build(equation.right)
        self.notes: list[str] = []

    def solutions(self) -> Solutions:
        """The answer; `solutions` is None where none was found, with the reason in `note`."""
        if self.unknown in self.system.q:
            roots = self._coordinate()
        elif self.unknown in self.system.qdot:
            roots = self._velocity()
        else:
            roots = self._parameter()
        if roots is None:
            return self._answer(None, [self.along.why_not])
        return self._answer(roots, [*self.notes, *self.along.notes(roots)])

    def _answer(self, roots: Sequence[Expr] | None, notes: Sequence[str]) -> Solutions:
        trees = None if roots is None else tuple(map(self.along.tree, roots))
        note = "; ".join(dict.fromkeys(n for n in notes if n))
        return Solutions(unknown=self.unknown.name, solutions=trees, note=note)

    # -- a coordinate -----------------------------------------------------------------------

    def _coordinate(self) -> list[Expr] | None:
        u, velocity = self.unknown, self._rate
        equation = self.along.rewritten(self.equation, [u])
        speeds: Expr | None = None
        if equation is None:
            both = self.along.rewritten(self.equation, [u, velocity])
            square = self._square
            if both is None or square is None:
                return None
            split = _split(both, velocity, square)
            if split is None:
                self.along.why_not = f"the equation is not solved with {velocity}"
                return None
            # A + B u' = 0 with u'^2 = w:  A^2 = B^2 w
            a, b = split
            speeds = -a / b
            equation = a**2 - b**2 * square
        found = self._roots(equation)
        if found is None:
            return None
        return self._reached(found, equation, speeds)

    @cached_property
    def _rate(self) -> Symbol:
        return self.system.symbol_of(self.unknown.name + "'")

    @cached_property
    def _square(self) -> Expr | None:
        """w(u) = u'^2 by the conservation laws."""
        if self.along.initial is None:
            return None
        return self.along.rewritten(self._rate**2, [self.unknown])

    def _roots(self, equation: Expr) -> Roots | None:
        """All real roots, verified; None with the reason."""
        if self.unknown not in equation.free_symbols:
            holds = is_zero(equation)
            everywhere = "everywhere" if holds is True else "nowhere"
            self.along.why_not = f"the equation does not depend on {self.unknown}: it holds {everywhere}"
            return Roots((), angle=False) if holds is False else None
        found = solve_for(equation, self.unknown)
        if found is None:
            self.along.why_not = f"no closed form was found for {self.unknown}"
            return None
        kept = []
        for root in map(simplify, found.values):
            verdict = self._satisfies(equation, root)
            if verdict is None:
                continue
            if verdict is False:
                self.along.why_not = "a root could not be verified"
                return None
            kept.append(root)
        return Roots(tuple(kept), found.angle)

    def _satisfies(self, equation: Expr, root: Expr) -> bool | None:
        """Substitution at 50 digits, wherever the root is real and admissible.

        None where it is real for none of the tested parameters.
        """
        others = sorted(
            (equation.free_symbols | root.free_symbols)
            - {self.unknown, *self.system.parameters},
            key=lambda s: s.name,
        )
        tested = None
        approximate = root.is_Rational and len(str(root.q)) > 12
        limit = mpf(10) ** -10 if approximate else _EXACTLY
        for index, values in enumerate(self._choices):
            place = {**values, **{s: mpf(7 + index + k) / 11 for k, s in enumerate(others)}}
            value = real_value(root, place, digits=60)
            if value is None or not self._admissible(value):
                continue
            with mpmath.workdps(60):
                try:
                    parts = Evaluator(
                        [equation, *sympy.Add.make_args(sympy.expand(equation))], 60
                    )({**place, self.unknown: value})
                except (ArithmeticError, ValueError):
                    continue  # the root of a denominator
                tested = abs(parts[0]) < limit * max(mpf(1), *map(abs, parts[1:]))
                if not tested:
                    return False
        return tested

    @cached_property
    def _choices(self) -> list[dict[Symbol, mpf]]:
        return admissible_values(self.system, _CHOICES)

    def _admissible(self, value: mpf) -> bool:
        """Whether the unknown may have this value by what the file assumes."""
        u = self.unknown
        return not (
            (u.is_nonnegative and value < 0)
            or (u.is_positive and value <= 0)
            or (u.is_negative and value >= 0)
            or (u.is_nonzero and value == 0)
        )

    # -- reach ----------------------------------------------------------------------------------

    def _reached(self, found: Roots, equation: Expr, speeds: Expr | None) -> list[Expr] | None:
        """The roots that the motion comes to for some of the tested parameters."""
        roots = list(found.values)
        if self.along.initial is None:
            self.notes.append("without an initial state all roots are listed")
            return self._sorted(roots)
        square = self._square
        if square is None:
            self.notes.append("whether the motion comes there was not decided")
            return self._sorted(roots)
        line = self._line(square, angle=found.angle)
        if line is None:
            return None
        times_reached = dict.fromkeys(roots, 0)
        tested = 0
        rest = False
        for values in self._choices:
            try:
                reach = Reach(line, values)
            except (ArithmeticError, ValueError):
                continue
            tested += 1
            rest = rest or reach.at_equilibrium
            for root in roots:
                times_reached[root] += self._passes(reach, root, speeds)
        if not tested:
            self.along.why_not = "the initial state is not real for the tested parameters"
            return None
        kept = [root for root in roots if times_reached[root]]
        if any(times_reached[root] < tested for root in kept):
            self.notes.append("for some values of the parameters only")
        if roots and not kept:
            self.notes.append("the motion comes to none of the roots of the equation")
        if rest:
            kept = self._departing(kept, equation, square)
        return self._sorted(kept)

    def _line(self, square: Expr, *, angle: bool) -> LineOfMotion | None:
        along, u = self.along, self.unknown
        acceleration = along.on_motion(self.system.symbol_of(u.name + "''"))
        if acceleration is None:
            return None
        return LineOfMotion(
            coordinate=u,
            square_of_velocity=square,
            margins=tuple(self._margins()),
            start=along.initially(u),
            velocity=along.initially(self._rate),
            acceleration=along.initially(acceleration),
            angle=angle,
        )

    def _margins(self) -> list[Expr]:
        """left - right of every `holds_while`, as a function of u where it is one."""
        margins = []
        build = self.system.build
        for constraint in self.system.problem.constraints:
            if (condition := constraint.holds_while) is None:
                continue
            margin = build(condition.left) - build(condition.right)
            margin = margin if condition.comparison in (">", ">=") else -margin
            formula = self.along.rewritten(margin, [self.unknown])
            if formula is None:
                self.notes.append(f"whether contact '{constraint.name}' lasts was not decided")
            else:
                margins.append(formula)
        return margins

    def _passes(self, reach: Reach, root: Expr, speeds: Expr | None) -> bool:
        place = real_value(root, reach.values)
        if place is None or not self._admissible(place):
            return False
        signs = reach.signs(place)
        if speeds is None or not signs:
            return bool(signs)
        speed = real_value(speeds, {**reach.values, self.unknown: place})
        if speed is None:
            return True  # 0/0: both parts of the equation vanish there
        return abs(speed) < _ZERO or (1 if speed > 0 else -1) in signs

    def _departing(self, roots: list[Expr], equation: Expr, square: Expr) -> list[Expr]:
        """From rest at an equilibrium: mirror images are told once."""
        u = self.unknown
        self.notes.append("the initial state is an equilibrium: departure from it either way")
        if is_zero(self.along.initially(u)) is not True:
            return roots
        mirrored = {u: -u}
        even = is_zero(square - square.xreplace(mirrored)) is True and any(
            is_zero(equation + sign * equation.xreplace(mirrored)) is True for sign in (1, -1)
        )
        positive = [r for r in roots if (self._number(r) or 0) > 0]
        if not even or len(positive) == len(roots):
            return roots
        self.notes.append(f"{u} and -{u} are mirror images, the positive ones are listed")
        return [r for r in roots if (self._number(r) or 0) >= 0]

    def _number(self, root: Expr) -> mpf | None:
        for values in self._choices:
            number = real_value(root, values)
            if number is not None:
                return number
        return None

    def _sorted(self, roots: list[Expr]) -> list[Expr]:
        return sorted(roots, key=lambda r: (self._number(r) or mpf(0), str(r)))

    # -- a velocity or a parameter ----------------------------------------------------------

    def _velocity(self) -> list[Expr] | None:
        """u' where the equation holds: from it together with all relations."""
        v = self.unknown
        equation = self.along.on_motion(self.equation)
        if equation is None:
            return None
        for relations, remove in self.along.attempts([v], with_time=False):
            left = self.along.eliminated(v, (*relations, equation), remove)
            for relation in (*left.relations, v - left.expression):
                present = relation.free_symbols
                if v in present and not present & {*remove, self.system.t}:
                    found = self._roots(relation)
                    return None if found is None else self._sorted(self._allowed(found))
        formula = self.along.rewritten(self.equation, [v, *self.system.q])
        if formula is None or v not in formula.free_symbols:
            self.along.why_not = f"constraints and conserved quantities do not determine {v}"
            return None
        found = self._roots(formula)
        return None if found is None else self._sorted(self._allowed(found))

    def _parameter(self) -> list[Expr] | None:
        """A parameter for which the equation holds, with the coordinates that are left."""
        for keep in ((), self.system.q):
            formula = self.along.rewritten(self.equation, keep)
            if formula is not None:
                found = self._roots(formula)
                return None if found is None else self._sorted(self._allowed(found))
        return None

    def _allowed(self, found: Roots) -> list[Expr]:
        """Without the roots that the assumptions exclude."""
        u = self.unknown
        return [
            r
            for r in found.values
            if not (u.is_nonnegative and r.is_negative)
            and not (u.is_positive and r.is_nonpositive)
            and not (u.is_negative and r.is_nonnegative)
        ]


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
