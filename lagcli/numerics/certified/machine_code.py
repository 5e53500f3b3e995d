"""When the motion is run in machine code, and in which numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import cache
from typing import Any
from weakref import WeakKeyDictionary

from lagcli.numerics.certified import perturbed_twin as twin
from lagcli.numerics.certified.prepared import ROUNDED, Prepared, RunOrder
from lagcli.numerics.compiled.engine import NoCompiler, engine
from lagcli.numerics.compiled.machine import Machine, NotCompiled
from lagcli.numerics.compiled.numbers import DOUBLE, EXTENDED, QUADRUPLE, Extended
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import refined_state, rounded_components
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.compiled_taylor import CompiledTaylor
from lagcli.numerics.hybrid.modes import MakeMethod, Mode, Modes
from lagcli.numerics.hybrid.request import Progress
from lagcli.numerics.hybrid.run import Phase, Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.hybrid.subsystems import Apart, MakeMachine, apart
from lagcli.numerics.hybrid.transitions import Transitions
from lagcli.numerics.integrators.steps import Method, NotPossible, Tolerance
from lagcli.numerics.integrators.taylor import Taylor

#: Parts of the span that the longest step is: a series knows what lies within its step,
#: but for what is flat and then is not.
LONGEST = (10.0, 200.0, 2000.0, 20000.0)
_PROBES = 2000
#: No tolerance below these changes anything.
_FINEST_EXTENDED, _FINEST_QUADRUPLE = 1e-22, 1e-36
#: Bits of the parameters and initial values behind numbers of 80 and 128.
_BITS = 160
#: Numbers of 80 and of 128 bits claim nothing better.
_LEAST_EXTENDED, _LEAST_QUADRUPLE = 1e-14, 1e-26
_DIGITS_QUADRUPLE = 33


#: Steps beyond which the rounding of doubles may cost charges 1e-12; and where so many are
#: made anyhow, a tolerance that is not felt in charges costs little more.
LONG = 2_000_000
#: So many times as many, foreseen on the way, are certainly too many.
_CERTAINLY = 1.5
FIRST_OF_LONG = 1e-17


class RoundingAddsUp(NotPossible):
    """So many steps are to be made in numbers of more bits."""

    def __init__(self) -> None:
        super().__init__(f"over more than {LONG:,} steps the rounding of doubles adds up")


#: The machines of motions that are still there: an ensemble runs one motion many times.
_MACHINES: WeakKeyDictionary[Motion, Machine | str] = WeakKeyDictionary()


def double_machine(motion: Motion) -> Machine | str:
    """The machine for a motion, or why there is none."""
    if motion not in _MACHINES:
        try:
            _MACHINES[motion] = Machine(motion, DOUBLE)
        except (NoCompiler, NotCompiled) as reason:
            _MACHINES[motion] = str(reason)
    return _MACHINES[motion]


def _machine(motion: Motion, independent: Sequence[int] | None) -> Machine | str:
    """The machine for a motion without constraints that these imply."""
    if independent is None:
        return double_machine(motion)
    equations = motion.equations.without_implied(independent)
    return double_machine(Motion(equations, motion.constants, motion.arithmetic))


class Runs:
    """Runs in machine code, that go through the controller.

    Parameters
    ----------
    setup, modes
        The request, and the modes with the numbers of the machine code or better.
    machine
        The equations of the first mode.
    make
        Makes the machine code of a part of that mode's motion; None keeps it in one.
    otherwise
        Makes the method of a mode for which there is no machine code.
    """

    def __init__(
        self,
        setup: Setup,
        modes: Modes,
        machine: Machine,
        make: MakeMachine | None,
        otherwise: MakeMethod | None = None,
    ) -> None:
        self.setup, self._otherwise = setup, otherwise
        self._machine, self._make = machine, make
        #: told how many steps a long run will take
        self.foreseen: Progress = None
        #: the subsystems, once it is known whether steps of their own pay
        self._apart: Apart | None = None
        self._is_weighed = make is None or setup.request.whole
        self._machines: dict[Motion, Machine | str] = {modes.first.motion: machine}
        self.modes = modes.by(self._method)

    def _method(self, mode: Mode, surface: Surface | None) -> Method:
        motion = mode.motion
        if motion not in self._machines:
            make = self._make or double_machine
            self._machines[motion] = "friction holds" if mode.stuck else make(motion)
        machine = self._machines[motion]
        if isinstance(machine, str):
            if self._otherwise is None:
                raise NotPossible(machine)
            return self._otherwise(mode, surface)
        return CompiledTaylor(machine, surface)

    def _parts(self, state: tuple[list[Any], list[Any]], bound: Tolerance) -> Apart | None:
        """The subsystems, where they are run apart."""
        if not self._is_weighed:
            assert self._make is not None
            self._is_weighed = True
            mode, until = self.modes.first, self.setup.request.until
            self._apart = apart(mode, self._machine, self._make, state, bound, until)
        return self._apart

    def run(
        self,
        state: tuple[Sequence[Any], Sequence[Any]],
        times: Sequence[Any],
        order: RunOrder,
    ) -> Run:
        """One run from a state, with rows at these times by the clock of the order."""
        bound, progress = order.bound, order.progress
        request, mode = self.setup.request, self.modes.first
        transitions = Transitions(self.modes, request.accuracy, request.until)
        run = Run(transitions, bound, request.accuracy)
        q, v = list(state[0]), list(state[1])
        if mode.conditions or mode.motion.kinks:
            return run.go(q, v, times, probe_every=order.every, progress=progress)
        surface = mode.surface()
        probes = _PROBES if order.every else 0
        run.phases.append(Phase(mode, surface, 0.0))
        parts = self._parts((q, v), bound)
        if parts is not None:
            if parts.go(run, (q, v), times, probes=probes, progress=progress):
                return run
            self._apart = None
        method = mode.method(surface)
        assert isinstance(method, CompiledTaylor)
        return method.go(
            run,
            q,
            v,
            times,
            probes=probes,
            progress=progress,
            most=order.most,
            foreseen=self.foreseen,
        )


def prepared_doubles(setup: Setup, doubles: Modes) -> Prepared | str:
    """Machine code in doubles made ready, or why there is none."""
    first = doubles.first
    independent = None
    if first.equations.rows and not first.conditions and not first.motion.kinks:
        q, v = setup.start
        independent = first.motion.independent(0.0, *q, *v)
    machine = _machine(first.motion, independent)
    if isinstance(machine, str):
        return machine
    make = double_machine if independent is None else None
    usual = Runs(setup, doubles, machine, make, doubles.make_method)
    has_more = cache(lambda: not isinstance(prepared_extended(setup, doubles), str))

    def prepared(other: Runs, beside: tuple[twin.State, twin.State]) -> Prepared:
        both, states = (usual, other), (setup.start, *beside)

        def run(order: RunOrder) -> Run:
            runs = both[order.moved != 0]
            runs.foreseen = lambda steps: too_many(steps / _CERTAINLY)
            times = twin.clocked(order.times, order.moved)
            done = runs.run(states[order.moved], times, order)
            too_many(done.steps)
            return done

        def too_many(steps: float) -> None:
            if steps > LONG and setup.request.method == "auto" and has_more():
                raise RoundingAddsUp

        def with_others(others: Modes) -> Prepared:
            found = _machine(others.first.motion, independent)
            if isinstance(found, str):
                raise NotPossible(found)
            runs = Runs(setup, others, found, make, others.make_method)
            return prepared(runs, twin.elsewhere(setup))

        return Prepared(
            run=run,
            rounded=ROUNDED * DOUBLE.rounding,
            longest=LONGEST,
            with_others=with_others,
        )

    return prepared(usual, twin.moved_states(setup, doubles))


def prepared_extended(setup: Setup, doubles: Modes) -> Prepared | str:
    """Machine code in numbers of 80 bits made ready, or why there is none."""
    if setup.request.accuracy < _LEAST_EXTENDED:
        return "80 bits claim nothing better than 1e-14"
    return _beyond_doubles(setup, doubles, EXTENDED, _FINEST_EXTENDED)


def prepared_quadruple(setup: Setup, doubles: Modes) -> Prepared | str:
    """Machine code in numbers of 128 bits made ready, or why there is none."""
    request = setup.request
    if request.digits is not None and request.digits > _DIGITS_QUADRUPLE:
        return f"128 bits are {_DIGITS_QUADRUPLE} digits"
    if request.accuracy < _LEAST_QUADRUPLE:
        return f"128 bits claim nothing better than {_LEAST_QUADRUPLE:.0e}"
    return _beyond_doubles(setup, doubles, QUADRUPLE, _FINEST_QUADRUPLE)


def _beyond_doubles(
    setup: Setup, doubles: Modes, numbers: Extended, finest: float
) -> Prepared | str:
    has_events = setup.equations.kinks or doubles.first.conditions or setup.goes_on
    if has_events and numbers is not EXTENDED:
        return "events and switching functions are followed in up to 80 bits"
    try:
        with precision():
            return _prepared(setup, doubles, numbers, finest)
    except (Refusal, NoCompiler, NotCompiled, OverflowError) as reason:
        return str(reason)


def _prepared(setup: Setup, doubles: Modes, numbers: Extended, finest: float) -> Prepared | str:
    from lagcli.numerics.equations.arithmetic import Balls

    if not (engine().extended if numbers is EXTENDED else engine().quadruple):
        return f"there are no numbers of {numbers.name.removeprefix('taylor')} bits here"
    equations, request = setup.equations, setup.request
    arithmetic = Balls()
    constants = constants_of(equations, setup.all_nodes, arithmetic)
    modes = Modes(setup, constants, arithmetic, doubles.make_method, 2.0**-_BITS)
    modes.first.conserved = doubles.first.conserved
    motion = modes.first.motion

    def in_python(mode: Mode, surface: Surface | None) -> Taylor:
        if len(mode.stuck) < len(mode.motion.kinks):
            raise NotPossible("friction holds at some of the switching functions only")
        return Taylor(mode.motion, surface)

    def with_doubles(motion: Motion) -> Machine:
        own = Motion(motion.equations, doubles.constants, doubles.arithmetic)
        own.looked_at = motion.looked_at
        beside = "it reads no signs" if motion.kinks else double_machine(own)
        return Machine(motion, numbers, None if isinstance(beside, str) else beside)

    def runs_of(modes: Modes) -> Runs:
        motion = modes.first.motion
        if numbers is EXTENDED:
            return Runs(setup, modes, with_doubles(motion), with_doubles, in_python)
        return Runs(setup, modes, Machine(motion, numbers), None)

    def other_runs() -> Runs:
        beside = twin.BesideBalls(round(-math.log2(numbers.rounding)))
        try:
            others = constants_of(equations, setup.all_nodes, beside)
            made = Modes(setup, others, beside, doubles.make_method, modes.rounding)
            made.first.conserved = doubles.first.conserved
            return runs_of(made)
        except (Refusal, NotCompiled, OverflowError) as reason:
            raise NotPossible(str(reason)) from None

    q, v = setup.start
    initial = setup.problem.initial
    anew = {} if request.project else initial
    exact_q, exact_v = refined_state(motion, modes.first.surface(), q, v, anew)
    inexact = rounded_components(motion, initial, q, v)
    unit = arithmetic.ball(numbers.rounding) * 2
    beside = twin.by_turns(
        (*exact_q, *exact_v), inexact, motion.n, lambda x, sign: x * (1 + unit * sign)
    )
    states = (exact_q, exact_v), *beside

    usual, unit_of_doubles = runs_of(modes), numbers.rounding / DOUBLE.rounding

    def prepared(other: Runs) -> Prepared:
        def run(order: RunOrder) -> Run:
            moved = order.moved
            times: list[Any] = [*order.times]
            runs = other if moved else usual
            if moved:  # by a clock that is a rounding fast, or slow
                clock = 1 + 2 * moved * Fraction(numbers.rounding)
                times = [*(Fraction(t) * clock for t in times[:-1]), times[-1]]
            order.bound.unit = unit_of_doubles
            try:
                return runs.run(states[moved], times, order)
            except (OverflowError, NotCompiled, Refusal) as reason:
                raise NotPossible(str(reason)) from None

        return Prepared(
            run=run,
            finest=finest,
            rounded=2 * ROUNDED * numbers.rounding,  # 1e-18 is 18 of those of 80 bits
            longest=LONGEST,
            precision=precision,
            unit=unit_of_doubles,
            with_others=lambda _: prepared(other_runs()),
        )

    return prepared(usual)


@contextmanager
def precision() -> Iterator[None]:
    """The bits of what stands behind numbers of 80 and 128."""
    from flint import ctx

    with ctx.workprec(_BITS):
        yield
