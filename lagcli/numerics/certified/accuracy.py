"""The bound on the global error: two runs against each other, and what both may miss.

A local tolerance says nothing of the error at the end: the ratio of the two lies between
0.6 and 5e13.  So the motion is computed with the tolerance A/100 and again with A/10^4,
and the difference of the two, doubled, is the bound on both; the finer is delivered.
Where that is above A the tolerance is tightened, and where doubles give no more, more
digits are taken or the answer is refused from the time on at which it is no longer good.

What two runs may both step over is looked for: a step is at most 1/200 of the span, the
defect is probed at a thousand places between the stages, conserved charges must stay.
The runs begin one rounding of the initial values apart, and more: see `perturbed_twin`.

Where things happen on the way (impacts, contacts lost), both runs must go through the same
events in the same order.  A time that lies after an event in one run and before it in the
other is within the error of that event: there the state on the same side is compared, and
the times of the events are compared as every other number.  It is a cross-check, no proof.

References
----------
Shampine, "Error estimation and control for ODEs", J. Sci. Comput. 25 (2005), section 4.
Calvo, Higham, Montijano, Randez, "Global error estimation with adaptive explicit
Runge-Kutta methods", IMA J. Numer. Anal. 16 (1996).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import islice
from operator import add, sub
from typing import Any

from lagcli.numerics.certified.clock import clock_errors, column_changes
from lagcli.numerics.certified.drift import changes
from lagcli.numerics.certified.partners import Partners, both_stop, why_apart
from lagcli.numerics.certified.rank import RankPlace, places
from lagcli.numerics.certified.scales import (
    Scales,
    at_rounding,
    first_beyond,
    is_enlarged,
    relative,
)
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.integrators.steps import DEPENDENT, StopWithReason, component_scales
from lagcli.record import record, replace

#: The runs' tolerances lie this far apart.
BETWEEN = 100.0
_SHARE = 100.0  # the first tolerance is A / 100
_PROBES = 1000
#: A defect that a step would turn into an error of this multiple of A is a feature stepped over.
_DEFECT = 3.0
#: So many differences of two runs bound the error: this is measured, not derived.  Where the finer
#: one meets rounding, the two differ by chance.  Against 34 digits the error was then up to 9
#: differences in 390 pairs of nine problems with series in machine code, and up to 5 (once in 4300
#: columns of eleven problems) with dop853; implicit and symplectic methods meet rounding at the
#: finest tolerance only, with up to 4.
#: Where steps were shortened for what is narrow the error was up to 43 (once in 1300 runs) and 213
#: (once in 200) differences: a third run, of a tolerance _THIRD of the coarse one's, is compared.
#: On 51 motions that were new to these numbers, at four accuracies, no error was above 0.45 of its
#: bound, and on 290 grazes, barriers, kinks and near collisions none above 0.56, but for one of 1.5
#: before both comparisons counted (`worse`).  Of 360 runs that pass a saddle, where
#: rounding is enlarged, 20 errors were up to 20 times this bound: with the multiple for
#: chance at any size (`_grows`) two were 10 and 1.1 times it, the others 0.9 of it at most.
#: Of 840 that pass one of five saddles two were 1.8 and 2.2 times it: with the third run, which
#: such motions have, too, one of 1,080, 2.1 times.
USUAL, CHANCE, NARROW, _THIRD = 2.0, 20.0, 60.0, 3.0
_CHARGES = 10.0
LONGEST = (200.0, 2000.0, 20000.0)  # parts of the span
#: An error larger than this says little of the tolerance that is needed.
SATURATED = 0.03
_MARGIN = 0.3
_NEXT = 10.0
#: Runs at rounding that differ by more than this part of what those before them differed by, whose
#: tolerances were a hundred times coarser, gain nothing more; so far above A it is out of reach.
_NO_GAIN, _FAR = 0.5, 5.0
#: A difference that grows as t^3 is 64 times as large at the end as after a quarter.
_GROWS = 200.0
#: Runs that begin at less have all digits that help where constraints become dependent.
_SHARP = 1e-16
#: Intervals that are compared between two rows where the accuracy is lost.
_CLOSER = 64
#: Where the longest step binds both runs their steps must still differ, or so would nothing.
_FINER_STEPS = 1.37

#: (tolerance, longest step, peaks of the run before, probes at this interval of steps, whether with
#: a slow clock where others have a fast one, other rows than the usual ones) -> run
Runner = Callable[
    [float, float, "Sequence[float] | None", int, bool, "Sequence[float] | None"], Run
]


@record
class Outcome:
    """The finer of two runs and what is known of it."""

    run: Run
    rows: list[list[Any]]
    errors: list[float]  # of each column, relative to its scale
    scales: list[float]  # of the columns
    held: list[float]  # the same over the rows that are within the accuracy
    held_scales: list[float]  # and their scales
    times: list[float]  # the errors of the times of the events
    lost_at: float  # the time from which no digit is known
    good_rows: int  # rows from the beginning that are within the accuracy
    reached: bool
    reason: str
    runs: int
    evaluations: int
    tolerances: tuple[float, float]
    multiples: tuple[float, float]  # of the differences, the least and the largest in `held`
    is_against_two: bool  # the finer run was compared with two others
    looked_at: int | None  # the rows that are usual, where others lie between those that follow
    controller: Controller  # what can look more closely at where it fails


class Controller:
    """Runs, compares, tightens.

    Parameters
    ----------
    runner
        Makes a run.
    accuracy
        A.
    first, finest
        No run is made with a tolerance above, or below.
    rounded, chance
        Runs with this tolerance or less meet rounding: a multiple of the differences bounds the
        error, at the finest tolerance 20.
    span
        Of time.
    charges
        How many columns at the end of a row are conserved.
    scales
        What the errors of the columns are relative to.
    longest
        The longest step as parts of the span: at first, and where something was missed.
    """

    def __init__(
        self,
        runner: Runner,
        *,
        accuracy: float,
        finest: float,
        span: float,
        charges: int,
        scales: Scales,
        first: float = math.inf,
        rounded: float = 0.0,
        chance: float = CHANCE,
        longest: Sequence[float] = LONGEST,
    ) -> None:
        self.runner = runner
        self.accuracy, self.first, self.finest, self.span = accuracy, first, finest, span
        self.charges, self.rounded, self.chance = charges, rounded, chance
        self._scales, self._longest = scales, longest
        self.runs = self.evaluations = self._finer = self._level = 0
        self._is_refused = self.is_unstable = False
        self._furthest: Outcome | None = None

    def outcome(self) -> Outcome:
        """The first pair of runs that agrees, or the last that could be made."""
        level, apart = 0, math.inf
        tolerance = max(min(self.accuracy / _SHARE, self.first, 1e-4), self.finest * BETWEEN)
        coarse, rows = self._run(tolerance, level, None)
        while True:
            finer = max(tolerance / BETWEEN, self.finest)
            fine, fine_rows = self._run(finer, level, coarse)
            found = self._compared(coarse, rows, fine, fine_rows, (tolerance, finer))
            third = None
            enlarged = self.is_unstable or max(found.errors, default=0.0) >= self.accuracy
            if found.reached and (fine.shortened or enlarged):
                third = self._run(tolerance / _THIRD, level, fine, slow=True)
                found = self._worse(found, third)
            self._furthest = self.furthest(found)
            if found.reached or self._stepped_over(fine):
                missed = self._missed(fine, fine_rows)
                if not missed:
                    return found
                if met := places(fine, fine.marks):
                    return ended(found, met[0])
                if level + 1 < len(self._longest):  # something narrow: look again with short steps
                    level += 1
                    self._finer, self._level, apart = 0, level, math.inf
                    self._furthest = None
                    coarse, rows = self._run(tolerance, level, fine)
                    continue
                self._is_refused = True
                return replace(found, reached=False, reason=missed, good_rows=1)
            if finer <= self.finest or both_stop(coarse, fine, found.good_rows, self.accuracy):
                return found
            bound = max(found.errors)
            before, apart = apart, bound / self.factor(finer, fine)
            gains = finer > self.rounded or apart <= _NO_GAIN * before
            out_of_reach = not gains and _FAR * self.accuracy < bound <= SATURATED
            if out_of_reach or (self.first < _SHARP and places(fine, fine.marks)):  # branches
                return found
            tolerance = self._tightened(tolerance, finer, bound)
            if tolerance == finer:
                coarse, rows = third or (fine, fine_rows)
            else:
                coarse, rows = self._run(tolerance, level, fine)

    def furthest(self, found: Outcome) -> Outcome:
        """The pair of runs that held longest: at rounding the bound is taken larger for chance."""
        before = self._furthest
        if before is None or self._is_refused or found.run.stop or found.reason:
            return found
        return before if before.good_rows > found.good_rows else found

    def factor(self, tolerance: float, fine: Run) -> float:
        """Times the difference of two runs that bounds the error, by the finer one.

        What is narrow enlarges rounding, by which the two then differ at any tolerance; so they do
        where events are met, between which a motion may be a polynomial.
        """
        if fine.shortened:
            return NARROW
        if tolerance <= self.finest:
            return CHANCE
        met = tolerance <= self.rounded or len(fine.events) > (fine.event is not None)
        return self.chance if met else USUAL

    def _tightened(self, tolerance: float, finer: float, bound: float) -> float:
        """The coarser tolerance of the next pair: the global error is in proportion to it."""
        if not 0 < bound <= SATURATED:
            return finer
        needed = _MARGIN * tolerance * self.accuracy / bound
        return finer if needed > finer / _NEXT else max(needed, self.finest * BETWEEN)

    def _worse(self, found: Outcome, third: tuple[Run, list[list[Any]]]) -> Outcome:
        """Of two comparisons with the finer run the one that says less.

        A fast clock may cancel what a motion feels of its initial values: a slow one then does not.
        """
        again = self._compared(*third, found.run, found.rows, found.tolerances)
        return replace(worse(found, again), is_against_two=True)

    def _run(
        self,
        tolerance: float,
        level: int,
        before: Run | None,
        *,
        slow: bool = False,
        times: Sequence[float] | None = None,
    ) -> tuple[Run, list[list[Any]]]:
        every = 0 if before is None else max(1, int(2 * before.steps / _PROBES))
        peaks = None if before is None or before.stop is not None else before.scales
        longest = self.span / (self._longest[level] * _FINER_STEPS**self._finer)
        run = self.runner(tolerance, longest, peaks, every, slow, times)
        self._finer, self.runs = self._finer + 1, self.runs + 1
        self.evaluations += run.evaluations
        return run, run.rows()

    def _compared(
        self,
        coarse: Run,
        rows: list[list[Any]],
        fine: Run,
        fine_rows: list[list[Any]],
        tolerances: tuple[float, float],
    ) -> Outcome:
        """The difference of two runs, doubled at least, column by column and row by row."""
        count = len(fine_rows[0]) - self.charges
        factor = self.factor(tolerances[1], fine)
        partner, clock = Partners(coarse, fine), clock_errors(fine, self.span)
        places = partner.places(fine.marks)
        others = zip(*(rows[place] for place in places), strict=True)
        pairs = zip(others, zip(*fine_rows, strict=True), strict=False)
        differences = [_distances(a, b, factor) for a, b in islice(pairs, count)]
        if clock:
            moved = [column_changes(fine, mark, clock) for mark in fine.marks[: len(places)]]
            columns = zip(differences, zip(*moved, strict=True), strict=False)
            differences = [[*map(add, *pair)] for pair in columns]
        bounds = list(map(max, differences)) or [math.inf] * count
        differences += [self._late(coarse, fine, places)] if places else []

        def scaled(kept: int) -> list[float]:
            return self._scales(fine, fine_rows[:kept], bounds, tolerances[1])

        scales = scaled(len(fine_rows))
        good, held, held_scales = self._held(differences, len(places), scaled)
        self.is_unstable |= self._grows(differences, scales, fine)
        most = USUAL * tolerances[0] if factor == USUAL else self.accuracy
        shown = self.accuracy if self.is_unstable else most
        found = [*map(relative, bounds, scales)]
        gain = (NARROW if is_enlarged(fine, found, factor * self.rounded) else self.chance) / factor
        largest = factor * (max(1.0, gain) if any(0 < x < shown for x in held) else 1.0)
        errors, held = at_rounding(found, gain, most), at_rounding(held, gain, shown)
        lost = first_beyond(differences, [SATURATED * scale for scale in [*scales, 1.0]])
        lost_at = math.inf if lost is None else fine.marks[lost].t
        same_end = (coarse.event is None) == (fine.event is None) and partner.agree
        reached = good == len(fine_rows) and same_end and fine.stop is None
        return Outcome(
            fine,
            fine_rows,
            errors,
            scales,
            held,
            held_scales,
            partner.late,
            lost_at,
            good,
            reached,
            "" if reached else why_apart(coarse, fine, good, partner),
            self.runs,
            self.evaluations,
            tolerances,
            (factor, largest),
            False,
            None,
            self,
        )

    def _grows(
        self, differences: Sequence[Sequence[float]], scales: Sequence[float], fine: Run
    ) -> bool:
        """Whether two runs part faster than t^3; chance may bring a later pair together again."""
        early = sum(mark.t <= self.span / 4 for mark in fine.marks)
        least = self.rounded or _SHARP
        return any(
            max(column, default=0.0) > _GROWS * max(least * scale, *column[:early], 0.0)
            for column, scale in zip(differences, scales, strict=False)
        )

    def _late(self, coarse: Run, fine: Run, places: Sequence[int]) -> list[float]:
        """Twice what the rows beside events are apart in time, as parts of the span."""
        return [
            0.0 if mark.sample >= 0 else 2 * abs(coarse.marks[place].t - mark.t) / self.span
            for place, mark in zip(places, fine.marks, strict=False)
        ]

    def _held(
        self, differences: list[list[float]], good: int, scaled: Callable[[int], list[float]]
    ) -> tuple[int, list[float], list[float]]:
        """How many rows are within the accuracy, and the error and scale of each column over these.

        Where not all are, the scale of a column is that of the rows that are left.
        """
        while True:
            scales = [*scaled(good), 1.0]
            kept = [column[:good] for column in differences]
            beyond = first_beyond(kept, [self.accuracy * scale for scale in scales])
            if beyond is None:
                break
            good = beyond
        worst = map(max, kept) if good else ()
        held = [relative(most, scale) for most, scale in zip(worst, scales, strict=False)][:-1]
        return good, held or [0.0] * (len(scales) - 1), scales[:-1]

    def refined(self, found: Outcome, usual: Sequence[float]) -> Outcome:
        """The same pair of runs, compared more closely where the accuracy is lost.

        Up to there they have the usual rows.
        """
        fine, good = found.run, found.good_rows
        if good < 2 or fine.steps >= fine.step_limit or self._is_refused:
            return found
        ends = [mark.t for mark in fine.marks[good : good + 1]]
        ends += [fine.stop.t] if fine.stop is not None else []
        if not ends or min(ends) <= fine.marks[good - 1].t:
            return found
        last, lost = fine.marks[good - 1].t, min(ends)
        kept = [t for t in usual if t <= last]
        step = (lost - last) / _CLOSER
        times = [*kept, *(last + step * k for k in range(1, _CLOSER)), lost]
        times += [self.span] if lost < self.span else []
        coarse, rows = self._run(found.tolerances[0], self._level, None, times=times)
        again, fine_rows = self._run(found.tolerances[1], self._level, coarse, times=times)
        closer = self._compared(coarse, rows, again, fine_rows, found.tolerances)
        coarser = found.tolerances[0] / _THIRD
        third = self._run(coarser, self._level, again, slow=True, times=times)
        closer = self._worse(closer, third)
        if closer.good_rows < good:
            return found
        # beyond these there is the end alone: what lies between was not within the accuracy
        looked_at = sum(mark.t <= lost for mark in again.marks)
        return replace(
            closer,
            errors=[*map(max, found.errors, closer.errors)],
            good_rows=min(closer.good_rows, looked_at),
            reached=False,
            reason=found.reason or closer.reason,
            looked_at=len(kept),
        )

    def _missed(self, fine: Run, rows: list[list[Any]]) -> str:
        """What both runs may have stepped over."""
        if self._stepped_over(fine):
            return "something acts in a time too short for the steps"
        for j in range(self.charges):
            column = len(rows[0]) - self.charges + j
            values = [row[column] for row in rows]
            for where, found, scale in changes(fine, j, values):
                drift = max(map(abs, found))
                if drift > _CHARGES * self.accuracy * scale:
                    worst = max(k for k, x in zip(where, found, strict=True) if abs(x) == drift)
                    errors = component_scales(fine.peaks, self.span)
                    errors = [self.accuracy * peak for peak in errors]
                    felt = column_changes(fine, fine.marks[worst], errors)[column]
                    if drift > _CHARGES * felt:
                        return "a conserved charge drifts"
        return ""

    def _stepped_over(self, fine: Run) -> bool:
        return fine.defect > _DEFECT * self.accuracy


def _distances(coarse: Sequence[Any], fine: Sequence[Any], factor: float) -> list[float]:
    """Of the values of a column in two runs, this factor times |a - b|; 0 where one has none."""
    if None not in coarse and None not in fine:
        return [factor * abs(d) for d in map(float, map(sub, coarse, fine))]
    pairs = zip(coarse, fine, strict=False)
    return [0.0 if a is None or b is None else factor * abs(float(a - b)) for a, b in pairs]


def worse(one: Outcome, other: Outcome) -> Outcome:
    """Of two comparisons the one with fewer rows; the larger bounds where both reach the end."""
    found = max(one, other, key=lambda each: (-each.good_rows, not each.reached, *each.held))
    if not (one.reached and other.reached):
        return found
    (least, largest), (others_least, others_largest) = one.multiples, other.multiples
    return replace(
        found,
        errors=[*map(max, one.errors, other.errors)],
        held=[*map(max, one.held, other.held)],
        multiples=(min(least, others_least), max(largest, others_largest)),
    )


def ended(outcome: Outcome, place: RankPlace) -> Outcome:
    """What is left before a place at which constraints become dependent."""
    run, good = outcome.run, outcome.good_rows
    good = max(1, sum(mark.t <= place.begin for mark in run.marks[:good]))
    if good == outcome.good_rows:
        return outcome
    at, last = (place.begin + place.end) / 2, run.marks[good - 1]
    run.stop = StopWithReason(at, last.q, last.v, DEPENDENT)
    return replace(outcome, reached=False, good_rows=good, reason=DEPENDENT)
