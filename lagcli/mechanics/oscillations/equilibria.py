"""Equilibria: states of rest at which all forces and constraint forces balance.

    forcing_j(q, q' = 0) + sum_k lambda_k a_kj(q) = 0,   f(q) = 0,   b(q) = 0

The multipliers are removed by taking the components along the constraint surface: the
virtual work of the forces vanishes for every displacement with A dq = 0.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 1.4 and 6.1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from itertools import chain, combinations, product

import mpmath
import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import Field, dot, is_zero, nullspace, simplify
from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.equations import decimal, is_decimal, rounded
from lagcli.algebra.factors import factors_of
from lagcli.algebra.field import common_denominator
from lagcli.algebra.numeric import Evaluator, vanishes_at_random
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import SystemSolution, solve_system
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.oscillations.exceptions import without_unknowns
from lagcli.mechanics.oscillations.family import Family, exists_where, family
from lagcli.mechanics.oscillations.kinks import at_kinks
from lagcli.mechanics.reduction.readable import weak_sign
from lagcli.mechanics.translations import constant_nullspace
from lagcli.record import record
from lagcli.statements.wording import FINITE_MASS, INDEPENDENT, NOT_ZERO

_MAX_EVIDENT = 64
#: Why nothing is solved for where the forces at rest are 0/0.
NO_VALUE_AT_REST = "a force has no value at rest, as v/|v| has none"
_NO_CLOSED_SOLUTION = "the conditions of equilibrium have no closed solution"
#: Why nothing is solved for that is constant.
TIMED = "the equations depend explicitly on the time"
_AT_A_KINK = "a force jumps where its sign changes, and rest at such a kink is not decided"
#: Digits to which decimals are worked out.
_DIGITS = 40
_AT_AN_EDGE = (
    "the forces vanish at the edge of the positions that the coordinates describe, and rest there "
    "is not decided"
)
_LONGEST = 60  # operations of conditions that are quoted
_LAST_DIGITS = sympy.Float("1e-13")


@record
class RestPoint:
    """An equilibrium: values of coordinates as formulas in the free ones and parameters.

    It is there where each of `positive` is > 0.  With a `family` it is one branch of that.
    """

    values: Mapping[Symbol, Expr]
    free: tuple[Symbol, ...]
    positive: tuple[Expr, ...] = ()
    family: Family | None = None


class RestPoints:
    """All equilibria of a system, or the evident ones.

    Attributes
    ----------
    reason
        Why none can be given, in a sentence; empty otherwise.
    """

    def __init__(self, dynamics: Dynamics, *, kinks_apart: bool = False) -> None:
        self.dynamics = dynamics
        self._kinks_apart = kinks_apart  # rest at kinks is sought by others
        self.system = dynamics.system
        self.reason = ""
        self.complete = True
        #: all solutions are where the coordinates are singular, and none is an equilibrium
        self.at_singular_coordinates = False
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
        equations = self._at_all_times
        found, lost = self._found(equations)
        if not (found or self.complete or self.depends_on_time) and self.sums:
            self.complete = True
            return ()
        kinks = not (self.depends_on_time or self._kinks_apart) and at_kinks(
            self.forces_at_rest, equations, self.system.q, found
        )
        self.complete &= not lost and not kinks
        if not self.complete:
            known = {tuple(p.values.get(q, q) for q in self.system.q) for p in found}
            found += [p for p in self._evident() if tuple(p.values.values()) not in known]
            if not found:
                self.reason = _AT_A_KINK if kinks else _NO_CLOSED_SOLUTION
                self.reason = TIMED if self.depends_on_time else self.reason
                return None
        return self._in_regular_coordinates(found)

    def _in_regular_coordinates(self, found: list[RestPoint]) -> tuple[RestPoint, ...] | None:
        from lagcli.mechanics.oscillations.singular import is_pressed_to_an_edge, survives

        kept = tuple(point for point in found if survives(self, point))
        if any(point not in kept and is_pressed_to_an_edge(self, point) for point in found):
            self.reason, self.complete = _AT_AN_EDGE, False
            return kept or None
        self.at_singular_coordinates = bool(found) and not kept
        return kept

    def _found(self, equations: list[Expr]) -> tuple[list[RestPoint], bool]:
        """The solutions that balance; whether a family was lost of which some members may."""
        solved = solve_system(equations, self.system.q, families=True)
        self.complete = solved.complete
        found, lost = [], False
        for each in solved.solutions:
            if -1 in map(weak_sign, each.positive):
                continue
            solution = replace(each, values=self._to_the_last_digit(each.values))
            point = self._point(solution)
            if any(not free_of(x, [self.system.t]) for x in solution.values.values()):
                lost |= len(solution.values) < len(self.system.q)
            elif point is not None and self.balanced(point.values, solution.positive):
                found.append(point)
            elif self._without_value(solution.values):
                continue
            elif len(solution.values) < len(self.system.q) and self._may_be_real(solution):
                lost = True
            else:
                self.at_singular_constraints |= self._loses_rank(solution.values)
        return found, lost or not (found or solved.complete)

    def _to_the_last_digit(self, values: Mapping[Symbol, Expr]) -> Mapping[Symbol, Expr]:
        """The same, the decimals among them by Newton's method: some come from rounded ones."""
        decimals = any(map(is_decimal, values.values()))
        if not decimals or self.dynamics.constraints.equations or len(values) < len(self.system.q):
            return values
        forces = Evaluator(self.forces_at_rest, _DIGITS)
        try:
            with mpmath.workdps(_DIGITS):
                start = [mpmath.mpf(int(x.p)) / int(x.q) for x in values.values()]
                root = mpmath.findroot(lambda *x: forces(dict(zip(values, x, strict=True))), start)
        except (ArithmeticError, AttributeError, ValueError, KeyError):
            return values
        return {
            q: decimal(sympy.Float(x, _DIGITS)) if is_decimal(old) else old
            for (q, old), x in zip(values.items(), root, strict=True)
        }

    def _point(self, solution: SystemSolution) -> RestPoint | None:
        q, values, known = self.system.q, dict(solution.values), None
        positive = solution.positive
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
        return RestPoint(values, free, positive, known)

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
            values = {**known.given, **each.values}
            values[known.unknown] = known.root.xreplace(dict(each.values))
            try:
                if self.balanced(values):
                    return True
            except ZeroDivisionError:
                continue
        return not solved.complete

    @cached_property
    def depends_on_time(self) -> bool:
        """Whether the equations or the constraints have t in them."""
        system, constraints = self.system, self.dynamics.constraints
        everything = [
            *self.forcing,
            *(entry for e in constraints.equations for entry in (*e.row, e.drift)),
            *(e.f for e in constraints.equations if e.holonomic),
        ]
        return not all(
            free_of(e, [system.t]) or is_zero(e.diff(system.t)) is True for e in everything
        )

    @cached_property
    def growth(self) -> Expr:
        """f(t) > 0 of equations of motion that are f(t) times others without t, else 1."""
        t, lagrange = self.system.t, self.dynamics.lagrange
        entries = [x for x in (*chain(*lagrange.mass_matrix), *lagrange.forcing) if x != 0]
        if not entries or free_of(entries[0], [t]):
            return S.One
        timed = (f**k for f, k in factors_of(simplify(entries[0])) if f.free_symbols & {t})
        growth = sympy.Mul(*timed)
        alike = all(free_of(simplify(entry / growth), [t]) for entry in entries)
        return growth if alike and sign(growth) == 1 else S.One

    @cached_property
    def forcing(self) -> tuple[Expr, ...]:
        """Of M q'' = forcing + A^T lambda, without a factor f(t) that all equations have."""
        forcing = self.dynamics.lagrange.forcing
        return forcing if self.growth == 1 else tuple(simplify(f / self.growth) for f in forcing)

    @cached_property
    def mass_matrix(self) -> tuple[tuple[Expr, ...], ...]:
        """M, without the factor that `forcing` is without."""
        rows = self.dynamics.lagrange.mass_matrix
        if self.growth == 1:
            return rows
        return tuple(tuple(simplify(x / self.growth) for x in row) for row in rows)

    @cached_property
    def energy_never_grows(self) -> bool:
        """Whether no force, dissipation or constraint feeds the energy function."""
        from lagcli.mechanics.stability.energy import never_grows

        return self.growth == 1 and never_grows(self.dynamics)

    @cached_property
    def forces_at_rest(self) -> tuple[Expr, ...]:
        """forcing(q, q' = 0)."""
        at_rest = dict.fromkeys(self.system.qdot, S.Zero)
        return tuple(f.xreplace(at_rest) for f in self.forcing)

    @property
    def has_no_value(self) -> bool:
        """Whether a force is 0/0 or infinite in every state of rest."""
        return any(f.has(S.NaN, S.ComplexInfinity) for f in self.forces_at_rest)

    @cached_property
    def equations(self) -> list[Expr]:
        """What vanishes at rest: the constraints, and the forces along what they allow."""
        constraints = self.dynamics.constraints
        conditions = [e.f for e in constraints.equations if e.holonomic]
        conditions += [e.drift for e in constraints.equations if not e.holonomic]
        forces: Sequence[Expr] = self.forces_at_rest
        if self._one_gradient:
            forces = self._along_one
        elif constraints.equations:
            forces = [dot(v, forces) for v in _polynomial(self._displacements)]
        return [e for e in (*conditions, *forces) if is_zero(e) is not True]

    @property
    def _displacements(self) -> list[list[Expr]]:
        """A basis of the v with A v = 0, solved for coordinates whose factors vanish nowhere."""
        rows, q = self.dynamics.constraints.jacobian, self.system.q

        def may_vanish(j: int) -> bool:
            return not any(free_of(row[j], q) and is_zero(row[j]) is False for row in rows)

        order = sorted(range(len(q)), key=may_vanish)
        back = [order.index(j) for j in range(len(q))]
        return [[v[k] for k in back] for v in nullspace([[row[j] for j in order] for row in rows])]

    @cached_property
    def _at_all_times(self) -> list[Expr]:
        """The same with its first rates of change: a state of rest is one at all times."""
        if not self.depends_on_time:
            return self.equations
        t = self.system.t
        rates = [e.diff(t, k) for k in (0, 1, 2) for e in self.equations]
        return [e for e in rates if is_zero(e) is not True]

    @property
    def conditions(self) -> tuple[Expr, ...]:
        """What the coordinates of an equilibrium solve; empty where that is long."""
        short = [simplify(e) for e in self.equations if not free_of(e, self.system.q)]
        short = [-e if e.could_extract_minus_sign() else e for e in short]
        return tuple(short) if sum(int(e.count_ops()) for e in short) <= _LONGEST else ()

    @cached_property
    def sums(self) -> list[Expr]:
        """Sums of multiples of the equations in which the coordinates cancel, and not all does.

        Newton's third law: of bodies that push each other, the outer forces are left.
        """
        equations, q = [e for e in self.equations if not free_of(e, self.system.q)], self.system.q
        if len(equations) < 2:
            return []
        slopes = [[e.diff(x) for e in equations] for x in q]
        multiples = constant_nullspace(slopes, q)
        sums = (simplify(dot(c, equations)) for c in multiples)
        return [x for x in sums if is_zero(x) is not True]

    @cached_property
    def unless(self) -> tuple[Expr, ...] | None:
        """What has no coordinate in it and is 0 for some values of the parameters only.

        None where special values were not excluded.
        """
        timed = [self.system.t] if self.depends_on_time else []
        return without_unknowns((*self._at_all_times, *self.sums), (*self.system.q, *timed))

    @property
    def edge(self) -> tuple[str, ...]:
        """Coordinates assumed positive at whose value 0 all conditions hold."""

        def holds(q: Symbol) -> bool:
            there = [e.xreplace({q: S.Zero}) for e in self.equations]
            return not any(e.has(S.NaN, S.ComplexInfinity) or is_zero(e) is not True for e in there)

        return tuple(q.name for q in self.system.q if q.is_positive and holds(q))

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
        entries = (entry for row in self.dynamics.lagrange.mass_matrix for entry in row)
        below = (sympy.denom(sympy.together(entry)) for entry in entries)
        return any(not free_of(d, self.system.q) and sign(d) not in (1, -1) for d in below)

    @property
    def _one_gradient(self) -> bool:
        """Whether no basis of the displacements is one everywhere, of a single constraint."""
        constraints = self.dynamics.constraints.equations
        return len(constraints) == 1 and not any(
            free_of(a, self.system.q) and is_zero(a) is False for a in constraints[0].row
        )

    @property
    def _along_one(self) -> list[Expr]:
        """a_i F_j = a_j F_i: the force along the gradient of a single constraint."""
        [constraint] = self.dynamics.constraints.equations
        a, F = constraint.row, self.forces_at_rest
        pairs = combinations(range(len(F)), 2)
        return [simplify(a[i] * F[j] - a[j] * F[i]) for i, j in pairs]

    def _loses_rank(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether the gradients of the constraints are independent, but not there."""
        rows = self.dynamics.constraints.jacobian
        there = [[at(a, values) for a in row] for row in rows]
        return bool(rows) and len(nullspace(there)) > len(nullspace(rows))

    def balanced(self, values: Mapping[Symbol, Expr], positive: Sequence[Expr] = ()) -> bool:
        """Whether a state of rest is an equilibrium, by substitution where these are positive.

        It is none where the equations have no value.
        """
        try:
            return self._balanced(values, positive)
        except ZeroDivisionError:
            return False

    def _balanced(self, values: Mapping[Symbol, Expr], positive: Sequence[Expr]) -> bool:
        rounded = [q for q, value in values.items() if is_decimal(value)]
        if rounded and not self.dynamics.constraints.equations:
            return all(_nearly_vanishes(f, values, rounded) for f in self.forces_at_rest)
        residuals = (where_positive(each, positive) for each in self._residuals(values))
        return all(is_zero(each) is True or _vanishes(each) for each in residuals)

    def _without_value(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether some force has no value at any member of a family."""
        forces = (at(f, values) for f in self.forces_at_rest)
        try:
            return any(f.has(S.NaN, S.ComplexInfinity) for f in forces)
        except ZeroDivisionError:
            return True

    def _residuals(self, values: Mapping[Symbol, Expr]) -> list[Expr]:
        constraints = self.dynamics.constraints
        forces = [at(f, values) for f in self.forces_at_rest]
        conditions = [at(e.f if e.holonomic else e.drift, values) for e in constraints.equations]
        if not constraints.equations:
            return forces
        rows = [[at(a, values) for a in row] for row in constraints.jacobian]
        return [*conditions, *(dot(vector, forces) for vector in nullspace(rows))]

    def _evident(self) -> list[RestPoint]:
        """Of the states q = 0, with angles at 0 or pi, the equilibria, moved where all can be."""
        q, moved = self.system.q, self._translations
        choices = [
            (S.Zero, sympy.pi) if s not in moved and self._is_angle(s) else (S.Zero,) for s in q
        ]
        found = []
        for count, place in enumerate(product(*choices)):
            if count == _MAX_EVIDENT:
                break
            values = {
                s: simplify(x + sympy.Add(*(c[i] * free for free, c in moved.items())))
                for i, (s, x) in enumerate(zip(q, place, strict=True))
                if s not in moved
            }
            if any(s.is_nonzero for s in q):
                break
            if self.balanced(values):
                found.append(RestPoint(values, tuple(moved)))
        return found

    @cached_property
    def _translations(self) -> dict[Symbol, list[Expr]]:
        """Constant displacements c under which what vanishes at rest is the same, by the q = c."""
        q = self.system.q
        rows = [[e.diff(s) for s in q] for e in self.equations]
        basis = constant_nullspace(rows, q) if rows else []
        own = [k for k in range(len(q)) if sum(c[k] != 0 for c in basis) == 1]
        return {q[max(k for k in own if c[k] == 1)]: c for c in basis}

    def _is_angle(self, q: Symbol) -> bool:
        """Whether the coordinate occurs inside sin and cos only."""
        field = Field(self.equations)
        elements = [field(e) for e in self.equations]
        used = {g for e in elements for g in field.ring.used(e.numerator)}
        kinds = {
            field.generators[g].kind
            for g in used
            if q in field.generators[g].expression.free_symbols
        }
        return bool(kinds) and kinds <= {"cos", "sin"}


def at(expression: Expr, values: Mapping[Symbol, Expr]) -> Expr:
    """The value at a place; multiple angles are expanded, so that sin(acos(k)) is radical."""
    present = {s: v for s, v in values.items() if s in expression.free_symbols}
    if not present:
        return expression
    if not expression.has(*CIRCULAR):
        # one fraction of sums of roots would be long, and is needed where parts are infinite only
        there = expression.xreplace(present)
        if not there.has(S.NaN, S.ComplexInfinity, S.Infinity, S.NegativeInfinity):
            return rounded(simplify(there))
        roots = filter(_divides_by_root, expression.atoms(sympy.Pow))
        if any(is_zero(p.base.xreplace(present)) is True for p in roots):
            return S.NaN
    field, element = Field([expression]), None
    with suppress(ZeroDivisionError):
        element = field(expression)
        expression = field.to_sympy(element)
    value = rounded(simplify(expression.xreplace(present)))
    if value != 0 or element is None:
        return value
    below = field.to_sympy(field.polynomial(element.denominator))
    return S.NaN if is_zero(below.xreplace(present)) is True else value


def where_positive(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """The same where these are positive: sign and modulus of what is in proportion to them."""
    known: dict[Expr, Expr] = {}
    for node in expression.atoms(sympy.Abs, sympy.sign):
        for side in (sign(simplify(node.args[0] / u)) for u in positive):
            if side in (1, -1):
                known[node] = S(side) if node.func is sympy.sign else side * node.args[0]
    return expression.xreplace(known)


def _divides_by_root(power: sympy.Pow) -> bool:
    return bool(power.exp.is_Rational and not power.exp.is_Integer and power.exp < 0)


def _polynomial(vectors: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
    """The vectors times their denominators: defined everywhere."""
    whole = []
    for vector in vectors:
        field = Field(vector)
        elements = [field(v) for v in vector]
        factor = field.polynomial(common_denominator(field, elements))
        whole.append([field.to_sympy(each * factor) for each in elements])
    return whole


def _nearly_vanishes(force: Expr, values: Mapping[Symbol, Expr], rounded: list[Symbol]) -> bool:
    """Whether the force changes its sign, or vanishes, within the last digits of the values."""
    put_in = list(values.items())
    numbers = [
        x.subs(put_in, simultaneous=True).evalf(40)
        for x in (force, *(force.diff(q) * values[q] for q in rounded))
    ]
    if not all(x.is_Float or x.is_zero for x in numbers):
        return False
    residual, *slopes = numbers
    return bool(abs(residual) <= _LAST_DIGITS * sum(map(abs, slopes), sympy.Float("1e-25")))


def _vanishes(expression: Expr) -> bool:
    """Whether it is 0 to many digits, which a singular point of the potential is not."""
    if not expression.is_number:
        return vanishes_at_random(expression)
    value = expression.evalf(50)
    return value is not sympy.nan and bool(abs(value) < sympy.Float("1e-40"))
