"""The right-hand side x' = f(t, x) and its derivative, on power series of balls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol
from lagcli.numerics.equations.equations import Equations
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal


class Field:
    """f and J = df/dx of a motion in balls.

    Parameters
    ----------
    motion : Motion
        In balls.

    Raises
    ------
    Refusal
        When the accelerations cannot be written out.
    """

    def __init__(self, motion: Motion) -> None:
        from flint import arb, arb_mat, arb_poly, arb_series, ctx

        self._ball, self._matrix, self._series, self._context = arb, arb_mat, arb_series, ctx
        self._polynomial = arb_poly
        self.n, self._motion = motion.n, motion
        equations = motion.equations
        roots, entries = _written_out(equations)
        self._accelerations = motion.function(roots, frozen=True)
        self._slopes = motion.function(entries, frozen=True)
        mask = 0
        for symbol in equations.qdot:
            mask |= symbol.mask
        #: coefficients that one evaluation gives
        self._gain = 1 if any(a.mask & mask for a in roots) else 2

    def accelerations(self, t: Any, x: Sequence[Any]) -> list[Any]:
        """a at balls."""
        return list(self._accelerations(t, *x))

    def coefficients(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """Taylor coefficients 0 .. order of the solution from x: of q, then of v."""
        n, ball = self.n, self._ball
        q, v = [[c] for c in x[:n]], [[c] for c in x[n:]]
        while len(v[0]) <= order:
            known = len(v[0]) + self._gain - 1
            for c, rate in zip(q, v, strict=True):
                c.append(rate[-1] / len(rate))
            found = self._evaluated(self._accelerations, [t, 1], [*q, *v], known)
            for _ in range(self._gain):
                k = len(v[0])
                for c, rate, a in zip(q, v, found, strict=True):
                    if len(c) < k + 1:
                        c.append(rate[k - 1] / k)
                    rate.append(a[k - 1] / ball(k))
        return [c[: order + 1] for c in (*q, *v)]

    def shifted(
        self, t: Any, h: Any, centre: Sequence[Sequence[Any]]
    ) -> tuple[Any, list[list[Any]]]:
        """The times of a step, and coefficients of polynomials about every time of it."""
        half = (h / 2).abs_upper()
        forward = self._polynomial([half, 1])
        both = self._polynomial([self._ball(0, half), 1])
        count = len(centre[0])
        found = []
        for each in centre:
            moved = list(self._polynomial(list(each))(forward)(both))
            found.append(moved + [self._ball(0)] * (count - len(moved)))
        return t + half + self._ball(0, half), found

    def highest(self, times: Any, along: Sequence[Sequence[Any]]) -> list[Any]:
        """The last Taylor coefficient of f along polynomials x of degree K: the K-th."""
        order = len(along[0]) - 1
        found = self._evaluated(self._accelerations, [times, 1], along, order + 1)
        return [*(c[order] for c in along[self.n :]), *(a[order] for a in found)]

    def jacobian(
        self, time: Sequence[Any], x: Sequence[Sequence[Any]], length: int
    ) -> list[Any]:
        """The first Taylor coefficients of J along power series x."""
        n, found = self.n, []
        entries = self._evaluated(self._slopes, time, x, length)
        for k in range(length):
            top = [int(k == 0 and j == i + n) for i in range(n) for j in range(2 * n)]
            found.append(self._matrix(2 * n, 2 * n, [*top, *(a[k] for a in entries)]))
        return found

    def _evaluated(
        self, function: Any, time: Sequence[Any], x: Sequence[Sequence[Any]], length: int
    ) -> list[Any]:
        """The values of a function as series of a length."""
        series, context = self._series, self._context
        usual, context.cap = context.cap, length
        try:
            found = function(series(list(time)[:length]), *(series(c[:length]) for c in x))
            return [a if isinstance(a, series) else series([a]) for a in found]
        finally:
            context.cap = usual


def _written_out(equations: Equations) -> tuple[list[Node], list[Node]]:
    """The accelerations, and their derivatives with respect to q and q', row by row.

    With a and lambda the solution of M a - A^T lambda = F, A a = -c, the derivatives obey
    the same equations:

        M da - A^T dlambda = dF - dM a + dA^T lambda,    A da = -(dc + dA a).
    """
    eliminated = equations.eliminated
    if eliminated is None:
        raise Refusal("not enclosed: the accelerations have no formula of their own", mistake=False)
    accelerations, multipliers = eliminated.motion(equations.forcing, equations.bias)
    columns = []
    for symbol in (*equations.q, *equations.qdot):
        forcing, bias = _differentiated(equations, symbol, accelerations, multipliers)
        columns.append(eliminated.motion(forcing, bias)[0])
    return accelerations, [entry for row in zip(*columns, strict=True) for entry in row]


def _differentiated(
    equations: Equations, symbol: Symbol, a: Sequence[Node], multipliers: Sequence[Node]
) -> tuple[list[Node], list[Node]]:
    """dF - dM a + dA^T lambda, and dc + dA a."""
    graph, slope = equations.graph, partial(equations.graph, symbol)
    product, minus = graph.product, lambda x: graph.scaled(x, -1)
    rows = [[slope(entry) for entry in row] for row in equations.rows]
    forcing = [
        graph.sum([
            slope(force),
            *(minus(product(slope(m), x)) for m, x in zip(mass, a, strict=True)),
            *(product(row[i], y) for row, y in zip(rows, multipliers, strict=True)),
        ])
        for i, (force, mass) in enumerate(zip(equations.forcing, equations.mass, strict=True))
    ]  # fmt: skip
    bias = [
        graph.sum([slope(c), *(product(x, y) for x, y in zip(row, a, strict=True))])
        for c, row in zip(equations.bias, rows, strict=True)
    ]
    return forcing, bias
