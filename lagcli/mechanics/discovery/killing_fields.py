"""Killing vectors of a metric whose curvature is not constant, and what stretches it.

With xi = f(q) e_i the change of the metric is

    (L_xi g)_ab = f g_ab,i + g_ib f,a + g_ai f,b,

so that constants c with sum c L_xi g = 2 k g are a linear system.  The f are products of functions
of each coordinate: of a cyclic one those that `killing_jets` tells, of any other those of which the
metric and its inverse consist, of few coordinates first, until there are as many as there can be.
Of a product of metrics those of its factors are known first.

References
----------
Stephani and others, *Exact Solutions of Einstein's Field Equations*, 2nd ed., chapter 8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations, product

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import derivative, dot, simplify
from lagcli.algebra.build import CIRCULAR, HYPERBOLIC, free_of
from lagcli.mechanics.discovery.ansatz import TimeFunctions, complexity, ordered, products_of_two
from lagcli.mechanics.discovery.constant_curvature import ConstantCurvature, Vector
from lagcli.mechanics.discovery.killing_jets import KillingJets
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.search import Search, SlotUnknown
from lagcli.mechanics.discovery.slots import Slot, SlotEquations

_MOST_UNKNOWNS = 700
_MOST_COORDINATES = 6
_HALF = sympy.S.Half


class KillingFields:
    """Those of one metric.

    Attributes
    ----------
    fields
        Killing vectors, and one that stretches the metric if any.
    number, isometries
        Bounds from above for the independent ones, with and without one that stretches the metric.
    """

    def __init__(self, metric: Metric, allowed: Allowance) -> None:
        self.metric, self.allowed = metric, allowed
        self._jets = KillingJets(metric, allowed)
        self.number = self._jets.number
        self.isometries = self._jets.isometries
        self.fields = self._found()

    @staticmethod
    def apply(equations: SlotEquations) -> bool:
        """Whether they are worth looking for: M depends on q, and neither on t nor on q'."""
        entries = sympy.Tuple(*(m for row in equations.mass for m in row))
        moving = not free_of(entries, equations.q)
        return (
            moving
            and free_of(entries, [equations.t, *equations.v])
            and len(equations.q) <= _MOST_COORDINATES
        )

    def rate_of(self, potential: Expr) -> Expr | None:
        """K where grad (2 c V + xi.grad V) = K xi, xi being a gradient with L_xi g = 2 c g.

        d^3f/dt^3 = -K df/dt for the time f of the symmetry that has it: V = k r^2/2 has K = 4 k.
        """
        q, g = self.metric.q, self.metric.g
        for xi in self.fields if self.isometries < self.number else []:
            c = self._stretched(xi) / 2
            along = 2 * c * potential + dot(xi, [derivative(potential, x) for x in q])
            pairs = [
                (simplify(derivative(along, x)), simplify(dot(row, xi)))
                for x, row in zip(q, g, strict=True)
            ]
            K = next((simplify(a / b) for a, b in pairs if b != 0), sympy.S.Zero)
            if K != 0 and free_of(K, q) and not any(simplify(a - K * b) for a, b in pairs):
                return K
        return None

    def _stretched(self, xi: Vector) -> Expr:
        """2 c of L_xi g = 2 c g."""
        q, g, n = self.metric.q, self.metric.g, range(self.metric.n)
        i, j = next((i, j) for i in n for j in n if g[i][j] != 0)
        change = dot(xi, [derivative(g[i][j], x) for x in q])
        change += dot(g[i], [derivative(x, q[j]) for x in xi])
        change += dot(g[j], [derivative(x, q[i]) for x in xi])
        return simplify(change / g[i][j])

    @property
    def words(self) -> str:
        """What is searched."""
        words = "point transformations that are isometries of the kinetic energy"
        return words if self.isometries == self.number else f"{words} or stretch it"

    def search(self, equations: SlotEquations, times: TimeFunctions, allowed: Allowance) -> Search:
        """The linear system for the point symmetries: constant factors of T(t) xi."""
        slots = [Slot(("tau",), tuple(-v for v in equations.v))]
        slots += [Slot(("xi", k), field) for k, field in enumerate(self.fields)]
        one = sympy.S.One
        unknowns = [SlotUnknown(k, T, one) for k in range(len(slots)) for T in times.others]
        return Search(equations, slots, ordered(unknowns), allowed)

    def _found(self) -> list[Vector]:
        found: list[Vector] = []
        cyclic = [x for x in self.metric.q if self.metric.is_cyclic(x)]
        if self.number <= len(cyclic):
            return found
        found += self._of_factors()
        if len(found) == self.number:
            return found
        along = {x: self._jets.along(x) for x in cyclic}
        if any(functions is None for functions in along.values()):
            return found
        own = {x: along.get(x) or self._of_coordinate(x) for x in self.metric.q}
        moving = [x for x in self.metric.q if x not in cyclic]
        lengths = [x for x in moving if x**2 in own[x]]
        if len(lengths) > 1:  # of what is projective
            monomials = products_of_two([sympy.S.One, *lengths])
            found += self._solutions(monomials, found)
            if len(found) == self.number:
                return found
        for count in range(1, len(moving) + 1):
            for chosen in combinations(moving, count):
                given = {x: own[x] if x in (*cyclic, *chosen) else [sympy.S.One] for x in own}
                functions = self._products(given)
                if len(functions) * self.metric.n <= _MOST_UNKNOWNS:
                    found += self._solutions(functions, found)
                if len(found) == self.number:
                    return found
        return found

    def _of_factors(self) -> list[Vector]:
        """Of a product those of each factor that is curved, and of all flat ones together."""
        factors, q = self.metric.factors, self.metric.q
        if len(factors) == 1:
            return []
        flat = [q.index(x) for factor in factors if factor.curvature == 0 for x in factor.q]
        parts = [factor for factor in factors if factor.curvature != 0]
        found = []
        for part in [*parts, self.metric.of(flat)] if flat else parts:
            fields = ConstantCurvature(part, self.allowed).fields
            if part.curvature is None:
                known = KillingFields(part, self.allowed)
                fields = known.fields if known.isometries == known.number else []
            for field in fields:
                values = dict(zip(part.q, field, strict=True))
                found.append(tuple(values.get(x, sympy.S.Zero) for x in q))
        return found

    def _of_coordinate(self, x: Symbol) -> list[Expr]:
        """Those of which g and its inverse consist, and their slopes."""
        rows = (*self.metric.g, *self.metric.inverse)
        entries = sympy.Tuple(*(e for row in rows for e in row))
        found: dict[Expr, None] = {sympy.S.One: None}
        families: tuple[tuple[type[Expr], ...], ...] = (CIRCULAR, HYPERBOLIC, (sympy.exp,))
        arguments = {(f.args[0], family) for family in families for f in entries.atoms(*family)}
        for a, family in sorted(arguments, key=str):
            if a.free_symbols & {*self.metric.q} != {x}:
                continue
            if sympy.exp in family:
                found |= dict.fromkeys(sympy.exp(k * a) for k in (1, -1, _HALF, -_HALF))
                continue
            s, c = family[:2]
            found |= {s(a): None, c(a): None}
            for f, other in ((s(a), c(a)), (c(a), s(a))):
                if any(f in sympy.fraction(e)[1].atoms(f.func) for e in entries):
                    found |= {1 / f: None, other / f: None}
        functions = entries.atoms(sympy.Function, sympy.exp)
        if x in entries.xreplace(dict.fromkeys(functions, sympy.S.One)).free_symbols:
            found |= {x: None, 1 / x: None, x**2: None, x**-2: None}
        return list(found)

    def _products(self, given: Mapping[Symbol, Sequence[Expr]]) -> list[Expr]:
        """Of one function of each coordinate; of two cyclic ones where both may stand together."""
        cyclic = [x for x in given if self.metric.is_cyclic(x)]
        apart = {pair for pair in combinations(cyclic, 2) if not self._jets.together(*pair)}
        found = []
        for parts in product(*given.values()):
            moved = [x for x, f in zip(given, parts, strict=True) if f != 1]
            if apart.isdisjoint(combinations(moved, 2)):
                found.append(sympy.Mul(*parts))
        return list(dict.fromkeys(found))

    def _solutions(self, functions: Sequence[Expr], known: Sequence[Vector]) -> list[Vector]:
        """Those beyond the known ones that change the metric by a constant factor."""
        n, q, g = range(self.metric.n), self.metric.q, self.metric.g
        unknowns = [(f, i) for f in sorted(functions, key=complexity, reverse=True) for i in n]
        values = [tuple(f if k == i else sympy.S.Zero for k in n) for f, i in unknowns]
        values.append((sympy.S.Zero,) * self.metric.n)
        columns = []
        for f, i in unknowns:
            slopes = [derivative(f, x) for x in q]
            columns.append([
                f * derivative(g[a][b], q[i]) + g[i][b] * slopes[a] + g[a][i] * slopes[b]
                for a in n for b in range(a + 1)
            ])  # fmt: skip
        columns.append([g[a][b] for a in n for b in range(a + 1)])
        more = [x for field in (*values, *known) for x in field]
        found = Relation(columns, q, self.allowed, more).beyond(values, known, len(n))
        return [tuple(dot(c.values(), (values[k][i] for k in c)) for i in n) for c in found]
