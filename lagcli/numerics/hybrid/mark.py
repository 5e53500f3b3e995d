"""A row of a run."""

from __future__ import annotations

from typing import Any, NamedTuple

Vector = list[Any]


class Mark(NamedTuple):
    """A row: at a time that was requested for, or on one side of an event.

    Attributes
    ----------
    phase
        Its number.
    sample
        Which of the requested times; -1 at an event.
    begins
        At an event: whether it is the beginning of the phase, or its end.
    """

    t: float
    q: Vector
    v: Vector
    phase: int
    sample: int = -1
    begins: bool = False
