"""The files under the paths, checked and reported as the results come."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing

from lagcli.cli.error_output import report_line
from lagcli.cli.files import print_result
from lagcli.cli.motion_commands import is_known
from lagcli.cli.status import Status
from lagcli.studies.check import CheckOutcome, NothingToCheck, Report, check_all, problem_files
from lagcli.studies.check.reports import FORMS


def check_paths(
    paths: Sequence[str], form: str, jobs: int | None, limit: float, shard: str | None = None
) -> Status:
    """Check, print, and say how it ended."""
    part, known = _part(shard), is_known("--format", form, tuple(FORMS))
    try:
        files = problem_files(paths)
    except NothingToCheck as error:
        for line in error.lines:
            report_line(line)
        return Status.USAGE
    if not known or part is None:
        return Status.USAGE
    files = files[part]
    worst = Status.WELL

    def noted(reports: Iterable[Report]) -> Iterator[Report]:
        nonlocal worst
        for report in reports:
            worst = max(worst, _status(report))
            yield report

    with closing(check_all(files, jobs or cores(), limit)) as reports:
        for piece in FORMS[form](_with_progress(noted(reports), len(files))):
            print_result(piece.encode("utf-8", "replace"))
    return worst


def _part(shard: str | None) -> slice | None:
    """Every N-th file from the I-th for `I/N`; None where that is wrong, which is reported."""
    if shard is None:
        return slice(None)
    first, slash, count = shard.partition("/")
    if slash and first.isdecimal() and count.isdecimal() and 1 <= int(first) <= int(count):
        return slice(int(first) - 1, None, int(count))
    report_line(f"lagcli: error: --shard: write I/N with 1 <= I <= N, such as 1/4, not '{shard}'")
    return None


def _status(report: Report) -> Status:
    if report.passed:
        return Status.WELL
    return Status.USAGE if report.outcome is CheckOutcome.INVALID else Status.NOT_FOUND


def cores() -> int:
    """The cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _with_progress(reports: Iterable[Report], total: int) -> Iterable[Report]:
    """A bar on standard error, where someone is there to see it and the results are not."""
    if total < 2 or not sys.stderr.isatty() or sys.stdout.isatty():
        return reports
    from rich.console import Console
    from rich.progress import track

    return track(reports, "checking", total=total, console=Console(stderr=True), transient=True)
