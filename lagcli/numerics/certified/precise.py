"""The same motion with more digits than doubles have."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

from lagcli.numerics.certified.prepared import Prepared, RunOrder
from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import refined_state
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.modes import Mode, Modes
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.hybrid.transitions import Transitions
from lagcli.numerics.integrators.steps import Method
from lagcli.numerics.integrators.taylor import Taylor

_DIGITS = 30
_GUARD_BITS = 40
_LONGEST = (10.0,)  # a part of the span: a series knows what lies within its step
#: Steps of one run, when nobody has requested for more digits and when somebody has.
_UNASKED, _ASKED = 20_000, 500_000


@contextmanager
def precision(digits: int) -> Iterator[None]:
    """Arithmetic with these digits, and some more for rounding."""
    from flint import ctx

    with ctx.workprec(math.ceil(digits * math.log2(10)) + _GUARD_BITS):
        yield


def prepared(setup: Setup, doubles: Modes, digits: int | None = None) -> Prepared | str:
    """Power series with this number of digits made ready, or why only doubles can do it.

    Parameters
    ----------
    setup, doubles
        The request, and the modes in doubles.
    digits
        The requested ones, or 30, without it.
    """
    equations, request = setup.equations, setup.request
    given = setup.problem.initial
    if equations.kinks:
        return "abs and sign have no power series"
    if setup.goes_on:
        return "contacts that close or are released are followed in doubles only"
    limit = _UNASKED if request.digits is None and digits is None else _ASKED
    carried = digits or request.digits or _DIGITS
    rounding = 10.0**-carried
    try:
        with precision(carried):
            arithmetic = Balls()
            constants = constants_of(equations, setup.all_nodes, arithmetic)
            modes = Modes(setup, constants, arithmetic, _taylor, rounding)
            modes.first.conserved = doubles.first.conserved
            surface = modes.first.surface()
            state = refined_state(
                modes.first.motion, surface, *setup.start, {} if request.project else given
            )
    except Refusal as refusal:
        return str(refusal)

    def run(order: RunOrder) -> Run:
        # nothing is probed or moved: nothing lies between its stages, and its rounding is its own
        transitions = Transitions(modes, request.accuracy, request.until)
        made = Run(transitions, order.bound, request.accuracy)
        made.step_limit = min(limit, order.most or limit)
        return made.go(*state, order.times, progress=order.progress)

    return Prepared(
        run=run,
        finest=rounding,
        longest=_LONGEST,
        floor=math.sqrt(rounding),
        precision=lambda: precision(carried),
    )


def _taylor(mode: Mode, surface: Surface | None) -> Method:
    return Taylor(mode.motion, surface)
