"""The kinetic energy as a metric: Christoffel symbols, Hessians, constant curvature.

T = g_ij(q) q_i' q_j' / 2.  With [jk, m] = (g_jm,k + g_km,j - g_jk,m)/2 and
Gamma^i_jk = g^im [jk, m],

    R_ijkl = (g_il,jk + g_jk,il - g_ik,jl - g_jl,ik)/2 + g^mn ([jk, m] [il, n] - [jl, m] [ik, n]),

and the curvature is the constant K where R_ijkl = K (g_ik g_jl - g_il g_jk).

References
----------
Eisenhart, *Riemannian Geometry*, sections 8 and 27.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import combinations, combinations_with_replacement

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import derivative, dot, simplify, solve_linear
from lagcli.algebra.build import CIRCULAR, HYPERBOLIC, free_of
from lagcli.algebra.linear import unit_vectors
from lagcli.algebra.numeric import DIGITS, Evaluator

_SMALL = mpf(10) ** -15
_FIRST = mpf(19) / 17  # of the parameters: no exponent with which a component is 0
_PLACES = 40  # tried for one where the metric is positive definite
_POINTS = (mpf(3) / 7, mpf(8) / 11)  # for the first symbol; the others follow at steps of 1/13


class Metric:
    """g(q) of a system without time in its kinetic energy."""

    def __init__(self, q: Sequence[Symbol], g: Sequence[Sequence[Expr]]) -> None:
        self.q, self.g = q, g
        self.n = len(self.q)

    def is_cyclic(self, x: Symbol) -> bool:
        """Whether no component depends on the coordinate."""
        return free_of(sympy.Tuple(*(entry for row in self.g for entry in row)), [x])

    @cached_property
    def factors(self) -> list[Metric]:
        """The metrics on their own coordinates whose sum it is: two bodies have one each."""
        label = list(range(self.n))
        for i, row in enumerate(self.g):
            for k, entry in enumerate(row):
                inside = {self.q.index(x) for x in entry.free_symbols if x in self.q}
                old = {label[j] for j in ({i, k, *inside} if entry != 0 else {i})}
                label = [label[i] if x in old else x for x in label]
        parts = [[i for i in range(self.n) if label[i] == x] for x in dict.fromkeys(label)]
        return [self.of(part) for part in parts]

    def of(self, part: Sequence[int]) -> Metric:
        """The components of some of the coordinates, by their places."""
        return Metric([self.q[i] for i in part], [[self.g[i][k] for k in part] for i in part])

    @cached_property
    def inverse(self) -> list[list[Expr]]:
        """g^ij."""
        if len(self.factors) > 1:
            place = {x: (f, i) for f in self.factors for i, x in enumerate(f.q)}
            zero = sympy.S.Zero
            return [
                [place[x][0].inverse[place[x][1]][place[y][1]] if place[x][0] is place[y][0]
                 else zero for y in self.q]
                for x in self.q
            ]  # fmt: skip
        n = range(self.n)
        solved = solve_linear(self.g, unit_vectors(self.n))
        if solved is not None and not solved.singular:
            return [list(row) for row in solved.values]
        g = sympy.Matrix([list(row) for row in self.g])
        above, below = g.adjugate(), g.det()
        return [[simplify(above[i, j] / below) for j in n] for i in n]

    @cached_property
    def place(self) -> dict[Symbol, sympy.Rational] | None:
        """Values of all symbols at which it is positive definite; None where none was found."""
        source, g = random.Random("place"), sympy.Matrix([list(row) for row in self.g])
        symbols = sorted(g.free_symbols | {*self.q}, key=str)
        for _ in range(_PLACES):
            sizes = {s: sympy.Rational(source.randint(1, 60), 29) for s in symbols}
            values = {s: x if s.is_nonnegative else source.choice((1, -1)) * x
                      for s, x in sizes.items()}  # fmt: skip
            there = g.xreplace(values)
            minors = [there[:k, :k].det().evalf() for k in range(1, self.n + 1)]
            if all(x.is_positive for x in minors):
                return values
        return None

    def first_kind(self, j: int, k: int, m: int) -> Expr:
        """[jk, m]."""
        g, q, D = self.g, self.q, derivative
        return (D(g[j][m], q[k]) + D(g[k][m], q[j]) - D(g[j][k], q[m])) / 2

    @cached_property
    def christoffel(self) -> list[list[list[Expr]]]:
        """Gamma^i_jk as [i][j][k]."""
        n = range(self.n)
        return [
            [
                [
                    sympy.Add(*(self.inverse[i][m] * self.first_kind(j, k, m) for m in n))
                    for k in n
                ]
                for j in n
            ]
            for i in n
        ]  # fmt: skip

    def gradient(self, X: Expr) -> tuple[Expr, ...]:
        """g^ij X,j."""
        slopes = [derivative(X, x) for x in self.q]
        return tuple(simplify(dot(row, slopes)) for row in self.inverse)

    def riemann(self, i: int, j: int, k: int, m: int) -> Expr:
        """R_ijkm."""
        g, q, D = self.g, self.q, derivative
        second = (
            D(D(g[i][m], q[j]), q[k]) + D(D(g[j][k], q[i]), q[m])
            - D(D(g[i][k], q[j]), q[m]) - D(D(g[j][m], q[i]), q[k])
        ) / 2  # fmt: skip
        products = [
            self.inverse[a][b]
            * (self.first_kind(j, k, a) * self.first_kind(i, m, b)
               - self.first_kind(j, m, a) * self.first_kind(i, k, b))
            for a in range(self.n) for b in range(self.n)
        ]  # fmt: skip
        return second + sympy.Add(*products)

    @cached_property
    def curvature(self) -> Expr | None:
        """K, or None where the curvature is not constant."""
        planes = list(combinations(range(self.n), 2))
        if len(self.factors) > 1:  # a product is flat or not of constant curvature
            flat = all(factor.curvature == 0 for factor in self.factors)
            return sympy.S.Zero if flat else None
        if not planes:
            return sympy.S.Zero
        if not self._is_constant(planes):
            return None
        i, j = next(plane for plane in planes if simplify(self._area(*plane, *plane)) != 0)
        K = simplify(self.riemann(i, j, i, j) / self._area(i, j, i, j))
        return K if free_of(K, self.q) else None

    def constant_where(self, parameters: Sequence[Symbol]) -> Expr:
        """What vanishes with parameters at which the curvature is constant, by rational points.

        1 where there is none, and where the components there are no rational functions of them and
        of exponentials and tangents.
        """
        planes = list(combinations(range(self.n), 2))
        pairs = list(combinations_with_replacement(planes, 2))
        sides = [(self.riemann(*a, *b), self._area(*a, *b)) for a, b in pairs]
        points = [{x: sympy.Rational(k, j) for j, x in enumerate(self.q, k)} for k in (2, 3, 5)]
        values = [(_rational(R, at), _rational(area, at)) for at in points for R, area in sides]
        first = next(((R, area) for R, area in values if area != 0), None)
        found = sympy.S.Zero
        for R, area in values if first else ():
            assert first is not None
            relation = (R * first[1] - first[0] * area).rewrite(HYPERBOLIC, sympy.exp)
            condition = sympy.numer(sympy.together(relation.rewrite(CIRCULAR, sympy.tan)))
            functions = {f: sympy.Dummy() for f in condition.atoms(sympy.Function)}
            if not condition.xreplace(functions).is_polynomial(*parameters):
                return sympy.S.One
            found = sympy.gcd(found, condition)
        return found

    def _area(self, i: int, j: int, k: int, m: int) -> Expr:
        return self.g[i][k] * self.g[j][m] - self.g[i][m] * self.g[j][k]

    def _is_constant(self, planes: Sequence[tuple[int, int]]) -> bool:
        """R_ijkm against K g_ikjm at two points, in numbers."""
        pairs = list(combinations_with_replacement(planes, 2))
        formulas = [self.riemann(*a, *b) for a, b in pairs] + [self._area(*a, *b) for a, b in pairs]
        symbols = sorted({s for f in formulas for s in f.free_symbols}, key=str)
        evaluate = Evaluator(formulas)
        found: list[mpf] = []
        with mpmath.workdps(DIGITS):
            for start in _POINTS:
                try:
                    values = evaluate(_point(symbols, self.q, start))
                except (ArithmeticError, ValueError):
                    return False
                if not all(isinstance(x, mpf) and mpmath.isfinite(x) for x in values):
                    return False
                R, area = values[: len(pairs)], values[len(pairs) :]
                largest = max(range(len(area)), key=lambda k: abs(area[k]))
                if area[largest] == 0:
                    return False
                found.append(R[largest] / area[largest])
                scale = max(map(abs, area)) * (1 + abs(found[0]))
                if any(abs(r - found[0] * a) > _SMALL * scale
                       for r, a in zip(R, area, strict=True)):  # fmt: skip
                    return False
        return True


def _rational(formula: Expr, at: Mapping[Symbol, Expr]) -> Expr:
    """At a point, where cos(k x) + i sin(k x) = ((1 + i u)/(1 - i u))^k is rational as well."""
    put_in: dict[Expr, Expr] = {}
    for f in formula.atoms(*CIRCULAR):
        k, x = f.args[0].as_coeff_Mul()
        if x in at and k.is_Integer:
            turned = (1 + sympy.I / (at[x] + 1)) ** (2 * abs(k))
            c, s = (part / abs(turned) for part in turned.expand().as_real_imag())
            s *= sympy.sign(k)
            put_in[f] = dict(zip(CIRCULAR, (s, c, s / c, c / s, 1 / c, 1 / s), strict=True))[f.func]
    return formula.xreplace(put_in).xreplace(at)


def _point(symbols: Sequence[Symbol], q: Sequence[Symbol], start: mpf) -> dict[Symbol, mpf]:
    """Parameters that are the same at all points, coordinates that are not."""
    step = mpf(1) / 13
    fixed = [s for s in symbols if s not in q]
    return {s: _FIRST + k * step for k, s in enumerate(fixed)} | {
        s: start + k * step for k, s in enumerate(q)
    }
