"""All solutions of several equations in several unknowns, one factor and one root at a time.

Equations are factored, each factor opens a branch.  In a branch a factor with one unknown
is solved, or one that is linear in an unknown, and the solution is put into the others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from dataclasses import field as default
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.equations import solve_for
from lagcli.algebra.opening import (
    by_distances,
    opened,
    phases,
    turns,
    whole_angles,
    without_phases,
)
from lagcli.algebra.polynomial_roots import coefficients
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.algebra.resultants import pairs_of_values, substituted
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import is_zero, simplify
from lagcli.algebra.vanishing_factors import same, vanishing_factors, without_repeats
from lagcli.platform.effort import Work
from lagcli.record import record

_MAX_BRANCHES = 256  # measured: at most 10


@record
class SystemSolution:
    """Values of unknowns, formulas in the free ones; it is there where `positive` > 0.

    With a `relation` it is a family: the free unknowns are tied by relation = 0.
    """

    values: Mapping[Symbol, Expr]
    positive: tuple[Expr, ...] = ()
    relation: Expr | None = None


#: Of work, for all solutions.
_UNITS = 3_000_000


@dataclass(slots=True)
class SolvedSystem:
    """The solutions found; `complete` tells whether there can be no other."""

    solutions: list[SystemSolution] = default(default_factory=list)
    complete: bool = True


def solve_system(
    equations: Sequence[Expr],
    unknowns: Sequence[Symbol],
    *,
    families: bool = False,
) -> SolvedSystem:
    """All real solutions of equations = 0 within the assumptions on the unknowns.

    With `families`, those that one relation between unknowns gives are among them, and no
    solution that lies on another.
    """
    moved = phases(equations, unknowns)
    equations = [whole_angles(without_phases(e, moved), unknowns) for e in equations]
    solver = _Solver(equations, unknowns, Work(_UNITS), families=families)
    solver.branch(equations, {}, ())
    found = solver.found
    found.solutions = [
        each for each in found.solutions
        if not any(_lies_on(each, other) for other in found.solutions)
    ]  # fmt: skip
    if moved:
        found.solutions = [_with_phases(each, moved, solver.turning) for each in found.solutions]
    return found


def _with_phases(
    solution: SystemSolution, moved: Mapping[Symbol, Expr], turning: Sequence[Symbol]
) -> SystemSolution:
    """The solution in x - d as one in x: an angle that is a number in (-pi, pi]."""
    back = {x: x - d for x, d in moved.items()}
    values = {
        x: value.xreplace(back) + moved.get(x, sympy.S.Zero) for x, value in solution.values.items()
    }
    values |= {x: _within_a_turn(values[x]) for x in turning if x in values}
    relation = None if solution.relation is None else solution.relation.xreplace(back)
    return SystemSolution(values, tuple(e.xreplace(back) for e in solution.positive), relation)


class _Solver:
    def __init__(
        self,
        given: Sequence[Expr],
        unknowns: Sequence[Symbol],
        allowed: Work,
        *,
        families: bool,
    ) -> None:
        self.unknowns = tuple(unknowns)
        self.found = SolvedSystem()
        self._given = given
        self.turning = [x for x in unknowns if turns(given, x)]
        self._allowed = allowed
        self._families = families
        self._branches = 0
        self._opened = False

    def branch(
        self, equations: list[Expr], values: dict[Symbol, Expr], positive: tuple[Expr, ...]
    ) -> None:
        """Follow one branch to its solutions."""
        self._branches += 1
        if self._branches > _MAX_BRANCHES or self._allowed.over:
            self.found.complete = False
            return
        left: list[list[Expr]] = []
        for equation in equations:
            factors = vanishing_factors(equation, self.unknowns)
            if factors is None:
                continue
            if not factors:
                return
            left.append(factors)
        left = without_repeats(left)
        if not left:
            self._keep(values, positive)
            return
        left.sort(key=self._cost)
        for index, factors in enumerate(left):
            if all(self._solvable(factor) for factor in factors):
                rest = [sympy.Mul(*other) for k, other in enumerate(left) if k != index]
                for factor in factors:
                    self._solve(factor, rest, values, positive)
                return
        if not (self._reformed(left, values, positive) or self._family(left, values, positive)):
            self.found.complete = False

    def _family(
        self, left: list[list[Expr]], values: dict[Symbol, Expr], positive: tuple[Expr, ...]
    ) -> bool:
        """Keep what a single relation gives: lines of translations, or the relation itself."""
        if not self._families or len(left) != 1 or len(left[0]) != 1:
            return False
        [[relation]] = left
        if len(self._in(relation)) == 1:
            return False
        lines = self._translated(relation)
        for unknown, value in lines:
            put = {unknown: value}
            self._keep({**{s: v.xreplace(put) for s, v in values.items()}, **put}, positive)
        if not lines:
            self._keep(values, positive, relation)
        return True

    def _translated(self, relation: Expr) -> list[tuple[Symbol, Expr]]:
        """Values of x where f depends on x + r y + … alone, r a number: of f(x) = 0, less r y."""
        unknown, *others = self._in(relation)
        slope = relation.diff(unknown)
        shift = sympy.S.Zero
        for other in others:
            ratio = simplify(relation.diff(other) / slope)
            if not ratio.is_Rational:
                return []
            shift += ratio * other
        found = solve_for(relation.xreplace(dict.fromkeys(others, sympy.S.Zero)), unknown)
        return [] if found is None else [(unknown, simplify(x - shift)) for x in found.values]

    def _reformed(
        self, left: list[list[Expr]], values: dict[Symbol, Expr], positive: tuple[Expr, ...]
    ) -> bool:
        """Follow the branches that another form of the equations opens, if there is one."""
        if not (values or self._opened):
            self._opened = True
            branches = by_distances(self._given, self.unknowns)
            for each in branches:
                self.branch(list(each.equations), values, (*positive, *each.positive))
            if branches:
                return True
        products = [sympy.Mul(*factors) for factors in left]
        if any(len(factors) > 1 for factors in left):
            first = next(k for k, factors in enumerate(left) if len(factors) > 1)
            rest = [e for k, e in enumerate(products) if k != first]
            for factor in left[first]:
                self.branch([factor, *rest], values, positive)
            return True
        branches = opened(products, self.unknowns)
        for each in branches:
            self.branch(list(each.equations), values, (*positive, *each.positive))
        return bool(branches) or self._by_resultant(products, values, positive)

    def _by_resultant(
        self, equations: list[Expr], values: dict[Symbol, Expr], positive: tuple[Expr, ...]
    ) -> bool:
        """In two unknowns: the roots of the resultant of two equations, each put into all."""
        present = [u for u in self.unknowns if any(u in e.free_symbols for e in equations)]
        if len(equations) < 2 or len(present) != 2:
            return False
        for kept, gone in (present, present[::-1]):
            pairs = pairs_of_values(equations, kept, gone)
            if pairs is not None:
                break
        else:
            return False
        for pair in pairs:
            own = [self._conditions(root, unknown) for unknown, root in pair.items()]
            if None not in own:
                wanted = [c for conditions in own for c in conditions or ()]
                shown = {s: v.subs(list(pair.items())) for s, v in values.items()}
                self._keep({**shown, **pair}, tuple(dict.fromkeys((*positive, *wanted))))
        return True

    def _cost(self, factors: Sequence[Expr]) -> tuple[int, int]:
        most = max(len(self._in(factor)) for factor in factors)
        return most, len(factors)

    def _in(self, expression: Expr) -> list[Symbol]:
        return [u for u in self.unknowns if u in expression.free_symbols]

    def _solvable(self, factor: Expr) -> bool:
        unknowns = self._in(factor)
        if len(unknowns) == 1:
            return solve_for(factor, unknowns[0]) is not None
        return self._linear(factor) is not None

    def _linear(self, factor: Expr) -> tuple[Symbol, Expr] | None:
        """An unknown in which the factor is linear, with a slope that cannot vanish."""
        field = Field([factor])
        poly = field(factor).numerator
        ring = field.ring
        for unknown in self._in(factor):
            number = field.number_of(unknown)
            used = ring.used(poly)
            if number not in used or ring.degree(poly, number) != 1:
                continue
            if any(
                unknown in field.generators[g].expression.free_symbols for g in used if g != number
            ):
                continue
            rest, slope = coefficients(field, poly, number)
            divisor = field.to_sympy(slope)
            if self._in(divisor) and sign(divisor) not in (1, -1):
                continue
            return unknown, field.to_sympy(-rest / slope)
        return None

    def _solve(
        self, factor: Expr, rest: list[Expr], values: dict[Symbol, Expr], positive: tuple[Expr, ...]
    ) -> None:
        linear = self._linear(factor)
        if linear is not None:
            unknown, roots = linear[0], [linear[1]]
        else:
            unknown = self._in(factor)[0]
            found = solve_for(factor, unknown)
            if found is None:
                self.found.complete = False
                return
            roots = list(found.values)
        for root in map(simplify, roots):
            conditions = self._conditions(root, unknown)
            if conditions is None:
                continue
            put = {unknown: root}
            self.branch(
                [substituted(e, unknown, root) for e in rest],
                {**{s: v.xreplace(put) for s, v in values.items()}, **put},
                tuple(dict.fromkeys((*positive, *conditions))),
            )

    def _conditions(self, root: Expr, unknown: Symbol) -> list[Expr] | None:
        """What must be positive for the root to be real and admissible; None: it never is."""
        wanted = [*not_negative_where_real(root), *(log.args[0] for log in root.atoms(sympy.log))]
        if unknown.is_positive or (unknown.is_nonnegative and root != 0):
            wanted.append(root)
        elif unknown.is_negative:
            wanted.append(-root)
        elif unknown.is_nonzero and root == 0:
            return None
        conditions = []
        for each in wanted:
            if self._in(each):
                continue
            value = sign(each)
            if value in (0, -1):
                return None
            if value is None:
                conditions.append(simplify(each))
        return conditions

    def _keep(
        self,
        values: dict[Symbol, Expr],
        positive: tuple[Expr, ...],
        relation: Expr | None = None,
    ) -> None:
        plain = {s: simplify(v) for s, v in values.items()}
        ordered = {
            u: _within_a_turn(plain[u]) if u in self.turning else plain[u]
            for u in self.unknowns
            if u in plain
        }
        same = [
            other
            for other in self.found.solutions
            if other.values == ordered and other.relation == relation
        ]
        conditions: list[Expr] = []
        for each in positive:
            there = simplify(each.subs(list(plain.items()), simultaneous=True))
            known = sign(there) if self._in(each) or there.is_number else None
            if known in (0, -1):
                return
            if known is None:
                conditions.append(there)
        if any(sign(simplify(a + b)) in (0, -1) for a, b in combinations(conditions, 2)):
            return  # x - a > 0 and -x - a > 0
        if not any({*other.positive} <= {*conditions} for other in same):
            for u in self.turning:
                if u in ordered:
                    ordered[u] = _shortest_angle(ordered[u], conditions)
            kept = SystemSolution(ordered, tuple(dict.fromkeys(conditions)), relation)
            self.found.solutions.append(kept)


def _within_a_turn(angle: Expr) -> Expr:
    """A rational multiple of pi between -pi and pi, pi itself among them."""
    turns = angle / (2 * sympy.pi)
    if not turns.is_Rational:
        return angle
    return (turns - sympy.ceiling(turns - sympy.S.Half)) * 2 * sympy.pi


def _shortest_angle(angle: Expr, positive: Sequence[Expr]) -> Expr:
    """acos(-c) for pi - asin(sqrt(1 - c²)), where the sign of its sine is known."""
    if not angle.is_Add or not angle.has(sympy.asin, sympy.atan):
        return angle
    side = sign(simplify(sympy.sin(angle)), positive)
    cosine = simplify(sympy.cos(angle))
    if side in (1, -1) and sympy.count_ops(cosine) + 2 < sympy.count_ops(angle):
        return side * sympy.acos(cosine)
    return angle


def _lies_on(solution: SystemSolution, other: SystemSolution) -> bool:
    """Whether a solution is one of a family, given by a relation or by fewer values."""
    if other is solution or not (other.relation or len(other.values) < len(solution.values)):
        return False
    if any(sign(p.xreplace(solution.values)) != 1 for p in other.positive):
        return False
    ties = [s - v for s, v in other.values.items()]
    ties += [] if other.relation is None else [other.relation]
    there = [tie.xreplace(solution.values) for tie in ties]
    own = solution.relation
    return all(is_zero(tie) is True or (own is not None and same(tie, own)) for tie in there)
