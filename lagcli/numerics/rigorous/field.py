"""The right-hand side x' = f(t, x) and its derivative, on power series of balls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol, ancestry, mask_of
from lagcli.numerics.equations.equations import Equations
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal

#: Coefficients found one by one; from there on each step of Newton's method doubles them.
_BASE = 7


class VectorField:
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
        self.n = motion.n
        equations = motion.equations
        symbols = (*equations.q, *equations.qdot)
        roots, columns, forces = solved(equations, equations.forcing, equations.bias, symbols)
        self.m = motion.m
        self._matrices = motion.matrices
        self._multipliers = motion.function(forces, frozen=True)
        self._accelerations = motion.function(roots, frozen=True)
        entries = [entry for row in zip(*columns, strict=True) for entry in row]
        self._slopes = motion.function(entries, frozen=True)
        #: what an evaluation costs, in nodes
        self.cost = len(ancestry([*roots, *entries]))
        mask = mask_of(equations.qdot)
        #: coefficients that one evaluation gives
        self._gain = 1 if mask_of(roots) & mask else 2

    def rate(self, t: Any, x: Sequence[Any]) -> list[Any]:
        """f at balls."""
        return [*x[self.n :], *self._accelerations(t, *x)]

    def slope(self, t: Any, x: Sequence[Any]) -> Any:
        """J at balls."""
        return self.jacobian(self.slopes([t], [[each] for each in x], 1)[0])

    def coefficients(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """Taylor coefficients 0 .. order of the solution from x: of q, then of v."""
        found = self._first(t, x, min(order, _BASE))
        while len(found[0]) <= order:
            found = self._doubled(t, found, min(2 * len(found[0]), order + 1))
        return found

    def _first(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """The coefficients one after the other: k v_k = a_(k-1)."""
        n, ball = self.n, self._ball
        q, v = [[c] for c in x[:n]], [[c] for c in x[n:]]
        while len(v[0]) <= order:
            known = len(v[0]) + self._gain - 1
            for c, rate in zip(q, v, strict=True):
                c.append(rate[-1] / len(rate))
            found = self.evaluated(self._accelerations, [t, 1], [*q, *v], known)
            for _ in range(self._gain):
                k = len(v[0])
                for c, rate, a in zip(q, v, found, strict=True):
                    if len(c) < k + 1:
                        c.append(rate[k - 1] / k)
                    rate.append(a[k - 1] / ball(k))
        return [c[: order + 1] for c in (*q, *v)]

    def _doubled(self, t: Any, x: Sequence[Sequence[Any]], count: int) -> list[list[Any]]:
        """From the coefficients 0 .. k-1 those up to 2k-1, by a step of Newton's method.

        f(x + e) = f(x) + J(x) e + O(e^2), and e = O(s^k).
        """
        n, known = self.n, len(x[0])
        found = [list(c) for c in x]
        a = self.evaluated(self._accelerations, [t, 1], x, count)
        slopes = self.slopes([t, 1], x, count - known)
        errors: list[Any] = []
        for k in range(known, count):
            change = [entry[k - 1] for entry in a]
            if errors:
                added = convolved(slopes, errors, len(errors) - 1).entries()
                change = [b + c for b, c in zip(change, added, strict=True)]
            places = [(found[n + i][k - 1]) / k for i in range(n)]
            rates = [b / k for b in change]
            for c, value in zip(found, [*places, *rates], strict=True):
                c.append(value)
            errors.append(self._matrix(2 * n, 1, [*places, *rates]))
        return found

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

    def forces(self, t: Any, x: Sequence[Sequence[Any]]) -> list[list[Any]]:
        """The Taylor coefficients of the multipliers along the solution x."""
        length = len(x[0]) - 1
        found = self.evaluated(self._multipliers, [t, 1], x, length)
        return [[each[k] for k in range(length)] for each in found]

    def defect(self, times: Any, along: Sequence[Sequence[Any]]) -> list[Any]:
        """Bounds of the K-th Taylor coefficient of x' - f(x) along polynomials of degree K.

        With a = v' and lambda polynomials, too, what they leave of the equations of motion,

            M a - A^T lambda - F    and    A a + c,

        is divided by the matrix of these equations over the whole step: no elimination is done
        with wide balls.

        Parameters
        ----------
        times : arb
        along : sequence of sequences of arb
            q, v and lambda about every time of the step.
        """
        n, m, series, context = self.n, self.m, self._series, self._context
        order = len(along[0]) - 1
        usual, context.cap = context.cap, order + 1
        try:
            values = self._matrices(series([times, 1]), *(series(c) for c in along[: 2 * n]))
            mass = [values[i * n : (i + 1) * n] for i in range(n)]
            rest = values[n * n + n :]
            rows = [rest[k * n : (k + 1) * n] for k in range(m)]
            a = [series([k * c[k] for k in range(1, order + 1)]) for c in along[n : 2 * n]]
            held = [series(c) for c in along[2 * n :]]
            columns = list(zip(*rows, strict=True)) if rows else [()] * n
            left = [_dot(mass[i], a) - _dot(columns[i], held) - values[n * n + i] for i in range(n)]
            left += [_dot(row, a) + c for row, c in zip(rows, rest[m * n :], strict=True)]
        finally:
            context.cap = usual
        over = [*(row for row in zip(mass, columns, strict=True))]
        whole = [[*map(self._first_of, row), *(-self._first_of(x) for x in held)]
                 for row, held in over]  # fmt: skip
        whole += [[*map(self._first_of, row), *([0] * m)] for row in rows]
        size = n + m
        inverse = self._matrix(size, size, [x for row in whole for x in row]).inv()
        last = self._matrix(size, 1, [x[order] if isinstance(x, series) else 0 for x in left])
        found = (inverse * last).entries()
        return [*(c[order] for c in along[n : 2 * n]), *found[:n]]

    def _first_of(self, x: Any) -> Any:
        return x[0] if isinstance(x, self._series) else x

    def slopes(self, time: Sequence[Any], x: Sequence[Sequence[Any]], length: int) -> list[Any]:
        """The first Taylor coefficients of da/dx, shape (n, 2n), along power series x."""
        n, entries = self.n, self.evaluated(self._slopes, time, x, length)
        return [self._matrix(n, 2 * n, [a[k] for a in entries]) for k in range(length)]

    def jacobian(self, slope: Any) -> Any:
        """J with da/dx below what the velocities have."""
        n = self.n
        above = [int(j == i + n) for i in range(n) for j in range(2 * n)]
        return self._matrix(2 * n, 2 * n, above + slope.entries())

    def evaluated(
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


Solution = tuple[list[Node], list[list[Node]], list[Node]]


def solved(
    equations: Equations, forcing: Sequence[Node], bias: Sequence[Node], symbols: Sequence[Symbol]
) -> Solution:
    """a of M a - A^T lambda = F, A a = -c, the columns of its derivatives, and lambda.

    These obey the same equations:

        M da - A^T dlambda = dF - dM a + dA^T lambda,    A da = -(dc + dA a).

    Raises
    ------
    Refusal
        When the solution cannot be written out.
    """
    eliminated = equations.eliminated
    if eliminated is None:
        raise Refusal("not enclosed: the accelerations have no formula of their own", mistake=False)
    a, multipliers = eliminated.motion(forcing, bias)
    columns = []
    for symbol in symbols:
        right = _differentiated(equations, symbol, forcing, bias, (a, multipliers))
        columns.append(eliminated.motion(*right)[0])
    return a, columns, multipliers


def _differentiated(
    equations: Equations,
    symbol: Symbol,
    forcing: Sequence[Node],
    bias: Sequence[Node],
    solution: tuple[Sequence[Node], Sequence[Node]],
) -> tuple[list[Node], list[Node]]:
    """dF - dM a + dA^T lambda, and dc + dA a."""
    graph, slope = equations.graph, partial(equations.graph, symbol)
    a, multipliers = solution
    rows = [[slope(entry) for entry in row] for row in equations.rows]

    def right(i: int) -> Node:
        moved = [graph.product(slope(m), x) for m, x in zip(equations.mass[i], a, strict=True)]
        held = [graph.product(row[i], y) for row, y in zip(rows, multipliers, strict=True)]
        return graph.difference(graph.sum([slope(forcing[i]), *held]), graph.sum(moved))

    turned = [
        graph.sum([slope(c), *(graph.product(x, y) for x, y in zip(row, a, strict=True))])
        for c, row in zip(bias, rows, strict=True)
    ]
    return [right(i) for i in range(len(forcing))], turned


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


def _dot(left: Sequence[Any], right: Sequence[Any]) -> Any:
    """sum_j left_j right_j, without the zeros of the structure."""
    total: Any = 0
    for a, b in zip(left, right, strict=True):
        if not (hasattr(a, "is_zero") and a.is_zero()):
            total += a * b
    return total
