"""The same motion with more digits than doubles have."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lagcli.numerics.accuracy import Controller, Outcome
from lagcli.numerics.arithmetic import Balls
from lagcli.numerics.constants import constants_of
from lagcli.numerics.modes import Mode, Modes
from lagcli.numerics.refusal import Refusal
from lagcli.numerics.run import Run
from lagcli.numerics.start import refined_state
from lagcli.numerics.steps import Method, Tolerance
from lagcli.numerics.surface import Surface
from lagcli.numerics.taylor import Taylor
from lagcli.numerics.transitions import Transitions

if TYPE_CHECKING:
    from lagcli.numerics.simulate import Simulation

_GUARD_BITS = 40
_LONGEST = (10.0,)  # a part of the span: a series knows what lies within its step
#: Steps of one run, when nobody has asked for more digits and when somebody has.
_UNASKED, _ASKED = 20_000, 500_000


def precise_outcome(
    simulation: Simulation, doubles: Modes, q: Sequence[float], v: Sequence[float], digits: int
) -> Outcome | None:
    """The outcome with up to so many digits; None where only doubles can do it."""
    from flint import ctx

    equations, asked = simulation.equations, simulation.asked
    if equations.kinks:
        return None
    usual = ctx.prec
    ctx.prec = math.ceil(digits * math.log2(10)) + _GUARD_BITS
    try:
        arithmetic = Balls()
        constants = constants_of(equations, simulation.all_nodes, arithmetic)
        rounding = 10.0**-digits
        modes = Modes(simulation, constants, arithmetic, _taylor, rounding)
        modes.first.conserved = doubles.first.conserved
        motion = modes.first.motion
        exact_q, exact_v = refined_state(
            motion, modes.first.surface(), q, v, anew=not asked.project
        )
        limit = _UNASKED if asked.digits is None else _ASKED

        def runner(tolerance: float, longest: float, peaks: Sequence[float] | None, _: int) -> Run:
            bound = Tolerance(tolerance, motion.n, asked.until, longest, peaks, math.sqrt(rounding))
            run = Run(Transitions(modes, asked.accuracy, asked.until), bound, asked.accuracy)
            run.step_limit = limit
            return run.go(exact_q, exact_v, simulation.times, progress=simulation.progress)

        return Controller(
            runner,
            accuracy=asked.accuracy,
            finest=rounding,
            span=asked.until,
            charges=len(simulation.charges),
            longest=_LONGEST,
        ).outcome()
    except Refusal:
        return None
    finally:
        ctx.prec = usual


def _taylor(mode: Mode, surface: Surface | None) -> Method:
    return Taylor(mode.motion, surface)
