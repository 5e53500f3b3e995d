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
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.ansatz import TimeFunctions
from lagcli.mechanics.discovery.boundary import gauge_of
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals, Slots
from lagcli.mechanics.discovery.isometries import Isometries
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.relation import with_gradient
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.noether import Noether, NoetherCharge

_MOST_UNKNOWNS = 900
_MOST_COORDINATES = 3  # measured: up to 4
_MOST_CANDIDATES = 400
_WAVES = (sympy.sin, sympy.cos, sympy.exp)


class TimedIntegrals(QuadraticIntegrals):
    """Those of equations M(q) q'' = forcing(t, q, q'), of a flat T or in lengths."""

    def __init__(
        self,
        noether: Noether,
        equations: SlotEquations,
        kinds: Kinds,
        times: TimeFunctions,
        flat: Isometries | None,
        allowed: Allowance,
    ) -> None:
        super().__init__(noether, equations, kinds, allowed, flat)
        self.times = times.others
        self.linear = self.shifts
        slots = len(self.pairs) + len(self.linear)
        self.functions = self.spaces(kinds, _MOST_UNKNOWNS // (slots * len(self.times)))

    @staticmethod
    def apply(equations: SlotEquations, known: Sequence[NoetherCharge]) -> bool:
        """Whether there may be any: not where 2n integrals of first degree give them all."""
        n = len(equations.q)
        moving = (*equations.q, *equations.v)
        plain = [c for c in known if c.transformation.displaces_without(moving)]
        return 1 < n <= _MOST_COORDINATES and len(plain) < 2 * n

    def _scalar(self, functions: Slots, eta: Sequence[Expr], moving: Expr, /) -> Expr | None:
        """S(t, q) with dS/dt = sum eta_j (d/dt dL/dq_j' - dL/dq_j) - d(moving)/dt."""
        found = self._of_given_shape(functions, eta)
        if found is not None:
            return found
        system = self.noether.system
        along = dot(eta, self.noether.dynamics.lagrange.left_sides)
        change = simplify(along - system.total_derivative(moving))
        return gauge_of(change, system, self.allowed)

    def _of_given_shape(self, functions: Slots, eta: Sequence[Expr]) -> Expr | None:
        """S as a sum of T(t) s(q), each s a term of L times a function of the coordinates."""
        t, q = self.equations.t, self.equations.q
        spaces = [*self._candidates(functions), sympy.S.One]
        candidates = [T * s for T in self._times_of(functions) for s in spaces]
        if len(candidates) > _MOST_CANDIDATES:
            return None
        gradient, rate = self._slopes(eta)
        return with_gradient([rate, *gradient], candidates, (t, *q), self.allowed)

    def _times_of(self, functions: Slots) -> list[Expr]:
        """The functions of time of an integral, and those with the same arguments."""
        waves = {w for _, f in functions for w in _waves(f, self.equations.t)}
        inside = {w.args[0] for w in waves}
        return [T for T in self.times if {w.args[0] for w in _waves(T, self.equations.t)} <= inside]


def _waves(expression: Expr, t: Symbol) -> set[Expr]:
    return {w for w in expression.atoms(*_WAVES) if t in w.free_symbols}
