"""One ensemble to one table; what is finished is kept on the way."""

from __future__ import annotations

from hashlib import sha256

from lagcli.cli.checking import cores
from lagcli.cli.choices import PICTURES, TABLES
from lagcli.cli.error_output import report_line
from lagcli.cli.motion_commands import counted, is_known, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.plotting import is_drawn_as
from lagcli.cli.simulating import SimulateOptions, can_be_written, request_of
from lagcli.cli.status import Status
from lagcli.numerics.hybrid.request import RunRequest
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


def sweep_file(options: SweepOptions) -> Status:
    """Run, write, and say how it ended."""
    known = is_known("--format", options.format_name, (*TABLES, *PICTURES))
    if not (known and _can_be_written(options)) & has_place(options.output):
        return Status.USAGE
    found = understood(options, lambda problem: _options(problem, options))
    if found is None:
        return Status.USAGE
    problem, (request, plan) = found
    options = replace(options, along=options.along or bool(request.times))
    with Journal(options.output, _digest(options, problem, request, plan)) as journal:
        if journal.done:
            report_line(f"{options.output}: going on after {len(journal.done)} finished parts")
        try:
            with counted("sweeping") as progress:
                table = sweep(
                    problem, request, plan, journal, along=options.along,
                    jobs=options.jobs or cores(), scheduler=options.scheduler, progress=progress,
                )  # fmt: skip
        except NoCluster as reason:
            report_line(f"lagcli: error: {reason}")
            return _without_cluster(options, journal)
        data = _written(table, problem, request, plan, options)
        if data is None or not place(data, options.output):
            return Status.USAGE
        journal.remove()
    if not table.complete:
        missed = sum(row[table.columns.index("reached")] != 1.0 for row in table.rows)
        report_line(f"{options.file}: {missed} of {len(table.rows)} rows do not reach the accuracy")
        return Status.NOT_FOUND
    return Status.WELL


def _can_be_written(options: SweepOptions) -> bool:
    if options.format_name not in PICTURES:
        return can_be_written(options)
    if options.output is None:
        report_line(f"lagcli: error: a picture goes to a file: -o sweep.{options.format_name}")
        return False
    return is_drawn_as(options.output, PICTURES)


def _written(
    table: Table, problem: Problem, request: RunRequest, plan: Plan, options: SweepOptions
) -> bytes | None:
    """The table or its picture; None where there is no such picture, which is reported."""
    if options.format_name not in PICTURES:
        return WRITERS[options.format_name](table)
    from lagcli.pictures.drawing import CannotDraw
    from lagcli.pictures.ensemble import Motions, ensemble
    from lagcli.pictures.figure import to_bytes

    count, reached = len(plan.names) + len(request.columns), table.columns.index("reached")
    motions = Motions(
        varied=plan.names,
        is_grid=plan.random is None,
        columns=request.columns,
        rows=[row[:count] for row in table.rows],
        are_right=[row[reached] == 1.0 for row in table.rows],
        along=options.along,
    )
    try:
        return to_bytes(ensemble(problem, motions), options.format_name)
    except CannotDraw as reason:
        report_line(f"{options.file}: error: {reason}")
        return None


def _without_cluster(options: SweepOptions, journal: Journal) -> Status:
    """What is there for the next call, when the scheduler was lost or never found."""
    if not journal.done:
        journal.remove()
        return Status.USAGE
    if options.output is not None:
        report_line(f"{options.output}: give the same command again to go on where this one ended")
    return Status.NOT_FOUND


def _options(problem: Problem, options: SweepOptions) -> tuple[RunRequest, Plan] | None:
    try:
        plan = plan_of(problem, options.vary, options.random, options.seed)
        given = times_of(options.at_times) if options.at_times else ()
    except WrongPlan as error:
        for line in error.lines:
            report_line(f"lagcli: error: {line}")
        return None
    request = request_of(problem, options, without_end=given[-1] if given else None)
    return None if request is None else (at_times(request, given), plan)


def _digest(options: SweepOptions, problem: Problem, request: RunRequest, plan: Plan) -> str:
    """Names the sweep by all that its rows depend on, the program included."""
    from lagcli.platform.cache import key

    parts = [repr(plan), options.until, options.accuracy, options.samples, options.settings,
             options.state, options.show, options.method, options.along, request.times,
             options.stop_when]  # fmt: skip
    text = key({"sweep": repr(parts)}, [(options.file, problem.source.text.encode())])
    return sha256(str(text).encode()).hexdigest()
