"""Newton's method with the shortest steps, onto the common zeros of formulas."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from flint import arb

from lagcli.verification.linear import Unclear, least_step, size
from lagcli.verification.program import Key
from lagcli.verification.reference import Reference
from lagcli.verification.sweeps import column

_HALVINGS = 8  # to a 256th of a step; a shorter one leads nowhere


def settled(
    reference: Reference,
    environment: dict[Key, arb],
    places: Sequence[int],
    keys: Sequence[Key],
    *,
    steps: int,
    near: float,
    far: float = inf,
    damped: bool = False,
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
    damped
        Whether steps are halved until no formula is further from 0 than before.
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
        room = 1 + damped * max(size(environment[key]) for key in keys)
        shorter = arb(room / longest) if far < inf and longest > room else arb(1)
        for _ in range(_HALVINGS):
            pairs = zip(keys, step, strict=True)
            there = environment | {key: (environment[key] + d * shorter).mid() for key, d in pairs}
            at = reference.values(there) if damped else at
            if not damped or max(size(at(place)) for place in places) <= max(map(size, residual)):
                break
            shorter /= 2
        environment.update(there)
    return not places
