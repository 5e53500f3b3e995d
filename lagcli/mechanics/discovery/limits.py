"""How long a search may take, and the sign that it took longer."""

from __future__ import annotations

from time import process_time

#: Seconds for the whole of a discovery: what is not done by then is left out, and said so.
SECONDS = 24.0
#: Unknowns of one linear system.
MOST_UNKNOWNS = 1200


class OutOfTime(Exception):
    """The search was stopped."""


class Clock:
    """A deadline in processor time, so that a busy machine finds as much as an idle one.

    Parameters
    ----------
    seconds
        From now on.
    """

    def __init__(self, seconds: float = SECONDS) -> None:
        self._end = process_time() + seconds

    @property
    def left(self) -> float:
        """Seconds that are left."""
        return self._end - process_time()

    def check(self) -> None:
        """Raise OutOfTime when none are left."""
        if process_time() > self._end:
            raise OutOfTime

    def part(self, share: float) -> Clock:
        """A clock for a share of the time that is left."""
        return Clock(max(0.0, self.left) * share)
