r"""The accelerations and the multipliers on power series of balls.

    M a - A^T lambda = F,    A a = -c,        in short K z = r,

are solved for one coefficient after another,

    K_0 z_k = r_k - sum_{j=1..k} K_j z_{k-j},

with one inverse: (Y K_0)^-1 Y, where Y is about the inverse of the middle of K_0, so that wide
balls are not eliminated from one another.  The derivatives obey the same equations:

    K dz = dr - dK z.

References
----------
A. Neumaier, *Interval Methods for Systems of Equations* (1990), section 4.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.expansion import Expansion
from lagcli.graph.nodes import Node, Symbol, ancestry, mask_of
from lagcli.numerics.equations.motion import Motion

Series = Sequence[Any]


class SolvedSeries:
    """z of one power series x, the coefficients that are known.

    Attributes
    ----------
    matrices, rights : list of arb_mat
        K_0 .. and r_0 .. ; K_0 only where K is constant.
    found : list of arb_mat
        z_0 .. , columns.
    """

    def __init__(self) -> None:
        self.matrices: list[Any] = []
        self.rights: list[Any] = []
        self.found: list[Any] = []
        self.inverse: Any = None

    def solve(self, rights: Sequence[Any], found: list[Any]) -> list[Any]:
        """The rest of z for right sides."""
        if self.inverse is None:
            self.inverse = inverted(self.matrices[0])
        later = self.matrices[1:]
        for k in range(len(found), len(rights)):
            rest = rights[k] - convolved(later, found, k - 1) if k and later else rights[k]
            found.append(self.inverse * rest)
        return found

    def components(self, places: range) -> list[list[Any]]:
        """Coefficients of components of z."""
        return [[z[i, 0] for z in self.found] for i in places]


class LinearSystem:
    """K z = r of a motion, and the derivatives of z.

    Parameters
    ----------
    motion : Motion
        In balls.
    forcing, bias : sequences of nodes
        F and c.
    symbols : sequence of Symbol
        With respect to which z is differentiated.
    """

    def __init__(
        self,
        motion: Motion,
        forcing: Sequence[Node],
        bias: Sequence[Node],
        symbols: Sequence[Symbol],
    ) -> None:
        from flint import arb_mat, arb_series, ctx

        self._matrix, self._series, self._context = arb_mat, arb_series, ctx
        equations = motion.equations
        graph, mass, rows = equations.graph, equations.mass, equations.rows
        n, m = motion.n, motion.m
        self.n, self.size, self._width = n, n + m, len(symbols)
        # z as arguments beside the state; no file can name the second
        z = [graph.symbol(q.name, 2) for q in equations.q]
        z += [graph.symbol(f"multiplier {k}") for k in range(m)]
        shorter = Expansion(graph)
        matrix = [
            [*map(shorter, mass[i]), *(graph.scaled(row[i], -1) for row in rows)] for i in range(n)
        ]
        matrix += [[*row, *[graph.zero] * m] for row in rows]
        right = [*map(shorter, forcing), *(graph.scaled(c, -1) for c in bias)]
        left = [
            graph.difference(
                r, graph.sum([graph.product(a, x) for a, x in zip(row, z, strict=True)])
            )
            for row, r in zip(matrix, right, strict=True)
        ]
        slopes = [partial(graph, s) for s in symbols]
        partials = [slope(node) for node in left for slope in slopes]
        entries = [*chain(*matrix)]
        self._entries = motion.function(entries, frozen=True)
        self._rights = motion.function(right, frozen=True)
        self._left = motion.function(left, z, frozen=True)
        self._partials = motion.function(partials, z, frozen=True)
        self._steady = not mask_of(entries) & mask_of(equations.state)
        #: coefficients that one evaluation gives
        self.gain = 1 if mask_of([*entries, *right]) & mask_of(equations.qdot) else 2
        #: K and its inverse where they are constant, by the bits
        self._constant: dict[int, tuple[list[Any], Any]] = {}
        #: what an evaluation costs, in nodes
        self.cost = len(ancestry([*entries, *right, *partials]))

    def solution(self, time: Series, x: Sequence[Series], length: int) -> SolvedSeries:
        """The first coefficients of z along power series x."""
        return self.continued(self.begun(time, x), time, x, length)

    def begun(self, time: Series, x: Sequence[Series]) -> SolvedSeries:
        """No coefficients yet; K and its inverse where they are constant."""
        found, bits = SolvedSeries(), self._context.prec
        if self._steady:
            if bits not in self._constant:
                matrix = self._matrices(time, x, 0, 1)
                self._constant[bits] = matrix, inverted(matrix[0])
            matrices, found.inverse = self._constant[bits]
            found.matrices = [*matrices]
        return found

    def _matrices(self, time: Series, x: Sequence[Series], first: int, length: int) -> list[Any]:
        """Coefficients of K from the first of them on."""
        entries = self.evaluated(self._entries, time, x, length)
        return [
            self._matrix(self.size, self.size, [each[k] for each in entries])
            for k in range(first, length)
        ]

    def continued(
        self, known: SolvedSeries, time: Series, x: Sequence[Series], length: int
    ) -> SolvedSeries:
        """The same with more coefficients of x."""
        begin = len(known.rights)
        if not self._steady:
            known.matrices += self._matrices(time, x, begin, length)
        rights = self.evaluated(self._rights, time, x, length)
        known.rights += [
            self._matrix(self.size, 1, [each[k] for each in rights]) for k in range(begin, length)
        ]
        known.solve(known.rights, known.found)
        return known

    def slopes(
        self, time: Series, x: Sequence[Series], length: int, known: SolvedSeries | None = None
    ) -> list[Any]:
        """The first coefficients of da/dx, shape (n, symbols), along power series x."""
        n, width = self.n, self._width
        if self._steady:  # then they do not depend on z
            at, z = self.begun(time, x), [[0]] * self.size
        else:
            at = known or self.solution(time, x, length)
            z = [each[:length] for each in at.components(range(self.size))]
        entries = self.evaluated(self._partials, time, [*x, *z], length)
        rights = [
            self._matrix(self.size, width, [each[k] for each in entries]) for k in range(length)
        ]
        found = at.solve(rights, [])
        if self.size == n:
            return found
        return [self._matrix(n, width, each.entries()[: n * width]) for each in found]

    def left(
        self, time: Series, x: Sequence[Series], z: Sequence[Series], first: int, length: int
    ) -> list[Any]:
        """Coefficients of r - K z along polynomials x and z, from the first of them on."""
        left = self.evaluated(self._left, time, [*x, *z], length)
        return [
            self._matrix(self.size, 1, [each[k] for each in left]) for k in range(first, length)
        ]

    def inverse(self, time: Any, x: Sequence[Any]) -> Any:
        """K^-1 at balls."""
        at = [time], [[each] for each in x]
        return self.begun(*at).inverse if self._steady else inverted(self._matrices(*at, 0, 1)[0])

    def evaluated(self, function: Any, time: Series, x: Sequence[Series], length: int) -> list[Any]:
        """The values of a function as series of a length."""
        series, context = self._series, self._context
        usual, context.cap = context.cap, length
        try:
            found = function(series(list(time)[:length]), *(series(c[:length]) for c in x))
            return [a if isinstance(a, series) else series([a]) for a in found]
        finally:
            context.cap = usual


def inverted(matrix: Any) -> Any:
    """An enclosure of the inverse.

    Raises
    ------
    ZeroDivisionError
        Where the matrix may be singular.
    """
    about = matrix.mid().inv().mid()
    return (about * matrix).inv() * about


def convolved(left: Sequence[Any], right: Sequence[Any], k: int) -> Any:
    """sum_j left_j right_(k-j)."""
    pairs = [
        (left[j], right[k - j])
        for j in range(max(0, k - len(right) + 1), min(k, len(left) - 1) + 1)
    ]
    total = pairs[0][0] * pairs[0][1]
    for a, b in pairs[1:]:
        total += a * b
    return total


def horner(coefficients: Sequence[Any], s: Any) -> Any:
    """sum_k c_k s^k."""
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = c + value * s
    return value


def sizes(matrix: Any) -> Any:
    """|M|, rounded up."""
    bounds = [x.abs_upper() for x in matrix.entries()]
    return type(matrix)(matrix.nrows(), matrix.ncols(), bounds)


def around_zero(bound: Any) -> Any:
    """A matrix of balls around 0."""
    entries = [x.union(-x) for x in bound.entries()]
    return type(bound)(bound.nrows(), bound.ncols(), entries)
