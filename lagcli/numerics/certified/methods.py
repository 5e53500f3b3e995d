"""The methods by name: what each is good for, and how it is made ready for a problem.

`simulate --method`, its choice `auto` and `tradeoff` know a method from here only: one that
is registered is offered by all three.  A module is imported when its method is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING, Any, Protocol

from lagcli.numerics.certified.accuracy import CHANCE, LONGEST, Controller, Outcome
from lagcli.numerics.certified.perturbed_twin import (
    are_felt,
    elsewhere,
    fast,
    moved_state,
    other_parameters,
)
from lagcli.numerics.certified.scales import Scales
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.transitions import Transitions
from lagcli.numerics.integrators.steps import Tolerance
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.numerics.certified.simulate import Simulation
    from lagcli.numerics.hybrid.modes import MakeMethod, Modes

Vector = list[Any]
Progress = Callable[[float], None]
Precision = Callable[[], AbstractContextManager[None]]

#: Local tolerances below this change nothing: an estimate is rounded at h |rate| 1e-16.
FINEST_DOUBLE = 1e-18
#: Local tolerances meet rounding from so many of its units on.
ROUNDED = 10.0
#: dop853's, whose steps err by far less than such a tolerance, and the bound with that.
_ROUNDED_853, _CHANCE = 1e-14, 8.0


class OneRun(Protocol):
    """Makes a run: of the problem, or of one a rounding beside it (`moved`)."""

    def __call__(
        self, bound: Tolerance, every: int, progress: Progress | None, *, moved: bool
    ) -> Run:
        """One run."""


@record(kw_only=True)
class Prepared:
    """A method made ready for one problem.

    Attributes
    ----------
    run : OneRun
        Makes a run.
    first, finest
        No run is made with a tolerance above, or below.
    rounded, chance
        Runs with this tolerance or less meet rounding: so many differences bound the error.
    longest : tuple of float
        The longest step as parts of the span: at first, and where something was missed.
    floor
        A component smaller than this part of the largest is taken for rounding.
    precision
        The digits within which runs are made and their rows worked out.
    with_others : function, optional
        The same with other parameters in the runs that are moved: see `perturbed_twin`.
    """

    run: OneRun
    first: float = math.inf
    finest: float = FINEST_DOUBLE
    rounded: float = 0.0
    chance: float = CHANCE
    longest: Sequence[float] = LONGEST
    floor: float = 0.0
    precision: Precision = nullcontext
    with_others: Callable[[Modes], Prepared] | None = None


#: Makes a method ready, or says why it is not for this problem.
Prepare = Callable[["Simulation", "Modes"], "Prepared | str"]


@record(kw_only=True)
class Entry:
    """A method as it is known before any problem.

    Attributes
    ----------
    name
        That of `--method`.
    order
        Of its global error in the step; None where it follows from the tolerance.
    properties : tuple of str
        Out of explicit, implicit, stiff, symplectic, fixed step, smooth (needs analytic
        equations), compiled, any precision.
    reason
        What it is taken for.
    prepare : Prepare
        Makes it ready.
    """

    name: str
    order: int | None
    properties: tuple[str, ...]
    reason: str
    prepare: Prepare


def in_doubles(
    make: MakeMethod, simulation: Simulation, modes: Modes, rounded: float = 0.0
) -> Prepared:
    """A method of the usual kind made ready: steps in Python, one state after the other.

    Parameters
    ----------
    make
        Makes the method of a mode.
    simulation, modes
        What is asked, and the modes in doubles.
    rounded
        As for `Prepared`.
    """
    asked = simulation.asked
    usual = modes.by(make)

    def prepared(other: Modes, beside: tuple[Vector, Vector]) -> Prepared:
        both, states = (usual, other), (simulation.start, beside)

        def run(bound: Tolerance, every: int, progress: Progress | None, *, moved: bool) -> Run:
            made = Run(Transitions(both[moved], asked.accuracy, asked.until), bound, asked.accuracy)
            times = fast(simulation.times) if moved else simulation.times
            q, v = states[moved]
            return made.go(q, v, times, probe_every=every, progress=progress)

        return Prepared(
            run=run,
            rounded=rounded,
            chance=_CHANCE,
            with_others=lambda others: prepared(others.by(make), elsewhere(simulation)),
        )

    return prepared(usual, moved_state(simulation, modes))


def outcome_of(simulation: Simulation, modes: Modes, made: Prepared, first: float = 1.0) -> Outcome:
    """The runs of a method, compared until they agree within the accuracy.

    Parameters
    ----------
    simulation, modes, made
        What is asked, the modes in doubles, and the method.
    first
        The first tolerance is no coarser.
    """
    asked = simulation.asked
    scales = Scales(simulation)
    total = 2  # runs that progress is told of
    count = 0

    def runner(tolerance: float, longest: float, peaks: Sequence[float] | None, every: int) -> Run:
        n = len(simulation.equations.q)
        bound = Tolerance(tolerance, n, asked.until, longest, peaks, made.floor)
        nonlocal count
        bound.moved = count % 2 == 0
        done = simulation.finished

        def told(part: float) -> None:
            if simulation.progress is not None:
                simulation.progress((done + part) / max(total, done + 1))

        run = made.run(bound, every, told, moved=bound.moved)
        count += 1
        simulation.finished += 1
        return run

    def found() -> Outcome:
        with made.precision():
            return Controller(
                runner,
                accuracy=asked.accuracy,
                finest=made.finest,
                rounded=made.rounded,
                chance=made.chance,
                span=asked.until,
                charges=len(simulation.charges),
                scales=scales,
                longest=made.longest,
                first=min(first, made.first),
            ).outcome()

    outcome = found()
    if outcome.reached and made.with_others is not None:
        others = other_parameters(simulation, modes)
        if others is not None and are_felt(outcome, others, asked.accuracy):
            made = made.with_others(others)
            count = 0
            return found()
    return outcome


def one_run(simulation: Simulation, made: Prepared, tolerance: float) -> Run:
    """One run of a method, compared with nothing."""
    n, until = len(simulation.equations.q), simulation.asked.until
    bound = Tolerance(tolerance, n, until, until / made.longest[0], None, made.floor)
    with made.precision():
        return made.run(bound, 0, None, moved=False)


def _dop853(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.dop853 import dop853

    return in_doubles(dop853, simulation, modes, _ROUNDED_853)


def _radau5(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.radau5 import radau5

    return _without_kinks(simulation) or in_doubles(radau5, simulation, modes)


def _gauss8(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.gauss8 import gauss8

    return _without_kinks(simulation) or in_doubles(gauss8, simulation, modes)


def _yoshida8(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.yoshida8 import separates, yoshida8

    if not separates(simulation.equations) or simulation.contacts:
        return "it does not separate: it needs a constant M, forces of q and t, no constraints"
    return _without_kinks(simulation) or in_doubles(yoshida8, simulation, modes)


def _without_kinks(simulation: Simulation) -> str:
    return (
        "it does not stop at the zeros of switching functions (abs, sign)"
        if simulation.equations.kinks
        else ""
    )


def _taylor64(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_doubles

    return prepared_doubles(simulation, modes)


def _taylor80(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_extended

    return prepared_extended(simulation, modes)


def _taylor128(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_quadruple

    return prepared_quadruple(simulation, modes)


def _taylor(simulation: Simulation, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.precise import prepared

    return prepared(simulation, modes)


METHODS: dict[str, Entry] = {
    entry.name: entry
    for entry in (
        Entry(
            name="dop853",
            order=8,
            properties=("explicit",),
            reason="explicit, of order 8: the cheapest that reaches the accuracy without stiffness",
            prepare=_dop853,
        ),
        Entry(
            name="radau5",
            order=5,
            properties=("implicit", "stiff"),
            reason="implicit, of order 5: something dies away so quickly that explicit methods "
            "would need more steps than it costs",
            prepare=_radau5,
        ),
        Entry(
            name="gauss8",
            order=8,
            properties=("implicit", "symplectic", "fixed step"),
            reason="implicit, symplectic, of order 8: keeps charges for long times",
            prepare=_gauss8,
        ),
        Entry(
            name="yoshida8",
            order=8,
            properties=("explicit", "symplectic", "fixed step"),
            reason="explicit, symplectic, of order 8: keeps charges for long times",
            prepare=_yoshida8,
        ),
        Entry(
            name="taylor64",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code: the cheapest of any order where it is compiled",
            prepare=_taylor64,
        ),
        Entry(
            name="taylor80",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code of 80 bits: the accuracy lies within the "
            "rounding of doubles",
            prepare=_taylor80,
        ),
        Entry(
            name="taylor128",
            order=None,
            properties=("explicit", "smooth", "compiled"),
            reason="power series in machine code of 128 bits: the accuracy lies within the "
            "rounding of 80 bits",
            prepare=_taylor128,
        ),
        Entry(
            name="taylor",
            order=None,
            properties=("explicit", "smooth", "any precision"),
            reason="power series with more digits than doubles: the accuracy lies within their "
            "rounding",
            prepare=_taylor,
        ),
    )
}

#: What `auto` tries before all others where the motion is stiff.
STIFF = ("radau5",)
#: Its digits are as many as are needed.
MORE_DIGITS = "taylor"
#: What has more digits than doubles for a motion that turns on them, the cheaper first.
SHARPER = ("taylor128", MORE_DIGITS)
#: A tolerance at which its steps do not pass over a bend that a rounding of doubles makes.
SHARP = 1e-17
#: What `auto` tries: of each group the first that is possible, the next group where more
#: digits may reach what was not reached.
AUTO: tuple[tuple[str, ...], ...] = (
    ("taylor64", "dop853"),
    ("taylor80",),
    ("taylor128", MORE_DIGITS),
)
