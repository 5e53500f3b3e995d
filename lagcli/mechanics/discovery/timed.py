"""First integrals of second degree in the velocities with explicit time.

    Q = sum_{i<=j} f_ij(t, q) p_i p_j + sum_j f_j(t, q) p_j + S(t, q)

beyond products of those of first degree: where coordinates separate, each has its own
dilation and conformal integral, while only their sum belongs to a point symmetry.

References
----------
Lewis, Riesenfeld, J. Math. Phys. 10 (1969) 1458; Lutzky, Phys. Lett. A 68 (1978) 3.
Katzin, Levine, J. Math. Phys. 18 (1977) 1267 (time-dependent quadratic integrals).
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.mechanics.discovery.ansatz import Kinds, TimeFunctions, quadratic
from lagcli.mechanics.discovery.boundary import gauge_of
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals, Slots
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.slots import Equations, point_slots
from lagcli.mechanics.noether import Noether, NoetherCharge

_MOST_UNKNOWNS = 600
_MOST_COORDINATES = 3


class TimedIntegrals(QuadraticIntegrals):
    """Those of equations M(q) q'' = forcing(t, q, q') in coordinates that are lengths."""

    def __init__(
        self,
        noether: Noether,
        equations: Equations,
        kinds: Kinds,
        times: TimeFunctions,
        allowed: Allowance,
    ) -> None:
        super().__init__(noether, equations, kinds, allowed)
        self.linear = point_slots(equations)[1:]
        self.times = times.others
        slots = len(self.pairs) + len(self.linear)
        self.functions = quadratic(kinds, _MOST_UNKNOWNS // (slots * len(self.times)))

    @staticmethod
    def applies(equations: Equations, kinds: Kinds, known: Sequence[NoetherCharge]) -> bool:
        """Whether there may be any: not where 2n integrals of first degree give them all."""
        n = len(equations.q)
        plain = [
            c for c in known
            if c.transformation.time == 0
            and not sympy.Tuple(*c.transformation.changes).free_symbols & {*equations.q,
                                                                         *equations.v}
        ]  # fmt: skip
        return 1 < n <= _MOST_COORDINATES and not kinds.angles and len(plain) < 2 * n

    def _scalar(self, _: Slots, eta: Sequence[Expr], moving: Expr, /) -> Expr | None:
        """S(t, q) with dS/dt = sum eta_j (d/dt dL/dq_j' - dL/dq_j) - d(moving)/dt."""
        system = self.noether.system
        left = self.noether.dynamics.lagrange.left_sides
        along = sympy.Add(*(x * e for x, e in zip(eta, left, strict=True)))
        change = simplify(along - system.total_derivative(moving))
        return gauge_of(change, system, self.allowed)
