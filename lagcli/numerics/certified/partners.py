"""Which row of one run stands for which of another, where things happen on the way."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.integrators.steps import DEPENDENT, SINGULAR_MASS


class Partners:
    """The rows of one run that those of another are compared with.

    Attributes
    ----------
    agree
        Whether both go through the same events.
    late
        Twice the difference of the times of each event.
    """

    def __init__(self, coarse: Run, fine: Run) -> None:
        self._marks = coarse.marks
        self._samples = {m.sample: place for place, m in enumerate(coarse.marks) if m.sample >= 0}
        self._sides = {
            (m.phase, m.begins): place for place, m in enumerate(coarse.marks) if m.sample < 0
        }
        same = 0
        for (_, one), (_, other) in zip(coarse.events, fine.events, strict=False):
            if (one.name, one.what) != (other.name, other.what):
                break
            same += 1
        self.agree = same == len(coarse.events) == len(fine.events)
        self.late = [
            2 * abs(one.t - other.t)
            for (_, one), (_, other) in zip(coarse.events[:same], fine.events, strict=False)
        ] + [float("inf")] * (len(fine.events) - same)
        # phases up to the first event that differs
        self._phases = fine.events[same][0] if same < len(fine.events) else len(fine.phases)
        if same < len(coarse.events):
            self._phases = min(self._phases, coarse.events[same][0])

    def places(self, marks: Sequence[Mark]) -> list[int]:
        """The place of each of these rows, up to the first that has none."""
        if not self._sides and [mark.sample for mark in marks] == [*self._samples]:
            return [*range(len(marks))]  # nothing happens on the way
        found: list[int] = []
        for mark in marks:
            place = self(mark)
            if place is None:
                break
            found.append(place)
        return found

    def __call__(self, mark: Mark) -> int | None:
        """The place of the same row in the coarser run; None where there is none."""
        if mark.phase > self._phases:
            return None
        if mark.sample < 0:
            return self._sides.get((mark.phase, mark.begins))
        place = self._samples.get(mark.sample)
        if place is not None and self._marks[place].phase == mark.phase:
            return place
        # one run is already beyond the event: the nearest state on the same side
        ahead = place is None or self._marks[place].phase > mark.phase
        return self._sides.get((mark.phase, not ahead))


def both_stop(coarse: Run, fine: Run, good: int, accuracy: float) -> bool:
    """Whether the motion itself ends, at a time that both runs know."""
    if fine.steps >= fine.step_limit:
        return True
    if coarse.stop is None or fine.stop is None:
        return False
    together = abs(coarse.stop.t - fine.stop.t) <= accuracy * fine.stop.t
    together = together or coarse.stop.reason == fine.stop.reason in (DEPENDENT, SINGULAR_MASS)
    return together and good >= min(len(coarse.marks), len(fine.marks))


def why_apart(coarse: Run, fine: Run, good: int, partner: Partners) -> str:
    """Why two runs without an error beyond the accuracy are not one motion to the end."""
    if fine.stop is not None:
        return ""
    if (coarse.event is None) != (fine.event is None):
        return "whether the event takes place is within the error"
    if not partner.agree:
        return "which event comes next is within the error"
    return "" if good < len(fine.marks) else "the two runs end at different rows"
