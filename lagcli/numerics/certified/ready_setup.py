"""A problem and a request, ready to be run or proved: the model, and the state at t = 0."""

from __future__ import annotations

import math
from typing import Self

from lagcli.numerics.certified.reduced_run import cut_simulation
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal, reason_of
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.equations.surface import ROUNDING
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.dop853 import dop853


class ReadySetup(Setup):
    """A setup whose initial state is found and tried."""

    def ready(self) -> tuple[Self, Modes]:
        """What is integrated, this or less, in doubles; the initial state is found and tried."""
        arithmetic = Doubles()
        constants = constants_of(self.equations, self.all_nodes, arithmetic)
        modes = Modes(self, constants, arithmetic, dop853, ROUNDING)
        self.start = initial_state(modes.first.motion, project=self.request.project)
        self._keep_conserved(modes)
        reduced = None if self.request.whole else cut_simulation(self, modes, *self.start)
        if reduced is not None:
            modes = Modes(reduced, constants, arithmetic, dop853, ROUNDING)
        integrated = reduced or self
        self.check_start(modes.first.motion, *integrated.start)
        return integrated, modes

    def _keep_conserved(self, modes: Modes) -> None:
        """Leave out the candidates that are conserved in no mode."""
        if not self.candidates:
            return
        kept = dict(zip(self.charges, modes.first.conserved, strict=True))
        shown = {column.name for column in self.request.columns}
        self.notes = [
            f"{s.name} is shown without a gauge, since the file gives none: it is not conserved"
            for s in self.problem.symmetries
            if s.gauge is None and s.name in shown and not kept.get(s.name, True)
        ]
        if not self.goes_on:
            self.charges = {name: node for name, node in self.charges.items() if kept[name]}
            self.candidates = [name for name in self.candidates if kept[name]]
            del modes.first.conserved

    def check_start(self, motion: Motion, q: list[float], v: list[float]) -> None:
        """Whether anything moves at all: the accelerations at t = 0.

        Raises
        ------
        Refusal
            When they are not determined.
        """
        try:
            motion.set_signs(0.0, q, v)
            found = motion.accelerations(0.0, *q, *v)
            if all(math.isfinite(a) for a in found):
                return
            reason = "they are not finite"
        except (ArithmeticError, ValueError) as error:
            reason = reason_of(error)
        raise Refusal(f"at t = 0 the accelerations are not determined: {reason}", mistake=False)
