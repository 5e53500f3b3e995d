"""The right-hand side x' = f(t, x) and its derivative, on power series of balls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.rigorous.solution import LinearSystem, convolved, horner, sizes

#: Coefficients found one by one; from there on each step of Newton's method doubles them.  These
#: are so small a part of the state (2^-28) that they need _FEWER bits less.
_BASE, _FEWER = 12, 24


class VectorField:
    """f and J = df/dx of a motion in balls.

    Parameters
    ----------
    motion : Motion
        In balls.
    """

    def __init__(self, motion: Motion) -> None:
        from flint import arb, arb_mat, arb_poly, ctx

        self._ball, self._matrix, self._polynomial, self._context = arb, arb_mat, arb_poly, ctx
        self.n, equations = motion.n, motion.equations
        symbols = (*equations.q, *equations.qdot)
        self.system = LinearSystem(motion, equations.forcing, equations.bias, symbols)

    def rate(self, t: Any, x: Sequence[Any]) -> list[Any]:
        """f at balls."""
        found = self.system.solution([t], [[each] for each in x], 1).found[0]
        return [*x[self.n :], *found.entries()[: self.n]]

    def jacobian(self, t: Any, x: Sequence[Any]) -> Any:
        """J at balls."""
        return self.with_velocities(self.system.slopes([t], [[each] for each in x], 1)[0])

    def with_velocities(self, accelerations: Any) -> Any:
        """J with da/dx below what the velocities have."""
        n = self.n
        above = [int(j == i + n) for i in range(n) for j in range(2 * n)]
        return self._matrix(2 * n, 2 * n, above + accelerations.entries())

    def coefficients(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """Taylor coefficients 0 .. order of the solution from x: of q, then of v."""
        found = self._first(t, x, min(order, _BASE))
        with self._context.workprec(self._context.prec - _FEWER):
            while len(found[0]) <= order:
                found = self._doubled(t, found, min(2 * len(found[0]), order + 1))
        return found

    def _first(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """The coefficients one after the other: k v_k = a_(k-1)."""
        n = self.n
        q, v = [[c] for c in x[:n]], [[c] for c in x[n:]]
        known = self.system.begun([t], [*q, *v])
        while len(v[0]) <= order:
            for c, rate in zip(q, v, strict=True):
                c.append(rate[-1] / len(rate))
            self.system.continued(known, [t, 1], [*q, *v], len(v[0]) + self.system.gain - 1)
            for _ in range(self.system.gain):
                k = len(v[0])
                for i, (c, rate) in enumerate(zip(q, v, strict=True)):
                    if len(c) < k + 1:
                        c.append(rate[k - 1] / k)
                    rate.append(known.found[k - 1][i, 0] / k)
        return [c[: order + 1] for c in (*q, *v)]

    def _doubled(self, t: Any, x: Sequence[Sequence[Any]], count: int) -> list[list[Any]]:
        """From the coefficients 0 .. k-1 those up to 2k-1, by a step of Newton's method.

        f(x + e) = f(x) + J(x) e + O(e^2), and e = O(s^k).
        """
        n, known = self.n, len(x[0])
        found = [list(c) for c in x]
        at = self.system.solution([t, 1], x, count)
        slopes = self.system.slopes([t, 1], x, count - known, at)
        errors: list[Any] = []
        for k in range(known, count):
            change = at.found[k - 1].entries()[:n]
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
        held = range(self.n, self.system.size)
        return self.system.solution([t, 1], x, len(x[0]) - 1).components(held) if held else []

    def left(self, time: Sequence[Any], x: Sequence[Any], first: int, length: int) -> list[Any]:
        """Coefficients of what polynomials leave of the equations of motion, with a = v'.

        Parameters
        ----------
        time : sequence of arb
        x : sequence of sequences of arb
            q, v and lambda.
        first, length : int
            Of the coefficients.
        """
        n = self.n
        a = [[k * c[k] for k in range(1, len(c))] for c in x[n : 2 * n]]
        return self.system.left(time, x[: 2 * n], [*a, *x[2 * n :]], first, length)

    def defect(self, times: Any, along: Sequence[Any], ahead: Sequence[Any], h: Any) -> list[Any]:
        """Bounds of the integral of |x' - f(x)| along polynomials of degree K over a step h.

        Parameters
        ----------
        times : arb
            All those of the step.
        along : sequence of sequences of arb
            q, v and lambda about every time of the step.
        ahead : sequence of arb_mat
            Coefficients K, K + 1, ... of what they leave, about its beginning.
        h : arb
        """
        n, order = self.n, len(along[0]) - 1
        last = order + len(ahead)
        left = [*ahead, *self.left([times, 1], along, last, last + 1)]
        inverse = self.system.inverse(times, [c[0] for c in along[: 2 * n]])
        found = sizes(inverse) * horner([sizes(each) for each in left], h)
        rates = [*(c[order].abs_upper() for c in along[n : 2 * n]), *found.entries()[:n]]
        return [(x * h ** (order + 1) / (order + 1)).abs_upper() for x in rates]
