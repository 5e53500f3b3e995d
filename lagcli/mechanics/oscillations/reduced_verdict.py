"""The stability of rest by the reduced system: without solved constraints and cyclic coordinates.

References
----------
Routh, *Stability of a Given State of Motion*, chapter IV.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from sympy import Expr, S, Symbol

from lagcli.algebra.place import at, lies_in
from lagcli.algebra.positivity import is_positive
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.reduction.coinciding_axes import CoincidingAxes
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady import SteadyMotions
from lagcli.mechanics.reduction.steady_motion import Steady
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.rest_conditions import RestPoint
from lagcli.mechanics.stability.judge import judge
from lagcli.mechanics.stability.lagrange_dirichlet import by_derivatives, by_routh
from lagcli.mechanics.stability.near import Hypotheses
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
            axes = self._on_axes(fixed)
            if axes is not None:
                return by_routh(judge_on_axes(steady, axes))
            found = judge(Linearization(steady.rest, steady.point(Steady(fixed, None))))
        except ZeroDivisionError:
            return None
        if not self.cyclic:
            return None if found.is_open else found
        if found.minimum is None or found.neutral:
            return None
        cyclic = {self.dynamics.system.q[j] for j in steady.routh.cyclic}
        along = tuple(q for q in point.free if q in cyclic)
        return by_routh(replace(found, across=True, along=along or None))

    def _on_axes(self, fixed: Mapping[Symbol, Expr]) -> Steady | None:
        """The steady motion there at these momenta, where the axes of cyclic angles coincide."""
        assert self._steady is not None
        if not self.cyclic:
            return None
        for each in CoincidingAxes(self._steady.routh).motions():
            if lies_in(each.values, fixed):
                return replace(each, derivatives=tuple(at(d, fixed) for d in each.derivatives))
        return None


def judge_on_axes(steady: SteadyMotions, motion: Steady) -> Stability:
    """By the derivatives of U_eff, where the coordinates are singular."""
    [[mass]] = steady.dynamics.lagrange.mass_matrix
    definite = is_positive(at(mass, motion.values), motion.positive)
    hypotheses = Hypotheses(steady.rest.energy_never_grows, definite)
    return by_derivatives(motion.derivatives, hypotheses, motion.positive)
