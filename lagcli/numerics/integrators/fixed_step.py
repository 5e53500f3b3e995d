"""Steps of one length: what symplectic methods need to keep their charges for long times.

The length follows from the tolerance: a pilot run over the whole span compares each step with
two of half its length; the largest difference, which goes with h^(p+1), tells what length has
an error of the tolerance in its worst step.  Sums are compensated.

References
----------
Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., sections VIII.1 (why the
length must not change) and VIII.5 (compensated sums).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator

from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import reason_of
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.dop853 import added
from lagcli.numerics.integrators.steps import (
    CannotGoOn,
    Inside,
    Step,
    StopWithReason,
    Stretch,
    Tolerance,
    moved,
)

Vector = list[float]

#: The pilot's steps are halved until their errors are below this.
_RESOLVED = 1e-3
_HALVINGS = 10
#: Differences below this are rounding, and tell nothing of the order.
_ROUNDING = 1e-14
#: The slope inside a step: central differences at this part of it.
_PART = 0.02


class FixedStep(ABC):
    """The steps of one run.

    Parameters
    ----------
    motion
        In doubles, without abs and sign.
    surface
        The constraints, or None.
    pilots
        (length, error) of the pilot of the same motion, once it is made.

    Attributes
    ----------
    order : int
        p.
    """

    name: str
    sees, even = False, True
    order: int

    def __init__(
        self, motion: Motion, surface: Surface | None, pilots: list[tuple[float, float]]
    ) -> None:
        self.motion, self.surface, self.n = motion, surface, motion.n
        self.evaluations = 0
        self.reached: int | None = None
        self._pilots = pilots

    @abstractmethod
    def change(self, t: float, h: float, q: Vector, v: Vector) -> Vector:
        """How much q and then v change in a step.

        Raises
        ------
        ArithmeticError, ValueError
            Where it is not defined.
        """

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Steps to the end.

        Raises
        ------
        CannotGoOn
            Where a step is not defined.
        """
        q, v, until, begin = stretch
        tolerance.see(q, v, [0.0] * (2 * self.n))
        if not self._pilots:
            self._pilots.append(self._pilot(stretch, tolerance))
        length, error = self._pilots[0]
        if error > 0:
            length *= min(1.0, (tolerance.value / error) ** (1 / (self.order + 1)))
        count = math.ceil((until - begin) / min(length, tolerance.longest))
        h, t = (until - begin) / count, begin
        lost = [0.0] * (2 * self.n)
        for k in range(count):
            end = until if k == count - 1 else begin + (k + 1) * h
            try:
                change = self.change(t, end - t, q, v)
                tolerance.see(q, v, change)
                end_q, end_v, lost = added(q, v, change, lost)
                if self.surface is not None:
                    end_q, end_v = self.surface.project(end, end_q, end_v)
            except (ArithmeticError, ValueError) as failure:
                raise CannotGoOn(t, q, v, reason_of(failure)) from None
            if not all(map(math.isfinite, (*end_q, *end_v))):
                raise CannotGoOn(t, q, v, "")
            inside = self._inside(t, q, v)
            start, t = t, end
            before, q, v = (q, v), end_q, end_v
            yield Step(start, end - start, end, q, v, inside, self._sloped(start, h, *before))

    def _pilot(self, stretch: Stretch, tolerance: Tolerance) -> tuple[float, float]:
        """A length, and the largest error of a step of it."""
        q, v, until, begin = stretch
        h = min(tolerance.longest, until - begin)
        for _ in range(_HALVINGS):
            try:
                error = self._largest(stretch, h)
            except (ArithmeticError, ValueError):
                error = math.inf
            if error <= _RESOLVED:
                break
            h /= 2
        else:
            raise StopWithReason(begin, q, v, "it takes steps too short for one length")
        return h, error if error > _ROUNDING else 0.0

    def _largest(self, stretch: Stretch, h: float) -> float:
        q, v, until, begin = stretch
        worst, n, t = 0.0, self.n, begin
        peaks = [abs(x) for x in (*q, *v)]
        while t < until:
            whole = self.change(t, h, q, v)
            first = self.change(t, h / 2, q, v)
            half = moved(q, v, first)
            second = self.change(t + h / 2, h / 2, *half)
            q, v = moved(*half, second)
            t += h
            if self.surface is not None:
                q, v = self.surface.project(t, q, v)
            peaks = [max(p, abs(x)) for p, x in zip(peaks, (*q, *v), strict=True)]
            for j, (a, b, c) in enumerate(zip(whole, first, second, strict=True)):
                across = h * peaks[n + j] if j < n else peaks[j - n] / (until - begin)
                scale = max(peaks[j], across, 1e-300)
                worst = max(worst, abs(a - b - c) / scale)
            if not worst <= _RESOLVED:
                return math.inf
        return worst

    def _inside(self, start: float, q: Vector, v: Vector) -> Inside:
        """A shorter step from the same beginning."""

        def at(t: float) -> tuple[Vector, Vector, Vector]:
            state = self._moved(start, t - start, q, v)
            return *state, list(self.motion.accelerations(t, *state[0], *state[1]))

        return at

    def _sloped(self, start: float, length: float, q: Vector, v: Vector) -> Inside:
        """The same with the slope of its velocities, by differences of order 4."""

        def at(t: float) -> tuple[Vector, Vector, Vector]:
            d = _PART * length
            a, b, c, e = (self._moved(start, t - start + k * d, q, v)[1] for k in (-2, -1, 1, 2))
            slope = [
                (8 * (z - y) - (w - x)) / (12 * d) for x, y, z, w in zip(a, b, c, e, strict=True)
            ]
            return *self._moved(start, t - start, q, v), slope

        return at

    def _moved(self, start: float, h: float, q: Vector, v: Vector) -> tuple[Vector, Vector]:
        return moved(q, v, self.change(start, h, q, v)) if h else (q, v)
