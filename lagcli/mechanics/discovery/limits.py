"""How much work a search may take, and the sign that it would take more."""

from __future__ import annotations

from lagcli.platform.effort import EFFORT, Work

#: Units of work for the whole of a discovery: what is not done by then is left out, and said so.
UNITS = 16_000_000
#: Unknowns of one linear system.
MOST_UNKNOWNS = 1200


class TooMuchWork(Exception):
    """The search was stopped."""


class Allowance(Work):
    """The work that a search, or a part of it, may do."""

    def __init__(self, units: float = UNITS) -> None:
        super().__init__(units)

    def check(self) -> None:
        """Raise TooMuchWork when none is left."""
        if self.over:
            raise TooMuchWork

    def spend(self, units: int) -> None:
        """Count work that nothing else counts; raise TooMuchWork when none is left."""
        EFFORT.done += units
        self.check()

    def part(self, share: float) -> Allowance:
        """An allowance of a share of what is left."""
        return Allowance(max(0.0, self.left) * share)
