"""A method made ready for one problem, and its runs against each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext

from lagcli.numerics.certified.accuracy import CHANCE, LONGEST, Controller, Outcome, worse
from lagcli.numerics.certified.perturbed_twin import (
    State,
    are_felt,
    clocked,
    elsewhere,
    moved_states,
    other_parameters,
)
from lagcli.numerics.certified.scales import Scales
from lagcli.numerics.hybrid.modes import MakeMethod, Modes
from lagcli.numerics.hybrid.request import Progress
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.hybrid.transitions import Transitions
from lagcli.numerics.integrators.steps import Tolerance
from lagcli.record import record

Precision = Callable[[], AbstractContextManager[None]]

#: Local tolerances below this change nothing: an estimate is rounded at h |rate| 1e-16.
FINEST_DOUBLE = 1e-18
#: In units of rounding: local tolerances below meet it.
ROUNDED = 10.0
#: Of runs by dop853 and its like, whose steps err by far less than such a tolerance.
_CHANCE = 8.0


@record(kw_only=True)
class RunOrder:
    """A run of a problem, or of one a rounding beside it.

    Attributes
    ----------
    bound, times
        The tolerance, and the rows.
    every
        At this interval of steps the defect is probed; 0 never.
    progress
        Called with the part that is done.
    moved
        1 or -1 with a fast clock or a slow one, and a rounding beside the problem.
    most
        Steps, where it has more digits than doubles.
    """

    bound: Tolerance
    times: Sequence[float]
    every: int = 0
    progress: Progress = None
    moved: int = 0
    most: int | None = None


OneRun = Callable[[RunOrder], Run]


class RunsDone:
    """The progress of runs of which there are two at least."""

    def __init__(self, progress: Progress) -> None:
        self._progress, self._done = progress, 0

    def report(self, part: float) -> None:
        """The part of a run that is done."""
        if self._progress is not None:
            self._progress((self._done + part) / max(2, self._done + 1))

    def finish(self) -> None:
        """One more is done."""
        self._done += 1


@record(kw_only=True)
class Prepared:
    """A method made ready for one problem.

    Attributes
    ----------
    run : OneRun
        Makes a run.
    finest
        No run is made with a tolerance below.
    rounded, chance
        Runs with a tolerance up to `rounded` meet rounding: `chance` differences bound the error.
    longest : tuple of float
        The longest step as parts of the span: at first, and where something was missed.
    floor
        A component smaller than this part of the largest is taken for rounding.
    precision
        The digits within which runs are made and their rows worked out.
    unit
        The rounding of its numbers as a part of that of doubles.
    with_others : function, optional
        The same with other parameters in the runs that are moved: see `perturbed_twin`.
    """

    run: OneRun
    finest: float = FINEST_DOUBLE
    rounded: float = 0.0
    chance: float = CHANCE
    longest: Sequence[float] = LONGEST
    floor: float = 0.0
    precision: Precision = nullcontext
    unit: float = 1.0
    with_others: Callable[[Modes], Prepared] | None = None


def in_doubles(make: MakeMethod, setup: Setup, modes: Modes, rounded: float = 0.0) -> Prepared:
    """A method of the usual kind made ready: steps in Python, one state after the other.

    Parameters
    ----------
    make
        Makes the method of a mode.
    setup, modes
        The request, and the modes in doubles.
    rounded
        As for `Prepared`.
    """
    request = setup.request
    usual = modes.by(make)

    def prepared(other: Modes, beside: tuple[State, State]) -> Prepared:
        both, states = (usual, other), (setup.start, *beside)

        def run(order: RunOrder) -> Run:
            moved = order.moved
            made = Run(
                Transitions(both[moved != 0], request.accuracy, request.until),
                order.bound,
                request.accuracy,
            )
            q, v = states[moved]
            times = clocked(order.times, moved)
            return made.go(q, v, times, probe_every=order.every, progress=order.progress)

        return Prepared(
            run=run,
            rounded=rounded,
            chance=_CHANCE,
            with_others=lambda others: prepared(others.by(make), elsewhere(setup)),
        )

    return prepared(usual, moved_states(setup, modes))


def outcome_of(
    setup: Setup,
    modes: Modes,
    made: Prepared,
    done: RunsDone,
    *,
    first: float = 1.0,
    most: int | None = None,
) -> Outcome:
    """The runs of a method, compared until they agree within the accuracy.

    Parameters
    ----------
    setup, modes, made
        The request, the modes in doubles, and the method.
    done
        Counts the runs.
    first
        The first tolerance is no coarser.
    most
        Steps of a run with more digits than doubles.
    """
    request, usual = setup.request, setup.times
    scales = Scales(setup)
    count = 0

    def runner(
        tolerance: float,
        longest: float,
        peaks: Sequence[float] | None,
        every: int,
        slow: bool,
        times: Sequence[float] | None,
    ) -> Run:
        n = len(setup.equations.q)
        nonlocal count
        moved = -1 if slow else int(count % 2 == 0)

        def again(times: Sequence[float]) -> Run:
            bound = Tolerance(tolerance, n, request.until, longest, peaks, made.floor)
            bound.moved = moved != 0
            return made.run(
                RunOrder(
                    bound=bound,
                    times=times,
                    every=every,
                    progress=done.report,
                    moved=moved,
                    most=most,
                )
            )

        run = again(times or usual)
        run.again = again
        count += 1
        done.finish()
        return run

    def found() -> Outcome:
        with made.precision():
            return Controller(
                runner,
                accuracy=request.accuracy,
                finest=made.finest,
                rounded=made.rounded,
                chance=made.chance,
                span=request.until,
                charges=len(setup.charges),
                scales=scales,
                longest=made.longest,
                first=first,
            ).outcome()

    outcome = found()
    if outcome.good_rows > 1 and made.with_others is not None:
        others = other_parameters(setup, modes)
        if others is not None and are_felt(outcome, modes, others, request.accuracy, made.unit):
            with made.precision():
                made = made.with_others(others)
            count = 0
            # runs that meet rounding agree by chance, too: once in 37 rays that graze two discs
            return worse(outcome, found())
    return outcome
