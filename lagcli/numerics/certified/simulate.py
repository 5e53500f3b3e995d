"""A problem and a request -> a table with its certificate."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from lagcli.numerics.certified.accuracy import Outcome
from lagcli.numerics.certified.attempts import Attempt, attempt, groups
from lagcli.numerics.certified.branches import is_met, is_sharp, on_one_branch
from lagcli.numerics.certified.certificate import requested_rows, result_of
from lagcli.numerics.certified.escalation import (
    FEW,
    TIMES,
    first_tolerance,
    is_better,
    is_marginal,
    with_rounding,
    within_reach,
)
from lagcli.numerics.certified.methods import SHARP, SHARPER, STIFF
from lagcli.numerics.certified.prepared import RunsDone
from lagcli.numerics.certified.ready_setup import ready_setup
from lagcli.numerics.certified.stiffness import STIFF as STIFFNESS
from lagcli.numerics.certified.stiffness import decay
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import Grazes, NotPossible
from lagcli.problem_data import Problem
from lagcli.record import record, replace

#: The clocks of two runs differ by less than this part of the span.
_SAME_TIME = 1e-12
#: Whether a contact is struck may be known to a finer accuracy, down to what doubles reach, if that
#: is reached: 1e-10 tells a ray 2e-10 inside of a disc from a graze, behind it 1e-12 is not;
#: a clearance of 1e-12 is seen at 1e-13.
_FINER, _FINEST = 0.3, 1e-15


def simulate(problem: Problem, request: RunRequest, progress: Progress = None) -> Result:
    """Run a problem.

    Parameters
    ----------
    problem
        With values for its parameters and an initial state.
    request
        Span, accuracy, columns.
    progress
        Called now and then with the part of the span that is done.

    Raises
    ------
    Refusal
        When there is nothing to run: values are missing, the initial state is off the
        constraints, the accelerations are not determined.
    """
    return certified_run(*ready_setup(problem, request), progress)


def certified_run(setup: Setup, modes: Modes, progress: Progress = None) -> Result:
    """The table of what is ready to be run, over the longest span that is certain."""
    request, done = setup.request, RunsDone(progress)

    def over(request: RunRequest) -> Result:
        return _over_span(replace(setup, request=request), modes, done).result

    whole = _over_span(setup, modes, done)
    outcome, result = whole.outcome, whole.result
    if isinstance(outcome.run.stop, Grazes) and (decided := _told_from_a_graze(request, over)):
        return decided
    is_last = outcome.run.method_name in _last_methods(setup) and is_marginal(outcome)
    if request.furthest and (is_last or not outcome.reached):
        from lagcli.numerics.certified.horizon import longest

        result = longest(setup, modes, outcome, result, over)
    return _with_rows_beyond(result, request, whole.rows) if request.beyond else result


@record
class _SpanRun:
    """What comes of a span as it is, and all rows of its run where they are requested."""

    outcome: Outcome
    result: Result
    rows: list[tuple[float | None, ...]]


def _told_from_a_graze(request: RunRequest, over: Callable[[RunRequest], Result]) -> Result | None:
    """The result of a finer accuracy that tells whether what is grazed is struck.

    Where one of its runs strikes and the other does not, the next one is tried.
    """
    finer = request.accuracy
    while finer > _FINEST:
        finer = max(_FINER * finer, _FINEST)
        found = over(replace(request, accuracy=finer, furthest=False))
        if found.certificate.reached:
            certificate = replace(found.certificate, accuracy=request.accuracy)
            return replace(found, certificate=certificate)
    return None


def _last_methods(setup: Setup) -> Sequence[str]:
    """Those after which none has more digits."""
    has_events = setup.request.method == "auto" and (setup.goes_on or setup.equations.kinks)
    return ("taylor80",) if has_events else groups(setup.request)[-1]


def _with_rows_beyond(
    result: Result, request: RunRequest, rows: Sequence[tuple[float | None, ...]]
) -> Result:
    """The result with the rows after those that are certified."""
    last = result.certificate.holds_until + _SAME_TIME * request.until
    is_cut = not result.certificate.reached
    return replace(result, beyond=tuple(row for row in rows if is_cut and (row[0] or 0.0) > last))


def _over_span(setup: Setup, modes: Modes, done: RunsDone) -> _SpanRun:
    """The pair of runs of the first method that reaches the accuracy, or comes furthest."""
    found, remark = Attempt(None), ""
    if setup.request.method == "auto" and decay(setup, modes) > STIFFNESS:
        found = attempt(setup, STIFF, modes, done)
        remark = found.remark
    if found.outcome is None or not found.outcome.reached:
        found = _furthest_of_groups(setup, modes, done)
        remark += found.remark
    outcome = found.outcome
    if outcome is None:
        raise Refusal(f"no method for this problem{remark}", mistake=False)
    rows = requested_rows(setup, outcome)
    if not outcome.reached:
        outcome = outcome.controller.furthest(outcome)
    if not outcome.reached and setup.request.furthest:
        with found.precision(), suppress(NotPossible):
            outcome = outcome.controller.refined(outcome, setup.times)
    outcome, more = on_one_branch(setup, modes, outcome, found.precision, done)
    return _SpanRun(outcome, result_of(setup, modes.first.motion, outcome, remark + more), rows)


def _furthest_of_groups(setup: Setup, modes: Modes, done: RunsDone) -> Attempt:
    """The first group's method that reaches the accuracy, else the one that comes furthest."""
    best, remark, first = Attempt(None), "", 1.0
    most: int | None = None
    for group in groups(setup.request):
        names, coarsest = group, 1.0
        if best.outcome is not None:
            names, coarsest = _beyond(setup.request, best.outcome, group)
            if setup.request.digits is None:
                most = TIMES * max(best.outcome.run.steps, FEW)
        if names:
            found = attempt(setup, names, modes, done, first=min(first, coarsest), most=most)
            first, remark = min(first, found.first), remark + found.remark
            best = _better(best, found)
    if best.outcome is None:
        best = attempt(setup, ("dop853",), modes, done, most=most)
        remark += best.remark
    return replace(best, remark=remark)


def _better(best: Attempt, found: Attempt) -> Attempt:
    """Of an attempt and one with more digits the one that comes further."""
    if best.outcome is None or found.outcome is None:
        return best if found.outcome is None else found
    outcome = with_rounding(found.outcome, best.outcome)
    return replace(found, outcome=outcome) if is_better(outcome, best.outcome) else best


def _beyond(
    request: RunRequest, outcome: Outcome, group: Sequence[str]
) -> tuple[Sequence[str], float]:
    """The methods that may reach with more digits what was not reached, and from where on."""
    if outcome.reached:
        return (), 1.0
    if request.digits is not None:
        return group, 1.0
    if is_sharp(outcome):
        return (), 1.0
    if is_met(outcome):
        return SHARPER, SHARP
    return within_reach(outcome, group), first_tolerance(outcome)
