"""Random points on the constraint surface, modulo a prime.

Coordinates and velocities that the constraints give outright are substituted.  Of each
other position constraint one coordinate is found as a root of its polynomial modulo p, the
rest being random; the velocities then solve linear equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import combinations, permutations, product

import sympy
from flint import nmod_mat
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.relations import Relations
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import (
    PRIME,
    NoPoint,
    Terms,
    kernel_modulo,
    pivot_columns,
    square_root,
)
from lagcli.mechanics.discovery.modular_roots import joint_root
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.dynamics import Dynamics

_TRIES = 60  # a quadratic has a root modulo p for half of them
_MOST_ORDERS = 2000  # measured: at most 2
Plan = list[tuple[list[Terms], list[int]]]


class FormulaSurface:
    """Formulas on the constraint surface, and their values at points of it.

    Parameters
    ----------
    dynamics
        Of a system with constraints.
    expressions
        Everything that is to be evaluated, already `on` the surface.
    same
        Functions that have the same values at all points: those of one component of a
        surface that falls apart, as that of a rigid triangle and its mirror image.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        expressions: Sequence[Expr],
        allowed: Allowance,
        same: Sequence[Expr] = (),
    ) -> None:
        self.system = dynamics.system
        self.allowed = allowed
        relations = dynamics.constraints.relations
        remaining = [] if relations is None else relations.remaining
        v = set(self.system.qdot)
        self._positions = [f for f in remaining if not f.free_symbols & v]
        if dynamics.redundant:
            self._positions = _not_implied(self._positions)
        self._moving = [v for v in self.system.qdot if relations and v not in relations.solved]
        #: Whether position constraints are left that no coordinate was substituted for.
        self.curved = bool(self._positions)
        self._rows, self._drifts = self._velocity_rows(
            [f for f in remaining if f.free_symbols & v], self._moving
        )
        self._squared = [_without_root(f) for f in self._positions]
        parts = [e for row in self._rows for e in row] + self._drifts + self._squared
        variables = (self.system.t, *self.system.q, *self.system.qdot)
        self._same = list(same)
        self._values: list[int] | None = None
        self.tree = Tree(
            [*expressions, *same, *parts, *self._positions, *variables], variables, allowed
        )
        self.points = self.tree.points
        self._last = [self._number(x) for x in self._moving]
        self._plans = list(self._made_plans())

    @cached_property
    def independent_velocities(self) -> dict[Expr, Expr]:
        """The velocities that the others determine, by what they then are."""
        found: dict[Expr, Expr] = {}
        for row, drift in zip(self._rows, self._drifts, strict=True):
            form = dot(row, self._moving) + drift
            form = form.xreplace(found)
            v = next((v for v in reversed(self._moving) if is_zero(form.diff(v)) is not True), None)
            if v is None:
                continue
            value = simplify(-form.xreplace({v: sympy.S.Zero}) / form.diff(v))
            found = {w: x.xreplace({v: value}) for w, x in found.items()}
            found[v] = value
        return found

    @staticmethod
    def _velocity_rows(
        forms: Sequence[Expr], moving: Sequence[Symbol]
    ) -> tuple[list[list[Expr]], list[Expr]]:
        still = dict.fromkeys(moving, sympy.S.Zero)
        return [[f.diff(v) for v in moving] for f in forms], [f.xreplace(still) for f in forms]

    def _number(self, symbol: Symbol) -> int:
        return next(g for g, x in enumerate(self.points.field.generators) if x.expression == symbol)

    # -- which coordinate is solved for ------------------------------------------------------

    def _made_plans(self) -> Iterator[Plan]:
        """Orders in which the position constraints can be solved, one by one or jointly."""
        field = self.points.field
        polynomials = [self.points.terms(field(f).numerator) for f in self._squared]
        free = self._free()
        uses = [{g for _, monomial in terms for g, _ in monomial} for terms in polynomials]
        count = 0
        for order in permutations(range(len(polynomials))):
            for sizes in _compositions(len(order)):
                starts = [sum(sizes[:k]) for k in range(len(sizes))]
                blocks = [order[i : i + size] for i, size in zip(starts, sizes, strict=True)]
                for chosen in product(
                    *(combinations(sorted(set().union(*(uses[k] for k in b)) & free,
                                          reverse=True), len(b)) for b in blocks)
                ):  # fmt: skip
                    count += 1
                    if count > _MOST_ORDERS:
                        return
                    if self._is_plan(blocks, chosen, uses):
                        yield [
                            ([polynomials[k] for k in b], list(pivots))
                            for b, pivots in zip(blocks, chosen, strict=True)
                        ]

    def _is_plan(
        self,
        blocks: Sequence[Sequence[int]],
        chosen: Sequence[Sequence[int]],
        uses: Sequence[set[int]],
    ) -> bool:
        """Whether no block has an unknown of a later one, or the cosine beside the sine."""
        every = [g for pivots in chosen for g in pivots]
        if len(set(every)) < len(every):
            return False
        for k, (block, pivots) in enumerate(zip(blocks, chosen, strict=True)):
            later = {g for other in chosen[k + 1 :] for g in other}
            partners = {self._partner(g) for g in pivots}
            if any(uses[e] & (later | partners) for e in block):
                return False
        return True

    def _free(self) -> set[int]:
        """Coordinates that occur in no function but roots: their values may be chosen."""
        generators = self.points.field.generators
        hidden = {
            s for g in generators if g.kind not in ("symbol", "root")
            for s in g.expression.free_symbols
        }  # fmt: skip
        return {
            g for g, x in enumerate(generators)
            if (x.kind == "symbol" and x.expression in self.system.q
                and x.expression not in hidden)
            or (x.kind in ("sin", "cos") and x.argument in self.system.q)
        }  # fmt: skip

    def _partner(self, g: int) -> int:
        """The cosine of a sine and the other way round; -1 for others."""
        return self.points.field.generators[g].partner

    # -- points -----------------------------------------------------------------------------

    def point(self) -> list[int]:
        """Values of all generators at a new point of the surface.

        Raises
        ------
        NoPoint
            Where the constraints are not of a kind that is solved, or have no root modulo p.
        """
        for number in range(_TRIES):
            self.allowed.check()
            if not self._plans:
                break
            point = self._tried(self._plans[number % min(len(self._plans), 4)])
            if point is not None and self._on_component(point):
                return point
        raise NoPoint

    def _on_component(self, point: list[int]) -> bool:
        values = list(map(self.tree.at(point), self._same))
        if self._values is None:
            self._values = values
        return values == self._values

    def _tried(self, plan: Plan) -> list[int] | None:
        points = self.points
        generators = points.field.generators
        values = dict(points.constants)
        roots = [
            g for g, x in enumerate(generators)
            if (g in points.rules or g in points.signs)
            and x.kind not in ("sin", "sinh") and g not in values
        ]  # fmt: skip
        solved = {g for _, pivots in plan for g in pivots}
        waiting = solved | {self._partner(g) for g in solved} | set(roots) | set(self._last)
        if not self._drawn(values, [g for g in range(len(generators)) if g not in waiting]):
            return None
        for block, pivots in plan:
            if any(k in roots for terms in block for _, monomial in terms for k, _ in monomial):
                return None
            found = joint_root(block, pivots, values)
            if found is None:
                return None
            values.update(found)
            for g in pivots:
                if self._partner(g) >= 0:
                    other = square_root(1 - values[g] * values[g])
                    if other is None:
                        return None
                    values[self._partner(g)] = other
        early = [g for g in roots if not self._has_velocity(g)]
        if not self._drawn(values, early) or not self._on_constraints(values):
            return None
        self._solve_velocities(values)
        if not self._drawn(values, [g for g in roots if g not in early]):
            return None
        return [values[g] for g in range(len(generators))]

    def _on_constraints(self, values: dict[int, int]) -> bool:
        """Whether the roots were drawn with the sign that the constraints demand."""
        if self._squared == self._positions:
            return True
        point = [values.get(g, 0) for g in range(len(self.points.field.generators))]
        return not any(map(self.tree.at(point), self._positions))

    def _has_velocity(self, g: int) -> bool:
        symbols = self.points.field.generators[g].expression.free_symbols
        return bool(symbols & set(self.system.qdot))

    def _drawn(self, values: dict[int, int], wanted: Sequence[int]) -> bool:
        return all(self.points.draw(g, values) for g in wanted if g not in values)

    def _solve_velocities(self, values: dict[int, int]) -> None:
        """Random velocities moved onto A q' + b = 0."""
        for g in self._last:
            self.points.draw(g, values)
        if not self._rows:
            return
        point = [values.get(g, 0) for g in range(len(self.points.field.generators))]
        at = self.tree.at(point)
        table = [
            [at(e) for e in (*row, drift)]
            for row, drift in zip(self._rows, self._drifts, strict=True)
        ]
        reduced, rank = nmod_mat(table, PRIME).rref()
        for row in reduced.table()[:rank]:
            entries = [int(x) for x in row]
            pivot = next((j for j, x in enumerate(entries) if x), len(self._last))
            if pivot == len(self._last):
                raise NoPoint
            rest = entries[-1] + sum(
                x * values[self._last[j]] for j, x in enumerate(entries[:-1]) if j != pivot
            )
            values[self._last[pivot]] = -rest % PRIME


