r"""Impacts that accumulate: a bound of all that are still to come, and of where they end.

Let a contact be struck from g' = -w/e to g' = w, and -a_2 <= g'' <= -a_1 < 0 on a box in flight.
Then a flight lasts at most 2 w/a_1, as high as w^2/(2 a_1), and ends at w sqrt(a_2/a_1) at most:

    w_(k+1) <= r w_k,    r = e sqrt(a_2/a_1).

With r < 1 all flights are over within 2 w/(a_1 (1 - r)), and all speeds at impacts together are
at most w sqrt(a_2/a_1)/(1 - r), which bounds what they change in the velocities.  If neither this
nor the equations with the contact open, or closed, over that time lead out of the box, nothing
does, and the contact is closed at the end: g = 0, g' = 0.

References
----------
V. Acary, B. Brogliato, *Numerical Methods for Nonsmooth Dynamical Systems* (2008), section 1.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.numerics.rigorous.crossings import Restart, Watched
from lagcli.numerics.rigorous.modes import ProofMode
from lagcli.record import record

#: The room that a trial box has, and how often it is widened.
_ROOM, _WIDENED = 2, 6


@record
class AtRest:
    """When the last impacts are over, where the motion is until then, and where at the end."""

    times: Any
    box: list[Any]
    end: list[Any]
    mode: ProofMode


def rest_after(
    watched: Watched, mode: ProofMode, restart: Restart, times: Any, x: Sequence[Any], most: float
) -> AtRest | None:
    """What follows the impacts that an impact is followed by.

    Parameters
    ----------
    watched, mode, restart
        The gap, the motion while it is open, and what an impact does.
    times : arb
        Of the impact.
    x : sequence of arb
        The states after it, at these times.
    most : float
        The longest time until rest.

    Returns
    -------
    AtRest or None
        None where it is not proved, or lasts longer.
    """
    n, index = mode.motion.n, watched.index
    if mode.stuck or any(each.kind == "force" for each in mode.watched):
        return None
    restitution = mode.modes.setup.contacts[index].restitution
    if restitution is None:
        return None
    [e] = mode.motion.function([mode.equations.form.read(restitution)])(times, *x)
    closed = mode.modes(mode.held | {index}, mode.signs)
    speed = watched.rate(mode.field, times, x).upper()
    box, span = list(x), times
    for _ in range(_WIDENED):
        bend = 2 * watched.term(mode.field, span, box, 2)
        if not (bend < 0 and speed > 0):
            return None
        least, steeper = -bend.upper(), (bend.lower() / bend.upper()).sqrt().upper()
        rest = 1 - e * steeper
        if not (e >= 0 and rest > 0):
            return None
        lasts = (2 * speed / (least * rest)).upper()
        if not lasts < most:
            return None
        impulses = -(speed * steeper / rest).upper()
        over = times.upper() + lasts
        span = times.union(over)
        late = (over - times.lower()).union(0)
        pushed = _push(watched, restart, span, box, n)
        if pushed is None:
            return None
        rates = [
            a.union(b)
            for a, b in zip(mode.field.rate(span, box), closed.field.rate(span, box), strict=True)
        ]
        struck = [*([0] * n), *((impulses * d).union(0) for d in pushed)]
        found = [x0 + late * f + d for x0, f, d in zip(x, rates, struck, strict=True)]
        if all(a.contains(b) for a, b in zip(box, found, strict=True)):
            both = [*mode.watched, *closed.watched]
            if not all(each.at(span, box) > 0 for each in both if each != watched):
                return None
            passed = over - times
            end = [x0 + passed * f + d for x0, f, d in zip(x, rates, struck, strict=True)]
            return AtRest(span, box, _touching(watched, over, end, n), closed)
        box = [a.union(x0 + _ROOM * (b - x0)) for a, b, x0 in zip(box, found, x, strict=True)]
    return None


def _push(
    watched: Watched, restart: Restart, times: Any, box: Sequence[Any], n: int
) -> list[Any] | None:
    """What an impact changes in the velocities, for each unit of g' before it."""
    _, explicit, *gradient = watched.value(times, *box)
    trial = [each.mid() for each in gradient[:n]]
    rate = sum((a * b for a, b in zip(gradient, trial, strict=False)), explicit)
    if rate.contains(0):
        return None
    after = restart.state(times, [*box[:n], *trial])
    return [(a - b) / rate for a, b in zip(after[n:], trial, strict=True)]


def _touching(watched: Watched, t: Any, box: Sequence[Any], n: int) -> list[Any]:
    """The part of a box with g = 0 and g' = 0, by the component that g depends on most."""
    found, middles = list(box), [x.mid() for x in box]
    gap = watched.value(t, *middles[:n], *box[n:])[0]
    _, explicit, *gradient = watched.value(t, *box)
    j = max(range(n), key=lambda k: float(gradient[k].abs_lower()))
    if gradient[j].contains(0):
        return found
    others = [k for k in range(n) if k != j]
    gap += sum(gradient[k] * (box[k] - middles[k]) for k in others)
    rate = explicit + sum(gradient[k] * box[n + k] for k in others)
    found[j] = box[j].intersection(middles[j] - gap / gradient[j])
    found[n + j] = box[n + j].intersection(-rate / gradient[j])
    return found
