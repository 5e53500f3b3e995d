"""What holds at rest: all forces and constraint forces balance.

    forcing_j(q, q' = 0) + sum_k lambda_k a_kj(q) = 0,   f(q) = 0,   b(q) = 0

The multipliers are removed by taking the components along the constraint surface: the
virtual work of the forces vanishes for every displacement with A dq = 0.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 1.4 and 6.1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain, combinations, islice
from typing import TYPE_CHECKING

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import Field, dot, is_zero, nullspace, simplify, solve_linear
from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.decimals import is_decimal
from lagcli.algebra.determinants import determinant
from lagcli.algebra.factors import factors_of
from lagcli.algebra.field import common_denominator
from lagcli.algebra.numeric import vanishes_at_random
from lagcli.algebra.place import NO_VALUE, at, nearly_vanishes, vanishes, where_positive
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.algebra.translates import common_period, recur
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.rest.exceptions import Vanishing, with_a_value, without_unknowns
from lagcli.mechanics.translations import constant_nullspace
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.mechanics.rest.family import Family

_LONGEST = 60  # operations of conditions that are quoted
_LONGEST_GRAM = 200  # operations of det(A A^T) that is factored
_MOST_MINORS = 40  # three of six coordinates have 20, of seven 35


@record
class RestPoint:
    """An equilibrium: values of coordinates as formulas in the free ones and parameters.

    It is there where each of `positive` is > 0.  With a `family` it is one branch of that.
    """

    values: Mapping[Symbol, Expr]
    free: tuple[Symbol, ...]
    positive: tuple[Expr, ...] = ()
    family: Family | None = None

    def depends_on_time(self, t: Symbol) -> bool:
        """Whether it is there while a condition with the time holds: an open contact moves."""
        return any(x.has(t) for x in self.positive)


def given_formulas(dynamics: Dynamics) -> tuple[Expr, ...]:
    """What the motion follows from: L, the constraints and the forces that are not in L."""
    constraints = (e.f for e in dynamics.constraints.equations)
    return (dynamics.system.L, *constraints, *dynamics.system.applied_forces)


class RestConditions:
    """The conditions of equilibrium of a system, and whether values fulfil them."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system

    @cached_property
    def depends_on_time(self) -> bool:
        """Whether the equations or the constraints have t in them."""
        system, constraints = self.system, self.dynamics.constraints
        everything = [
            *chain(*self.mass_matrix),
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
        """Of M q'' = forcing + A^T lambda, without a factor f(t) that all equations have.

        The time is taken out where it cancels: cos(w t) sin(w t + q) - sin(w t) cos(w t + q).
        """
        forcing, timed = self.dynamics.lagrange.forcing, [self.system.t]
        return tuple(f if free_of(f, timed) else simplify(f / self.growth) for f in forcing)

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
        from lagcli.mechanics.rest.energy import never_grows

        return self.growth == 1 and never_grows(self.dynamics)

    @cached_property
    def energy_always_shrinks(self) -> bool:
        """Whether forces take energy out of every motion near rest."""
        from lagcli.mechanics.rest.energy import always_shrinks

        return self.growth == 1 and always_shrinks(self.dynamics)

    @cached_property
    def energy_is_kept(self) -> bool:
        """Whether forces take no energy out of any motion, and feed none."""
        from lagcli.mechanics.rest.energy import is_kept

        return self.growth == 1 and is_kept(self.dynamics)

    @cached_property
    def forces_at_rest(self) -> tuple[Expr, ...]:
        """forcing(q, q' = 0)."""
        still = dict.fromkeys(self.system.qdot, S.Zero)
        return tuple(f.xreplace(still) for f in self.forcing)

    @property
    def rests_everywhere(self) -> bool:
        """Whether no force acts at rest, wherever fixed holonomic constraints allow it to be."""
        equations = self.dynamics.constraints.equations
        fixed = all(e.holonomic and is_zero(e.drift) is True for e in equations)
        return fixed and all(is_zero(f) is True for f in self.forces_at_rest)

    @property
    def has_no_value(self) -> bool:
        """Whether a force is 0/0 or infinite in every state of rest."""
        return self.without_value({})

    def without_value(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether some force has no value at any member of a family."""
        forces = (at(f, values) for f in self.forces_at_rest)
        try:
            return any(f.has(*NO_VALUE) for f in forces)
        except ZeroDivisionError:
            return True

    def has_open_power(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether 0^n, with n an open exponent, stands in some force there."""
        return any(is_zero(at(p.base, values)) is True for p in self._open_powers)

    def has_unreal_power(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether (-1)^n, with n an open exponent, stands in some force there."""
        powers = (p for p in self._open_powers if not p.exp.is_integer)
        return any(sign(at(p.base, values)) == -1 for p in powers)

    @cached_property
    def _open_powers(self) -> list[Expr]:
        powers = {p for f in self.forces_at_rest for p in f.atoms(sympy.Pow)}
        return [p for p in powers if p.exp.free_symbols]

    @cached_property
    def equations(self) -> list[Expr]:
        """What vanishes at rest: the constraints, and the forces along what they allow."""
        constraints = self.dynamics.constraints
        conditions = [e.f for e in constraints.equations if e.holonomic]
        conditions += [e.drift for e in constraints.equations if not e.holonomic]
        return [e for e in conditions if is_zero(e) is not True] + self._forces_along

    @cached_property
    def _forces_along(self) -> list[Expr]:
        """The forces along what the constraints allow."""
        forces: Sequence[Expr] = self.forces_at_rest
        if self._one_gradient:
            forces = self._along_one
        elif self.dynamics.constraints.equations:
            forces = [dot(v, forces) for v in _polynomial(self._displacements)]
        return [e for e in forces if is_zero(e) is not True]

    @property
    def _displacements(self) -> list[list[Expr]]:
        """A basis of the v with A v = 0, solved for coordinates whose minor vanishes nowhere."""
        rows, size = self.dynamics.independent_rows, len(self.system.q)

        def may_vanish(j: int) -> bool:
            return not any(free_of(r[j], self.system.q) and is_zero(r[j]) is False for r in rows)

        order = sorted(range(size), key=may_vanish)
        for bound in islice(combinations(order, len(rows)), _MOST_MINORS):
            free = [j for j in range(size) if j not in bound]
            columns = [[-row[j] for j in free] for row in rows]
            solved = solve_linear([[row[j] for j in bound] for row in rows], columns)
            if solved is not None and solved.determinant and sign(solved.determinant**2) == 1:
                by_free = dict(zip(bound, solved.values, strict=True))
                return [
                    [by_free[j][k] if j in bound else S(int(j == other)) for j in range(size)]
                    for k, other in enumerate(free)
                ]
        return nullspace(rows)

    @property
    def _one_gradient(self) -> bool:
        """Whether no basis of the displacements is one everywhere, of a single constraint."""
        rows = self.dynamics.independent_rows
        return len(rows) == 1 and not any(
            free_of(a, self.system.q) and is_zero(a) is False for a in rows[0]
        )

    @property
    def _along_one(self) -> list[Expr]:
        """a_i F_j = a_j F_i: the force along the gradient of one constraint; F_j where a_j = 0."""
        [a], F = self.dynamics.independent_rows, self.forces_at_rest
        alone = [j for j, part in enumerate(a) if is_zero(part) is True]
        pairs = combinations([j for j in range(len(F)) if j not in alone], 2)
        return [simplify(a[i] * F[j] - a[j] * F[i]) for i, j in pairs] + [F[j] for j in alone]

    @cached_property
    def at_all_times(self) -> list[Expr]:
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
        found = without_unknowns((*self.at_all_times, *self.sums), (*self.system.q, *timed))
        return with_a_value(found, given_formulas(self.dynamics))

    @cached_property
    def balance(self) -> Vanishing:
        """What vanishes at rest, none where that depends on the time."""
        drifts = (e.drift for e in self.dynamics.constraints.equations)
        conditions = [] if self.depends_on_time else [*self._forces_along, *drifts]
        return Vanishing(conditions, self.system.q, self.dynamics.lagrange.mass_matrix)

    @property
    def edge(self) -> tuple[str, ...]:
        """Coordinates assumed positive at whose value 0 all conditions may hold.

        A finite force along what has an infinite mass there need not vanish: s = r^2, M = m/(4 s).
        """
        mass, forces_at_rest = self.dynamics.lagrange.mass_matrix_at_rest, self.forces_at_rest
        free = not self.dynamics.constraints.equations

        def infinite(e: Expr, q: Symbol) -> bool:
            return bool(e.xreplace({q: S.Zero}).has(*NO_VALUE))

        def holds(q: Symbol) -> bool:
            if self.has_open_power({q: S.Zero}):
                return True
            j = self.system.q.index(q)
            others = [f for k, f in enumerate(forces_at_rest) if k != j]
            loose = free and infinite(mass[j][j], q) and not infinite(forces_at_rest[j], q)
            there = [e.xreplace({q: S.Zero}) for e in (others if loose else self.equations)]
            if any(e.has(*NO_VALUE) for e in there):
                return False
            solved = solve_system(there, [x for x in self.system.q if x != q])
            return bool(solved.solutions) or not solved.complete

        return tuple(q.name for q in self.system.q if q.is_positive and holds(q))

    @cached_property
    def translations(self) -> dict[Symbol, list[Expr]]:
        """Constant displacements c under which what vanishes at rest is the same, by the q = c."""
        q = self.system.q
        rows = [[e.diff(s) for s in q] for e in self.equations]
        basis = constant_nullspace(rows, q) if rows else []
        own = [k for k in range(len(q)) if sum(c[k] != 0 for c in basis) == 1]
        return {q[max(k for k in own if c[k] == 1)]: c for c in basis}

    def is_angle(self, q: Symbol) -> bool:
        """Whether the coordinate occurs inside sin and cos."""
        return any(not free_of(f, [q]) for e in self.equations for f in e.atoms(*CIRCULAR))

    def jumps_at(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether L may jump there, with an impulse that the equations of motion lack."""
        if self.system.is_continuous:
            return False
        arguments = (jump.args[0] for jump in self.system.L.atoms(sympy.sign))
        return any(is_zero(at(u, values)) is True for u in arguments)

    @cached_property
    def goes_beyond_one_turn(self) -> bool:
        """Whether an angle of the conditions counts its turns: M = 1 + q², V = exp(-q) sin(q)."""
        entries = [x for x in (*chain(*self.mass_matrix), *self.forcing) if x != 0]
        state = [*self.system.q, *self.system.qdot, self.system.t]
        angles = (q for q in self.system.q if self.is_angle(q) and not self._is_fixed(q))
        return any(
            common_period(entries, q, state) is None and not recur(entries, q) for q in angles
        )

    @cached_property
    def periods(self) -> dict[Symbol, Expr]:
        """2 π/k of coordinates q of which all that acts has sines and cosines of k q alone.

        k is the least common factor of all multiples; where it is a number, whole turns are listed.
        """
        constraints, found = self.dynamics.constraints.equations, dict[Symbol, Expr]()
        if self.system.problem.contacts:
            return found
        acting = [*chain(*self.mass_matrix), *self.forcing, *chain(*(e.row for e in constraints))]
        acting += [e.f for e in constraints if e.f is not None]
        for q in self.system.q:
            waves = {f for e in acting for f in e.atoms(*CIRCULAR) if f.has(q)}
            hidden: dict[Expr, Expr] = {f: sympy.Dummy() for f in waves}
            outside = (e.xreplace(hidden) for e in acting)
            rates = [simplify(f.args[0].diff(q)) for f in sorted(waves, key=str)]
            ratios = [simplify(rate / rates[0]) for rate in rates]
            if not rates or rates[0].is_Rational or not all(r.is_Rational for r in ratios):
                continue
            moving = [*self.system.q, *self.system.qdot, self.system.t]
            if free_of(rates[0], moving) and all(free_of(e, [q]) for e in outside):
                period = simplify(2 * sympy.pi / (rates[0] * sympy.gcd_list(ratios)))
                shorter = period / 2  # of products such as sin(k q/2) cos(k q/2)
                if all(vanishes_at_random(e.subs(q, q + shorter) - e) for e in acting):
                    period = shorter
                found[q] = -period if period.could_extract_minus_sign() else period
        return found

    def _is_fixed(self, q: Symbol) -> bool:
        """Whether conditions without sines give the coordinate."""
        return q in self._fixed

    @cached_property
    def _fixed(self) -> frozenset[Symbol]:
        """The coordinates that conditions without sines give, linear ones put into the others.

        Of c (b - a) = 0 and 2 a - b = sin(a - b) both: the second is then a = 0.
        """
        left, given = [*self.equations], dict[Symbol, Expr]()
        while (found := next(self._linear(left), None)) is not None:
            q, value = found
            given = {s: v.xreplace({q: value}) for s, v in given.items()} | {q: value}
            left = [simplify(e.xreplace({q: value})) for e in left]
        all_q = {*self.system.q}
        own = (e for e in left if not any(f.free_symbols & all_q for f in e.atoms(*CIRCULAR)))
        fixed = {q for e in own for q in all_q if e.free_symbols & all_q == {q}}
        return frozenset(fixed | {s for s, v in given.items() if v.free_symbols & all_q <= fixed})

    def _linear(self, equations: Sequence[Expr]) -> Iterator[tuple[Symbol, Expr]]:
        """A coordinate with its value, of a condition without sines that is linear in it."""
        for e in equations:
            within = [q for q in self.system.q if e.has(q)]
            if len(within) < 2 or any(f.has(*within) for f in e.atoms(*CIRCULAR)):
                continue
            for q in within:
                slope = simplify(e.diff(q))
                if sign(slope) in (1, -1) and free_of(slope, within):
                    yield q, simplify(q - e / slope)

    def real_where(self, values: Mapping[Symbol, Expr]) -> Iterator[Expr]:
        """The arguments of even roots and logarithms in L that are not known to be positive there.

        Those with a coordinate of a family in them are left out.
        """
        still = self.system.L.xreplace(dict.fromkeys(self.system.qdot, S.Zero))
        powers = (p for p in still.atoms(sympy.Pow) if p.exp.is_Rational and p.exp.q % 2 == 0)
        arguments = {*(p.base for p in powers), *(x.args[0] for x in still.atoms(sympy.log))}
        for argument in sorted(arguments, key=sympy.default_sort_key):
            there = at(argument, values)
            if free_of(there, self.system.q) and sign(there) not in (0, 1):
                yield there

    def loses_rank(self, values: Mapping[Symbol, Expr]) -> bool:
        """Whether the gradients of the constraints are independent, but not there.

        Not where one has no value.  Of y (x' - z') = 0 and (y - 1) (x' - z') = 0 one restricts the
        velocities everywhere.
        """
        rows = self.dynamics.constraints.jacobian
        there = [[at(at(a, values), values) for a in row] for row in rows]
        freedom = len(self.system.q) - len(self.dynamics.independent_constraints)
        try:
            return bool(rows) and len(nullspace(there)) > freedom
        except ZeroDivisionError:
            return False

    def independent_where(
        self, values: Mapping[Symbol, Expr], free: Sequence[Symbol]
    ) -> Iterator[Expr | None]:
        """What is positive at the members of a family that lie on one surface of the constraints.

        None where it is not known whether surfaces meet.

        On z (z - x) = 0 the family z = 0 meets the other surface where x = 0: there det(A A^T) is
        0, and what holds beside it need not hold.  Constraints on velocities have no surfaces that
        meet: without a force all positions are at rest, also where x' sin(phi) = 0 is 0 = 0.
        """
        surfaces = any(e.holonomic for e in self.dynamics.constraints.equations)
        pushed = any(is_zero(at(F, values)) is not True for F in self.forces_at_rest)
        given = self.dynamics.independent_rows if free and (surfaces or pushed) else ()
        rows = [[at(a, values) for a in row] for row in given]
        found = determinant([[dot(a, b) for b in rows] for a in rows]) if rows else None
        gram = S.One if found is None else simplify(found)
        for factor, power in factors_of(gram) if sympy.count_ops(gram) < _LONGEST_GRAM else ():
            if power > 0 and not free_of(factor, free) and sign(factor) not in (1, -1):
                vanishing = solve_system([factor], free)
                if not vanishing.complete:
                    yield None
                elif any(
                    self.loses_rank({**values, **each.values}) for each in vanishing.solutions
                ):
                    yield factor if weak_sign(factor) == 1 else factor**2

    def balanced(self, values: Mapping[Symbol, Expr], positive: Sequence[Expr] = ()) -> bool:
        """Whether a state of rest is an equilibrium, by substitution where these are positive.

        It is none where L or the equations have no value, nor known to be one where L jumps.
        """
        if self.jumps_at(values) or -1 in map(sign, self.real_where(values)):
            return False
        decimals = [q for q, value in values.items() if is_decimal(value)]
        try:
            if decimals and not self.dynamics.constraints.equations:
                return all(nearly_vanishes(f, values, decimals) for f in self.forces_at_rest)
            residuals = (where_positive(each, positive) for each in self._residuals(values))
            return all(is_zero(each) is True or vanishes(each) for each in residuals)
        except ZeroDivisionError:
            return False

    def _residuals(self, values: Mapping[Symbol, Expr]) -> list[Expr]:
        constraints = self.dynamics.constraints
        forces = [at(f, values) for f in self.forces_at_rest]
        conditions = [at(e.f if e.holonomic else e.drift, values) for e in constraints.equations]
        if not constraints.equations:
            return forces
        rows = [[at(a, values) for a in row] for row in self.dynamics.independent_rows]
        return [*conditions, *(dot(vector, forces) for vector in nullspace(rows))]


def _polynomial(vectors: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
    """The vectors times their denominators: defined everywhere."""
    whole = []
    for vector in vectors:
        field = Field(vector)
        elements = [field(v) for v in vector]
        factor = field.polynomial(common_denominator(field, elements))
        whole.append([field.to_sympy(each * factor) for each in elements])
    return whole
