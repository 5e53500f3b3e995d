"""Where constraints become dependent on the way, two branches of the motion may meet.

A linkage that is flat can go on in two ways.  The equations know which one only beyond the
place: next to it, rounding may turn the velocity from one branch to the other, and two runs
in the same numbers turn alike.  A length that differs by 1e-15 turns it, too, in a bend so sharp
that steps of a usual tolerance pass over it.  So a run that has passed such a place must agree
with one of more digits and finer steps; where it does not, that one is taken, and without one
the rows end before it.

The pivots of A M^-1 A^T vanish there as the square of the distance: between two rows where
their root, drawn on as a straight line, meets 0.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., section 4.2 (pivots of L D L^T).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.attempts import attempt
from lagcli.numerics.certified.methods import METHODS, MORE_DIGITS, SHARP, SHARPER
from lagcli.numerics.certified.prepared import Precision, one_run
from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Mode, Modes
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import NotPossible, component_scales
from lagcli.record import replace

#: Rows after those that are good which are looked at: there the accuracy may have been lost.
_BEYOND = 2


def on_one_branch(
    simulation: Setup, modes: Modes, outcome: Outcome, digits: Precision
) -> tuple[Outcome, Precision]:
    """The outcome where it is certain to be on one branch, or what is left of it.

    Parameters
    ----------
    simulation, modes
        What is asked, and the modes in doubles.
    outcome, digits
        What a method gave, and its precision.
    """
    if _is_sharp(outcome):
        return outcome, digits
    with digits():
        place = meeting(outcome)
    if place is None:
        return outcome, digits
    if _is_confirmed(simulation, modes, outcome):
        return outcome, digits
    found, with_digits = attempt(simulation, SHARPER, modes, SHARP)
    if found is not None and found.good_rows > min(place + 1, outcome.good_rows):
        return found, with_digits
    if place + 1 >= outcome.good_rows:
        return outcome, digits
    reason = (
        f"the constraints become dependent after t = {outcome.run.marks[place].t:.6g}, and on "
        "which branch it goes on is within rounding"
    )
    return replace(outcome, reached=False, good_rows=place + 1, reason=reason), digits


def through_meeting(
    simulation: Setup, modes: Modes, outcome: Outcome, digits: Precision
) -> tuple[Outcome, Precision]:
    """More digits where what is lost is lost at such a place, if they hold for longer.

    Parameters
    ----------
    simulation, modes, outcome, digits
        As for `on_one_branch`.
    """
    if _is_sharp(outcome, (MORE_DIGITS,)) or simulation.asked.method != "auto":
        return outcome, digits
    with digits():
        place = meeting(outcome)
    if place is not None:
        found, with_digits = attempt(simulation, SHARPER, modes, SHARP)
        if found is not None and found.good_rows > outcome.good_rows:
            return found, with_digits
    return outcome, digits


def _is_sharp(outcome: Outcome, names: Sequence[str] = SHARPER) -> bool:
    return outcome.run.method_name in names and outcome.tolerances[0] <= SHARP


def meeting(outcome: Outcome) -> int | None:
    """The row before the first place at which the constraints become dependent."""
    run = outcome.run
    marks = run.marks[: outcome.good_rows + _BEYOND]
    for number, phase in enumerate(run.phases):
        places = [k for k, mark in enumerate(marks) if mark.phase == number]
        if phase.surface is None or len(places) < 3:
            continue
        roots = _roots(phase.mode, [marks[k] for k in places])
        for j in range(1, len(roots) - 1):
            before, here, after = roots[j - 1 : j + 2]
            if here <= before and here <= after and here <= max(before - here, after - here):
                return places[j - 1]
    return None


def _roots(mode: Mode, marks: Sequence[Mark]) -> list[float]:
    """The root of the smallest pivot at each row, beside the largest that it is."""
    eliminated = mode.equations.eliminated
    if eliminated is None:
        return []
    pivots = eliminated.schur.pivots
    at = mode.motion.function([node for pair in pivots for node in pair])
    try:
        values = [[abs(float(x)) for x in at(mark.t, *mark.q, *mark.v)] for mark in marks]
    except (ArithmeticError, ValueError):
        return []
    whole = [max(column) for column in zip(*values, strict=True)]
    # a constraint that follows from others all the way has no branches
    kept = [k for k in range(0, len(whole), 2) if whole[k] > PIVOT_TOLERANCE * whole[k + 1]]
    if not kept:
        return []
    return [math.sqrt(min(row[k] / whole[k] for k in kept)) for row in values]


def _is_confirmed(simulation: Setup, modes: Modes, outcome: Outcome) -> bool:
    """Whether a run of more digits and finer steps agrees: the first that is possible tells."""
    for name in SHARPER:
        made = METHODS[name].prepare(simulation, modes)
        if not isinstance(made, str):
            with suppress(NotPossible):
                return _agree(outcome, one_run(simulation, made, SHARP))
    return False


def _agree(outcome: Outcome, run: Run) -> bool:
    """Whether two runs have the same states, as far as they are claimed."""
    if len(run.marks) < outcome.good_rows:
        return False
    pairs = list(zip(outcome.run.marks, run.marks, strict=False))[: outcome.good_rows]
    accuracy = outcome.controller.accuracy
    scales = component_scales(outcome.run.peaks, outcome.controller.span)
    return all(
        abs(float(x) - float(y)) <= accuracy * scale
        for one, other in pairs
        for x, y, scale in zip((*one.q, *one.v), (*other.q, *other.v), scales, strict=True)
    )
