"""Newton's method with the shortest steps, onto the common zeros of formulas."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from flint import arb

from lagcli.verification.linear import Unclear, least_step, size
from lagcli.verification.program import Key
from lagcli.verification.reference import Reference
from lagcli.verification.sweeps import column


def settled(
    reference: Reference,
    environment: dict[Key, arb],
    places: Sequence[int],
    keys: Sequence[Key],
    *,
    steps: int,
    near: float,
    far: float = inf,
) -> bool:
    """Move some quantities until formulas are 0; whether that came to an end.

    Parameters
    ----------
    environment
        Where it begins; changed in place.
    places, keys
        The formulas, and the quantities that may move.
    steps
        The most steps.
    near
        Below it a formula is 0.
    far
        The longest step that is taken for one; where it is finite, none is longer than 1.
    """
    symbols = [reference.program.symbol(*key) for key in keys]
    for _ in range(steps if places else 0):
        at = reference.values(environment)
        residual = [at(place) for place in places]
        if max(map(size, residual)) < near:
            return True
        if not keys:
            return False
        rows = [column(at.gradient(place), symbols) for place in places]
        try:
            step = least_step(rows, residual)
        except Unclear:
            return False
        longest = max(map(size, step))
        if not longest < far:
            return False
        shorter = arb(1 / longest) if far < inf and longest > 1 else arb(1)
        for key, d in zip(keys, step, strict=True):
            environment[key] = (environment[key] + d * shorter).mid()
    return not places
