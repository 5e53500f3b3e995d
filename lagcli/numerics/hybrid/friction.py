"""Dry friction that sticks: a sign(s) whose s(q, q') stays at 0 takes what holds it there.

Where both branches of sign(s) drive s back to 0, the motion goes on with s' = 0 and a value
sigma between -1 and 1 in place of the sign (Filippov's sliding mode, Coulomb's static
friction with the coefficient of the sliding one):

    s'(sigma) = 0,   linear in sigma;       it slips where |sigma| reaches 1.

References
----------
Filippov, *Differential Equations with Discontinuous Righthand Sides* (1988), section 4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Symbol
from lagcli.numerics.equations.arithmetic import Arithmetic
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Function, Motion
from lagcli.numerics.equations.null_space import NoMass, held_motion, solved

#: How far from linear in sigma the rates may be, relative to their size.
_LINEAR = 1e-9


class NotLinear(ArithmeticError):
    """The signs that stick multiply each other."""


class StuckMotion(Motion):
    """The motion while some arguments of sign stay at 0.

    Parameters
    ----------
    equations, constants, arithmetic, signs
        As for `Motion`.
    stuck
        The kinks that are held.
    """

    def __init__(
        self,
        equations: EquationsOfMotion,
        constants: Mapping[Symbol, Any],
        arithmetic: Arithmetic,
        signs: list[float],
        stuck: frozenset[int],
    ) -> None:
        super().__init__(equations, constants, arithmetic, signs)
        self.stuck = tuple(sorted(stuck))

    @cached_property
    def accelerations(self) -> Function:
        """q'' with the friction that holds."""
        free = self._free

        def held(*state: float) -> tuple[Any, ...]:
            self._hold(free, state)
            return free(*state)

        return held

    @cached_property
    def _free(self) -> Function:
        """q'' with the signs as they are."""
        return Motion(self.equations, self.constants, self.arithmetic, self.signs).accelerations

    @cached_property
    def accelerations_and_multipliers(self) -> Function:
        """The same with the multipliers."""
        both = super().accelerations_and_multipliers
        free = self._free

        def held(*state: float) -> tuple[Any, ...]:
            self._hold(free, state)
            return both(*state)

        return held

    def friction(self, *state: float) -> list[float]:
        """Sigma of each that sticks."""
        self._hold(self._free, state)
        return [self.signs[k] for k in self.stuck]

    def _hold(self, free: Function, state: Sequence[float]) -> None:
        """Set the signs that stick to what makes s' = 0."""

        def rates() -> list[float]:
            found = self.kink_rates(*state, *free(*state))
            return [found[k] for k in self.stuck]

        for k in self.stuck:
            self.signs[k] = 0.0
        level = rates()
        columns = []
        for k in self.stuck:
            self.signs[k] = 1.0
            columns.append([x - y for x, y in zip(rates(), level, strict=True)])
            self.signs[k] = 0.0
        matrix = [list(row) for row in zip(*columns, strict=True)]
        try:
            sigma = solved(matrix, [-x for x in level])
        except NoMass:
            sigma = [2.0 if x > 0 else -2.0 for x in level]  # nothing holds it: it slips
        for k, value in zip(self.stuck, sigma, strict=True):
            self.signs[k] = value
        if len(self.stuck) > 1 and self.arithmetic.ordered:
            size = max(map(abs, level), default=0.0)
            if max(map(abs, rates())) > _LINEAR * (size or 1.0):
                raise NotLinear("forces that stick depend on each other")


def stopped(
    motion: Motion, which: Sequence[int], t: float, q: Sequence[float], v: Sequence[float]
) -> list[float]:
    """The velocities with s = 0 for some kinks, the nearest ones in the metric M."""
    e = motion.equations
    nodes = [motion.kinks[k] for k in which]
    slopes = [partial(e.graph, u)(node) for node in nodes for u in e.qdot]
    n, found = motion.n, motion.function([*slopes, *nodes])(t, *q, *v)
    mass, _, held, _ = motion.system(t, *q, *v)
    rows = [list(found[i * n : (i + 1) * n]) for i in range(len(which))]
    lacking = [*found[len(which) * n :], *([0.0] * motion.m)]
    jump = held_motion(mass, [0.0] * n, [*rows, *held], lacking)
    return [x + d for x, d in zip(v, jump.accelerations, strict=True)]
