"""Yoshida's method of order 8: explicit, symplectic, symmetric; steps of one length.

For q'' = a(t, q): a composition of 15 leapfrog steps, one evaluation each, whose lengths
gamma_i h cancel the errors of order 2, 4 and 6.

References
----------
Yoshida, "Construction of higher order symplectic integrators", Phys. Lett. A 150 (1990).
Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., section V.3.2, equation
(3.11): the coefficients, of Suzuki and Umeno.
"""

from __future__ import annotations

from lagcli.graph.nodes import mask_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.fixed_step import FixedStep, Vector
from lagcli.numerics.integrators.steps import Method, MotionOfMode

_HALF = (
    0.74167036435061295344822780,
    -0.40910082580003159399730010,
    0.19075471029623837995387626,
    -0.57386247111608226665638773,
    0.29906418130365592384446354,
    0.33462491824529818378495798,
    0.31529309239676659663205666,
)
_LENGTHS = (*_HALF, 1 - 2 * sum(_HALF), *reversed(_HALF))


class Yoshida8(FixedStep):
    """The steps of one run; see `FixedStep`."""

    name = "yoshida8"
    order = 8

    def change(self, t: float, h: float, q: Vector, v: Vector) -> Vector:
        """One step: drift, kick, drift for each length."""
        n = self.n
        moved_q, moved_v = [0.0] * n, [0.0] * n
        for gamma in _LENGTHS:
            d = gamma * h
            half = d / 2
            moved_q = [x + half * (u + w) for x, u, w in zip(moved_q, v, moved_v, strict=True)]
            t += half
            places = [x + y for x, y in zip(q, moved_q, strict=True)]
            kick = self.motion.accelerations(t, *places, *v)
            moved_v = [w + d * a for w, a in zip(moved_v, kick, strict=True)]
            moved_q = [x + half * (u + w) for x, u, w in zip(moved_q, v, moved_v, strict=True)]
            t += half
        self.evaluations += len(_LENGTHS)
        return [*moved_q, *moved_v]


def separates(equations: EquationsOfMotion) -> bool:
    """Whether q'' is a function of t and q: M constant, no force of q', no constraint."""
    mass = mask_of(entry for row in equations.mass for entry in row)
    return (
        not equations.rows
        and not mass & mask_of(equations.state)
        and not mask_of(equations.forcing) & mask_of(equations.qdot)
    )


def yoshida8(mode: MotionOfMode, surface: Surface | None) -> Method:
    """The method of a mode."""
    if mode.generated is None:
        mode.generated = []
    return Yoshida8(mode.motion, surface, mode.generated)
