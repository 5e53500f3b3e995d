"""A problem and a request, ready to be run or proved: the model, and the state at t = 0."""

from __future__ import annotations

import math

from lagcli.numerics.certified.reduced_run import cut_setup
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal, reason_of
from lagcli.numerics.equations.start import initial_state
from lagcli.numerics.equations.surface import ROUNDING
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup, setup_of
from lagcli.numerics.integrators.dop853 import dop853
from lagcli.problem_data import Problem
from lagcli.record import replace


def ready_setup(problem: Problem, request: RunRequest) -> tuple[Setup, Modes]:
    """What is integrated, the model as it is or less of it, and its modes in doubles.

    Raises
    ------
    Refusal
        When values are missing, the initial state is off the constraints, or the accelerations
        are not determined there.
    """
    setup, arithmetic = setup_of(problem, request), Doubles()
    constants = constants_of(setup.equations, setup.all_nodes, arithmetic)
    modes = Modes(setup, constants, arithmetic, dop853, ROUNDING)
    start = initial_state(modes.first.motion, problem.initial, project=request.project)
    setup = replace(setup, start=start)
    modes = modes.of(setup)
    setup = _with_what_is_conserved(setup, modes)
    modes = modes.of(setup)
    reduced = None if request.whole else cut_setup(setup, modes)
    if reduced is not None:
        setup, modes = reduced, Modes(reduced, constants, arithmetic, dop853, ROUNDING)
    check_start(modes.first.motion, *setup.start)
    return setup, modes


def _with_what_is_conserved(setup: Setup, modes: Modes) -> Setup:
    """Without the candidates that are conserved in no mode."""
    if not setup.candidates:
        return setup
    kept = dict(zip(setup.charges, modes.first.conserved, strict=True))
    shown = {column.name for column in setup.request.columns}
    notes = tuple(
        f"{s.name} is shown without a gauge, since the file gives none: it is not conserved"
        for s in setup.problem.symmetries
        if s.gauge is None and s.name in shown and not kept.get(s.name, True)
    )
    if setup.goes_on:
        return replace(setup, notes=notes)
    return replace(
        setup,
        notes=notes,
        charges={name: node for name, node in setup.charges.items() if kept[name]},
        candidates=tuple(name for name in setup.candidates if kept[name]),
    )


def check_start(motion: Motion, q: list[float], v: list[float]) -> None:
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
