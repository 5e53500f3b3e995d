"""What the runs say of the numbers, put down with them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from lagcli.numerics.certified.accuracy import USUAL, Outcome
from lagcli.numerics.certified.drift import changes
from lagcli.numerics.certified.exact_columns import at_written_times, with_digits
from lagcli.numerics.certified.left_signs import left_signs
from lagcli.numerics.certified.methods import METHODS
from lagcli.numerics.certified.scales import relative
from lagcli.numerics.equations.columns import Values
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import reason_of
from lagcli.numerics.hybrid.events import Event
from lagcli.numerics.hybrid.result import Certificate, Result
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import CannotGoOn, Grazes, StopWithReason
from lagcli.problem_data import pushing_sign
from lagcli.record import replace

#: A motion that is known up to this part of the time at which its run stops, stops there.
_KNOWN = 0.5
#: Accelerations that move a coordinate by less than this multiple of itself do not end the motion.
_BOUNDED = 1e3
#: Parts of the time over which the forces bend: what bends by as much over the shorter one jumps;
#: a corner bends by 1e-2 of it, what is smooth by 1e-4.
_SIDES, _SMOOTH = (1e-4, 1e-6), 1e-3


def result_of(setup: Setup, motion: Motion, outcome: Outcome, remark: str) -> Result:
    """The table with its certificate; a remark on the methods stands with the reason for one."""
    request, run = setup.request, outcome.run
    outcome = replace(outcome, rows=with_digits(setup, outcome))
    outcome = replace(outcome, rows=at_written_times(setup, outcome))
    names = tuple(column.name for column in request.columns)
    kept = len(outcome.rows) if outcome.reached else outcome.good_rows
    rows, every = list[tuple[float | None, ...]](), setup.every
    for place, mark in enumerate(run.marks[:kept]):
        ends = run.event is not None and place == len(run.marks) - 1
        if mark.sample >= 0:
            is_usual = outcome.looked_at is None or mark.sample < outcome.looked_at
            regular = is_usual and mark.sample % every == 0
            shown = regular or (place == kept - 1 and not outcome.reached)
        else:
            shown = ends and (not rows or rows[-1][0] != mark.t)
        if shown:
            rows.append(_floats(outcome.rows[place][: len(names)]))
    last = max(0, kept - 1)
    holds_until = run.marks[last].t
    events = _events(outcome, names, kept)
    refusal = ""
    if not outcome.reached:
        refusal = refusal_of(setup, motion, outcome, holds_until)
        if run.stop is not None and _is_known(outcome, holds_until):
            what = "grazes" if isinstance(run.stop, Grazes) else "singularity"
            events.append(Event(run.stop.t, what, why_stopped(motion, run.stop)))
    return Result(
        columns=names,
        rows=tuple(rows),
        certificate=Certificate(
            accuracy=request.accuracy,
            reached=outcome.reached,
            holds_until=holds_until,
            global_error={
                name: outcome.held[j]
                for j, name in enumerate(names)
                if request.columns[j].expression is not None
            },
            scales=tuple(outcome.held_scales),
            estimated_by=_estimated_by(outcome),
            charges=_drifts(setup, outcome, kept),
            constraints=_residuals(outcome, setup),
        ),
        method=run.method_name or "dop853",
        reason=METHODS[run.method_name or "dop853"].reason + _apart(run) + remark,
        steps=run.steps,
        evaluations=outcome.evaluations,
        events=tuple(events),
        warnings=(
            *_broken_at_once(setup, motion, outcome, events),
            *_warnings(setup, rows, events),
            *left_signs(setup, run.marks[:kept]),
        ),
        cut=setup.cut,
        refusal=refusal,
    )


def requested_rows(setup: Setup, outcome: Outcome) -> list[tuple[float | None, ...]]:
    """The rows of a run at the times of the output, certified or not, if they are requested."""
    if not setup.request.beyond:
        return []
    count = len(setup.request.columns)
    return [
        _floats(row[:count])
        for mark, row in zip(outcome.run.marks, outcome.rows, strict=True)
        if mark.sample >= 0 and mark.sample % setup.every == 0
    ]


def _apart(run: Run) -> str:
    """Which coordinates had steps of their own."""
    if not run.apart:
        return ""
    parts = "; ".join(map(", ".join, run.apart))
    return f"; subsystems that move without each other took steps of their own ({parts})"


def _floats(row: Sequence[Any]) -> tuple[float | None, ...]:
    return tuple(None if x is None else float(x) for x in row)


def _events(outcome: Outcome, names: Sequence[str], kept: int) -> list[Event]:
    """What happened while the accuracy held, with the columns on both sides."""
    run = outcome.run
    sides = {
        (mark.phase, mark.begins): dict(zip(names, _floats(row[: len(names)]), strict=True))
        for mark, row in zip(run.marks[:kept], outcome.rows, strict=False)
        if mark.sample < 0
    }
    found = []
    for (phase, event), late in zip(run.events, outcome.times, strict=True):
        if phase >= 0 and (phase, False) not in sides:
            break
        found.append(
            replace(
                event,
                error=event.error + late,
                before=_without_time(sides.get((phase, False), {})),
                after=_without_time(sides.get((phase + 1, True), {})),
            )
        )
    return found


def _without_time(row: dict[str, float | None]) -> dict[str, float | None]:
    return {name: value for name, value in row.items() if name != "t"}


def _estimated_by(outcome: Outcome) -> str:
    coarse, fine = outcome.tolerances
    least, largest = outcome.multiples
    times = "twice" if largest == USUAL else f"{largest:g} times"
    times = times if least == largest else f"up to {times}"
    runs = "three" if outcome.is_against_two else "two"
    return (
        f"{times} the difference of {runs} runs with local tolerances {coarse:.0e} and {fine:.0e}; "
        "the finer one is shown (a cross-check, no proof)"
    )


def _drifts(setup: Setup, outcome: Outcome, kept: int) -> dict[str, float]:
    """The largest change of each charge between events, relative to the sum of its terms."""
    first = len(setup.nodes)
    drifts: dict[str, float] = {}
    for j, name in enumerate(setup.charges):
        values = [row[first + j] for row in outcome.rows[:kept]]
        for _, found, scale in changes(outcome.run, j, values):
            drifts[name] = max(drifts.get(name, 0.0), relative(max(map(abs, found)), scale))
    return drifts


def _residuals(outcome: Outcome, setup: Setup) -> dict[str, tuple[float | None, float]]:
    """The largest residual of each constraint while it acts, and of its rate.

    One that was solved for a coordinate holds by itself.
    """
    solved = setup.cut.eliminated if setup.cut else ()
    found: dict[str, tuple[float | None, float]] = {s.constraint: (0.0, 0.0) for s in solved}
    for phase in outcome.run.phases:
        if phase.surface is None:
            continue
        e, residuals = phase.mode.equations, phase.surface.residuals
        place = {k: i for i, k in enumerate(e.holonomic)}
        for k, constraint in enumerate(e.declared):
            position, rate = found.get(constraint.name, (None, 0.0))
            if k in place:
                position = max(position or 0.0, residuals[place[k]])
            found[constraint.name] = (position, max(rate, residuals[len(place) + k]))
    return found


def refusal_of(setup: Setup, motion: Motion, outcome: Outcome, holds_until: float) -> str:
    """Why the accuracy is not reached to the end, and until when it holds."""
    request, stop = setup.request, outcome.run.stop
    if stop is not None and _is_known(outcome, holds_until):
        why = why_stopped(motion, stop)
        return f"the motion stops at t = {stop.t:.13g}: {why}; shown until t = {holds_until:.6g}"
    why = outcome.reason or _what_grows(outcome)
    reason_of = (
        f"the accuracy {request.accuracy:g} is not reached until t = {request.until:g}: {why}"
    )
    held = f"it holds until t = {holds_until:.6g}"
    in_doubles = setup.goes_on or setup.equations.kinks
    helps = request.digits is None and not in_doubles and not outcome.reason
    return f"{reason_of}; {held}" + ("; --precision carries more digits" if helps else "")


def _what_grows(outcome: Outcome) -> str:
    """Rounding, or the distance of neighbouring motions until no digit is known."""
    if outcome.lost_at < outcome.controller.span:
        return "motions that begin a rounding apart agree in no digit later on"
    return f"rounding leaves an error of up to {max(outcome.errors):.1e}"


def _is_known(outcome: Outcome, holds_until: float) -> bool:
    """Whether a run that stops does so where the motion does, not long after nothing is known."""
    run = outcome.run
    assert run.stop is not None
    return run.steps >= run.step_limit or holds_until >= _KNOWN * run.stop.t


def why_stopped(motion: Motion, stop: CannotGoOn) -> str:
    """What ends the motion."""
    if isinstance(stop, StopWithReason):
        return stop.reason
    names = [q.name for q in motion.equations.q]
    try:
        rates: Any = motion.accelerations(stop.t, *stop.q, *stop.v)
        j = max(range(len(names)), key=lambda k: abs(float(rates[k])))
        if any(math.isnan(float(x)) for x in rates):  # 0 times what is larger than any double
            raise OverflowError
        if abs(float(rates[j])) * stop.t**2 <= _BOUNDED * _size(stop.q):
            return stop.reason or _irregularity(motion, stop)
        grows = f"{names[j]}'' grows without bound there"
    except (ArithmeticError, ValueError) as error:
        return f"the accelerations are not defined there: {reason_of(error)}"
    return f"{grows} ({stop.reason})" if stop.reason else grows


def _irregularity(motion: Motion, stop: CannotGoOn) -> str:
    """What ends a motion whose accelerations stay finite."""

    def rates(time: float) -> Sequence[Any]:
        places = (x + time * u for x, u in zip(stop.q, stop.v, strict=True))
        return motion.accelerations(stop.t + time, *places, *stop.v)

    def bend(time: float) -> float:
        """|a(t + h) - 2 a(t) + a(t - h)|: of h^0 where a jumps, of h where it has a corner."""
        sides = zip(rates(-time), rates(0.0), rates(time), strict=True)
        return max(abs(float(a - 2 * b + c)) for a, b, c in sides)

    try:
        far, near = (bend(part * (stop.t or 1.0)) for part in _SIDES)
    except (ArithmeticError, ValueError):
        return "a function in the equations is not defined beyond"
    if not near > _SMOOTH * far:
        return "the power series of a function in the equations is beyond all numbers there"
    what = "jumps" if 2 * near > far else "has a corner"
    return f"a function in the equations {what} there"


def _broken_at_once(
    setup: Setup, motion: Motion, outcome: Outcome, events: list[Event]
) -> Iterator[str]:
    """A sentence for each constraint whose force has the other sign in the initial state."""
    lost = {event.name for event in events if event.what == "contact lost" and event.t == 0}
    for k, node in setup.margins.items():
        one = setup.whole.constraints[k]
        sign = None if one.holds_while is None else pushing_sign(one.multiplier, one.holds_while)
        if one.name not in lost or k not in setup.given or sign is None:
            continue
        mark = outcome.run.marks[0]
        [margin] = Values(motion, setup.reading, [node])(mark.t, mark.q, mark.v)
        if margin is not None and float(margin) < 0:
            holds, fits = (">=", "<=") if sign > 0 else ("<=", ">=")
            yield (
                f"{one.multiplier} {holds} 0 does not hold at the beginning, where "
                f"{one.multiplier} = {sign * float(margin):.6g}; for a force of this sign write "
                f"holds_while: {one.multiplier} {fits} 0"
            )


def _warnings(setup: Setup, rows: list[Any], events: list[Event]) -> list[str]:
    found = list(setup.notes)
    found += [
        f"{event.name} comes to its limit at t = {event.t:.10g}: whether it is lost there is "
        "within the error; it is kept"
        for event in events
        if event.what == "touches"
    ]
    for j, column in enumerate(setup.request.columns):
        empty = [row[0] for row in rows if row[j] is None]
        if empty and len(empty) == len(rows):
            why = "not determined: redundant constraints share a force"
            shares = setup.whole.constraints
            found.append(f"{column.name} is {why if shares else 'not defined at any row'}")
        elif empty:
            found.append(f"{column.name} is not defined at t = {empty[0]:g}")
    return found


def _size(q: Sequence[Any]) -> float:
    return max(1.0, *(abs(float(x)) for x in q))
