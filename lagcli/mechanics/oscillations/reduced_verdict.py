"""The stability of rest by the reduced system: without solved constraints and cyclic coordinates.

References
----------
Routh, *Stability of a Given State of Motion*, chapter IV.
"""

from __future__ import annotations

from functools import cached_property

from sympy import S

from lagcli.algebra.place import at
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady import SteadyMotions
from lagcli.mechanics.reduction.steady_motion import Steady
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.mechanics.stability.judge import judge
from lagcli.mechanics.stability.lagrange_dirichlet import by_routh
from lagcli.mechanics.stability.verdict import Stability
from lagcli.record import replace


class ReducedVerdict:
    """Judges rest in the coordinates that are left, at the momenta that it has."""

    def __init__(self, dynamics: Dynamics, rest: RestPoints) -> None:
        self.dynamics, self.rest = dynamics, rest

    @cached_property
    def _steady(self) -> SteadyMotions | None:
        """The motions at constant momenta of cyclic coordinates, rest among them."""
        if self.rest.depends_on_time:
            return None
        routh = Routh(Derivation(self.dynamics.system.problem))
        if routh.reduced is None or routh.reduced.dynamics.constraints.equations:
            return None
        if not routh.cyclic and not self.dynamics.constraints.equations:
            return None
        return SteadyMotions(routh)

    @property
    def cyclic(self) -> bool:
        """Whether it is of U_eff, at constant momenta."""
        return self._steady is not None and bool(self._steady.routh.cyclic)

    def of(self, point: RestPoint) -> Stability | None:
        """The verdict on rest as a steady motion; None where that decides nothing."""
        steady, values = self._steady, point.values
        if steady is None or point.family is not None or point.depends_on_time(steady.system.t):
            return None
        still = dict.fromkeys(self.dynamics.system.qdot, S.Zero)
        full = steady.routh.full.dynamics.lagrange
        fixed = {q: values[q] for q in steady.system.q if q in values}
        for p, j in zip(steady.routh.momenta, steady.routh.cyclic, strict=True):
            fixed[p] = at(full.momenta[j].xreplace(still), values)
        try:
            found = judge(Linearization(steady.rest, steady.point(Steady(fixed, None))))
        except ZeroDivisionError:
            return None
        if not self.cyclic:
            return None if found.is_open else found
        return by_routh(replace(found, across=True)) if found.minimum is not None else None