def _not_implied(forms: Sequence[Expr]) -> list[Expr]:
    """The forms without those that are 0 wherever the others are."""
    kept = list(dict.fromkeys(forms))
    for form in reversed(kept[:]):
        others = [f for f in kept if f != form]
        if others and is_zero(form, Relations(others)) is True:
            kept = others
    return kept


def _without_root(form: Expr) -> Expr:
    """A² - B² u for A + B sqrt(u), the same where the root has the right sign; else the form."""
    roots = [p for p in form.atoms(sympy.Pow) if p.exp == sympy.Rational(1, 2) and p.free_symbols]
    if len(roots) != 1:
        return form
    r = sympy.Dummy()
    open_ = form.xreplace({roots[0]: r})
    B = open_.diff(r)
    if r in B.free_symbols or open_.has(roots[0].base ** sympy.Rational(-1, 2)):
        return form
    A = open_.xreplace({r: sympy.S.Zero})
    return sympy.expand(A**2 - B**2 * roots[0].base)


def _compositions(total: int) -> Iterator[tuple[int, ...]]:
    """Sizes of blocks, small ones first: (1, 1, 1), (1, 2), (2, 1), (3)."""
    found = [()] if total == 0 else [
        (first, *rest) for first in range(1, min(total, 3) + 1)
        for rest in _compositions(total - first)
    ]  # fmt: skip
    yield from sorted(found, key=lambda sizes: (-len(sizes), sizes))


