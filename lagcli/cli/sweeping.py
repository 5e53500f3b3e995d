"""One ensemble to one table; what is finished is kept on the way."""

from __future__ import annotations

from hashlib import sha256

from lagcli.cli.checking import cores
from lagcli.cli.choices import PICTURES, TABLES
from lagcli.cli.error_output import report_line
from lagcli.cli.motion_commands import counted, is_known, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.plotting import is_drawn_as
from lagcli.cli.simulating import SimulateOptions, asked_of, can_be_written
from lagcli.cli.status import Status
from lagcli.numerics.hybrid.request import Asked
from lagcli.problem_data import Problem
from lagcli.record import record, replace
from lagcli.studies.sweep import WRITERS, Plan, Table, WrongPlan, at_times, plan_of, sweep, times_of
from lagcli.studies.sweep.journal import Journal
from lagcli.studies.sweep.workers import NoCluster


@record(kw_only=True)
class SweepOptions(SimulateOptions):
    """The command line, as it was written."""

    vary: tuple[str, ...] = ()
    random: int | None = None
    seed: int
    along: bool
    at_times: str | None
    jobs: int | None = None
    scheduler: str | None = None


def sweep_file(wish: SweepOptions) -> Status:
    """Run, write, and say how it ended."""
    known = is_known("--format", wish.format_name, (*TABLES, *PICTURES))
    if not (known and _can_be_written(wish)) & has_place(wish.output):
        return Status.USAGE
    found = understood(wish, lambda problem: _options(problem, wish))
    if found is None:
        return Status.USAGE
    problem, (asked, plan) = found
    wish = replace(wish, along=wish.along or bool(asked.times))
    with Journal(wish.output, _digest(wish, problem, asked, plan)) as journal:
        if journal.done:
            report_line(f"{wish.output}: going on after {len(journal.done)} finished parts")
        try:
            with counted("sweeping") as progress:
                table = sweep(
                    problem, asked, plan, journal, along=wish.along, jobs=wish.jobs or cores(),
                    scheduler=wish.scheduler, progress=progress,
                )  # fmt: skip
        except NoCluster as reason:
            report_line(f"lagcli: error: {reason}")
            return _without_cluster(wish, journal)
        data = _written(table, problem, asked, plan, wish)
        if data is None or not place(data, wish.output):
            return Status.USAGE
        journal.remove()
    if not table.complete:
        missed = sum(row[table.columns.index("reached")] != 1.0 for row in table.rows)
        report_line(f"{wish.file}: {missed} of {len(table.rows)} rows do not reach the accuracy")
        return Status.NOT_FOUND
    return Status.WELL


def _can_be_written(wish: SweepOptions) -> bool:
    if wish.format_name not in PICTURES:
        return can_be_written(wish)
    if wish.output is None:
        report_line(f"lagcli: error: a picture goes to a file: -o sweep.{wish.format_name}")
        return False
    return is_drawn_as(wish.output, PICTURES)


def _written(
    table: Table, problem: Problem, asked: Asked, plan: Plan, wish: SweepOptions
) -> bytes | None:
    """The table or its picture; None where there is no such picture, which is reported."""
    if wish.format_name not in PICTURES:
        return WRITERS[wish.format_name](table)
    from lagcli.pictures.drawing import CannotDraw
    from lagcli.pictures.ensemble import Motions, ensemble
    from lagcli.pictures.figure import to_bytes

    count, reached = len(plan.names) + len(asked.columns), table.columns.index("reached")
    motions = Motions(
        varied=plan.names,
        is_grid=plan.random is None,
        columns=asked.columns,
        rows=[row[:count] for row in table.rows],
        are_right=[row[reached] == 1.0 for row in table.rows],
        along=wish.along,
    )
    try:
        return to_bytes(ensemble(problem, motions), wish.format_name)
    except CannotDraw as reason:
        report_line(f"{wish.file}: error: {reason}")
        return None


def _without_cluster(wish: SweepOptions, journal: Journal) -> Status:
    """What is there for the next call, when the scheduler was lost or never found."""
    if not journal.done:
        journal.remove()
        return Status.USAGE
    if wish.output is not None:
        report_line(f"{wish.output}: give the same command again to go on where this one ended")
    return Status.NOT_FOUND


def _options(problem: Problem, wish: SweepOptions) -> tuple[Asked, Plan] | None:
    try:
        plan = plan_of(problem, wish.vary, wish.random, wish.seed)
        given = times_of(wish.at_times) if wish.at_times else ()
    except WrongPlan as error:
        for line in error.lines:
            report_line(f"lagcli: error: {line}")
        return None
    asked = asked_of(problem, wish, without_end=given[-1] if given else None)
    return None if asked is None else (at_times(asked, given), plan)


def _digest(wish: SweepOptions, problem: Problem, asked: Asked, plan: Plan) -> str:
    """Names the sweep by all that its rows depend on, the program included."""
    from lagcli.platform.cache import key

    options = [repr(plan), wish.until, wish.accuracy, wish.samples, wish.settings, wish.state,
               wish.show, wish.method, wish.along, asked.times, wish.stop_when]  # fmt: skip
    text = key({"sweep": repr(options)}, [(wish.file, problem.source.text.encode())])
    return sha256(str(text).encode()).hexdigest()
