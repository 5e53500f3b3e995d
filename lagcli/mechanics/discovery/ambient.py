"""Functions in which a space of constant curvature is as simple as in Cartesian coordinates.

In a space of constant curvature K with n dimensions the equations

    X;ij = X,ij - Gamma^k_ij X,k = -K g_ij X

have n + 1 solutions: where K = 0 the constant 1 and n Cartesian coordinates, else the
coordinates of the sphere or the hyperboloid in n + 1 dimensions.  All isometries are made
of them, X_a grad X_b - X_b grad X_a, so it does not matter which coordinates the problem
is written in: r and phi, parabolic or elliptic ones, or those of a half plane.

Along a cyclic coordinate x the solutions change as exp(lambda x), det(lambda - B) = 0 with
dX/dx = X,x and dX,i/dx = -K g_ix X + Gamma^k_ix X,k, so their dependence on it is known.
For the other coordinates products of the functions are tried that the metric consists of.

References
----------
Obata, J. Math. Soc. Japan 14 (1962) 333 (the equation and the sphere).
Eisenhart, *Riemannian Geometry*, sections 27 and 71 (spaces of constant curvature).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.modular import PRIME, NoPoint, kernel_modulo, pivot_columns
from lagcli.mechanics.discovery.spectrum import roots_of
from lagcli.mechanics.discovery.tree import Memo, Tree

_MOST = 260
_BAD_POINTS = 50
_HYPERBOLIC = (sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth)
_Jet = tuple[int, int, int]  # value, first and second derivative


def ambient_functions(metric: Metric, allowed: Allowance) -> list[Expr]:
    """The solutions that are not constant; none where they were not found."""
    K = metric.curvature
    if K is None:
        return []
    if metric.n == 1:  # X = int sqrt(g) dx
        length = antiderivative(simplify(sympy.sqrt(metric.g[0][0])), metric.q[0], rules=False)
        return [] if length is None else [length]
    factors = [_of_coordinate(x, metric, K) for x in metric.q]
    joint = _joint(metric)
    size = len(joint)
    for each in factors:
        size *= len(each)
    if size > _MOST:
        return []
    try:
        found = _Hessian(metric, K, factors, joint, allowed).solutions()
    except (NoPoint, ZeroDivisionError):
        return []
    found = [X for X in found if not free_of(X, metric.q)]
    return found if len(found) == metric.n + (K != 0) else []


# -- which functions are tried ---------------------------------------------------------------


def _of_coordinate(x: Symbol, metric: Metric, K: Expr) -> list[Expr]:
    one = sympy.S.One
    if free_of(sympy.Tuple(*(e for row in metric.g for e in row)), [x]):
        return [one, *_along(x, metric, K)]
    alone = [e for e in _parts(metric) if e.free_symbols & set(metric.q) == {x}]
    found: dict[Expr, None] = {one: None}
    for a in _arguments(alone, CIRCULAR):
        found |= dict.fromkeys(f(a / k) for k in (1, 2) for f in (sympy.sin, sympy.cos))
    for a in _arguments(alone, _HYPERBOLIC):
        found |= dict.fromkeys(f(a / k) for k in (1, 2) for f in (sympy.sinh, sympy.cosh))
    for f in _below(alone):  # 1/cosh(x)^2 of Mercator's map comes from 1/cosh(x) and tanh(x)
        other = sympy.sinh if f.func is sympy.cosh else sympy.cosh
        found |= {1 / f: None, other(f.args[0]) / f: None}
    for a in _arguments(alone, (sympy.exp,)):
        found |= dict.fromkeys(sympy.exp(a * k / 2) for k in (-2, -1, 1, 2))
    shared = [1 / J for J in _joint(metric) if x in J.free_symbols]
    if any(not free_of(_without_functions(e), [x]) for e in (*alone, *shared)):
        found |= {x: None, x**2: None, 1 / x: None}
        sums = [b for e in alone for b in _bases(e) if b.is_Add]
        for b in dict.fromkeys(sums):
            found |= {sympy.sqrt(b): None, 1 / sympy.sqrt(b): None, 1 / b: None}
            found |= {x / sympy.sqrt(b): None, x / b: None, x**2 / b: None}
    return list(found)


def _along(x: Symbol, metric: Metric, K: Expr) -> Iterator[Expr]:
    """exp(lambda x) for a cyclic coordinate, real; powers where lambda = 0 is repeated."""
    n, c = metric.n, metric.q.index(x)
    rows = [
        [sympy.Integer(k == c + 1) for k in range(n + 1)],
        *([-K * metric.g[i][c], *(metric.christoffel[k][i][c] for k in range(n))]
          for i in range(n)),
    ]  # fmt: skip
    lam = Symbol("lambda", real=True)
    B = sympy.Matrix(rows)
    poly = (lam * sympy.eye(n + 1) - B).det(method="berkowitz").as_poly(lam)
    powers = [simplify(a) for a in poly.all_coeffs()]
    if not free_of(sympy.Tuple(*powers), metric.q):
        return
    if powers[-2] == 0:  # lambda = 0 is a root at least twice
        yield from (x, x**2)
    for exponent in roots_of(sympy.Poly(powers, lam).as_expr(), lam):
        yield from exponent.functions(x)


def _parts(metric: Metric) -> list[Expr]:
    """Factors of the components of the metric and of their terms."""
    entries = [sympy.factor_terms(e) for row in metric.g for e in row if e != 0]
    entries += [t for e in entries for t in sympy.Add.make_args(sympy.expand(e))]
    return list(dict.fromkeys(f for e in entries for f in sympy.Mul.make_args(e)))


def _joint(metric: Metric) -> list[Expr]:
    """Sums of several coordinates that stand in denominators, as 1 - x^2 - y^2 of a disk."""
    one = sympy.S.One
    bases = {
        p.base
        for row in metric.g for e in row for p in e.atoms(sympy.Pow)
        if p.exp.is_negative and p.base.is_Add and len(p.base.free_symbols & set(metric.q)) > 1
    }  # fmt: skip
    return [one, *(1 / b for b in sorted(bases, key=sympy.default_sort_key))]


def _arguments(expressions: Iterable[Expr], functions: tuple[type, ...]) -> list[Expr]:
    atoms = {f for e in expressions for f in e.atoms(*functions)}
    return list(dict.fromkeys(f.args[0] for f in sorted(atoms, key=sympy.default_sort_key)))


def _below(expressions: Iterable[Expr]) -> list[Expr]:
    """cosh and sinh in denominators, that of tanh among them."""
    powers = {p for e in expressions for p in e.atoms(sympy.Pow) if p.exp.is_negative}
    found = {f for p in powers for f in p.base.atoms(sympy.cosh, sympy.sinh)}
    found |= {sympy.cosh(f.args[0]) for e in expressions for f in e.atoms(sympy.tanh)}
    return sorted(found, key=sympy.default_sort_key)


def _without_functions(expression: Expr) -> Expr:
    functions = expression.atoms(*CIRCULAR, *_HYPERBOLIC, sympy.exp)
    return expression.xreplace({f: sympy.Dummy() for f in functions})


def _bases(expression: Expr) -> list[Expr]:
    powers = expression.atoms(sympy.Pow) | {expression}
    return [p.as_base_exp()[0] for p in sorted(powers, key=sympy.default_sort_key)]


# -- the linear equations --------------------------------------------------------------------


class _Hessian:
    """X;ij + K g_ij X = 0 for combinations of products of functions of single coordinates."""

    def __init__(
        self,
        metric: Metric,
        K: Expr,
        factors: Sequence[Sequence[Expr]],
        joint: Sequence[Expr],
        allowed: Allowance,
    ) -> None:
        self.metric, self.K, self.allowed = metric, K, allowed
        products = [(parts, j) for parts in product(*factors) for j in joint]
        self.products = sorted(products, key=_complexity, reverse=True)
        q, n = metric.q, range(metric.n)
        self._jets = {
            (x, h): (h, h.diff(x), h.diff(x, 2))
            for x, each in zip(q, factors, strict=True) for h in each
        }  # fmt: skip
        self._joint_jets = {
            j: (j, [j.diff(x) for x in q], [[j.diff(x, y) for y in q] for x in q]) for j in joint
        }
        self._pairs = [(i, k) for i in n for k in range(i + 1)]
        self._gamma = metric.christoffel
        expressions = [e for jet in self._jets.values() for e in jet]
        for j, first, second in self._joint_jets.values():
            expressions += [j, *first, *(e for row in second for e in row)]
        expressions += [e for table in self._gamma for row in table for e in row]
        expressions += [K * metric.g[i][k] for i, k in self._pairs]
        self.tree = Tree(expressions, q, allowed)

    def solutions(self) -> list[Expr]:
        """All of them, the simplest first, with exact coefficients."""
        width = len(self.products)
        rows: list[list[int]] = []
        values: list[list[int]] = []
        bad = 0
        while len(rows) < width + 12 or len(values) < 4 * self.metric.n:
            self.allowed.check()
            try:
                more, value = self._rows(self.tree.points.point())
            except NoPoint:
                bad += 1
                if bad > _BAD_POINTS:
                    raise
                continue
            rows += more
            values.append(value)
        return self._exact(_independent(kernel_modulo(rows, width)[1], values))

    def _exact(self, vectors: Sequence[dict[int, int]]) -> list[Expr]:
        exact = ExactSolver(self.tree.points)
        found = []
        for vector in vectors:
            indices = sorted(vector)
            values = exact.recognized([vector[i] for i in indices])
            values = values or exact.solved([self._conditions(i) for i in indices])
            if values is not None:
                terms = [c * self._function(i) for c, i in zip(values, indices, strict=True)]
                found.append(sympy.Add(*terms))
        return found

    def _function(self, index: int) -> Expr:
        parts, j = self.products[index]
        return sympy.Mul(*parts, j)

    def _conditions(self, index: int) -> list[Expr]:
        X, q = self._function(index), self.metric.q
        slopes = [X.diff(x) for x in q]
        return [
            slopes[i].diff(q[k])
            - sympy.Add(*(self._gamma[m][i][k] * s for m, s in enumerate(slopes)))
            + self.K * self.metric.g[i][k] * X
            for i, k in self._pairs
        ]

    def _rows(self, point: Sequence[int]) -> tuple[list[list[int]], list[int]]:
        """The equations at a point, and the values of the products there."""
        memo: Memo = {}

        def at(expression: Expr) -> int:
            return self.tree.value(expression, point, memo)

        jets = {key: tuple(map(at, jet)) for key, jet in self._jets.items()}
        joint = {
            j: (at(j), list(map(at, first)), [list(map(at, row)) for row in second])
            for j, (_, first, second) in self._joint_jets.items()
        }
        gamma = [[[at(e) for e in row] for row in table] for table in self._gamma]
        metric = [at(self.K * self.metric.g[i][k]) for i, k in self._pairs]
        columns, values = [], []
        for parts, j in self.products:
            own = [jets[x, h] for x, h in zip(self.metric.q, parts, strict=True)]
            X, first, second = _times(own, joint[j])
            values.append(X)
            columns.append([
                (second[i][k] - sum(gamma[m][i][k] * s for m, s in enumerate(first)) + g * X)
                % PRIME
                for (i, k), g in zip(self._pairs, metric, strict=True)
            ])  # fmt: skip
        return [list(row) for row in zip(*columns, strict=True)], values


def _independent(
    vectors: Sequence[dict[int, int]], values: Sequence[Sequence[int]]
) -> list[dict[int, int]]:
    """The simplest combinations of products that are independent functions, and not 0."""
    simplest = list(reversed(vectors))
    if not simplest:
        return []
    table = [
        [sum(c * row[k] for k, c in vector.items()) % PRIME for vector in simplest]
        for row in values
    ]
    return [simplest[k] for k in pivot_columns(table)]


def _times(
    own: Sequence[tuple[int, ...]], joint: tuple[int, list[int], list[list[int]]]
) -> tuple[int, list[int], list[list[int]]]:
    """Value, gradient and second derivatives of h_1(q_1) … h_n(q_n) J(q)."""
    n = len(own)

    def mixed(orders: Sequence[int]) -> int:
        value = 1
        for jet, order in zip(own, orders, strict=True):
            value = value * jet[order] % PRIME
        return value

    def unit(*places: int) -> list[int]:
        return [places.count(k) for k in range(n)]

    plain = mixed(unit())
    slopes = [mixed(unit(i)) for i in range(n)]
    J, DJ, DDJ = joint
    first = [(s * J + plain * d) % PRIME for s, d in zip(slopes, DJ, strict=True)]
    second = [
        [(mixed(unit(i, k)) * J + slopes[i] * DJ[k] + slopes[k] * DJ[i] + plain * DDJ[i][k])
         for k in range(n)]
        for i in range(n)
    ]  # fmt: skip
    return plain * J % PRIME, first, second


def _complexity(each: tuple[tuple[Expr, ...], Expr]) -> tuple[int, str]:
    whole = sympy.Mul(*each[0], each[1])
    return sympy.count_ops(whole) + len(whole.free_symbols), str(whole)
