"""The motion in numbers: q'' and the multipliers that the equations give at random states.

Where the motion is too long to be written in formulas, it still decides whether a quantity
changes: [[M, -A^T], [A, 0]] (q'', lambda) = (forcing, -bias) is solved at each state.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import mpmath
from mpmath import mpf
from sympy import Symbol

from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.row_rank import rows_of
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.euler_lagrange import EulerLagrange
from lagcli.mechanics.states import State


class MotionAtStates:
    """Adds q'' and multipliers to states on the constraints.

    Parameters
    ----------
    lagrange
        M and the forcing.
    rows
        The independent constraints; the multipliers of the others are 0.
    """

    def __init__(self, lagrange: EulerLagrange, rows: Sequence[ConstraintEquation]) -> None:
        system = lagrange.system
        self._shape = len(system.q), len(rows)
        self._unknowns: list[Symbol] = [*system.qddot, *(e.multiplier for e in rows)]
        self._others = [m for m in system.multipliers if m not in self._unknowns]
        entries = [x for line in lagrange.mass_matrix for x in line]
        entries += [x for e in rows for x in e.row]
        self._matrices = Evaluator(entries, DIGITS + 10)
        self._right = Evaluator([*lagrange.forcing, *(-e.bias for e in rows)], DIGITS + 10)

    def along(self, states: Iterator[State]) -> Iterator[State]:
        """Those states at which the equations determine q'' and the multipliers, with them."""
        for state in states:
            with mpmath.workdps(DIGITS + 10):
                try:
                    solved = mpmath.lu_solve(mpmath.matrix(self.rows(state)), self._right(state))
                except (ArithmeticError, ValueError):
                    continue
            found = dict(zip(self._unknowns, solved, strict=True))
            yield {**state, **dict.fromkeys(self._others, mpf(0)), **found}

    def rows(self, state: State) -> list[list[mpf]]:
        """[[M, -A^T], [A, 0]]."""
        n, m = self._shape
        values = self._matrices(state)
        M, A = rows_of(values[: n * n], n), rows_of(values[n * n :], n)
        above = [[*row, *(-a[i] for a in A)] for i, row in enumerate(M)]
        return [*above, *([*a, *([mpf(0)] * m)] for a in A)]
