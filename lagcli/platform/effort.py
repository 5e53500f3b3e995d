"""Work that is counted, not timed, so that a search ends at the same place on every machine.

One unit is about a microsecond on a processor of 2020.  What costs much counts its own work:
the arithmetic of fields by the terms that it multiplies, values modulo a prime by the nodes
that they are made of, eliminations by rows and columns, calls of SymPy by a typical cost.
"""

from __future__ import annotations

import sys

#: Units of one call of a cached function of SymPy, with what is done around it: 3.3 million of
#: them are the 25 s of an integral (problems/canonical/weber-potential.yaml).
_OF_CALL = 8
#: Units of one fraction, and of a term in it.
_OF_FRACTION = 20
_OF_TERM = 1


class Effort:
    """All work done so far.

    Attributes
    ----------
    done
        In units; only differences mean anything.
    fractions
        What the fractions of the fields have taken, in units, of which `done` has too many
        for long ones: it counts the products of their terms.
    """

    __slots__ = ("done", "fractions")

    def __init__(self) -> None:
        self.done = 0
        self.fractions = 0

    def fraction(self, above: int, below: int) -> None:
        """Count a fraction by the numbers of its terms."""
        self.done += 250 + above * below // 6
        self.fractions += _OF_FRACTION + _OF_TERM * (above + below)


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


class OutOfWork(BaseException):
    """A computation was stopped: it takes more work than it is allowed.

    No `Exception`, so that nothing on the way takes it for a formula that has no value.
    """


def work_done() -> int:
    """The work of fractions and of SymPy so far, in units.

    SymPy counts the calls of its cached functions, through which nearly all of it goes.
    """
    return EFFORT.fractions + _OF_CALL * _sympy_calls()


def _sympy_calls() -> int:
    """Calls of SymPy's cached functions; 0 before and while it is loaded, and without its cache."""
    functions = list(getattr(sys.modules.get("sympy.core.cache"), "CACHE", ()))
    infos = [function.cache_info() for function in functions]
    return sum(info.hits + info.misses for info in infos)
