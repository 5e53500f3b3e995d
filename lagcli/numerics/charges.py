"""The conserved charges of a mode: those that are evident, and the candidates of the file.

A candidate's charge is p Delta q - h Delta t - gauge.  Whether it is conserved is asked of
numbers: its rate along the motion, at random states on the constraints, beside the terms
that the rate is the sum of.  A gauge that the file leaves out is not searched for.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.graph.derivative import partial
from lagcli.numerics.motion import Motion
from lagcli.numerics.surface import Surface
from lagcli.problem import Coordinate

if TYPE_CHECKING:
    from lagcli.numerics.modes import Mode

_ATTEMPTS, _ENOUGH = 40, 6
_ZERO = 1e-9
_SPREAD = 0.4
_PROJECTIONS = 8


def conserved_charges(mode: Mode) -> set[str]:
    """The names of those charges of the simulation that are conserved in a mode."""
    simulation = mode.modes.simulation
    found = set(mode.equations.evident_charges) & set(simulation.charges)
    asked = [name for name in simulation.candidates if name in simulation.charges]
    if not asked:
        return found
    equations, motion = mode.equations, mode.motion
    graph = equations.graph
    solved = simulation.reading.accelerations
    rates = [
        *((equations.t, graph.one),),
        *zip(equations.q, equations.qdot, strict=True),
        *zip(equations.qdot, solved, strict=True),
    ]
    terms = [
        graph.product(partial(graph, x)(simulation.charges[name]), rate)
        for name in asked
        for x, rate in rates
    ]
    function = motion.function(terms, solved)
    signs = list(motion.signs)
    good, left = 0, set(asked)
    for t, q, v in _states(mode):
        try:
            if motion.kinks:
                motion.set_signs(t, q, v)
            values = [float(x) for x in function(t, *q, *v, *motion.accelerations(t, *q, *v))]
        except (ArithmeticError, ValueError):
            continue
        for place, name in enumerate(asked):
            part = values[place * len(rates) : (place + 1) * len(rates)]
            if not abs(sum(part)) <= _ZERO * sum(map(abs, part)):
                left.discard(name)
        good += 1
        if good == _ENOUGH or not left:
            break
    motion.signs[:] = signs
    return found | left if good == _ENOUGH else found


def _states(mode: Mode) -> Iterator[tuple[float, list[float], list[float]]]:
    """Random states near the initial one, on the constraints; the same ones in every run."""
    simulation = mode.modes.simulation
    q0, v0 = simulation.start
    number = _Numbers()
    for _ in range(_ATTEMPTS):
        t = simulation.asked.until * number()
        q = [x + _SPREAD * (2 * number() - 1) * (abs(x) or 1.0) for x in q0]
        v = [x + _SPREAD * (2 * number() - 1) * max(abs(x), 1.0) for x in v0]
        if mode.equations.rows:
            state = _on_constraints(mode.motion, t, q, v)
            if state is None:
                continue
            q, v = state
        if all(map(_allowed, simulation.problem.coordinates, q)):
            yield t, q, v


def _on_constraints(
    motion: Motion, t: float, q: list[float], v: list[float]
) -> tuple[list[float], list[float]] | None:
    surface = Surface(motion)
    try:
        surface.measure(t, q, v)
        for _ in range(_PROJECTIONS):
            q, v = surface.project(t, q, v)
        surface.note(t, q, v)
    except (ArithmeticError, ValueError):
        return None
    return (q, v) if max(surface.residuals) <= _ZERO * _ZERO**0.25 else None


def _allowed(coordinate: Coordinate, value: float) -> bool:
    match coordinate.assume:
        case "positive" | "nonnegative":
            return value > 0
        case "negative":
            return value < 0
        case _:
            return True


class _Numbers:
    """Evenly spread numbers between 0 and 1.

    References
    ----------
    Park, Miller, "Random number generators: good ones are hard to find", CACM 31 (1988).
    """

    def __init__(self) -> None:
        self._state = 20011

    def __call__(self) -> float:
        self._state = self._state * 48271 % 2147483647
        return self._state / 2147483647
