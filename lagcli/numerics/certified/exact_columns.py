"""Columns worked out with more digits than the run, where doubles lose them in the formula.

Two runs in doubles work a column out alike: near the pole of a top, where its acceleration is
a quotient of two cancelled numbers, they agree in every digit and are wrong in half of them.
What the state is known to is in the difference of the runs; what the formula loses at a state
is not.  So the columns that are no coordinates are worked out again at some of the rows, and
where that matters, at all.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.clock import BITS
from lagcli.numerics.certified.precise import precision
from lagcli.numerics.certified.scales import relative
from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Mode, Modes
from lagcli.numerics.hybrid.run import moved_state
from lagcli.numerics.hybrid.setup import Setup

Rows = list[list[Any]]

_DIGITS = 40
_LOOKS = 10
#: A part of the accuracy.
_LOST = 0.05


def with_digits(setup: Setup, outcome: Outcome) -> Rows:
    """The rows of a run, their columns as exact as their states.

    Parameters
    ----------
    setup
        The request.
    outcome
        As it came; rows of more digits than doubles stay as they are.
    """
    run, rows = outcome.run, outcome.rows
    state = setup.equations.state
    places = [j for j, node in enumerate(setup.nodes) if node not in state]
    modes = {mark.phase: run.phases[mark.phase].mode for mark in run.marks}
    if not rows or not places or not modes[run.marks[0].phase].motion.arithmetic.ordered:
        return rows
    with precision(_DIGITS):
        others, number = _exact(setup)
        n, dependent = len(setup.equations.q), cache(_dependent)

        def columns(mark: Mark, row: list[Any]) -> list[Any]:
            mode = modes[mark.phase]
            if mode.stuck or dependent(mode)(mark):
                return row
            t, *state = map(number, (mark.t, *mark.q, *mark.v))
            try:
                found = others.mode(*mode.key).tabulate(t, state[:n], state[n:])
            except Refusal:  # what only doubles solve
                return row
            better = list(row)
            for j in places:
                if found[j] is not None and row[j] is not None:
                    better[j] = float(found[j])
            return better

        pairs = [*zip(run.marks, rows, strict=False)]
        looks = {*range(0, len(rows), max(1, len(rows) // _LOOKS)), len(rows) - 1}
        looks |= {_peak(rows, j) for j in places}
        found = {place: columns(*pairs[place]) for place in looks}
        lost = max(
            (
                relative(abs(found[place][j] - float(rows[place][j])), outcome.scales[j])
                for place in looks
                for j in places
                if rows[place][j] is not None
            ),
            default=0.0,  # of columns that are defined nowhere
        )
        if lost <= _LOST * setup.request.accuracy:
            return rows
        return [found.get(k) or columns(*pair) for k, pair in enumerate(pairs)]


def at_written_times(setup: Setup, outcome: Outcome) -> Rows:
    """The rows of a run of more digits than doubles, moved from doubles to the times as written.

    A drive of 5000 cos(5000 t) makes x'(10.8) differ by 2e-12 from x' at the double next to 10.8.
    """
    run, rows = outcome.run, list(outcome.rows)
    if run.method_name not in BITS:
        return rows
    with precision(_DIGITS):
        written = setup.written_times(Balls())
        for place, mark in enumerate(run.marks[: len(rows)]):
            row, between = divmod(mark.sample, setup.every)
            if between or not 0 <= row < len(written):
                continue
            late, mode = written[row] - mark.t, run.phases[mark.phase].mode
            if not late.is_zero() and abs(late) <= math.ulp(mark.t):
                state = moved_state(mode, mark.t, mark.q, mark.v, late)
                rows[place] = mode.tabulate(mark.t + late, *state)
    return rows


def _peak(rows: Sequence[Sequence[Any]], column: int) -> int:
    """Where a column is largest."""
    return -max((abs(float(row[column] or 0.0)), -place) for place, row in enumerate(rows))[1]


def _dependent(mode: Mode) -> Callable[[Mark], bool]:
    """Whether a pivot of the elimination vanishes: more digits divide by what rounding left."""
    eliminated = mode.equations.eliminated
    pairs = (
        [] if eliminated is None else [pair for pair in eliminated.guards if pair[0] is not pair[1]]
    )
    pivots = mode.motion.function([node for pair in pairs for node in pair])

    def vanishes(mark: Mark) -> bool:
        try:
            found = pivots(mark.t, *mark.q, *mark.v)
        except (ArithmeticError, ValueError):
            return True
        sizes = zip(found[::2], found[1::2], strict=True)
        return any(abs(x) <= PIVOT_TOLERANCE * abs(entry) for x, entry in sizes)

    return vanishes


def _exact(setup: Setup) -> tuple[Modes, Callable[[float], Any]]:
    """The modes in balls, and what makes a ball of a double."""
    from lagcli.numerics.integrators.dop853 import dop853

    arithmetic = Balls()
    constants = constants_of(setup.equations, setup.all_nodes, arithmetic)
    modes = Modes(setup, constants, arithmetic, dop853, 10.0**-_DIGITS)
    return modes, arithmetic.ball
