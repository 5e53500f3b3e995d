"""Equilibria: the states of rest that solve the conditions of rest, all or the evident ones."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain, islice, product

import mpmath
import sympy
from sympy import Expr, S, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import simplify
from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.decimals import decimal, is_decimal
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import SolvedSystem, SystemSolution, solve_system
from lagcli.algebra.translates import least_period, one_of_each, recur
from lagcli.algebra.vanishing_factors import divisors
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.inequalities import never_together
from lagcli.mechanics.rest.family import Family, exists_where, family
from lagcli.mechanics.rest.kinks import at_cusps, at_kinks
from lagcli.mechanics.rest.rest_conditions import RestConditions, RestPoint
from lagcli.mechanics.rest.singular import is_pressed_to_an_edge, survives
from lagcli.mechanics.system import System
from lagcli.record import replace
from lagcli.statements.wording import FINITE_MASS, INDEPENDENT, NOT_ZERO, enumerated

_MAX_EVIDENT = 64  # six angles at 0 or pi
#: Why nothing is solved for where the forces at rest are 0/0.
NO_VALUE_AT_REST = "a force has no value at rest, as v/|v| has none"
_NO_CLOSED_SOLUTION = "no closed solution of the conditions of equilibrium was found"
#: Why none is listed where all are.
EVERYWHERE = "no force acts at rest, so every position that the constraints allow is an equilibrium"
#: Why nothing is solved for that is constant.
TIMED = "the equations depend explicitly on the time"
REACHED = "a contact moves, and may reach it"
_AT_A_KINK = "a force may jump at a kink of the potential, and rest there is not decided"
_AT_A_JUMP = "the potential may jump where its derivatives vanish, and rest there is not decided"
_AT_AN_OPEN_POWER = (
    "where the base of a power is 0 the force depends on the exponent, and rest there is not "
    "decided"
)
_AT_AN_EDGE = (
    "the forces vanish at the edge of the positions that the coordinates describe, and rest there "
    "is not decided"
)


def _finite_where(values: Iterable[Expr]) -> Iterator[Expr]:
    """The squares of what values are divided by, where that may be 0."""
    order = sympy.default_sort_key
    found = (divisor for value in values for divisor in sorted(divisors(value), key=order))
    yield from (f**2 for f in dict.fromkeys(found) if f.free_symbols and sign(f**2) is None)


def _signs_of_letters(positive: Sequence[Expr]) -> Iterator[Expr]:
    """-b where one of these is not positive for any b > 0: of -b (2 a b + k), say."""
    letters = {s for e in positive for s in e.free_symbols if s.is_nonnegative is None}
    for letter in sorted(letters, key=str):
        for side in (1, -1):
            put_in = {letter: side * sympy.Dummy(letter.name, positive=True)}
            if any(sign(simplify(e.xreplace(put_in))) in (-1, 0) for e in positive if e != letter):
                yield -side * letter


def not_specified(system: System, conditions: Iterable[Expr]) -> str:
    """Which functions of the conditions the file does not specify, in a sentence; empty: none."""
    called = {
        word
        for c in conditions
        for f in c.atoms(AppliedUndef)  # U, U' or diff(U, 1, 2)
        for word in re.findall(r"\w+", f.func.__name__)
    }
    names = [name for name in system.problem.functions if name in called]
    if not names:
        return ""
    nouns = "function" if len(names) == 1 else "functions"
    return f"the {nouns} {enumerated(names)} {'is' if len(names) == 1 else 'are'} not specified"


class RestPoints(RestConditions):
    """All equilibria of a system, or the evident ones.

    Attributes
    ----------
    reason
        Why none can be given, in a sentence; empty otherwise.
    """

    def __init__(self, dynamics: Dynamics, *, kinks_apart: bool = False) -> None:
        super().__init__(dynamics)
        self._kinks_apart = kinks_apart  # rest at kinks is sought by others
        self.reason = ""
        self.complete = True
        #: there may be some, and no closed solution was found
        self.is_unsolved = False
        #: all solutions are where the coordinates are singular, and none is an equilibrium
        self.at_singular_coordinates = False
        #: at some solutions the base of a power is 0, and its exponent has no known sign
        self.at_open_powers = False
        #: at some solutions the potential jumps
        self.at_jumps = False
        #: at some solutions the gradients of the constraints are not independent
        self.at_singular_constraints = False

    @cached_property
    def points(self) -> tuple[RestPoint, ...] | None:
        """The equilibria; None with a reason where there is nothing to solve.

        `complete` tells afterwards whether there can be no other.
        """
        if self.has_no_value:
            self.reason, self.complete = NO_VALUE_AT_REST, False
            return None
        equations, still = self.at_all_times, dict.fromkeys(self.system.qdot, S.Zero)
        found, lost = self._found(equations)
        if not (found or self.complete or self.depends_on_time) and self.sums:
            self.complete = True
            return ()
        places = [place.values for place in found]
        kinks = not (self.depends_on_time or self._kinks_apart) and (
            at_kinks(self.forces_at_rest, equations, self.system.q, places)
            or at_cusps(-self.system.L.xreplace(still), self.system.q)
        )
        self.complete &= not (lost or kinks or (found and self.goes_beyond_one_turn))
        if not self.complete and self.rests_everywhere:
            self.reason = EVERYWHERE
            return None
        if not self.complete:
            known = [{**dict.fromkeys(p.free), **p.values} for p in found]
            evident = (
                p for p in self._evident() if {**dict.fromkeys(p.free), **p.values} not in known
            )
            found += evident
            if not found:
                unknown = not_specified(self.system, equations)
                self.is_unsolved = bool(unknown) or not kinks
                self.reason = unknown or (_AT_A_KINK if kinks else _NO_CLOSED_SOLUTION)
                self.reason = _AT_AN_OPEN_POWER if self.at_open_powers else self.reason
                self.reason = _AT_A_JUMP if self.at_jumps else self.reason
                self.reason = TIMED if self.depends_on_time else self.reason
                return None
        return self._in_regular_coordinates(found)

    def _in_regular_coordinates(self, found: list[RestPoint]) -> tuple[RestPoint, ...] | None:
        kept = tuple(point for point in found if survives(self, point))
        if any(point not in kept and is_pressed_to_an_edge(self, point) for point in found):
            self.reason, self.complete = _AT_AN_EDGE, False
            return kept or None
        self.at_singular_coordinates = bool(found) and not kept
        return kept

    def _found(self, equations: list[Expr]) -> tuple[list[RestPoint], bool]:
        """The solutions that balance; whether a family was lost of which some members may."""
        solved = self._over_all_turns(equations)
        if not solved.complete:
            solved = self._up_to_translations(equations) or solved
        self.complete = solved.complete
        found, lost = [], False
        for each in solved.solutions:
            if any(e.has(*NO_VALUE) for e in each.positive):
                lost = True  # a force has no value there, as that of asin(sin(x)) at pi/2
                continue
            if never_together(each.positive):
                continue
            solution = replace(each, values=self._to_the_last_digit(each.values))
            if self.has_unreal_power(solution.values):
                self.at_open_powers = True
                continue
            point = self._point(solution)
            if any(not free_of(x, [self.system.t]) for x in solution.values.values()):
                lost |= len(solution.values) < len(self.system.q)
            elif point is not None and self.balanced(point.values, solution.positive):
                found.append(point)
            elif self.jumps_at(solution.values):
                lost = self.at_jumps = True
            elif self.without_value(solution.values):
                self.at_open_powers |= self.has_open_power(solution.values)
            elif len(solution.values) < len(self.system.q) and self._may_be_real(solution):
                lost = True
            else:
                self.at_singular_constraints |= self.loses_rank(solution.values)
        return found, lost or self.at_open_powers or not (found or solved.complete)

    def _over_all_turns(self, equations: list[Expr]) -> SolvedSystem:
        """All solutions, with an angle in (-pi n, pi n] where the forces have the period 2 pi n."""
        scaled = {q: n * q for q, n in self._periods.items()}
        solved = solve_system([e.xreplace(scaled) for e in equations], self.system.q, families=True)
        solved = replace(solved, solutions=self._one_of_each(solved.solutions))
        if not scaled:
            return solved
        back = {q: q / n for q, n in self._periods.items()}
        solutions = [
            SystemSolution(
                {q: self._periods.get(q, 1) * v.xreplace(back) for q, v in each.values.items()},
                tuple(e.xreplace(back) for e in each.positive),
                None if each.relation is None else each.relation.xreplace(back),
            )
            for each in solved.solutions
        ]
        return SolvedSystem(solutions, solved.complete)

    def _one_of_each(self, solutions: list[SystemSolution]) -> list[SystemSolution]:
        """Those of one coordinate, a length, that are not a whole number of periods apart."""
        q = self.system.q
        if len(q) != 1 or len(solutions) < 2 or self.dynamics.constraints.equations:
            return solutions
        period = least_period([*chain(*self.mass_matrix), *self.forcing], q[0])
        if period is None or any(list(each.values) != list(q) for each in solutions):
            return solutions
        kept = one_of_each((each.values[q[0]] for each in solutions), period)
        return [each for each in solutions if each.values[q[0]] in kept]

    @cached_property
    def _periods(self) -> dict[Symbol, int]:
        """The n > 1 by their coordinates: of cos(q/n) in forces that one turn changes."""
        positions = [e.f for e in self.dynamics.constraints.equations if e.holonomic]
        found, formulas = {}, [*self.forces_at_rest, *positions]
        nodes = {node for f in formulas for node in f.atoms(*CIRCULAR)}
        hidden: dict[Expr, Expr] = {node: sympy.Dummy() for node in nodes}
        for q in self.system.q:
            rates = [simplify(x.args[0].diff(q)) for x in nodes if not free_of(x, [q])]
            if not all(rate.is_Rational for rate in rates):
                continue
            n = sympy.ilcm(1, 1, *(rate.q for rate in rates))
            sines = n > 1 and all(free_of(f.xreplace(hidden), [q]) for f in formulas)
            if sines and not recur(formulas, q):
                found[q] = int(n)
        return found

    @cached_property
    def is_of_one_turn(self) -> bool:
        """Whether places are sought within one turn of an angle, which changes the forces."""
        angles = [q for q in self.system.q if self.is_angle(q) and q not in self._periods]
        return not all(recur(self.forces_at_rest, q) for q in angles)

    def _up_to_translations(self, equations: list[Expr]) -> SolvedSystem | None:
        """All solutions at which the q are 0 along which nothing changes, then moved along them."""
        q, moved, shift = self.system.q, self.translations, self._shift
        if not moved or any(s.is_nonnegative or s.is_nonzero for s in q):
            return None
        still = [e.xreplace(dict.fromkeys(moved, S.Zero)) for e in equations]
        solved = solve_system(still, list(shift), families=True)
        if not solved.complete:
            return None
        back = {s: s - by for s, by in shift.items()}
        return SolvedSystem(
            [
                SystemSolution(
                    {s: simplify(v.xreplace(back) + shift[s]) for s, v in each.values.items()},
                    tuple(p.xreplace(back) for p in each.positive),
                    None if each.relation is None else simplify(each.relation.xreplace(back)),
                )
                for each in solved.solutions
            ]
        )

    @property
    def _shift(self) -> dict[Symbol, Expr]:
        """What the other q are moved by along with those that may be moved freely."""
        moved = self.translations
        return {
            s: sympy.Add(*(c[i] * free for free, c in moved.items()))
            for i, s in enumerate(self.system.q)
            if s not in moved
        }

    def _to_the_last_digit(self, values: Mapping[Symbol, Expr]) -> Mapping[Symbol, Expr]:
        """The same, the decimals among them by Newton's method: some come from rounded ones."""
        decimals = any(map(is_decimal, values.values()))
        if not decimals or self.dynamics.constraints.equations or len(values) < len(self.system.q):
            return values
        forces = Evaluator(self.forces_at_rest)
        try:
            with mpmath.workdps(DIGITS):
                start = [mpmath.mpf(int(x.p)) / int(x.q) for x in values.values()]
                root = mpmath.findroot(lambda *x: forces(dict(zip(values, x, strict=True))), start)
        except (ArithmeticError, AttributeError, ValueError, KeyError):
            return values
        return {
            q: decimal(sympy.Float(x, DIGITS)) if is_decimal(old) else old
            for (q, old), x in zip(values.items(), root, strict=True)
        }

    def _point(self, solution: SystemSolution) -> RestPoint | None:
        q, values, known = self.system.q, dict(solution.values), None
        positive = (*solution.positive, *_finite_where(values.values()))
        if solution.relation is not None:
            room = exists_where(solution.relation, q)
            if room is None:
                return None
            positive = (*positive, *room)
            known = family(solution.relation, solution.values, q)
            if known is None:
                self.complete = False
                return None
            if known.root.has(sympy.I):
                if self._real_points(known):
                    self.complete = False
                return None
            branch = {known.unknown: known.root}
            values = {**{s: v.xreplace(branch) for s, v in values.items()}, **branch}
        free = tuple(s for s in q if s not in values)
        apart = tuple(self.independent_where(values, free))
        self.at_singular_constraints |= bool(apart)
        known_apart = (each for each in apart if each is not None)
        positive = (*positive, *self.real_where(values), *known_apart)
        return RestPoint(values, free, (*positive, *_signs_of_letters(positive)), known)

    def _may_be_real(self, solution: SystemSolution) -> bool:
        """Whether a family has real members: x^2 - x y + y^2 = 0 has one point only."""
        if solution.relation is None:
            return True
        known = family(solution.relation, solution.values, self.system.q)
        return known is None or not known.root.has(sympy.I) or self._real_points(known)

    def _real_points(self, known: Family) -> bool:
        """Whether a relation whose roots are not real may hold at equilibria, where they are."""
        _, imaginary = known.root.as_real_imag()
        solved = solve_system([imaginary], self.system.q)
        for each in solved.solutions:
            put_in = dict(each.values)
            put_in[known.unknown] = known.root.xreplace(put_in)
            values = {q: value.xreplace(put_in) for q, value in known.given.items()} | put_in
            try:
                if self.balanced(values):
                    return True
            except ZeroDivisionError:
                continue
        return not solved.complete

    @property
    def restricted_to(self) -> str:
        """Where rest was decided, in words; empty: everywhere."""
        if not self.points and self._mass_may_be_infinite:
            return FINITE_MASS
        several = len(self.dynamics.constraints.equations) > 1
        return (INDEPENDENT if several else NOT_ZERO) if self.at_singular_constraints else ""

    @property
    def _mass_may_be_infinite(self) -> bool:
        """Whether coordinates fail where a denominator of T vanishes, as on an ellipse's axis."""
        entries = (entry for row in self.dynamics.lagrange.mass_matrix_at_rest for entry in row)
        below = (sympy.denom(sympy.together(entry)) for entry in entries)
        return any(not free_of(d, self.system.q) and sign(d) not in (1, -1) for d in below)

    def _evident(self) -> list[RestPoint]:
        """Of the states q = 0, with angles at 0 or pi, the equilibria, moved where all can be."""
        if any(s.is_nonzero for s in self.system.q):
            return []
        shift = self._shift
        choices = [(S.Zero, sympy.pi) if self.is_angle(s) else (S.Zero,) for s in shift]
        found = []
        for place in islice(product(*choices), _MAX_EVIDENT):
            pairs = zip(shift.items(), place, strict=True)
            values = {s: simplify(x + by) for (s, by), x in pairs}
            if self.balanced(values):
                found.append(RestPoint(values, tuple(self.translations)))
        return found or list(self._evident_in_one())

    def _evident_in_one(self) -> Iterator[RestPoint]:
        """On a curve, where one coordinate is 0, or an angle 0 or pi: the others follow."""
        q, known = self.system.q, []
        on_a_curve = len(self.dynamics.independent_constraints) == len(q) - 1 > 0
        places = [(s, x) for s in q for x in (S.Zero, sympy.pi)[: 1 + self.is_angle(s)]]
        for unknown, value in places if on_a_curve else ():
            there = [e.xreplace({unknown: value}) for e in self.at_all_times]
            if any(e.has(*NO_VALUE) for e in there):
                continue
            for each in solve_system(there, [s for s in q if s != unknown]).solutions:
                solution = replace(each, values={unknown: value, **each.values})
                point = self._point(solution) if len(solution.values) == len(q) else None
                if point is None or point.values in known:
                    continue
                known.append(point.values)
                if self.balanced(point.values, solution.positive):
                    yield point