def independent_on_surface(
    charges: Sequence[Expr], dynamics: Dynamics, allowed: Allowance, same: Sequence[Expr] = ()
) -> list[int]:
    """Which functions are no combinations of earlier ones and of 1, over the constants."""
    if not charges:
        return []
    relations = dynamics.constraints.relations
    assert relations is not None
    values = [[relations.substitute(Q)] for Q in charges]
    surface = FormulaSurface(dynamics, [e for v in values for e in v], allowed, same)
    rows = surface.tree.rows(values, len(values) + 4, surface.point)
    return [k - 1 for k in pivot_columns([[1, *row] for row in rows]) if k]


def relations_on_surface(
    vectors: Sequence[Sequence[Expr]], dynamics: Dynamics, allowed: Allowance
) -> list[dict[int, Expr]]:
    """A basis of the constant coefficients with which the vectors add up to 0 there.

    In each the last vectors are used as seldom as may be; what has no simple coefficients
    is left out.
    """
    if not any(vectors):
        return []
    relations = dynamics.constraints.relations
    assert relations is not None
    order = list(reversed(range(len(vectors))))
    values = [[relations.substitute(e) for e in vectors[k]] for k in order]
    surface = FormulaSurface(dynamics, [e for v in values for e in v], allowed)
    rows = surface.tree.rows(values, len(values) + 8, surface.point)
    _, kernel = kernel_modulo(rows, len(values))
    exact = ExactSolver(surface.points)
    found = []
    for combination in kernel:
        indices = sorted(combination)
        coefficients = exact.recognized([combination[i] for i in indices])
        if coefficients is None and not surface.curved:
            coefficients = exact.solved([values[i] for i in indices])
        if coefficients is not None:
            found.append({order[i]: c for i, c in zip(indices, coefficients, strict=True)})
    return found
