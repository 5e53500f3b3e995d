"""Which part of the phase plane is shown: where the potential has its features.

Equilibria are the roots of dU_eff/dq.  Their surroundings, the place where the motion begins
and its turning points are in the window; an angle is shown once round.
"""

from __future__ import annotations

import math
from functools import cached_property

from lagcli.pictures.contours import first_root, grid, roots
from lagcli.pictures.drawing import CannotDraw, MarkRole
from lagcli.pictures.labels import Labels
from lagcli.pictures.one_freedom import RemainingFreedom
from lagcli.pictures.turning import is_periodic

_PLACES = 2001
#: How far away equilibria and turning points are looked for, in lengths of the motion.
_FAR = 40.0
_NEAR = 12.0
_ROOM = 0.4
#: A coordinate that is not negative is not followed down to 0.
_LEAST = 1e-6
#: Heights above the lowest energy, in those of what is shown.
_ABOVE = 1.7
_SAME = 1e-9


class Window:
    """The ranges of q and q', the equilibria and the energies of a portrait."""

    def __init__(
        self, freedom: RemainingFreedom, labels: Labels, motion: tuple[float, ...] = ()
    ) -> None:
        self.freedom = freedom
        self.energy = freedom.energy(*freedom.start)
        name = freedom.columns[0][1]
        self.turns = labels.is_angle(name) and is_periodic(freedom.potential)
        self.positive = freedom.coordinate.assume in {"positive", "nonnegative"}
        self._motion = tuple(x for x in (*motion, freedom.start[0]) if math.isfinite(x))

    @cached_property
    def scale(self) -> float:
        """A length of the motion; 1 where there is none."""
        return max((abs(x) for x in self._motion), default=0.0) or 1.0

    @cached_property
    def _searched(self) -> list[float]:
        """Places that lie closer where q is small."""
        if self.turns:
            return grid(-1.01 * math.pi, 1.01 * math.pi, _PLACES)
        far = _FAR * self.scale
        if self.positive:
            low = math.log(_LEAST * self.scale)
            return [math.exp(x) for x in grid(low, math.log(far), _PLACES)]
        # an odd number of intervals: no place is 0, where symmetric potentials have their feature
        return [self.scale * math.sinh(x) for x in grid(-4.5, 4.5, _PLACES - 1)]

    @cached_property
    def equilibria(self) -> list[float]:
        """The roots of dU_eff/dq, of which far ones are left out."""
        found = roots(self.freedom.slope, self._searched)
        if self.turns:
            return found
        near = _NEAR * self.scale
        return [x for x in found if abs(x) <= near] or found[:1]

    @cached_property
    def stable(self) -> list[float]:
        """Minima of U_eff."""
        return [x for x in self.equilibria if self._rises(x)]

    @cached_property
    def unstable(self) -> list[float]:
        """Where U_eff is no minimum: dU_eff/dq falls through 0."""
        return [x for x in self.equilibria if not self._rises(x)]

    @property
    def marked(self) -> tuple[tuple[MarkRole, list[float], int], ...]:
        """Both kinds of equilibria with their colours."""
        return ("stable", self.stable, 2), ("unstable", self.unstable, 1)

    def _rises(self, x: float) -> bool:
        step = 1e-4 * (self.scale if not self.turns else 1.0)
        return self.freedom.slope(x + step) > self.freedom.slope(x - step)

    @cached_property
    def turning_points(self) -> list[float]:
        """The roots of U_eff = E."""
        u = self.freedom.potential
        return roots(lambda x: u(x) - self.energy, self._searched)

    @cached_property
    def q(self) -> tuple[float, float]:
        """The range of q."""
        if self.turns:
            return -math.pi, math.pi
        near = [x for x in self.turning_points if abs(x) <= 2 * _NEAR * self.scale]
        shown = [*self.equilibria, *near, *self._motion]
        low, high = min(shown), max(shown)
        width = high - low if high - low > _SAME * self.scale else self.scale
        room = _ROOM * width
        low, high = low - room, high + room
        return (max(low, 0.002 * width) if self.positive else low), high

    @cached_property
    def lowest(self) -> float:
        """The energy of the lowest equilibrium that is shown, or of the lowest place."""
        u = self.freedom.potential
        found = [u(x) for x in self.stable]
        values = [y for x in grid(*self.q, 201) if math.isfinite(y := u(x))]
        if not found and not values:
            raise CannotDraw("the potential has no values where the motion is")
        if found:
            return min(found)
        values.sort()
        return values[len(values) // 10]

    @cached_property
    def separatrices(self) -> list[float]:
        """The energies of the unstable equilibria, each once."""
        found: list[float] = []
        for value in sorted(map(self.freedom.potential, self.unstable)):
            if not found or value - found[-1] > _SAME * (1 + abs(value)):
                found.append(value)
        return found

    @cached_property
    def highest(self) -> float:
        """An energy above all that is shown by name."""
        u = self.freedom.potential
        named = [*self.separatrices, self.energy]
        height = max(named) - self.lowest
        if height <= _SAME * (1 + abs(self.lowest)):  # at rest in the only minimum
            edges = [y for x in self.q if math.isfinite(y := u(x))]
            height = max((y - self.lowest for y in edges), default=0.0) or 1.0
            return self.lowest + 0.5 * abs(height)
        return self.lowest + _ABOVE * height

    @cached_property
    def v(self) -> tuple[float, float]:
        """The range of q', symmetric: as fast as the highest energy lets it be."""
        places = [*self.stable, *grid(*self.q, 41)]
        fastest = max((self._speed(x) for x in places), default=0.0)
        return (-1.05 * fastest, 1.05 * fastest) if fastest else (-1.0, 1.0)

    def _speed(self, x: float) -> float:
        """The q' at which E(q, q') is the highest energy; 0 where U_eff is above it."""
        energy, goal = self.freedom.energy, self.highest
        at_rest = energy(x, 0.0)
        if not at_rest < goal or at_rest < self.lowest - 0.5 * (goal - self.lowest):
            return 0.0
        return first_root(lambda v: energy(x, v) - goal, 40)
