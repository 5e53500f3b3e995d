"""How much the conserved charges change along a run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from lagcli.numerics.hybrid.run import Run


def changes(
    run: Run, charge: int, values: Sequence[Any]
) -> Iterator[tuple[list[int], list[float], float]]:
    """Of each phase in which a charge is conserved: its rows, its changes, and its scale.

    Parameters
    ----------
    run, charge
        The rows, and which of the charges.
    values
        Of the charge in each row that counts; None where it is not defined.
    """
    for number, phase in enumerate(run.phases):
        if not phase.mode.conserved[charge]:
            continue
        places = [
            place
            for place, mark in enumerate(run.marks[: len(values)])
            if mark.phase == number and values[place] is not None
        ]
        if len(places) > 1:
            here = [values[place] for place in places]
            found = [float(value - here[0]) for value in here]
            peak = max(map(abs, map(float, here)))
            yield places, found, max(peak, phase.mode.sizes.largest(run.marks, places)[charge])
