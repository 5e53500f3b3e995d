"""How long the accuracy holds where it is not reached to the end: runs over spans of a grid.

The longest step, the tolerances and the digits of a run follow from its span, and where the
bound crosses the accuracy is a matter of chance by a factor of a few.  So that who asks for more
never gets less, the answer is that of runs which do not depend on the requested span: over
s_k = 2^(k/4), compared at rows of their own as well.  A motion whose errors grow is within the
accuracy up to some s_k and not beyond: of the first run that does not reach its end, and of the
one before it, the one that holds longer is the answer, for all longer spans.  Where a bound at the
rounding of its numbers is within the accuracy by chance, that answer counts as well.

Examples
--------
The plane double pendulum (m = l = 1, at rest at 2 and 2.5 rad, accuracy 1e-9) holds in 128 bits
until t = 34.58, whether 35, 40 or 1000 is requested.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.certificate import refusal_of
from lagcli.numerics.certified.escalation import horizon_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import NotPossible
from lagcli.record import replace

MakeResult = Callable[[RunRequest], Result]

#: Grid points in an octave.
_IN_OCTAVE = 4
#: Rows at which runs over the grid's spans are compared, whatever the requested rows.
_ROWS = 1600
#: The shortest span is this part of the requested one.
_SHORTEST = 2.0**-16
#: A run that holds up to this part of the time of a singularity gains nothing over a shorter span.
_CLOSE = 0.99
#: The clocks of two runs differ by less than this part of the span.
_SAME_TIME = 1e-12
#: Runs over shorter spans: a bracket of 16 octaves is halved to one interval in six.
_MOST = 12


def longest(
    setup: Setup, modes: Modes, outcome: Outcome, result: Result, run: MakeResult
) -> Result:
    """The result that holds longest, of the run over the whole span and of those of the grid.

    Parameters
    ----------
    setup, modes
        The problem with its options, and the modes in doubles.
    outcome, result
        The run over the whole span, which does not reach the accuracy to the end, or by chance.
    run
        Makes the result of another request.
    """
    stop, until = outcome.run.stop, setup.request.until
    if stop is not None and _holds(result) >= _CLOSE * stop.t:
        return result
    found: dict[int, Result | None] = {}

    def reaches(k: int) -> bool:
        found[k] = found.get(k) or _over(setup, run, _span(k))
        return (each := found[k]) is not None and each.certificate.reached

    low, high = _below(max(_holds(result), _SHORTEST * until)), _below(until, math.ceil)
    following, stride = _below(horizon_of(outcome)), 1
    for _ in range(_MOST):
        if high - low <= 1:
            break
        k = min(max(following, low + 1), high - 1)
        is_reached = reaches(k)
        low, high = (k, high) if is_reached else (low, k)
        following = low + stride if is_reached else (low + high) // 2
        stride = 2 * stride if is_reached else 1
    while not reaches(low) and high - low < _MOST:  # the run over the whole span held by chance
        low -= 1
    reaches(low + 1)
    high = low + 1
    kept = [each for k in (low, high) if (each := found.get(k)) is not None]
    best = _up_to(max(kept, key=_holds, default=result), until, setup.rows_at)
    if reached := _holds(best) >= until * (1 - _SAME_TIME):
        if outcome.reached:
            return result
        refusal = ""
    else:
        refusal = refusal_of(setup, modes.first.motion, outcome, _holds(best))
    certificate = replace(best.certificate, reached=reached)
    return replace(best, certificate=certificate, refusal=refusal)


def _over(setup: Setup, run: MakeResult, span: float) -> Result | None:
    """The result over a span of the grid, up to one of its own rows; None where there is none."""
    own = [span * k / _ROWS for k in range(_ROWS)] + [span]
    times = sorted({*own, *(t for t in setup.rows_at if t < span)})
    request = replace(setup.request, until=span, end=None, times=tuple(times), samples=len(times))
    try:
        found = run(replace(request, furthest=False))
    except (Refusal, NotPossible):
        return None
    if found.certificate.reached:
        return found
    return _up_to(found, max(t for t in own if t <= _holds(found)), times)


def _up_to(result: Result, until: float, rows: Sequence[float]) -> Result:
    """The part of a result up to a time, with its last row and those that are wanted."""
    same = _SAME_TIME * until
    kept = [row for row in result.rows if (row[0] or 0.0) <= until + same]
    last = (kept[-1][0] if kept else None) or 0.0
    wanted = [*rows, last]
    return replace(
        result,
        rows=tuple(row for row in kept if any(abs((row[0] or 0.0) - t) <= same for t in wanted)),
        events=tuple(event for event in result.events if event.t <= last),
        certificate=replace(result.certificate, holds_until=last),
    )


def _holds(result: Result) -> float:
    return result.certificate.holds_until


def _span(k: int) -> float:
    return float(2.0 ** (k / _IN_OCTAVE))


def _below(time: float, whole: Callable[[float], int] = math.floor) -> int:
    """The grid point at a time or before it."""
    return whole(_IN_OCTAVE * math.log2(time))
