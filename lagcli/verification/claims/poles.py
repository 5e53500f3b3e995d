"""Steady motions where the axes of two rotations coincide, and only the momenta are known.

A little beside the pole, at q_0 + e, the momenta give the rates, and U_eff is even about it:
    -q''/e = omega^2 + c e^2 + O(e^4)   at q' = 0,
from which two e eliminate c.
"""

from __future__ import annotations

from flint import arb

from lagcli.statements.motions import SteadyMotion
from lagcli.verification.claims.near import NOTHING, LinearMotion
from lagcli.verification.claims.rest import RestPlace, conditions, held_at, may_lose_contact
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, size, solve

#: The inertia beside it is e^2, which must stand out of rounding (2^-36 of a linear system).
_BESIDE = arb(2) ** -15
#: Relative difference of omega^2: the next order is e^4 = 2^-60 of it.
_AGREE = 1e-9


def refuted_at_a_pole(x: Examination, what: str, motion: SteadyMotion) -> str:
    """Why a motion cannot be right; empty where it can, or where it is not examined."""
    place = RestPlace(x, what, motion.at, {}, motion.on, motion.where)
    momenta = x.places(what, list(motion.momenta.values()))
    squares = x.places(what, list(motion.frequencies_squared))
    if momenta is None or squares is None or not place.readable:
        return "its printed form cannot be read back"
    kept = [n for n in x.reference.names if n not in motion.momenta]
    if len(kept) != 1 or x.reference.rows:
        x.unchecked.append(what)
        return ""
    for near in place.states():
        given = dict(zip(motion.momenta, (near.at(p) for p in momenta), strict=True))
        try:
            far, close = (_pull(near, kept[0], given, e) for e in (_BESIDE, _BESIDE / 2))
        except Unclear:
            continue
        pull = ((4 * close - far) / 3).mid()
        if not pull.is_finite():
            continue
        scale = 1 + max([size(pull), *(size(near.at(square)) for square in squares)])
        if size(pull) > 1e6:
            return "the equations of motion do not let it stay there"
        if not squares and not may_lose_contact(x):
            return "its frequency is left out"
        if any(size(near.at(square) - pull) > _AGREE * scale for square in squares):
            return f"its frequency has the square {float(pull):.6g} at a random state"
        if why := _misjudged(x, what, near, motion, float(pull)):
            return why
    return ""


def _pull(near: LinearMotion, name: str, momenta: dict[str, arb], beside: arb) -> arb:
    """-q''/e a little beside the pole, at these momenta."""
    names = near.x.reference.names
    there = dict(near.environment)
    there[name, 0] = there[name, 0] + beside
    cyclic = [names.index(n) for n in momenta]
    laws = near.laws_at(there)
    rows = [[laws.mass_matrix[i][j] for j in cyclic] for i in cyclic]
    right = [p - laws.momenta[j] for p, j in zip(momenta.values(), cyclic, strict=True)]
    rates = solve(rows, right, len(cyclic)).x
    there |= {(n, 1): v for n, v in zip(momenta, rates, strict=True)}
    return -near.laws_at(there).accelerations[names.index(name)] / beside


def _misjudged(
    x: Examination, what: str, near: LinearMotion, motion: SteadyMotion, square: float
) -> str:
    """Why a verdict is wrong where omega^2 decides."""
    verdict = motion.verdict
    bowl, grows = square > NOTHING, square < -NOTHING
    minimum = [near.at(place) > 0 for place in conditions(x, what, verdict.minimum or ())]
    unstable = held_at(x, what, near, verdict.unstable)
    if grows and (verdict.stable or (minimum and all(minimum))):
        return "a disturbance grows where none is said to"
    if bowl and (verdict.stable is False or any(unstable)):
        return "no disturbance grows where one is said to"
    return ""
