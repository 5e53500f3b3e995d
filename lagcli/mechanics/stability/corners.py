"""Stability of one coordinate where V has a corner: |x| |1 - |x|| and x |x| have some.

To each side of it V is smooth there, once the sign of what stands within each modulus is put in;
the first derivative that is not 0 says whether V grows or falls to that side.
"""

from __future__ import annotations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of
from lagcli.mechanics.stability.lagrange_dirichlet import DECREASES, at_strict_minimum
from lagcli.mechanics.stability.near import Near
from lagcli.mechanics.stability.verdict import Stability, unstable

#: Derivatives that are looked at.
_MOST = 6


def by_both_sides(near: Near) -> Stability | None:
    """The verdict by V on both sides; None where it is not known, or coordinates are several."""
    system, linear = near.linear.system, near.linear
    if len(system.q) != 1 or linear.dynamics.constraints.equations or near.hypotheses.lacking:
        return None
    side = BesidePlace(near)
    V = -system.L.xreplace(dict.fromkeys(system.qdot, S.Zero))
    signs = [side.sign(V - at(V, near.linear.point.values), direction) for direction in (1, -1)]
    if -1 in signs:
        return unstable(DECREASES)
    return at_strict_minimum(near) if signs == [1, 1] else None


class BesidePlace:
    """Functions of one coordinate just beside an equilibrium."""

    def __init__(self, near: Near) -> None:
        self.place, self.positive = near.linear.point.values, near.positive
        self.q: Symbol = near.linear.system.q[0]

    def sign(self, f: Expr, direction: int) -> int | None:
        """The sign of f there: that of its first derivative that is not 0; None: not known."""
        smooth = self._smooth(f, direction)
        if smooth is None:
            return None
        for order in range(_MOST):
            known = sign_of(simplify(at(smooth.diff(self.q, order), self.place)), self.positive)
            if known != 0:
                return None if known is None else known * direction**order
        return None

    def _smooth(self, f: Expr, direction: int) -> Expr | None:
        """The function with u or -u for |u|, the innermost first."""
        while bent := f.atoms(sympy.Abs, sympy.sign):
            node = min(bent, key=sympy.count_ops)
            known = self.sign(node.args[0], direction)
            if known is None:
                return None
            f = f.xreplace({node: known * node.args[0] if node.func is sympy.Abs else known})
        return f
