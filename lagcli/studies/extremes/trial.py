"""One case put to the test: what its formulas lose, and whether a run is right or refuses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from decimal import Decimal
from time import process_time

from lagcli.numerics.certified.precise import precision
from lagcli.numerics.certified.scales import relative
from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.equations.jacobian import jacobian
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.rigorous import prove
from lagcli.reader.columns import usual_columns
from lagcli.record import record, replace
from lagcli.studies.extremes.case import Case, CaseFormula, CaseTrial, Verdict
from lagcli.studies.extremes.condition import mass_condition
from lagcli.studies.extremes.digits import digits_between, losses
from lagcli.studies.extremes.roles import angles_of
from lagcli.studies.extremes.scene import ExtremeScene
from lagcli.studies.tradeoff.reference import Rows, difference, precise_rows, reference
from lagcli.studies.tradeoff.trial import LimitReached, until

#: Times of the fastest change at the start that a short run takes.
_TIMES = 10.0
_SAMPLES = 11
_PRECISE = 60
#: Of the run that confirms a claim: it must be right to the accuracy only.
_DIGITS = 24
#: A proof, and a reference, may take this part of the time that a case has.
_PROOF, _SHARE = 0.125, 0.25
#: The factor by which a run that takes too long is shortened, and how often.
_SHORTER, _ATTEMPTS = 100.0, 3


@record(kw_only=True)
class Wanted:
    """The request for every case.

    Attributes
    ----------
    until
        The longest span; None where the file has none: then the motion's own times.
    accuracy
        That of the runs.
    limit
        Seconds of processor time for each case.
    """

    until: float | None
    accuracy: float
    limit: float


def trial(case: Case, formulas: Sequence[CaseFormula], wanted: Wanted) -> CaseTrial:
    """Everything that is to be known of a case.

    Parameters
    ----------
    case
        The problem with its values.
    formulas
        Those that `solve` prints of it.
    wanted
        Span, accuracy, time.
    """
    begun = process_time()
    try:
        scene = ExtremeScene(case.problem)
    except Refusal as refusal:
        return CaseTrial(verdict="refused", reason=str(refusal))
    measured = CaseTrial(
        verdict="undecided",
        losses=losses(formulas, _values(scene)),
        run_loss=_run_loss(scene),
        condition=mass_condition(scene),
        accuracy=wanted.accuracy,
    )
    until = _span(scene, wanted.until) * case.stretch
    found = _moved(case, replace(measured, until=until), begun + wanted.limit, wanted)
    return replace(found, seconds=process_time() - begun)


def _values(scene: ExtremeScene) -> dict[str, float]:
    names = [c.name for c in scene.problem.coordinates]
    values = {symbol.name: x for symbol, x in scene.constants.items()}
    values |= dict(zip(names, scene.q, strict=True))
    return values | {f"{n}'": x for n, x in zip(names, scene.v, strict=True)} | {"t": 0.0}


def _run_loss(scene: ExtremeScene) -> float | None:
    """Digits lost by the accelerations as a run works them out; None where there are none."""
    from flint import arb

    state = (0.0, *scene.q, *scene.v)
    try:
        found = scene.motion.accelerations(*state)
        with precision(_PRECISE):
            motion, exact_state = scene.in_balls()
            exact = [arb(x) for x in motion.accelerations(*exact_state)]
    except (ArithmeticError, ValueError, Refusal):
        return None
    if not all(x.is_finite() for x in exact):
        return None
    return max(digits_between(float(a), b) for a, b in zip(found, exact, strict=True))


def _span(scene: ExtremeScene, longest: float | None) -> float:
    """Some 10 times in which the motion changes at the start, and no more than requested."""
    rate = 0.0
    state = (0.0, *scene.q, *scene.v)
    with suppress(ArithmeticError, ValueError, Refusal):
        rate = max(_rates(scene, state))
    own = _TIMES / rate if 0 < rate < math.inf else math.inf
    if longest is not None:
        return min(longest, own)
    return own if own < math.inf else 1.0


def _rates(scene: ExtremeScene, state: Sequence[float]) -> Iterator[float]:
    """1/time: of the linear equations, and of the path that is begun.

    sqrt(|df_i/dq_j df_j/dq_i|) and their like do not depend on the units of coordinates.
    """
    n = scene.n
    by_q, by_v = jacobian(scene.motion)(*state)
    for i in range(n):
        for j in range(n):
            yield abs(by_q[i][j] * by_q[j][i]) ** 0.25
            yield abs(by_v[i][j] * by_v[j][i]) ** 0.5
    turning = {name for angle in angles_of(scene) for name, _ in angle.factors}
    is_angle = [symbol.name in turning for symbol in scene.equations.q]
    longest = max(
        (abs(x) for x, turns in zip(scene.q, is_angle, strict=True) if not turns), default=0
    )
    found = scene.motion.accelerations(*state)
    for x, v, a, turns in zip(scene.q, scene.v, found, is_angle, strict=True):
        size = 1.0 if turns else max(abs(x), longest)
        if size:
            yield math.sqrt(abs(a) / size)
            yield abs(v) / size


# -- the run -------------------------------------------------------------------------------------


def _moved(case: Case, measured: CaseTrial, end: float, wanted: Wanted) -> CaseTrial:
    """The same with what came of a certified run, over a shorter span where it takes too long."""
    assert measured.until is not None
    request = RunRequest(
        until=measured.until,
        accuracy=wanted.accuracy,
        samples=_SAMPLES,
        columns=tuple(usual_columns(case.problem)),
        project=bool(case.problem.constraints),
        furthest=False,
    )
    for attempt in range(_ATTEMPTS):
        now = process_time()
        last = now + (end - now) * _SHARE if attempt < _ATTEMPTS - 1 else end
        try:
            return _run(case, request, measured, last, wanted)
        except LimitReached:
            request = replace(request, until=request.until / _SHORTER)
            why = f"only until t = {request.until:.3g}: {measured.until:.3g} takes too long"
            measured = replace(measured, reason=why)
    why = f"it takes more than {wanted.limit:g} s, until t = {request.until * _SHORTER:.3g} too"
    return replace(measured, reason=why)


def _run(
    case: Case, request: RunRequest, measured: CaseTrial, end: float, wanted: Wanted
) -> CaseTrial:
    try:
        result = simulate(case.problem, request, until(end))
    except Refusal as refusal:
        return replace(measured, verdict="refused", reason=str(refusal), accuracy=None)
    held = result.certificate
    known = replace(
        measured,
        method=result.method,
        drift=max(held.charges.values(), default=None),
        holds_until=held.holds_until,
    )
    error, bound, proved = _error(case, request, result, _SHARE * wanted.limit)
    if error is not None and error > wanted.accuracy + bound:
        why = f"it claims {wanted.accuracy:g} and errs by {error:.1e}"
        return replace(known, verdict="wrong", reason=why, error=error)
    if not held.reached:
        return replace(known, verdict="refused", reason=result.refusal, error=error)
    verdict: Verdict = "claimed" if error is None or bound > wanted.accuracy else "right"
    return replace(known, verdict=verdict, error=error, proved=proved)


def _error(
    case: Case, request: RunRequest, result: Result, limit: float
) -> tuple[float | None, float, bool]:
    """The true error of the rows that are claimed, how well it is known, and whether by a proof."""
    regular = {request.until * k / (request.samples - 1) for k in range(request.samples)}
    rows = [row for row in result.rows if row[0] in regular or row is result.rows[-1]]
    rows = [row for row in rows if row[0] is not None and _is_before_events(row[0], result)]
    times = tuple(row[0] for row in rows if row[0] is not None)
    if len(times) < 2 or any(x is None for row in rows for x in row):
        return None, math.inf, False
    same = replace(request, until=times[-1], times=times, samples=len(times))
    found: Rows = tuple(tuple(Decimal(x) for x in row if x is not None) for row in rows)
    scales = result.certificate.scales
    try:
        bound = _proved_error(case, same, found, scales, limit)
        if bound is not None:
            return bound, 0.0, True
        near = precise_rows(case.problem, same, _DIGITS, limit)
        if near is not None and (error := difference(near, found, scales)) <= request.accuracy:
            return error, 0.0, False
        known = reference(case.problem, same, limit)
    except (Refusal, LimitReached):
        return None, math.inf, False
    return difference(known.rows, found, scales), known.bound, False


def _proved_error(
    case: Case, request: RunRequest, rows: Rows, scales: Sequence[float], limit: float
) -> float | None:
    """A bound of the error by enclosures of the exact motion; None where they are not so thin."""
    try:
        proof = prove(case.problem, request, until(process_time() + limit * _PROOF / _SHARE))
    except (Refusal, LimitReached):
        return None
    if not proof.reached or any(ball is None for row in proof.rows for ball in row):
        return None
    worst = max(
        relative(float(abs(ball - type(ball)(str(x))).upper()), scale)
        for balls, row in zip(proof.rows, rows, strict=True)
        for ball, x, scale in zip(balls, row, scales, strict=True)
    )
    return worst if worst <= request.accuracy else None


def _is_before_events(t: float, result: Result) -> bool:
    """Rows beside an event are shown twice, and by its own time."""
    return all(event.what == "singularity" or t < event.t for event in result.events)
