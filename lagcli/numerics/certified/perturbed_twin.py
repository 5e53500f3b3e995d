"""What lies a rounding beside a problem: its initial values, its clock, its parameters.

Every other run begins a rounding of the initial values away and reads a clock that is a
rounding fast, so that neither what doubles make of the file nor a frequency that they get
wrong by a rounding is the same in both runs.  A parameter, or a number of a formula, is
seldom a double, nor a number of 80 bits.  Where the accelerations, or a column, feel that
more than they feel the clock, as k - c does for two numbers that are almost the same, or
where they may jump by it, the runs are made again, every other one with numbers that lie
so many times as far from the file's as the rounded ones do.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import cycle, groupby, islice
from typing import Any
from weakref import WeakKeyDictionary

from lagcli.graph.nodes import Symbol
from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.equations.arithmetic import Balls, Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import rounded_components
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup

Vector = list[Any]
State = tuple[Vector, Vector]

_EPSILON = 2.0**-52
#: The other parameters lie this multiple of the rounding beyond the file's.
_TIMES = 16
_PI_ULP = math.ulp(math.pi)
#: What the clock's rounding, and the factor of the bound, make up for.
_CLOCK = 4 * _EPSILON
_LOOKS = 12
#: Integers below this are counts.
_COUNTED = 100
#: For the rate at which a force changes with the time alone.
_LATER = 1e-7
_COLUMN = 0.25


class BesideDoubles(Doubles):
    """Doubles that miss a rational by more than its nearest double, to the same side of it.

    Parameters
    ----------
    exact
        Whether those miss it, too, that a double can be: an elimination rounds what it makes
        of them, as if they were some others.
    """

    #: pi, too, is no double: it lies 0.28 of a rounding above its own
    functions: Mapping[str, Any] = {**Doubles.functions, "pi": lambda: math.pi + 4 * _PI_ULP}

    def __init__(self, *, exact: bool) -> None:
        self._exact = exact

    def number(self, value: Fraction) -> float:
        """Of a rational that is no double, the double some 16 roundings beyond it."""
        nearest = float(value)
        if not value or not math.isfinite(nearest):
            return nearest
        missed, unit = value - Fraction(nearest), math.ulp(nearest)
        if missed:
            steps = max(1, round(_TIMES * abs(missed) / Fraction(unit)))
            return nearest + math.copysign(steps * unit, missed)
        if not self._exact or (value.denominator == 1 and abs(value) < _COUNTED):
            return nearest
        chance = value.numerator * 48271 % 2147483647
        return nearest + (2 + chance % 7) * math.copysign(unit, chance % 2 - 0.5)


class BesideBalls(Balls):
    """Balls about what numbers of so many bits, some 16 roundings beyond, make of a rational.

    Parameters
    ----------
    bits
        Of the significand.
    """

    def __init__(self, bits: int) -> None:
        super().__init__()
        self._bits = bits

    def number(self, value: Fraction) -> Any:
        """A rational that has as many bits is kept."""
        size = abs(value.numerator).bit_length() - value.denominator.bit_length()
        unit = Fraction(2) ** (size + 1 - self._bits)
        nearest = round(value / unit) * unit
        steps = max(1, round(_TIMES * abs(value - nearest) / unit))
        side = (value > nearest) - (value < nearest)
        return super().number(nearest + side * steps * unit)


def moved_states(setup: Setup, modes: Modes) -> tuple[State, State]:
    """The next doubles to the initial state: all above, and above and below by turns.

    What it is rounded by must not matter; in one of them its parts may cancel.
    """
    motion, (q, v) = modes.first.motion, setup.start
    rounded = rounded_components(motion, setup.problem.initial, q, v)

    return by_turns((*q, *v), rounded, motion.n, lambda x, sign: math.nextafter(x, sign * math.inf))


def by_turns(
    values: Sequence[Any], moves: Sequence[bool], n: int, moved: Callable[[Any, int], Any]
) -> tuple[State, State]:
    """The states with what moves moved upwards, and upwards and downwards by turns."""
    found = [
        [moved(x, sign) if each else x for x, each, sign in zip(values, moves, signs, strict=False)]
        for signs in (cycle([1]), cycle([1, -1]))
    ]
    above, both = ((each[:n], each[n:]) for each in found)
    return above, both


def elsewhere(setup: Setup) -> tuple[State, State]:
    """The initial state with all its components a few roundings away, to one side or the other."""
    q, v = setup.start
    return (_turned(q, 1), _turned(v, -1)), (_turned(q, -1), _turned(v, -1))


def _turned(values: Sequence[float], sign: int) -> list[float]:
    """Numbers a few roundings away, none of them as far as the one beside it."""
    return [
        x + sign * (-1) ** place * (1 + place % 3) * math.ulp(x) if x else x
        for place, x in enumerate(values)
    ]


def clocked(times: Sequence[float], moved: int) -> list[float]:
    """The times, but for the last, by a clock that is a rounding of doubles fast, or slow."""
    return [*(t * (1 + moved * _EPSILON) for t in times[:-1]), times[-1]]


#: Those of motions that are still there: an ensemble runs one many times.
_OTHERS: WeakKeyDictionary[Motion, Modes | None] = WeakKeyDictionary()


def other_parameters(setup: Setup, modes: Modes) -> Modes | None:
    """The same modes with parameters beside those of the file; None where all are exact."""
    motion = modes.first.motion
    if motion not in _OTHERS:
        _OTHERS[motion] = _other_parameters(setup, modes)
    known = _OTHERS[motion]
    return None if known is None else known.by(modes.make_method, setup)


def _other_parameters(setup: Setup, modes: Modes) -> Modes | None:
    arithmetic = BesideDoubles(exact=not setup.equations.rows)
    try:
        constants: Mapping[Symbol, Any] = constants_of(setup.equations, setup.all_nodes, arithmetic)
    except Refusal:  # at the end of what is allowed
        return None
    others = Modes(setup, constants, arithmetic, modes.make_method, modes.rounding)
    others.first.conserved = modes.first.conserved
    return others


def are_felt(outcome: Outcome, modes: Modes, others: Modes, accuracy: float, unit: float) -> bool:
    """Whether other parameters change what acts in a run by more than a clock does.

    Parameters
    ----------
    outcome
        Of the runs.
    modes, others
        In doubles; with the parameters beside.
    accuracy
        That of the columns.
    unit
        The rounding of the runs as a part of that of doubles.
    """
    run = outcome.run
    if run.shortened or run.events or modes.first.motion.kinks:
        return True  # what is narrow, an impact, or a jump is seldom met by a row
    every = max(1, len(run.marks) // _LOOKS)
    looks = [*run.marks[::every]]
    if run.narrowest is not None:
        looks.append(run.narrowest)
    n, columns = len(run.peaks) // 2, len(others.setup.nodes)
    least = [peak / others.setup.request.until for peak in run.peaks[n:]]
    sizes, changes = least, [0.0] * n
    moves, is_driven = [0.0] * columns, modes.first.motion.equations.depends_on_time
    for key, marks in groupby(looks, key=lambda mark: run.phases[mark.phase].mode.key):
        mode, beside = modes.mode(*key), others.mode(*key)
        states = [(float(m.t), [*map(float, m.q)], [*map(float, m.v)]) for m in marks]
        for t, q, v in states:
            try:
                here = mode.motion.accelerations(t, *q, *v)
                there = beside.motion.accelerations(t, *q, *v)
                then = mode.motion.accelerations(t + t * _LATER, *q, *v) if is_driven else here
            except (ArithmeticError, ValueError):
                continue
            for j, (a, b, c) in enumerate(zip(here, there, then, strict=True)):
                sizes[j] = max(sizes[j], abs(a) + abs(c - a) / _LATER)
                changes[j] = max(changes[j], abs(b - a))
        usual = mode.tabulate.along(states)
        moved = beside.tabulate.along([(t, _turned(q, 1), _turned(v, -1)) for t, q, v in states])
        pairs = zip(zip(*usual, strict=True), zip(*moved, strict=True), strict=True)
        for j, (these, those) in enumerate(islice(pairs, columns)):
            known = ((x, y) for x, y in zip(these, those, strict=True) if None not in (x, y))
            moves[j] = max(moves[j], *(unit * abs(y - x) for x, y in known), 0.0)
    limit = _TIMES * _CLOCK
    return any(d > limit * size for d, size in zip(changes, sizes, strict=True)) or any(
        d > _COLUMN * accuracy * scale for d, scale in zip(moves, outcome.scales, strict=True)
    )
