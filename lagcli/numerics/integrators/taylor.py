"""Power series: any order, any precision.

The series of q at the beginning of a step is found by putting the coefficients known so
far into the equations of motion, which gives the next one (the next two where q'' does not
depend on q').  The order follows from the tolerance, p = 1 - log(tolerance)/2, and the step
from the last coefficients, so that the rest of the series is below the tolerance: several
of them, since by symmetry one or two may vanish (a pendulum released at exactly 90°).

Explicit, dense output of the same order for nothing, some p passes a step.

References
----------
Jorba, Zou, "A software package for the numerical integration of ODEs by means of
high-order Taylor methods", Experimental Mathematics 14 (2005), sections 2 and 3.
Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE
Trans. Comput. 66 (2017): here the radii are dropped after each coefficient, the bound on
the error is measured as for any other method.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from lagcli.graph.nodes import mask_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.integrators.steps import CannotGoOn, Step, Stretch, Tolerance

_LOWEST = 8
_LOOKED_AT = 4  # coefficients, for the length of the step
_SAFETY = 0.9
_FIRST = 1e-3  # of the longest step
_LONGEST = 1000.0  # the exponent of a step
#: A step that is a larger part of the time ends at a double.
_RESOLVED = 1e-12
_SHORTEST = 2.0**20  # of the numbers' rounding, as a part of the time


class Taylor:
    """The steps of one run.

    Parameters
    ----------
    motion
        In balls.
    surface
        The constraints, or None.
    """

    name = "taylor"
    sees = even = False

    def __init__(self, motion: Motion, surface: Surface | None) -> None:
        from flint import arb, arb_series, ctx

        self.motion, self.surface, self.n = motion, surface, motion.n
        self.evaluations = 0
        self.reached: int | None = None
        self._ball, self._series, self._context = arb, arb_series, ctx
        mask = mask_of(motion.equations.qdot)
        #: how many coefficients one pass gives
        self._gain = 1 if mask_of(motion.equations.dynamics) & mask else 2

    def steps(self, stretch: Stretch, tolerance: Tolerance) -> Iterator[Step]:
        """Accepted steps to the end.

        Raises
        ------
        CannotGoOn
            Where the series has no radius of convergence left.
        """
        (q, v, until, begin), ball = stretch, self._ball
        t, last, order = ball(begin), ball(until), order_for(tolerance.value)
        shortest = _SHORTEST * 2.0**-self._context.prec
        while t < last:
            start = float(t)
            series = self._coefficients(t, q, v, order)
            self._see(series, tolerance, first=start == begin)
            h = min(self._length(series, tolerance), tolerance.longest)
            if not h > shortest * max(start, 1e-3 * until):
                raise CannotGoOn(start, q, v, "")
            end = last if t + 1.01 * h >= last else self._end(t, h)
            q, v, _ = self._at(end - t, series)
            inside = self._inside(t, end, series)
            if self.surface is not None:
                q, v = self.surface.project(end, q, v)
            q, v = [x.mid() for x in q], [x.mid() for x in v]
            yield Step(start, h, float(end), q, v, inside)
            t = end

    def _end(self, t: Any, h: float) -> Any:
        """t + h: a double, as the times of rows are, where doubles resolve the step."""
        exact = (t + h).mid()
        rounded = float(exact)
        return self._ball(rounded) if h > _RESOLVED * abs(rounded) else exact

    def _coefficients(
        self, t: Any, q: Sequence[Any], v: Sequence[Any], order: int
    ) -> list[list[Any]]:
        """The series of each coordinate up to the order."""
        series, context = self._series, self._context
        x = [[position, velocity] for position, velocity in zip(q, v, strict=True)]
        usual = context.cap
        try:
            while len(x[0]) <= order:
                known = len(x[0]) - (2 - self._gain)
                context.cap = known
                places = [series(c[:known]) for c in x]
                rates = [series([k * c[k] for k in range(1, known + 1) if k < len(c)]) for c in x]
                try:
                    found = self.motion.accelerations(series([t, 1]), *places, *rates)
                except (ZeroDivisionError, ValueError):
                    raise CannotGoOn(float(t), q, v, "something is divided by 0") from None
                self.evaluations += 1
                for c, a in zip(x, found, strict=True):
                    for k in range(len(c) - 2, known):
                        value = a[k] if isinstance(a, series) else a if k == 0 else 0
                        c.append(self._ball(value).mid() / ((k + 1) * (k + 2)))
                    if not c[-1].is_finite():
                        raise CannotGoOn(float(t), q, v, "something is not defined")
        finally:
            context.cap = usual
        return x

    def _see(self, series: list[list[Any]], tolerance: Tolerance, *, first: bool) -> None:
        """Tell the scales where it is and, for what begins at 0, where it goes at first."""
        h = _FIRST * tolerance.longest if first else 0.0
        low = [[float(x) for x in c[:4]] for c in series]
        change = [0.0 if c[0] else c[1] * h + c[2] * h * h for c in low]
        change += [0.0 if c[1] else 2 * c[2] * h + 3 * c[3] * h * h for c in low]
        tolerance.see([c[0] for c in low], [c[1] for c in low], change)

    def _length(self, series: list[list[Any]], tolerance: Tolerance) -> float:
        """The step after which the last terms are the tolerance times the scale."""
        exponent, n, allowed = math.inf, self.n, math.log2(tolerance.value)
        for j, c in enumerate(series):
            place, rate = (allowed + math.log2(tolerance.scales[k]) for k in (j, n + j))
            for k in range(len(c) - _LOOKED_AT, len(c)):
                size = log2_size(c[k])
                exponent = min(exponent, (place - size) / k, (rate - size - math.log2(k)) / (k - 1))
        return _SAFETY * math.exp2(min(exponent, _LONGEST))

    def _inside(self, start: Any, end: Any, series: list[list[Any]]) -> Any:
        """Positions, velocities and accelerations anywhere in the step.

        A double or a fraction between its ends; a step may be shorter than doubles are apart.
        """
        first, last, number = float(start), float(end), self.motion.arithmetic.number

        def at(t: float) -> tuple[list[Any], list[Any], list[Any]]:
            exact = start if t <= first else end if t >= last else number(Fraction(t))
            return self._at(exact - start, series)

        return at

    def _at(self, h: Any, series: list[list[Any]]) -> tuple[list[Any], list[Any], list[Any]]:
        """Positions, velocities and accelerations a time h after the beginning of a step."""
        q, v, a = [], [], []
        for c in series:
            x = u = b = self._ball(0)
            for coefficient in reversed(c):
                b = b * h + u * 2
                u = u * h + x
                x = x * h + coefficient
            q.append(x.mid())
            v.append(u.mid())
            a.append(b.mid())
        return q, v, a


def log2_size(x: Any) -> float:
    """The logarithm of the size, which may be no double; -inf for 0."""
    mantissa, exponent = x.mid().man_exp()
    return math.log2(abs(int(mantissa))) + int(exponent) if mantissa else -math.inf


def order_for(tolerance: float) -> int:
    """The order at which a step costs least for its length."""
    return max(_LOWEST, math.ceil(1 - math.log(tolerance) / 2))
