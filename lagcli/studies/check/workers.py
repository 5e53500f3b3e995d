"""Many checks at once, each with a time limit."""

from __future__ import annotations

import sys
from collections.abc import Generator, Sequence
from pathlib import Path

from lagcli.diagnostics import Diagnostic, Source
from lagcli.platform.failures import describe
from lagcli.sparing import keep_what_is_there, spare_sympy
from lagcli.studies.check.findings import Report
from lagcli.studies.check.one import broken, check_problem, too_long
from lagcli.studies.worker import NoAnswer, Pool


def check_all(files: Sequence[str], jobs: int, limit: float) -> Generator[Report, None, None]:
    """Check the files and yield their reports in the order of the files.

    Parameters
    ----------
    files
        Paths of problem files; `-` is standard input.
    jobs
        How many processes work at the same time.
    limit
        Seconds for each file.
    """
    spare_sympy()
    keep_what_is_there()
    standard = sys.stdin.buffer.read() if "-" in files else None
    tasks = [(name, standard if name == "-" else None) for name in files]
    pool = Pool(_report, jobs)
    try:
        for name, found in zip(files, pool.answers(tasks, limit), strict=True):
            yield _missing(name, found, limit) if isinstance(found, NoAnswer) else found
    finally:
        pool.stop()


def _missing(name: str, why: NoAnswer, limit: float) -> Report:
    if why.status is None:
        return too_long(name, limit)
    return broken(name, f"the process ended with status {why.status}")


def _report(name: str, data: bytes | None) -> Report:
    try:
        return check_problem(name, Path(name).read_bytes() if data is None else data)
    except OSError as error:
        sentence = error.strerror or str(error)
        return Report(Source(name, ""), diagnostics=(Diagnostic(sentence),))
    except Exception as error:  # noqa: BLE001 - one file's failure is not the others'
        return broken(name, describe(error))
