"""The stages of a collocation method: one simplified Newton iteration for all of them.

    K_i = a(t + c_i h, q + c_i h v + h^2 sum (A^2)_ij K_j, v + h sum A_ij K_j)

with J_q = da/dq and J_v = da/dq' at the beginning of the step.  With A = T diag(mu) T^-1 each
round solves (I - h mu J_v - h^2 mu^2 J_q) dW = -(T^-1 F) for each mu, and dK = T dW.

References
----------
Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., section IV.8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.numerics.equations.jacobian import Matrix, jacobian
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.null_space import dot
from lagcli.numerics.integrators.collocation import Collocation
from lagcli.numerics.integrators.linear import Factors

Vector = list[float]

_ROUNDS = 12
#: Changes of the state below this part of its scale are rounding.
_ROUNDING = 1e-15
_SLOW = 0.9


class NotSolved(ArithmeticError):
    """The stages do not converge: the step is too long."""


class Stages:
    """The stages of one method for one motion.

    Parameters
    ----------
    motion
        In doubles.
    method
        Its coefficients.
    """

    def __init__(self, motion: Motion, method: Collocation) -> None:
        self.motion, self.method, self.n = motion, method, motion.n
        self.evaluations = 0
        self._jacobian = jacobian(motion)
        self._blocks: tuple[Matrix, Matrix] = ([], [])
        self._h = math.nan
        self.factors: list[Factors] = []

    def linearize(self, t: float, q: Sequence[float], v: Sequence[float]) -> None:
        """Take the Jacobian here."""
        self._blocks = self._jacobian(t, *q, *v)
        self._h = math.nan
        self.evaluations += 1

    def factor(self, h: float) -> None:
        """The matrices of a step."""
        if h == self._h:
            return
        each, (by_q, by_v) = range(self.n), self._blocks
        self.factors = []
        for mu in self.method.eigenvalues:
            x = h * (mu if mu.imag else mu.real)
            matrix = [[(i == j) - x * by_v[i][j] - x * x * by_q[i][j] for j in each] for i in each]
            self.factors.append(Factors(matrix))
        self._h = h

    def filtered(self, h: float, at_q: Vector, at_v: Vector) -> Vector:
        """(I - h mu J)^-1 of a vector of the state, for the real mu."""
        x = h * self.method.eigenvalues[0].real
        by_q = self._blocks[0]
        right = [b + x * dot(row, at_q) for row, b in zip(by_q, at_v, strict=True)]
        found = self.factors[0].solve(right)
        return [a + x * b for a, b in zip(at_q, found, strict=True)] + found

    def solve(
        self,
        t: float,
        h: float,
        q: Sequence[float],
        v: Sequence[float],
        guess: list[Vector],
        scales: Sequence[float],
        precision: float,
    ) -> list[Vector]:
        """K of a step.

        Parameters
        ----------
        guess
            K, shape (s, n).
        scales
            Of positions and velocities.
        precision
            What the state at the end may still change by, in units of the scales.

        Raises
        ------
        NotSolved
            Where the iteration does not converge.
        ArithmeticError, ValueError
            Where a stage is not defined.
        """
        self.factor(h)
        method, n, s = self.method, self.n, self.method.size
        each, stages = range(n), range(s)
        k = [list(row) for row in guess]
        before = math.inf
        for _ in range(_ROUNDS):
            rest = []
            for i in stages:
                velocity, position = self._at(i, h, q, v, k)
                found = self.motion.accelerations(t + method.nodes[i] * h, *position, *velocity)
                rest.append([a - b for a, b in zip(found, k[i], strict=True)])
            self.evaluations += s
            change = [[0.0] * n for _ in stages]
            for row, column, factors in zip(
                method.to_modes, method.from_modes, self.factors, strict=True
            ):
                mode = [sum(row[i] * rest[i][j] for i in stages) for j in each]
                real = not any(x.imag for x in column)
                solved = factors.solve([x.real for x in mode] if real else mode)
                for i in stages:
                    weight = column[i]
                    for j in each:
                        change[i][j] += (weight * solved[j]).real
            size = 0.0
            for i in stages:
                for j in each:
                    k[i][j] += change[i][j]
                    moved = abs(h * change[i][j])
                    size = max(size, moved / scales[n + j], abs(h) * moved / scales[j])
            if not size < math.inf:
                raise NotSolved("the stages are not defined")
            rate = size / before if before < math.inf else 0.0
            if size <= _ROUNDING or (before < math.inf and rate < 1 and rate * size <= precision):
                return k
            if rate >= _SLOW:
                if size <= 100 * _ROUNDING:  # as good as doubles do
                    return k
                raise NotSolved("the stages do not converge")
            before = size
        raise NotSolved("the stages converge too slowly")

    def _at(
        self, i: int, h: float, q: Sequence[float], v: Sequence[float], k: list[Vector]
    ) -> tuple[Vector, Vector]:
        """Velocities and positions of a stage."""
        method = self.method
        first, second, c = method.a[i], method.a_squared[i], method.nodes[i] * h
        rates = list(zip(*k, strict=True))
        velocity = [x + h * dot(first, rates[j]) for j, x in enumerate(v)]
        position = [x + c * v[j] + h * h * dot(second, rates[j]) for j, x in enumerate(q)]
        return velocity, position

    def changes(self, h: float, v: Sequence[float], k: list[Vector]) -> Vector:
        """How much q and then v change over the step."""
        method, rates = self.method, list(zip(*k, strict=True))
        by_q = [h * (x + h * dot(method.weights_a, rate)) for x, rate in zip(v, rates, strict=True)]
        return by_q + [h * dot(method.weights, rate) for rate in rates]

    def velocities(self, h: float, q: Vector, v: Vector, k: list[Vector]) -> list[Vector]:
        """V of the stages, shape (s, n)."""
        return [self._at(i, h, q, v, k)[0] for i in range(self.method.size)]
