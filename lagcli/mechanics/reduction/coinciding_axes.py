"""Steady motions where the coordinates are singular: the axes of two rotations coincide.

An upright top, a pendulum that hangs.  There the mass matrix of the cyclic coordinates has null
vectors v with v p = 0, and with these momenta U_eff is regular.
"""

from __future__ import annotations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.equations import solve_for
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import at
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady_motion import Steady

_HIGHEST = 4  # derivative of U_eff at a singular place


class CoincidingAxes:
    """The steady motions at the singular places of a reduced system.

    Attributes
    ----------
    complete
        Whether there can be no other such place.
    """

    def __init__(self, routh: Routh) -> None:
        assert routh.reduced is not None
        self.routh = routh
        self.q = routh.reduced.system.q
        self.complete = True

    def motions(self) -> list[Steady]:
        """Those of a single coordinate, each once."""
        mass, q = self.routh.full.dynamics.lagrange.mass_matrix, self.q[0]
        if len(self.q) != 1:
            whole = determinant(mass)
            self.complete &= whole is not None and not self._vanishes_somewhere(whole)
            return []
        block = [[simplify(mass[i][j]) for j in self.routh.cyclic] for i in self.routh.cyclic]
        whole = determinant(block)
        if whole is None or free_of(whole, [q]):
            return []
        found = []
        for factor, power in factors_of(whole):
            roots = solve_for(factor, q) if power > 0 and not free_of(factor, [q]) else None
            for root in roots.values if roots is not None else ():
                if not root.free_symbols and not (q.is_nonzero and root == 0):
                    found += self._regularized(q, root, block)
        return list({tuple(each.values.items()): each for each in found}.values())

    def _vanishes_somewhere(self, expression: Expr) -> bool:
        """Whether a factor of it may be 0 at some values of the coordinates."""
        return any(
            power > 0 and sign(factor) not in (1, -1) and not free_of(factor, self.q)
            for factor, power in factors_of(simplify(expression))
        )

    def _regularized(self, q: Symbol, place: Expr, block: list[list[Expr]]) -> list[Steady]:
        momenta = self.routh.momenta
        there = [[at(entry, {q: place}) for entry in row] for row in block]
        if any(entry.has(sympy.zoo, sympy.nan) for row in there for entry in row):
            return []
        rows = nullspace(there)
        conditions = [dot(row, momenta) for row in rows]
        solved = solve_system(conditions, momenta)
        if len(solved.solutions) != 1 or not solved.complete:
            return []
        [solution] = solved.solutions
        half = Symbol("#half", real=True)
        potential = self.routh.effective_potential.xreplace(dict(solution.values))
        try:
            near = simplify(potential.subs(q, place + 2 * half))
            slope, *bends = (
                simplify(at(near.diff(half, k), {half: S.Zero}) / 2**k)
                for k in range(1, _HIGHEST + 1)
            )
        except ZeroDivisionError:
            return []
        if is_zero(slope) is not True or any(b.has(sympy.zoo, sympy.nan) for b in bends):
            return []
        return [Steady({q: place, **solution.values}, None, derivatives=tuple(bends))]

    @property
    def singular_where(self) -> tuple[Expr, ...]:
        """What vanishes where the coordinates are singular: factors of det M."""
        whole = determinant(self.routh.full.dynamics.lagrange.mass_matrix_at_rest)
        factors = sympy.Mul.make_args(S.One if whole is None else whole)
        bases = [f.base if isinstance(f, sympy.Pow) else f for f in factors]
        return tuple(f for f in bases if isinstance(f, (sympy.sin, sympy.cos)))
