"""Radau IIA of order 5: implicit, for stiff problems.

Three stages, L-stable, so that what dies away quickly bounds no step; the error is estimated
by an embedded formula of order 3, filtered so that it does not see what is stiff.  The local
tolerance of a method whose estimate is of a lower order than itself is 0.1 tol^(2/3).
Jacobians are exact.  The motion inside a step is that of a shorter step from its beginning:
of order 5 as the steps are, where the collocation polynomial has order 3.

References
----------
Hairer, Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., section IV.8 (RADAU5).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.collocation import radau
from lagcli.numerics.integrators.controlled import Controlled, State, Trial, Vector
from lagcli.numerics.integrators.implicit import Stages
from lagcli.numerics.integrators.steps import Inside, Method, MotionOfMode, moved

ORDER = 5
_STAGES = 3
_ESTIMATE = 4  # the power of h in the error that is estimated
_FIRST = 1e-6  # of the longest step, for the first
_NEWTON = 1e-3  # of the tolerance


class Radau5(Controlled):
    """The steps of one run.

    Parameters
    ----------
    motion
        In doubles, without abs and sign.
    surface
        The constraints, or None.
    stages
        Those made for the same motion before.
    """

    name, power, first = "radau5", _ESTIMATE, _FIRST

    def __init__(self, motion: Motion, surface: Surface | None, stages: Stages) -> None:
        self._stages = stages
        self._before = stages.evaluations
        super().__init__(motion, surface)
        method = stages.method
        self._gamma = method.eigenvalues[0].real
        self._embedded = [
            a - b for a, b in zip(_embedded(self._gamma), method.weights, strict=True)
        ]

    @property
    def evaluations(self) -> int:
        """Of the accelerations; a Jacobian counts as one."""
        return self._stages.evaluations - self._before + self.calls

    def begin(self) -> None:
        """Nothing has been tried."""
        self._guess: list[Vector] | None = None
        self._fresh = True

    def tried(self, t: float, h: float, state: State) -> Trial:
        """A step."""
        (q, v, rate), stages, tolerance = state, self._stages, self.tolerance
        allowed = max(0.1 * tolerance.value ** (2 / 3), 1e-14)
        guess, self._guess = self._guess or [list(rate) for _ in range(_STAGES)], None
        if self._fresh:
            stages.linearize(t, q, v)
            self._fresh = False
        k = stages.solve(t, h, q, v, guess, tolerance.scales, _NEWTON * allowed)
        change = stages.changes(h, v, k)
        tolerance.see(q, v, change)
        error = self._error(t, h, state, k) / allowed
        if not error <= 1:
            return Trial(error)
        end_q, end_v = moved(q, v, change)
        if self.surface is not None:
            end_q, end_v = self.surface.project(t + h, end_q, end_v)
        return Trial(error, (end_q, end_v, self.rate(t + h, end_q, end_v)), kept=k)

    def accepted(self, trial: Trial, ratio: float) -> None:
        """Keep the stages that the polynomial of the last step foretells."""
        method = self._stages.method
        self._guess = [method.interpolated(1 + c * ratio, trial.kept) for c in method.nodes]
        self._fresh = True

    def _error(self, t: float, h: float, state: State, k: list[Vector]) -> float:
        """(I - h g J)^-1 (g h f0 + h sum e_i f_i) in units of the scales."""
        q, v, rate = state
        stages, g = self._stages, self._gamma
        velocities = stages.velocities(h, q, v, k)

        def combined(first: Sequence[float], others: list[Vector]) -> Vector:
            return [
                h * (g * x + sum(e * row[j] for e, row in zip(self._embedded, others, strict=True)))
                for j, x in enumerate(first)
            ]

        def size(parts: Vector) -> float:
            scaled = zip(parts, self.tolerance.scales, strict=True)
            return math.sqrt(sum((x / scale) ** 2 for x, scale in scaled) / (2 * self.n))

        found = stages.filtered(h, combined(v, velocities), combined(rate, k))
        error = size(found)
        if self.size.is_shortened and error > 0.0:
            # what is stiff and still there is filtered once more
            moved_q, moved_v = moved(q, v, found)
            other = self.rate(t, moved_q, moved_v)
            found = stages.filtered(h, combined(moved_v, velocities), combined(other, k))
            error = min(error, size(found))
        return error

    def inside(self, t: float, h: float, state: State, trial: Trial) -> Inside:
        """A shorter step from the same beginning; the slope is that of the polynomial."""
        (q, v, _), k = state, trial.kept
        scales = list(self.tolerance.scales)
        precision = 1e-3 * _NEWTON * self.tolerance.value

        def at(time: float) -> tuple[Vector, Vector, Vector]:
            stages, short = self._stages, time - t
            method = stages.method
            x = short / h
            slope = method.interpolated(x, k)
            guess = [method.interpolated(c * x, k) for c in method.nodes]
            stages.linearize(t, q, v)
            found = stages.solve(t, short, q, v, guess, scales, precision) if short else guess
            return *moved(q, v, stages.changes(short, v, found)), slope

        return at


def _embedded(gamma: float) -> list[float]:
    """b^ with gamma f(0) + sum b^_i f(c_i) exact for polynomials of degree 2."""
    from lagcli.numerics.integrators.linear import Factors

    nodes = radau(_STAGES).nodes
    matrix = [[c**k for c in nodes] for k in range(_STAGES)]
    found: Vector = Factors(matrix).solve([1 - gamma, 1 / 2, 1 / 3])
    return found


def radau5(mode: MotionOfMode, surface: Surface | None) -> Method:
    """The method of a mode."""
    if mode.generated is None:
        mode.generated = Stages(mode.motion, radau(_STAGES))
    return Radau5(mode.motion, surface, mode.generated)
