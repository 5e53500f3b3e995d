"""What the error of a column is measured against, in whatever units the file is written.

That of a coordinate or a velocity against its largest magnitude along the run; a velocity's is
at least that of its coordinate over the span.  One that would be 0 but for rounding, of which
two runs know no digit, is measured against the largest of its kind.  That of a formula against
its largest magnitude, or the sum of the absolute values of its terms as far as that is below 1:
where they cancel, doubles know no more.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import islice
from typing import Any

from lagcli.graph.nodes import Node, mask_of
from lagcli.numerics.equations.columns import given
from lagcli.numerics.hybrid.charges import Sizes
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import SMALL, component_tops, with_own_time

#: Rounding differs by less than this part of the largest of its kind.
_ROUNDING = 1e-12
#: A bound on a column that is this part of it leaves no digit.
_UNKNOWN = 0.01
#: A step of this tolerance would have known some.
_RESOLVES = 1e-10
#: Of what rounding makes of the column that feels it most, any other is taken to feel this part:
#: three bodies of Lagrange, a saddle, had 1/20 of it in two runs, and 1/9 in the error.
_FELT = 1 / 8
#: What rounding grows to in stable motions, in tens of it: steps add to it.
_STEADY, _DRIFT = 2.0, 30.0
#: What is no component of the state.
_TIME, _FORMULA = -1, -2


class Scales:
    """The scales of the columns of a setup.

    Parameters
    ----------
    setup
        The request.
    """

    def __init__(self, setup: Setup) -> None:
        self._setup = setup
        e = setup.equations
        state: dict[Node, int] = {symbol: j for j, symbol in enumerate((*e.q, *e.qdot))}
        # the place of each column in the state
        self._places = [state.get(node, _FORMULA) for node in setup.nodes]
        for j, column in enumerate(setup.request.columns):
            if column.expression is None:
                self._places[j] = _TIME
        self._sizes: tuple[Run, dict[int, float]] | None = None

    def __call__(
        self, run: Run, rows: Sequence[Sequence[Any]], bounds: Sequence[float], tolerance: float
    ) -> list[float]:
        """The scale of each column over rows that count.

        Parameters
        ----------
        run, rows
            The finer of two runs, and what counts of its rows.
        bounds
            On the error of each column.
        tolerance
            That of the run.
        """
        columns = islice(zip(*rows, strict=True), len(self._places))
        peaks = list(map(_peak, columns)) or [0.0] * len(self._places)
        if self._sizes is None or self._sizes[0] is not run:
            self._sizes = run, self._of_formulas(run)
        accuracy, until = self._setup.request.accuracy, self._setup.request.until
        # near a singularity at which a run stops they are without bound; where rows are left out,
        # nothing is known of what lies behind them
        is_whole = run.stop is None and len(rows) == len(run.marks)
        marks = run.marks[: len(rows)] or run.marks[:1]
        sizes = with_own_time(run.peaks if is_whole else _peaks(marks), until)
        tops = component_tops(sizes)
        found = []
        for j, (place, peak, bound) in enumerate(zip(self._places, peaks, bounds, strict=True)):
            if place == _TIME:
                scale = until
            elif place == _FORMULA:
                scale = max(peak, self._sizes[1].get(j, 0.0))
            else:
                peak = max(peak, sizes[place])
                top = tops[place]
                is_zero = (
                    bound > accuracy * peak
                    and tolerance <= _RESOLVES
                    and peak <= SMALL * top
                    and _UNKNOWN * peak <= bound <= _ROUNDING * top
                )
                scale = top if is_zero else peak
            found.append(scale)
        return found

    def _of_formulas(self, run: Run) -> dict[int, float]:
        """Of each formula the sum of the absolute values of its terms along a run, at most 1.

        What is solved for stands beside the forces that it follows from.
        """
        setup = self._setup
        places = [j for j, place in enumerate(self._places) if place == _FORMULA]
        if not places or not run.marks:
            return {}
        e, reading = setup.equations, setup.reading
        solved = mask_of((*reading.accelerations, *reading.multipliers))
        plain = [j for j in places if not setup.nodes[j].mask & solved]
        nodes = [*(setup.nodes[j] for j in plain), *e.forcing]
        sizes = Sizes(e, nodes, run.phases[0].mode.modes.constants)
        largest = sizes.largest(run.marks, range(len(run.marks)))
        forces = max(largest[len(plain) :], default=0.0)
        found = dict.fromkeys(places, forces) | dict(zip(plain, largest, strict=False))
        return {j: min(1.0, size) for j, size in found.items()}


def _peaks(marks: Sequence[Mark]) -> list[float]:
    """The largest magnitude of each component at some rows."""
    return list(map(_peak, zip(*((*mark.q, *mark.v) for mark in marks), strict=True)))


def _peak(column: Sequence[Any]) -> float:
    """The largest magnitude; 0 of a column that is defined nowhere."""
    return max(map(abs, map(float, given(column))), default=0.0)


def relative(error: float, scale: float) -> float:
    """An error beside a scale; 0 where there is none."""
    return (error / scale if scale else math.inf) if error else 0.0


def at_rounding(errors: Sequence[float], gain: float, most: float) -> list[float]:
    """Bounds where two runs may be apart by rounding, which they are by chance.

    Parameters
    ----------
    errors : sequence of float
        Bounds by the usual multiple of the difference, relative to the scales of the columns.
    gain : float
        The multiple at rounding beside that one.
    most : float
        A bound below it may come of rounding: the tolerance of the coarser run is not met so well.
    """
    found = [max(x, min(gain * x, most)) for x in errors]
    least = _FELT * min(max(found, default=0.0), most)
    return [max(x, least) if x else x for x in found]


def is_enlarged(run: Run, errors: Sequence[float], rounded: float) -> bool:
    """Whether something narrow, or an unstable motion, has enlarged rounding.

    Two runs may then be near each other by chance: of 27 of three bodies of Lagrange the error of
    five was more than 20 differences, and of one 45.

    Parameters
    ----------
    errors : sequence of float
        Multiples of the difference of two runs, relative to the scales.
    rounded : float
        That multiple of ten roundings; 0 where they are not known.
    """
    steady = rounded * (_STEADY + run.steps / _DRIFT)
    return bool(run.shortened) or 0 < steady < max(errors, default=0.0)


def first_beyond(columns: Sequence[Sequence[float]], limits: Sequence[float]) -> int | None:
    """The first row in which a column is above its limit; None where there is none."""
    return min(
        (
            next(row for row, x in enumerate(column) if x > limit)
            for column, limit in zip(columns, limits, strict=False)
            if max(column, default=0.0) > limit
        ),
        default=None,
    )
