"""Steps over a place where the equations have values and no series: a root, an inverse function."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from lagcli.numerics.compiled import layout as k
from lagcli.numerics.compiled.machine import Machine
from lagcli.numerics.integrators.steps import CannotGoOn

#: Roundings of the time over which a place without a series is passed, in one run and the other;
#: _WIDER times as many each time, at most _AT_ONE_PLACE times within _NEARBY of them.
_NARROW, _WIDE, _WIDER, _AT_ONE_PLACE, _NEARBY = 16, 32, 8, 8, 1e9
#: In the first of these times the velocity changes by less than this part of its scale: more is
#: what a pole does.
_IMPULSE = 1e-12
#: What a change of the accelerations over it may add to a velocity in 80 and 128 bits.
_UNFELT = 1e-17


class Leaps:
    """The steps of one run over such places.

    Parameters
    ----------
    machine
        The equations.
    scales, facts, counts
        Those of the run, in memory.
    """

    def __init__(self, machine: Machine, scales: Any, facts: Any, counts: Any) -> None:
        self._motion, self._rounding = machine.motion, machine.numbers.rounding
        self._scales, self._facts, self._counts = scales, facts, counts
        self._times: list[float] = []

    def length(self, t: float) -> float:
        """How long a step over it is, where something blocks the way; or 0."""
        if not self._counts[k.BLOCKED]:
            return 0.0
        unit = self._unit(t)
        self._times = [*(before for before in self._times if t - before < _NEARBY * unit), t]
        if len(self._times) > _AT_ONE_PLACE:
            return 0.0
        return unit * float(_WIDER ** (len(self._times) - 1))

    def _unit(self, t: float) -> float:
        """The shortest time over which such a place is passed: times are doubles."""
        unit = 2.0**-52 * max(t, 1e-3 * float(self._facts[k.UNTIL]))
        return unit * (_WIDE if self._facts[k.KICK] else _NARROW)

    def straight(
        self, start: float, q: Any, v: Any
    ) -> Callable[[float], tuple[list[Any], list[Any], list[Any]]]:
        """The state a time after another one, under the accelerations there."""
        a = self._motion.accelerations(start, *q, *v)

        def inside(t: float) -> tuple[list[Any], list[Any], list[Any]]:
            h = t - start
            places = [x + h * (u + h * b / 2) for x, u, b in zip(q, v, a, strict=True)]
            return places, [u + h * b for u, b in zip(v, a, strict=True)], list(a)

        return inside

    def over(self, t: float, end: float, q: Any, v: Any) -> tuple[list[Any], list[Any]]:
        """q and q' on the other side, where what acts is no impulse.

        Raises
        ------
        CannotGoOn
            Where it grows without bound.
        """
        places, speeds, rates = self.straight(t, q, v)(end)
        n = self._motion.n
        scales = [*map(float, self._scales[n : 2 * n])]
        pairs = zip(rates, scales, strict=True)
        if any(abs(a) * self._unit(t) > _IMPULSE * scale for a, scale in pairs):
            raise CannotGoOn(t, q, v, "")
        if self._rounding < 2.0**-53:  # more digits than a time has: a jump is not passed
            later = map(float, self._motion.accelerations(end, *places, *speeds))
            jumps = (  # beyond |u| = 0 a root of u has no value
                abs((0.0 if math.isnan(b) else b) - float(a))
                for a, b in zip(rates, later, strict=True)
            )
            least = _UNFELT / (end - t)
            if not all(x <= least * scale for x, scale in zip(jumps, scales, strict=True)):
                raise CannotGoOn(t, q, v, "")
        return places, speeds
