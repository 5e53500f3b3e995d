"""What the runs say of the numbers, put down with them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lagcli.numerics.accuracy import Outcome
from lagcli.numerics.asked import Certificate, Result
from lagcli.numerics.events import Event
from lagcli.numerics.motion import Motion
from lagcli.numerics.refusal import told
from lagcli.numerics.steps import CannotGoOn

if TYPE_CHECKING:
    from lagcli.numerics.simulate import Simulation

REASONS = {
    "dop853": "explicit, of order 8: the cheapest that reaches the accuracy without stiffness",
    "taylor": "power series with more digits than doubles: the accuracy lies within their rounding",
}


def result_of(simulation: Simulation, motion: Motion, outcome: Outcome) -> Result:
    """The table with its certificate."""
    asked, run = simulation.asked, outcome.run
    names = tuple(column.name for column in asked.columns)
    kept = len(outcome.rows) if outcome.reached else outcome.good_rows
    rows = [
        tuple(None if x is None else float(x) for x in row[: len(names)])
        for place, row in enumerate(outcome.rows[:kept])
        if place % simulation.every == 0
        or (run.event is not None and run.times[place] == run.event.t)
    ]
    last = max(0, kept - 1)
    holds_until = run.times[last]
    events = [run.event] if run.event is not None and outcome.reached else []
    refusal = ""
    if not outcome.reached:
        refusal = _refusal(simulation, motion, outcome, holds_until)
        if run.stop is not None:
            events.append(Event(run.stop.t, "singularity", _why_stopped(motion, run.stop)))
    return Result(
        columns=names,
        rows=tuple(rows),
        certificate=Certificate(
            accuracy=asked.accuracy,
            reached=outcome.reached,
            holds_until=holds_until,
            global_error={
                name: outcome.errors[j]
                for j, name in enumerate(names)
                if asked.columns[j].expression is not None
            },
            estimated_by=_estimated_by(outcome),
            charges=_drifts(simulation, outcome, kept),
            constraints=_residuals(simulation, outcome),
        ),
        method=run.method.name,
        reason=REASONS[run.method.name],
        steps=run.steps,
        evaluations=outcome.evaluations,
        events=tuple(events),
        warnings=tuple(_warnings(simulation, rows)),
        refusal=refusal,
    )


def _estimated_by(outcome: Outcome) -> str:
    coarse, fine = outcome.tolerances
    return (
        f"twice the difference of two runs with local tolerances {coarse:.0e} and {fine:.0e}; "
        "the finer one is shown (a cross-check, no proof)"
    )


def _drifts(simulation: Simulation, outcome: Outcome, kept: int) -> dict[str, float]:
    """The largest change of each charge, relative to max(1, its magnitude)."""
    first = len(simulation.nodes)
    drifts: dict[str, float] = {}
    for j, name in enumerate(simulation.charges, start=first):
        values = [float(row[j]) for row in outcome.rows[:kept] if row[j] is not None]
        if values:
            scale = max(1.0, *map(abs, values), 1.0)
            drifts[name] = max(abs(x - values[0]) for x in values) / scale
    return drifts


def _residuals(simulation: Simulation, outcome: Outcome) -> dict[str, tuple[float | None, float]]:
    surface = outcome.run.surface
    if surface is None:
        return {}
    e = simulation.equations
    place = {k: i for i, k in enumerate(e.holonomic)}
    return {
        constraint.name: (
            surface.residuals[place[k]] if k in place else None,
            surface.residuals[len(place) + k],
        )
        for k, constraint in enumerate(e.problem.constraints)
    }


def _refusal(simulation: Simulation, motion: Motion, outcome: Outcome, holds_until: float) -> str:
    asked, stop = simulation.asked, outcome.run.stop
    if stop is not None:
        why = _why_stopped(motion, stop)
        return f"the motion stops at t = {stop.t:.13g}: {why}; shown until t = {holds_until:.6g}"
    bound = max(outcome.errors)
    why = outcome.reason or f"the bound at the end is {bound:.1e}"
    told = f"the accuracy {asked.accuracy:g} is not reached until t = {asked.until:g}: {why}"
    held = f"it holds until t = {holds_until:.6g}"
    more = "" if asked.digits is not None else "; --precision carries more digits"
    return f"{told}; {held}{more}"


def _why_stopped(motion: Motion, stop: CannotGoOn) -> str:
    """What ends the motion."""
    if stop.reason.startswith(("it takes", "a force")):
        return stop.reason
    names = [q.name for q in motion.equations.q]
    try:
        rates: Any = motion.accelerations(stop.t, *stop.q, *stop.v)
        j = max(range(len(names)), key=lambda k: abs(float(rates[k])))
        grows = f"{names[j]}'' grows without bound there"
    except (ArithmeticError, ValueError) as error:
        return f"the accelerations are not defined there: {told(error)}"
    return f"{grows} ({stop.reason})" if stop.reason else grows


def _warnings(simulation: Simulation, rows: list[Any]) -> list[str]:
    found = []
    for j, column in enumerate(simulation.asked.columns):
        empty = [row[0] for row in rows if row[j] is None]
        if empty and len(empty) == len(rows):
            found.append(f"{column.name} is not determined: redundant constraints share a force")
        elif empty:
            found.append(f"{column.name} is not defined at t = {empty[0]:g}")
    return found
