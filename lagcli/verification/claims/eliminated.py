"""States of a system some coordinates of which were eliminated by constraints.

With x_e = f(q_c) the momentum of a coordinate that is kept is that of the reduced Lagrangian,

    p_c + sum_e p_e dx_e'/dq_c',        A_e (dx_e'/dq_c') = -A_c,

where A_e and A_c are the columns of the constraints' gradients.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from flint import arb

from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import Unclear, dot, solve
from lagcli.verification.reference import DynamicsAtState
from lagcli.verification.states import State


class EliminatedFormula(Examination):
    """An examination at states with the momenta of the reduced Lagrangian."""

    def __init__(self, x: Examination, names: Collection[str]) -> None:
        super().__init__(x.problem, x.reference)
        self.retracted, self.unchecked = x.retracted, x.unchecked
        self._gone = [j for j, name in enumerate(x.reference.names) if name in names]
        self._changed: set[int] = set()

    def states(self, count: int = 0, bits: int = PRECISIONS[0]) -> list[State]:
        """As always, the momenta changed."""
        found = super().states(count, bits)
        for state in found:
            if id(state) not in self._changed:
                self._changed.add(id(state))
                self._change(state)
        return found

    def _change(self, state: State) -> None:
        state.laws.__dict__["momenta"] = reduced_momenta(state.laws, self._gone)
        state.__dict__.pop("following", None)


def reduced_momenta(laws: DynamicsAtState, gone: Sequence[int]) -> list[arb]:
    """The momenta of the reduced Lagrangian, 0 for the coordinates that are gone."""
    p = list(laws.momenta)
    rows = [[row[e] for e in gone] for row in laws.jacobian]
    for c in set(range(len(p))) - {*gone}:
        try:
            growth = solve(rows, [-row[c] for row in laws.jacobian], len(gone))
        except Unclear:
            continue
        if growth.consistent:
            p[c] = p[c] + dot([p[e] for e in gone], growth.x)
    return [arb(0) if j in gone else x for j, x in enumerate(p)]
