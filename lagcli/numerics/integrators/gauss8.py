"""Gauss-Legendre of order 8: implicit, symplectic, symmetric, A-stable; steps of one length.

Four stages, solved to rounding with exact Jacobians.  Keeps quadratic charges, and the energy
for times that grow exponentially with 1/h, where an explicit method's error grows with t^2.

References
----------
Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., sections II.1.3, VI.4.1
and VIII.6 (implementation).
"""

from __future__ import annotations

from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.collocation import gauss
from lagcli.numerics.integrators.fixed_step import FixedStep, Vector
from lagcli.numerics.integrators.implicit import Stages
from lagcli.numerics.integrators.steps import Method, MotionOfMode

_STAGES = 4
#: The stages are solved until nothing changes.
_PRECISION = 1e-16


class Gauss8(FixedStep):
    """The steps of one run; see `FixedStep`."""

    name = "gauss8"
    order = 2 * _STAGES

    def __init__(
        self, surface: Surface | None, stages: Stages, pilots: list[tuple[float, float]]
    ) -> None:
        super().__init__(stages.motion, surface, pilots)
        self._stages = stages

    def change(self, t: float, h: float, q: Vector, v: Vector) -> Vector:
        """One step."""
        stages, before = self._stages, self._stages.evaluations
        rate = list(self.motion.accelerations(t, *q, *v))
        stages.linearize(t, q, v)
        n = self.n
        scales = [max(abs(x), abs(h * u), 1e-300) for x, u in zip(q, v, strict=True)] + [
            max(abs(u), abs(h * a), 1e-300) for u, a in zip(v, rate, strict=True)
        ]
        top = max(scales[n:])
        scales[n:] = [max(s, 1e-3 * top) for s in scales[n:]]
        scales[:n] = [max(s, abs(h) * u) for s, u in zip(scales[:n], scales[n:], strict=True)]
        guess = [list(rate) for _ in range(_STAGES)]
        k = stages.solve(t, h, q, v, guess, scales, _PRECISION)
        self.evaluations += 1 + stages.evaluations - before
        return stages.changes(h, v, k)


def gauss8(mode: MotionOfMode, surface: Surface | None) -> Method:
    """The method of a mode."""
    if mode.generated is None:
        mode.generated = Stages(mode.motion, gauss(_STAGES)), []
    return Gauss8(surface, *mode.generated)
