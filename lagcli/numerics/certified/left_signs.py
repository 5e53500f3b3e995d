"""Coordinates that leave the sign which the file assumes.

The formulas of a file are simplified with it: sqrt(rho^2) is rho for a positive rho.  The run
follows the formulas of the file themselves, beyond the sign as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.setup import Setup

_HOLDS = {
    "positive": "for {} > 0",
    "nonnegative": "for {} >= 0",
    "negative": "for {} < 0",
    "nonzero": "on one side of {} = 0",
}


def left_signs(setup: Setup, marks: Sequence[Mark]) -> Iterator[str]:
    """A sentence for each integrated coordinate that is beyond 0 by more than its error."""
    for j, q in enumerate(setup.equations.q):
        declared = next(c for c in setup.problem.coordinates if c.name == q.name)
        if declared.assume == "real":
            continue
        values = [float(mark.q[j]) for mark in marks]
        error = setup.request.accuracy * max(map(abs, values), default=0.0)
        first = next((x for x in values if abs(x) > error), 0.0)
        side = {"negative": -1, "nonzero": first}.get(declared.assume, 1)
        beyond = (m for m, x in zip(marks, values, strict=True) if abs(x) > error and x * side < 0)
        if (mark := next(beyond, None)) is not None:
            yield (
                f"{q.name} is {float(mark.q[j]):.6g} at t = {mark.t:.6g}, and the file assumes it "
                f"{declared.assume}: formulas of solve may hold "
                f"{_HOLDS[declared.assume].format(q.name)} only"
            )
