"""A motion of thirty digits from the definitions alone, to test first integrals on.

The accelerations are those of the numeric equations of `states.with_motion`; the steps are
the modified midpoint rule with 2, 4, 6, … substeps, extrapolated to none (Gragg, Bulirsch,
Stoer); see Hairer, Noersett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
section II.9.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from mpmath import mpf

from .evaluate import Moment
from .jets import OutsideDomain
from .reference import Reference, Scalar
from .states import random_moments, with_motion

STAGES = 10
STARTS = 24
SPAN = mpf(1) / 8
FIRST_STEP = SPAN / 4
#: The difference of the last two extrapolations, of which the better one is kept.
ERROR = mpf(10) ** -28
SMALLEST = SPAN / 150

Row = list[mpf]
Rates = Callable[[mpf, Row], Row]


class NoMotion(Exception):
    """The equations do not determine the accelerations, or every motion ends too soon."""


def motion(reference: Reference, needed: Sequence[Scalar] = ()) -> list[Moment]:
    """Moments along a motion on the constraints, of length SPAN.

    Parameters
    ----------
    reference
        The problem.
    needed
        Functions that are real at the start: parameters of either sign may make them not.

    Raises
    ------
    NoMotion
        Where the accelerations are not determined, or no such start was found.
    """
    for start in random_moments(reference, STARTS, seed=5):
        if not with_motion(reference, start).regular:
            raise NoMotion
        try:
            for function in needed:
                function(start)
            return _from(reference, start)
        except (OutsideDomain, ZeroDivisionError, NoMotion):
            continue
    raise NoMotion


def _from(reference: Reference, start: Moment) -> list[Moment]:
    size = reference.size

    def at(t: mpf, y: Row) -> Moment:
        return replace(start, t=t, chain=(tuple(y[:size]), tuple(y[size:]), start.chain[2]))

    def rates(t: mpf, y: Row) -> Row:
        return [*y[size:], *with_motion(reference, at(t, y)).accelerations]

    t, y = start.t, [*start.chain[0], *start.chain[1]]
    end, step = t + SPAN, FIRST_STEP
    found = [at(t, y)]
    while t < end:
        step = min(step, end - t)
        after, error = _extrapolated(rates, t, y, step)
        if error > ERROR:
            step /= 2
            if step < SMALLEST:
                raise NoMotion
            continue
        t, y = t + step, after
        found.append(at(t, y))
    return found


def _extrapolated(rates: Rates, t: mpf, y: Row, step: mpf) -> tuple[Row, mpf]:
    """The state a step later and the estimate of its error."""
    last: list[Row] = []
    for k in range(1, STAGES + 1):
        row = [_midpoint(rates, t, y, step, 2 * k)]
        for j in range(1, k):
            ratio = (mpf(k) / (k - j)) ** 2 - 1
            row.append([a + (a - b) / ratio for a, b in zip(row[-1], last[j - 1], strict=True)])
        last = row
        error = max(abs(a - b) for a, b in zip(row[-1], row[-2], strict=True)) if k > 1 else mpf(1)
        if error < ERROR:
            break
    return last[-1], error


def _midpoint(rates: Rates, t: mpf, y: Row, step: mpf, count: int) -> Row:
    h = step / count
    before, now = y, _moved(y, h, rates(t, y))
    for k in range(1, count):
        before, now = now, _moved(before, 2 * h, rates(t + k * h, now))
    return [(a + b) / 2 for a, b in zip(now, _moved(before, h, rates(t + step, now)), strict=True)]


def _moved(y: Sequence[mpf], h: mpf, slope: Sequence[mpf]) -> Row:
    return [a + h * b for a, b in zip(y, slope, strict=True)]
