"""Rest that static friction or a kink of the potential holds, by what acts at states beside it.

At a kink V rises, or stays to first order, whatever the displacement.  What friction holds is
stopped whichever way it moves: with velocities v all forces Q do the work Q . v <= 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from flint import arb

from lagcli.statements.answers import Equilibrium
from lagcli.verification.claims.near import LinearMotion
from lagcli.verification.claims.rest import RestPlace
from lagcli.verification.examination import Examination
from lagcli.verification.linear import size

#: How far, or how fast, beside the state: what is of second order is less than the bound then.
_BESIDE, _BOUND = arb(2) ** -30, 1e-6
#: Ways tried at each state, the coordinates' own before random ones.
_WAYS = 12


def stays_held(x: Examination, what: str, place: RestPlace, each: Equilibrium) -> bool:
    """Whether no state was found at which it would leave; noted where none could be looked at."""
    tried = 0
    apart = place.readable and not (x.reference.rows or x.problem.contacts)
    for near in place.states() if apart else ():
        found = (
            _stopped(near) if each.sticking else _rises(near, strictly=bool(each.verdict.stable))
        )
        if found is False:
            x.refute(what, "what acts beside it does not hold it there")
            return False
        tried += found is True
    if not tried:
        x.unchecked.append(what)
    return True


def _ways(near: LinearMotion) -> Iterator[list[arb]]:
    random = Random(3)
    n = near.size
    for j in range(n):
        for side in (1, -1):
            yield [arb(side * (j == k)) for k in range(n)]
    for _ in range(_WAYS if n > 1 else 0):
        yield [arb(random.randint(-1024, 1024)) / 1024 for _ in range(n)]


def _rises(near: LinearMotion, *, strictly: bool) -> bool | None:
    """Whether -L at rest is nowhere lower beside it; None with other forces, or where not real."""
    reference = near.x.reference
    if reference.pushed:
        return None
    here, seen = near.at(reference.lagrangian), False
    for way in _ways(near):
        moved = {(n, 0): near.environment[n, 0] + _BESIDE * d
                 for n, d in zip(reference.names, way, strict=True)}  # fmt: skip
        there = reference.values({**near.environment, **moved})(reference.lagrangian)
        rise = here - there
        if not rise.is_finite():
            continue
        seen = True
        if rise < (0 if strictly else -_BOUND * _BESIDE):
            return False
    return seen or None


def _stopped(near: LinearMotion) -> bool | None:
    """Whether all forces together take energy from each slow motion; None where not seen."""
    reference, seen = near.x.reference, False
    for way in _ways(near):
        moving = {(n, 1): _BESIDE * d for n, d in zip(reference.names, way, strict=True)}
        laws = near.laws_at({**near.environment, **moving})
        forces = [f - d for f, d in zip(laws.applied, laws.drift, strict=True)]
        work = sum((f * d for f, d in zip(forces, way, strict=True)), arb(0))
        if not work.is_finite():
            continue
        seen = True
        if work > _BOUND * max([1.0, *map(size, forces)]):
            return False
    return seen or None
