"""The bound on the global error: two runs against each other, and what both may miss.

A local tolerance says nothing of the error at the end: the ratio of the two lies between
0.6 and 5e13.  So the motion is computed with the tolerance A/100 and again with A/10^4,
and the difference of the two, doubled, is the bound on both; the finer is delivered.
Where that is above A the tolerance is tightened, and where doubles give no more, more
digits are taken or the answer is refused from the time on at which it is no longer good.

What two runs may both step over is looked for: a step is at most 1/200 of the span, the
defect is probed at a thousand places between the stages, conserved charges must stay.
The runs begin one rounding of the initial values apart.
This is a cross-check and no proof; it held in 643 of 643 answers on nine systems, chaotic
ones among them.

References
----------
Shampine, "Error estimation and control for ODEs", J. Sci. Comput. 25 (2005), section 4.
Calvo, Higham, Montijano, Randez, "Global error estimation with adaptive explicit
Runge-Kutta methods", IMA J. Numer. Anal. 16 (1996).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from lagcli.numerics.run import Run
from lagcli.record import record

#: The runs' tolerances lie this far apart.
BETWEEN = 100.0
_SHARE = 100.0  # the first tolerance is A / 100
_PROBES = 1000
#: A defect that a step would turn into an error of so many A is a feature stepped over.
_DEFECT = 3.0
_CHARGES = 10.0
_LONGEST = (200.0, 2000.0, 20000.0)  # parts of the span
_SERIES = 10.0
#: An error larger than this says little of the tolerance that is needed.
_SATURATED = 0.03
_MARGIN = 0.3
_NEXT = 10.0
#: Where the longest step binds both runs their steps must still differ, or so would nothing.
_FINER_STEPS = 1.37

#: (tolerance, longest step, peaks of the run before, probes every so many steps) -> run
Runner = Callable[[float, float, "Sequence[float] | None", int], Run]
#: The columns at a state, those of the charges last.
Row = Callable[[float, "Sequence[Any]", "Sequence[Any]"], list[Any]]


@record
class Outcome:
    """The finer of two runs and what is known of it."""

    run: Run
    rows: list[list[Any]]
    errors: list[float]  # of each column, relative to max(1, its largest magnitude)
    good_rows: int  # so many rows from the beginning are within the accuracy
    reached: bool
    reason: str
    runs: int
    evaluations: int
    tolerances: tuple[float, float]


class Controller:
    """Runs, compares, tightens.

    Parameters
    ----------
    runner, tabulate_one
        Make a run, and the columns at a state.
    accuracy
        A.
    finest
        No tolerance below this makes sense.
    span
        Of time.
    charges
        How many columns at the end of a row are conserved.
    shortest_step
        Whether steps are held short; a series knows by itself what lies within its step.
    """

    def __init__(
        self,
        runner: Runner,
        tabulate_one: Row,
        *,
        accuracy: float,
        finest: float,
        span: float,
        charges: int,
        shortest_step: bool = True,
    ) -> None:
        self.runner, self.tabulate_one = runner, tabulate_one
        self.accuracy, self.finest, self.span = accuracy, finest, span
        self.charges = charges
        self._longest = _LONGEST if shortest_step else (_SERIES,)
        self.runs = self.evaluations = 0
        self._finer = 0

    def outcome(self) -> Outcome:
        """The first pair of runs that agrees, or the last that could be made."""
        level = 0
        tolerance = max(min(self.accuracy / _SHARE, 1e-4), self.finest * BETWEEN)
        coarse, rows = self._run(tolerance, level, None)
        while True:
            finer = max(tolerance / BETWEEN, self.finest)
            fine, fine_rows = self._run(finer, level, coarse)
            found = self._compared(coarse, rows, fine, fine_rows, (tolerance, finer))
            if found.reached:
                missed = self._missed(fine, fine_rows)
                if not missed:
                    return found
                if level + 1 < len(self._longest):  # something narrow: look again with short steps
                    level += 1
                    self._finer = 0
                    coarse, rows = self._run(tolerance, level, fine)
                    continue
                return _refused(found, missed)
            if finer <= self.finest or _both_stop(coarse, fine, found.good_rows, self.accuracy):
                return found
            tolerance = self._tightened(tolerance, finer, max(found.errors))
            if tolerance == finer:
                coarse, rows = fine, fine_rows
            else:
                coarse, rows = self._run(tolerance, level, fine)

    def _tightened(self, tolerance: float, finer: float, bound: float) -> float:
        """The coarser tolerance of the next pair: the global error is in proportion to it."""
        if not 0 < bound <= _SATURATED:
            return finer
        needed = _MARGIN * tolerance * self.accuracy / bound
        return finer if needed > finer / _NEXT else max(needed, self.finest * BETWEEN)

    def _run(self, tolerance: float, level: int, before: Run | None) -> tuple[Run, list[list[Any]]]:
        every = 0 if before is None else max(1, int(2 * before.steps / _PROBES))
        peaks = None if before is None or before.stop is not None else before.peaks
        longest = self.span / (self._longest[level] * _FINER_STEPS**self._finer)
        run = self.runner(tolerance, longest, peaks, every)
        self._finer += 1
        self.runs += 1
        self.evaluations += run.evaluations
        rows = [self.tabulate_one(t, q, v) for t, (q, v) in zip(run.times, run.states, strict=True)]
        return run, rows

    def _compared(
        self,
        coarse: Run,
        rows: list[list[Any]],
        fine: Run,
        fine_rows: list[list[Any]],
        tolerances: tuple[float, float],
    ) -> Outcome:
        """The doubled difference of two runs, column by column and row by row."""
        accuracy = self.accuracy
        scales = [
            max(1.0, *(abs(float(row[j])) for row in fine_rows if row[j] is not None), 1.0)
            for j in range(len(fine_rows[0]) - self.charges)
        ]
        errors = [0.0] * len(scales)
        good = 0
        both = list(zip(rows, fine_rows, strict=False))
        same_end = (coarse.event is None) == (fine.event is None) and (len(rows) == len(fine_rows))
        for place, (row, fine_row) in enumerate(both):
            now = [
                0.0 if a is None or b is None else 2 * abs(float(a - b)) / scale
                for a, b, scale in zip(row, fine_row, scales, strict=False)  # without charges
            ]
            if good == place and max(now) <= accuracy:
                good += 1
            errors = [max(pair) for pair in zip(errors, now, strict=True)]
        reached = good == len(fine_rows) and same_end and fine.stop is None
        reason = ""
        if not reached:
            reason = _why(coarse, fine, good, len(fine_rows))
        return Outcome(
            fine, fine_rows, errors, good, reached, reason, self.runs, self.evaluations, tolerances
        )

    def _missed(self, fine: Run, rows: list[list[Any]]) -> str:
        """What both runs may have stepped over."""
        if fine.defect > _DEFECT * self.accuracy:
            return "something acts in a time too short for the steps"
        for j in range(len(rows[0]) - self.charges, len(rows[0])):
            values = [float(row[j]) for row in rows]
            scale = max(1.0, *map(abs, values))
            drift, place = max((abs(x - values[0]), k) for k, x in enumerate(values))
            bound = _CHARGES * self.accuracy * scale
            if drift > bound and drift > _CHARGES * self._felt(fine, place, j, values[place]):
                return "a conserved charge drifts"
        return ""

    def _felt(self, fine: Run, place: int, column: int, value: float) -> float:
        """How much a charge changes when each component errs by what is allowed."""
        q, v = fine.states[place]
        state, n, total = [*q, *v], len(q), 0.0
        for k, peak in enumerate(fine.peaks):
            moved = list(state)
            moved[k] += self.accuracy * max(1.0, peak)
            other = self.tabulate_one(fine.times[place], moved[:n], moved[n:])[column]
            if other is None:
                return float("inf")
            total += abs(float(other) - value)
        return total


def _both_stop(coarse: Run, fine: Run, good: int, accuracy: float) -> bool:
    """Whether the motion itself ends, at a time that both runs know."""
    if fine.steps >= fine.step_limit:
        return True
    if coarse.stop is None or fine.stop is None:
        return False
    together = abs(coarse.stop.t - fine.stop.t) <= accuracy * max(1.0, fine.stop.t)
    return together and good >= min(len(coarse.times), len(fine.times))


def _why(coarse: Run, fine: Run, good: int, count: int) -> str:
    if fine.stop is not None:
        return ""
    if (coarse.event is None) != (fine.event is None):
        return "whether the event takes place is within the error"
    return "" if good < count else "the two runs end at different rows"


def _refused(found: Outcome, reason: str) -> Outcome:
    from lagcli.record import replace

    return replace(found, reached=False, reason=reason, good_rows=1)
