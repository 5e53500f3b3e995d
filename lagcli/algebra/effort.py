"""Work that is counted, not timed, so that a search ends at the same place on every machine.

One unit is about a microsecond on a processor of 2020.  What costs much counts its own work:
the arithmetic of fields by the terms that it multiplies, values modulo a prime by the nodes
that they are made of, eliminations by rows and columns, calls of SymPy by a typical cost.
"""

from __future__ import annotations


class Effort:
    """All work done so far.

    Attributes
    ----------
    done
        In units; only differences mean anything.
    """

    __slots__ = ("done",)

    def __init__(self) -> None:
        self.done = 0


EFFORT = Effort()


class Work:
    """A number of units that may still be done, from now on.

    Parameters
    ----------
    units
        How many.
    """

    def __init__(self, units: float) -> None:
        self._end = EFFORT.done + units

    @property
    def left(self) -> float:
        """Units that are left; negative where more than allowed was done."""
        return self._end - EFFORT.done

    @property
    def over(self) -> bool:
        """Whether none is left."""
        return EFFORT.done > self._end
