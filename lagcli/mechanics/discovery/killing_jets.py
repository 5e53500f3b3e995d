"""Killing vectors of a metric as Taylor series at a point: how many there are, and along what.

With x^i the deviations from a random point, xi^i = sum u_a^i x^a and |b| < N,

    sum_k xi^k g_ij,k + g_kj xi^k,i + g_ik xi^k,j = 2 c g_ij   at the order x^b

is linear in c and the u_a^i, and (c, xi, dxi) tells a Killing vector, or one that stretches the
metric.  All is modulo a prime, so their number is bounded from above, and it is theirs where N is
large enough.  Along a cyclic coordinate x the d xi/dx are Killing vectors again: the eigenvalues of
that map are the exponents of x, and its Jordan block of 0 tells the powers.

References
----------
Eisenhart, *Riemannian Geometry*, section 71 (the equations are completely integrable).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import combinations_with_replacement
from math import factorial, prod

import sympy
from flint import nmod_mat
from sympy import Expr, Symbol

from lagcli.algebra import derivative
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.modular import PRIME, kernel_modulo, pivot_columns
from lagcli.mechanics.discovery.spectrum import roots_of
from lagcli.mechanics.discovery.tree import Tree

_ORDER = {1: 6, 2: 6, 3: 5, 4: 4, 5: 4, 6: 4}  # by the number of coordinates

Monomial = tuple[int, ...]


class KillingJets:
    """Those at one point of a metric of at most six coordinates."""

    def __init__(self, metric: Metric, allowed: Allowance) -> None:
        self.metric = metric
        self.n = len(metric.q)
        self.order = _ORDER[self.n]
        self.allowed = allowed
        self._moving = [k for k, x in enumerate(metric.q) if not metric.is_cyclic(x)]

    @cached_property
    def number(self) -> int:
        """A bound from above for the independent ones, with one that stretches the metric."""
        return len(self._chosen)

    def along(self, x: Symbol) -> list[Expr] | None:
        """Functions of a cyclic coordinate that components may have; None where not told."""
        L = self._shifts.get(x)
        if L is None:
            return None
        known = ExactSolver(self._tree.points).recognized([int(c) for c in L.minpoly().coeffs()])
        if known is None:
            return None
        lam = Symbol("#lambda", real=True)
        power = next(k for k, c in enumerate(known) if c != 0)
        rest = sympy.factor(sympy.Add(*(c * lam ** (k - power) for k, c in enumerate(known))))
        exponents = list(roots_of(rest, lam))
        if sum(2 if e.frequency != 0 else 1 for e in exponents) < sympy.degree(rest, lam):
            return None
        found = [x**k for k in range(max(power, 1))]
        return found + [f for exponent in exponents for f in exponent.functions(x)]

    def together(self, x: Symbol, y: Symbol) -> bool:
        """Whether components may have products of functions of two cyclic coordinates."""
        one, other = self._shifts.get(x), self._shifts.get(y)
        return one is None or other is None or (one * other).rank() > 0

    @property
    def isometries(self) -> int:
        """Without the one that stretches the metric."""
        return self.number - any(u.get(self._stretch) for u in self._chosen)

    @cached_property
    def _shifts(self) -> dict[Symbol, nmod_mat]:
        """d/dx of the Killing vectors by themselves, for each cyclic x for which they are known."""
        found, d = {}, self.number
        jets = [self._first(u) for u in self._chosen]
        for place, x in enumerate(self.metric.q):
            if place in self._moving or not d:
                continue
            slopes = [self._first(self._slope(u, place)) for u in self._chosen]
            table = [list(row) for row in zip(*jets, *slopes, strict=True)]
            reduced, rank = nmod_mat(table, PRIME).rref()
            if rank == d:  # else the order is too low
                rows = [[int(reduced[i, d + k]) for k in range(d)] for i in range(d)]
                found[x] = nmod_mat(rows, PRIME)
        return found

    # -- the linear equations -----------------------------------------------------------------

    @cached_property
    def _monomials(self) -> list[Monomial]:
        n = self.n
        return [
            tuple(chosen.count(k) for k in range(n))
            for degree in range(self.order + 1)
            for chosen in combinations_with_replacement(range(n), degree)
        ]

    @cached_property
    def _tree(self) -> Tree:
        entries = [e for series in self._slopes.values() for e in series.values()]
        return Tree(entries, self.metric.q, self.allowed)

    @cached_property
    def _slopes(self) -> dict[tuple[int, int], dict[Monomial, Expr]]:
        """The derivatives of g_ij by the coordinates that it depends on, those that are not 0."""
        found: dict[tuple[int, int], dict[Monomial, Expr]] = {}
        for i in range(self.n):
            for j in range(i + 1):
                series = {(0,) * self.n: self.metric.g[i][j]}
                for monomial in self._monomials:
                    k = next((k for k in self._moving if monomial[k]), None)
                    if k is None or any(
                        monomial[c] for c in range(self.n) if c not in self._moving
                    ):
                        continue
                    below = tuple(m - (c == k) for c, m in enumerate(monomial))
                    if below in series:
                        slope = derivative(series[below], self.metric.q[k])
                        if slope != 0:
                            series[monomial] = slope
                found[i, j] = {m: e for m, e in series.items() if e != 0}
        return found

    def _series(self) -> dict[tuple[int, int], dict[Monomial, int]]:
        """Taylor coefficients of g_ij at a random point."""
        slopes = [(place, m, e) for place, each in self._slopes.items() for m, e in each.items()]
        [values] = self._tree.rows([[e] for _, _, e in slopes], 1)
        found: dict[tuple[int, int], dict[Monomial, int]] = {place: {} for place in self._slopes}
        for (place, m, _), value in zip(slopes, values, strict=True):
            found[place][m] = value * pow(prod(map(factorial, m)), -1, PRIME) % PRIME
        return found

    def _rows(self) -> Iterator[dict[tuple[int, Monomial], int]]:
        """One for each component of the equations and order below N, by (i, a) of u."""
        series = self._series()
        orders = [m for m in self._monomials if sum(m) < self.order]

        def g(i: int, j: int) -> dict[Monomial, int]:
            return series[max(i, j), min(i, j)]

        for i in range(self.n):
            for j in range(i + 1):
                for b in orders:
                    row: dict[tuple[int, Monomial], int] = {}
                    if b in g(i, j):
                        row[self._stretch] = -2 * g(i, j)[b]
                    for k in range(self.n):
                        for c, value in g(i, j).items():  # xi^k g_ij,k
                            if c[k]:
                                _add(row, k, b, c, k, -1, c[k] * value)
                        for one, other in ((i, j), (j, i)):
                            for c, value in g(k, other).items():  # xi^k,one g_k other
                                _add(row, k, b, c, one, 1, value)
                    if row:
                        yield row

    @cached_property
    def _solutions(self) -> list[dict[tuple[int, Monomial], int]]:
        unknowns = [(k, m) for m in reversed(self._monomials) for k in range(self.n)]
        unknowns.append(self._stretch)
        places = {u: k for k, u in enumerate(unknowns)}
        table = []
        for row in self._rows():
            line = [0] * len(unknowns)
            for u, value in row.items():
                line[places[u]] = value % PRIME
            table.append(line)
        self.allowed.spend(len(table) * len(unknowns) // 4)
        _, kernel = kernel_modulo(table, len(unknowns))
        return [{unknowns[k]: x for k, x in vector.items()} for vector in kernel]

    def _first(self, u: dict[tuple[int, Monomial], int]) -> list[int]:
        """c, xi and dxi at the point."""
        first = [m for m in self._monomials if sum(m) <= 1]
        return [u.get(self._stretch, 0), *(u.get((k, m), 0) for m in first for k in range(self.n))]

    @property
    def _stretch(self) -> tuple[int, Monomial]:
        """The place of c among the unknowns."""
        return self.n, (0,) * self.n

    @cached_property
    def _chosen(self) -> list[dict[tuple[int, Monomial], int]]:
        """Solutions whose first jets are independent."""
        jets = [self._first(u) for u in self._solutions]
        if not jets:
            return []
        chosen = pivot_columns([list(row) for row in zip(*jets, strict=True)])
        return [self._solutions[k] for k in chosen]

    def _slope(
        self, u: dict[tuple[int, Monomial], int], place: int
    ) -> dict[tuple[int, Monomial], int]:
        """Of d xi/dx^c."""
        return {
            (k, tuple(a - (c == place) for c, a in enumerate(m))): value * m[place] % PRIME
            for (k, m), value in u.items() if k < self.n and m[place]
        }  # fmt: skip


def _add(
    row: dict[tuple[int, Monomial], int],
    k: int,
    b: Monomial,
    c: Monomial,
    place: int,
    step: int,
    value: int,
) -> None:
    """The term of u_a^k in x^b: of g's x^c, one power of x^place more or less with a slope."""
    a = [m - power for m, power in zip(b, c, strict=True)]
    a[place] += 1
    if min(a) < 0:
        return
    factor = a[place] if step > 0 else 1
    key = (k, tuple(a))
    row[key] = (row.get(key, 0) + factor * value) % PRIME
