"""Where constraints become dependent on the way, two branches of the motion may meet.

A linkage that is flat can go on in two ways.  Of these the motion takes the one along which its
velocity is continuous: a force that is finite changes no velocity at once.  Rounding may turn it
to the other one all the same, in all runs alike.  So a run that has passed such a place is made
again with many rows about it.  Where the velocity jumps between two of them the run has left its
branch; where branches touch, or the motion rests, none is distinguished.  Then more digits are
taken, and where these do not help the rows end before the place.

A linkage that is nearly flat turns in a sharp bend: rows that are closer and closer show it, as
long as the roots of the pivots are more than rounding makes of 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from lagcli.numerics.certified.accuracy import Outcome, ended
from lagcli.numerics.certified.attempts import attempt
from lagcli.numerics.certified.clock import BITS, DOUBLES
from lagcli.numerics.certified.escalation import TIMES
from lagcli.numerics.certified.methods import SHARP, SHARPER
from lagcli.numerics.certified.prepared import Precision, RunsDone
from lagcli.numerics.certified.rank import RankPlace, places, varies
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import component_scales

#: Rows after those that are good which are looked at: there the accuracy may have been lost.
_BEYOND = 2
#: Rows about a place; in a step at least, and of one run at most.
_ROWS, _IN_STEP, _MOST = 64, 2, 20_000
#: A change of the velocity is a jump where it is _JUMP times those on both sides of it, unless it
#: is smaller than _SMALL.
_JUMP, _SMALL = 4.0, 1e-6
#: Roots at 16 and at 4 rows from the place: 4 where branches cross, 16 where they touch.
_STRAIGHT = 8.0
#: Roots larger than _KNOWN times what rounding makes of 0 are known.
_KNOWN, _CLOSER = 1e3, 10


def on_one_branch(
    setup: Setup, modes: Modes, outcome: Outcome, digits: Precision, done: RunsDone
) -> tuple[Outcome, str]:
    """The outcome where it is certain to be on one branch, or what is left of it; a remark.

    Parameters
    ----------
    setup, modes
        The request, and the modes in doubles.
    outcome, digits
        What a method gave, and its precision.
    done
        Counts the runs.
    """
    remark = ""
    met, left = _left_at(setup, outcome, digits)
    if met and setup.request.method == "auto" and not is_sharp(outcome):
        most = TIMES * outcome.run.steps
        sharper = attempt(setup, SHARPER, modes, done, first=SHARP, most=most)
        remark = sharper.remark
        if sharper.outcome is not None:  # steps of a usual tolerance pass over a bend
            outcome = sharper.outcome
            met, left = _left_at(setup, outcome, sharper.precision)
    return (outcome if left is None else ended(outcome, left)), remark


def is_sharp(outcome: Outcome) -> bool:
    """Whether it has more digits than are needed at such a place."""
    return outcome.run.method_name in SHARPER and outcome.tolerances[0] <= SHARP


def is_met(outcome: Outcome) -> bool:
    """Whether the constraints become dependent before the motion is lost."""
    met = places(outcome.run, outcome.run.marks)
    return bool(met) and met[0].begin <= outcome.lost_at


def _left_at(setup: Setup, outcome: Outcome, digits: Precision) -> tuple[bool, RankPlace | None]:
    """Whether there are such places, and the first at which the run may have left its branch."""
    with digits():
        run, marks = outcome.run, outcome.run.marks[: outcome.good_rows + _BEYOND]
        few = not is_sharp(outcome) and len(run.marks) < _IN_STEP * run.steps
        if few and varies(run, marks):
            count, until = min(_IN_STEP * run.steps, _MOST), marks[-1].t
            run = _again(setup, outcome, [until * k / count for k in range(1, count + 1)])
            marks = run.marks
        met = places(run, marks)
        if not met:
            return False, None
        times = [_about(place.begin, place.end) for place in met]
        run = _again(setup, outcome, [t for each in times for t in each])
        left = (
            place
            for place, each in zip(met, times, strict=True)
            if not _is_passed(setup, outcome, place, run, each)
        )
        return True, next(left, None)


def _about(begin: float, end: float) -> list[float]:
    return [begin + (end - begin) * k / _ROWS for k in range(_ROWS + 1)]


def _again(setup: Setup, outcome: Outcome, times: Sequence[float]) -> Run:
    """The same run with more rows, up to the last of these."""
    end = max(times)
    return outcome.run.again(sorted({*(t for t in setup.times if t < end), *times}))


def _is_passed(
    setup: Setup, outcome: Outcome, place: RankPlace, run: Run, times: Sequence[float]
) -> bool:
    """Whether a run passes a place on its branch."""
    least = _KNOWN * math.sqrt(2.0 ** -BITS.get(run.method_name, DOUBLES))
    for _ in range(_CLOSER):
        marks = _between(run, place.phase, times[0], times[-1])
        roots = place.roots(marks)
        if len(roots) < 3:
            return False
        k = roots.index(min(roots))
        smooth = _is_smooth(outcome, marks)
        if smooth and _is_straight(roots, k):
            return True
        if roots[k] <= least:
            return False
        if smooth and max(roots[max(0, k - 4) : k + 5]) <= 2 * roots[k]:
            return True
        times = _about(marks[max(0, k - 2)].t, marks[min(len(marks) - 1, k + 2)].t)
        run = _again(setup, outcome, times)
    return False


def _between(run: Run, phase: int, begin: float, end: float) -> list[Mark]:
    """The rows of a phase from one time to another, evenly spread."""
    least = 0.5 * (end - begin) / _ROWS
    found: list[Mark] = []
    for mark in run.marks:
        apart = mark.t - found[-1].t if found else least
        if mark.phase == phase and begin <= mark.t <= end and apart >= least:
            found.append(mark)
    return found


def _is_smooth(outcome: Outcome, marks: Sequence[Mark]) -> bool:
    """Whether the velocity does not jump between two of the rows."""
    n = len(marks[0].v)
    scales = component_scales(outcome.run.peaks, outcome.controller.span)[n:]
    rates = []
    for a, b in pairwise(marks):
        changes = zip(a.v, b.v, scales, strict=True)
        rates.append(max(abs(float(y - x)) / s for x, y, s in changes) / (b.t - a.t))
    spacing = (marks[-1].t - marks[0].t) / len(rates)
    small = max(_SMALL, 0.1 * outcome.controller.accuracy) / spacing
    return all(
        rate
        <= _JUMP * max(*rates[max(0, k - 3) : max(0, k - 1)], *rates[k + 2 : k + 4], 0.0, 0.0)
        + small
        for k, rate in enumerate(rates)
    )


def _is_straight(roots: Sequence[float], k: int) -> bool:
    """Whether branches cross at a place, and do not touch."""
    return all(
        roots[k + 16 * side] <= _STRAIGHT * roots[k + 4 * side]
        for side in (-1, 1)
        if 0 <= k + 16 * side < len(roots)
    )
