"""Whether more digits reach what rounding has kept from being reached, and at what cost.

Rounding of b bits that grows to an error of 2^(g - b) has lost g bits.  Of a motion that is known
to some digit at its end g is read off there; where no digit is left from a time on, it is taken to
have grown as evenly up to the end as up to then.  A short run is made with more digits anyhow:
what was lost in a close encounter is not lost again and again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.numerics.certified.accuracy import SATURATED, USUAL, Outcome
from lagcli.numerics.certified.clock import BITS, DOUBLES
from lagcli.record import replace

#: In machine code: a growth that is extrapolated is not known better, and a run is short.
_LARGEST, _AT_ONCE = "taylor128", 1000
_SLACK = 1.3
#: The growth of rounding is known from two runs, by a factor of a few.
_UNSURE = 2.0
#: Steps in Python take a thousand times as long.
_IN_PYTHON = 2000
_MOST = 200_000
_MARGIN = 0.1
#: Two bounds at rounding, of which each is a matter of chance, differ by less.
_CHANCE = 8.0
#: A run that passes a singularity far less closely than the motion does goes astray.
_CLOSE = 1e-22
#: More digits do not need many times the steps, unless they go astray.
TIMES = 20
#: A run that stops at its first step says nothing of their number.
FEW = 50


def lost_bits(outcome: Outcome) -> float:
    """How many bits of doubles the motion has lost to its end."""
    span = outcome.controller.span
    if outcome.lost_at < span:
        if not outcome.lost_at:
            return math.inf
        return (math.log2(SATURATED) + DOUBLES) * span / outcome.lost_at
    # at rounding the bound is so much larger for chance, which more digits do not meet
    chance = outcome.controller.factor(outcome.tolerances[1], outcome.run) / USUAL
    return math.log2(max(max(outcome.errors) / chance, 2.0**-DOUBLES)) + DOUBLES


def within_reach(outcome: Outcome, group: Sequence[str]) -> list[str]:
    """The methods of a group that may reach what was not reached."""
    accuracy, steps, stop = outcome.controller.accuracy, outcome.run.steps, outcome.run.stop
    if stop is not None:  # what is a singularity to doubles may only be close to one
        is_short = not stop.reason and steps <= _AT_ONCE
        return [name for name in group if name == _LARGEST and is_short]
    needed = lost_bits(outcome) - math.log2(accuracy)
    is_guessed = outcome.lost_at < outcome.controller.span
    found = []
    for name in group:
        if name != "taylor80" and steps > _MOST:  # it would not come to the end
            continue
        bits = BITS[name] + (0.0 if is_guessed else _UNSURE)
        if name == _LARGEST and is_guessed:
            bits = math.inf if steps <= _AT_ONCE else _SLACK * bits
        if needed <= bits and not (name == "taylor" and is_guessed and steps > _IN_PYTHON):
            found.append(name)
    return found


def is_marginal(outcome: Outcome) -> bool:
    """Whether runs at the rounding of their numbers are within the accuracy by chance."""
    controller = outcome.controller
    at_rounding = controller.factor(outcome.tolerances[1], outcome.run) > USUAL
    if controller.is_unstable and max(outcome.held) >= controller.accuracy:  # for chance
        return True
    return at_rounding and _CHANCE * max(outcome.errors) > controller.accuracy


def horizon_of(outcome: Outcome) -> float:
    """The time until which the accuracy may hold with the most bits there are, 0 < t <= span.

    A motion that has stopped is known no longer than to there.
    """
    span, stop = outcome.controller.span, outcome.run.stop
    if stop is not None:
        return float(stop.t) or span
    left, lost = BITS[_LARGEST] + math.log2(outcome.controller.accuracy), lost_bits(outcome)
    return min(span, span * max(left, 1.0) / lost) or span if lost > 0 else span


def with_rounding(found: Outcome, doubles: Outcome) -> Outcome:
    """The bounds of a run with more bits, as what rounding came to in doubles has them at least.

    Of 80 bits it is 2^-11 of that: near a collision two runs may differ by less, by chance.
    """
    if not found.reached or doubles.lost_at < doubles.controller.span:
        return found
    part = 2.0 ** (DOUBLES - BITS[found.run.method_name])
    least = [min(part * x, found.controller.accuracy) for x in doubles.errors]
    errors, held = ([*map(max, bounds, least)] for bounds in (found.errors, found.held))
    return replace(found, errors=errors, held=held)


def is_better(found: Outcome, outcome: Outcome) -> bool:
    """Whether to keep what a later method has found; one that stops must have come further."""
    if found.run.stop is not None:
        return found.good_rows > max(1, outcome.good_rows)
    return found.good_rows >= outcome.good_rows


def first_tolerance(outcome: Outcome) -> float:
    """A tolerance whose error, grown as rounding has, is within the accuracy."""
    if outcome.run.stop is not None:
        return _CLOSE
    if outcome.lost_at >= outcome.controller.span:
        return 1.0
    return float(_MARGIN * outcome.controller.accuracy * 2.0 ** -lost_bits(outcome))
