"""Subsystems that move without each other, each in steps of its own.

Together they take the steps of the quickest.  Whether steps of their own pay is found before
the first run: the series at the first states says how long a step each would take by itself,
the equations how much work one is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain, islice
from typing import Any

from lagcli.numerics.compiled.machine import Machine
from lagcli.numerics.equations.coupling import coupling, groups
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.reduced_model import CutEquations, Reduction, operations
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.compiled_taylor import CompiledTaylor
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.modes import Mode
from lagcli.numerics.hybrid.request import Progress
from lagcli.numerics.hybrid.run import Phase, Run
from lagcli.numerics.integrators.steps import CannotGoOn, NotPossible, Stretch, Tolerance
from lagcli.record import record

#: Steps that are looked at.
_STEPS = 16
#: The work, in the units of `machine.LONG_RUN`, as which the making of a machine counts, and
#: the part of the work of all together that is to be left at most.
_MAKING, _PAYS = 4e6, 0.8

#: The machine code of a motion, or why there is none.
MakeMachine = Callable[[Motion], Machine | str]


def subsystems(equations: EquationsOfMotion) -> list[CutEquations]:
    """The parts that move without each other; none where all is coupled."""
    e = equations
    found = groups(*coupling(e.graph, e.q, e.mass, e.forcing, e.constraints))
    if len(found) == 1:
        return []
    reduction, rows = Reduction(e, {}, frozenset(), 0), dict(enumerate(e.constraints))
    every = range(len(e.q))
    return [
        CutEquations(reduction, e.mass, e.forcing, rows, [j in places for j in every])
        for places in found
    ]


@record
class Subsystem:
    """A subsystem and its machine code."""

    equations: CutEquations
    motion: Motion
    machine: Machine

    def state(self, values: Sequence[Any]) -> list[Any]:
        """What belongs to it of something that each coordinate of the whole has."""
        return [values[j] for j in self.equations.coordinates]


class Apart:
    """The subsystems of a mode.

    Parameters
    ----------
    mode
        All of them.
    parts
        Two or more.
    """

    def __init__(self, mode: Mode, parts: Sequence[Subsystem]) -> None:
        self.mode, self.parts = mode, parts

    def go(
        self,
        run: Run,
        state: tuple[list[Any], list[Any]],
        times: Sequence[float],
        *,
        probes: int,
        progress: Progress,
    ) -> bool:
        """A run part by part; False where one of them ends early.

        Parameters
        ----------
        run
            What is made.
        state
            The coordinates and velocities at the beginning.
        times, probes, progress
            As for `CompiledTaylor.go`.
        """
        made: list[Run] = []
        n, bound = self.mode.motion.n, run.tolerance
        for count, part in enumerate(self.parts):
            peaks = None
            if bound.known:
                peaks = [*part.state(bound.peaks[:n]), *part.state(bound.peaks[n:])]
            own = Tolerance(bound.value, part.motion.n, bound.span, bound.longest, peaks)
            own.moved = bound.moved
            each = Run(run.transitions, own, 0.0)
            surface = Surface(part.motion, self.mode.modes.rounding) if part.motion.m else None
            each.phases.append(Phase(self.mode, surface, 0.0))
            q, v = map(part.state, state)

            def report(done: float, before: int = count) -> None:
                if progress is not None:
                    progress((before + done) / len(self.parts))

            method = CompiledTaylor(part.machine, surface)
            method.go(each, q, v, times, probes=probes, progress=report)
            if each.stop is not None or len(each.marks) < len(times):
                return False
            made.append(each)
        self._join(run, made)
        return True

    def _join(self, run: Run, made: Sequence[Run]) -> None:
        """The rows of all parts side by side, and what was seen in any."""
        n = self.mode.motion.n
        places = [j for part in self.parts for j in part.equations.coordinates]
        order = sorted(range(n), key=places.__getitem__)

        def joined(values: Sequence[Sequence[Any]]) -> list[Any]:
            side_by_side = list(chain.from_iterable(values))
            return [side_by_side[k] for k in order]

        run.marks = [
            Mark(marks[0].t, joined([m.q for m in marks]), joined([m.v for m in marks]), 0, k)
            for k, marks in enumerate(zip(*(each.marks for each in made), strict=True))
        ]
        run.method_name = made[0].method_name
        run.steps = sum(each.steps for each in made)
        run.evaluations = sum(each.evaluations for each in made)
        run.shortened = sum(each.shortened for each in made)
        run.defect = max(each.defect for each in made)
        run.apart = tuple(tuple(x.name for x in part.equations.q) for part in self.parts)
        bound, counts = run.tolerance, [part.motion.n for part in self.parts]
        for ours, theirs in (
            (bound.peaks, [each.tolerance.peaks for each in made]),
            (bound.scales, [each.tolerance.scales for each in made]),
        ):
            split = list(zip(theirs, counts, strict=True))
            ours[:] = [*joined([x[:k] for x, k in split]), *joined([x[k:] for x, k in split])]
        surface = run.phases[-1].surface
        if surface is not None:
            for part, each in zip(self.parts, made, strict=True):
                own = each.phases[-1].surface
                if own is not None:
                    surface.join(own, part.equations.place)


def apart(
    mode: Mode,
    machine: Machine,
    make: MakeMachine,
    state: tuple[list[Any], list[Any]],
    bound: Tolerance,
    until: float,
) -> Apart | None:
    """The subsystems of a mode, where steps of their own pay; else None.

    Parameters
    ----------
    mode, machine
        All together.
    make
        Makes the machine code of a part.
    state
        The coordinates and velocities at the beginning.
    bound, until
        Of the first run.
    """
    found = subsystems(mode.equations)
    if not found or not _pays(mode, machine, found, state, bound, until):
        return None
    parts = []
    for equations in found:
        motion = Motion(equations, mode.motion.constants, mode.motion.arithmetic)
        own = make(motion)
        if isinstance(own, str):
            return None
        parts.append(Subsystem(equations, motion, own))
    return Apart(mode, parts)


def _pays(
    mode: Mode,
    machine: Machine,
    parts: Sequence[CutEquations],
    state: tuple[list[Any], list[Any]],
    bound: Tolerance,
    until: float,
) -> bool:
    """Whether the parts are less work by themselves, by the steps at the beginning."""
    surface = mode.surface()
    if surface is not None:
        surface.measure(0.0, *state)
    method = CompiledTaylor(machine, surface)
    trial = Tolerance(bound.value, mode.motion.n, bound.span, bound.longest)
    rates: list[list[float]] = []
    try:
        for _ in islice(
            method.steps(Stretch(list(state[0]), list(state[1]), until), trial), _STEPS
        ):
            lengths = method.lengths([part.coordinates for part in parts])
            rates.append([1 / length for length in lengths])
    except (CannotGoOn, NotPossible):
        return False
    if len(rates) < _STEPS:
        return False
    per_operation = machine.ops / operations(mode.equations)

    def work(steps: float, ops: float, n: int) -> float:
        return until * steps / _STEPS * method.order**2 * (ops + 4 * n)

    together = work(sum(map(max, rates)), machine.ops, mode.motion.n)
    alone = sum(
        work(sum(rate), per_operation * operations(part), len(part.q))
        for rate, part in zip(zip(*rates, strict=True), parts, strict=True)
    )
    return alone + _MAKING * len(parts) <= _PAYS * together
