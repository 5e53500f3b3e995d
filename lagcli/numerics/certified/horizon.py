"""How long the accuracy holds where it is not reached to the end: runs over shorter spans.

The longest step, the tolerances and the digits of a run follow from its span.  A span at whose
end nothing can be known spares the digits that a shorter one is given, and one that is far too
long has its first row after the accuracy is lost.  So the motion is run again over shorter spans
s_k = 2^(k/4), the same whatever the span asked for, and of all runs the one that holds longest
is taken.  A motion whose errors grow is within the accuracy up to some s_k and not beyond: the
last of these is bracketed from both sides.

Examples
--------
The plane double pendulum (m = l = 1, at rest at 2 and 2.5 rad, accuracy 1e-9) holds in 128 bits
until t = 34; over t = 50 doubles alone are run, which hold until t = 8.4, and over t = 1000 the
first of 101 rows is at t = 10.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.certificate import refusal_of
from lagcli.numerics.certified.escalation import horizon_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import Asked, Result
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import NotPossible
from lagcli.record import replace

MakeResult = Callable[[Asked], Result]

#: Grid points in an octave: what is not known of the horizon is at most the ratio of two.
_IN_OCTAVE = 4
#: The shortest span is this part of the one asked for.
_SHORTEST = 2.0**-16
#: A run that holds up to this part of the time of a singularity gains nothing over a shorter span.
_CLOSE = 0.99
#: Runs over shorter spans: a bracket of 16 octaves is halved to one interval in six.
_MOST = 12


def longest(
    simulation: Setup, modes: Modes, outcome: Outcome, result: Result, run: MakeResult
) -> Result:
    """The result that holds longest, of the run over the whole span and of shorter ones.

    Parameters
    ----------
    simulation, modes
        The problem with its options, and the modes in doubles.
    outcome, result
        The run over the whole span, which does not reach the accuracy to the end.
    run
        Makes the result of another request.
    """
    stop, until = outcome.run.stop, simulation.asked.until
    best = result
    if stop is not None and _holds(best) >= _CLOSE * stop.t:
        return best
    low, high = _below(max(_holds(best), _SHORTEST * until)), _below(until, math.ceil)
    following, stride = _below(horizon_of(outcome)), 1
    for _ in range(_MOST):
        if high - low <= 1:
            break
        k = min(max(following, low + 1), high - 1)
        found = _shorter(simulation, run, _span(k))
        if found is not None and _holds(found) > _holds(best):
            best = found
        reached = found is not None and found.certificate.reached
        low, high = (k, high) if reached else (low, k)
        low = max(low, _below(max(_holds(best), _SHORTEST * until)))
        following = low + stride if _holds(best) >= _span(low) else (low + high) // 2
        stride = 2 * stride if reached else 1
    if best is result:
        return best
    held = replace(best.certificate, reached=False)
    refusal = refusal_of(simulation, modes.first.motion, outcome, held.holds_until)
    return replace(best, certificate=held, refusal=refusal)


def _shorter(simulation: Setup, run: MakeResult, span: float) -> Result | None:
    """The result over a shorter span; None where there is none."""
    try:
        return run(_within(simulation.asked, simulation.rows_at, span))
    except (Refusal, NotPossible):
        return None


def _within(asked: Asked, rows: list[float], span: float) -> Asked:
    """The same options over a shorter span, with the same times of the rows."""
    times = (*(t for t in rows if t < span), span)
    return replace(asked, until=span, times=times, samples=len(times))


def _holds(result: Result) -> float:
    return result.certificate.holds_until


def _span(k: int) -> float:
    return float(2.0 ** (k / _IN_OCTAVE))


def _below(time: float, whole: Callable[[float], int] = math.floor) -> int:
    """The grid point at a time or before it."""
    return whole(_IN_OCTAVE * math.log2(time))
