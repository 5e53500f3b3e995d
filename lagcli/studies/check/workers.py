"""Many checks at once, each with a time limit that is kept by killing what exceeds it."""

from __future__ import annotations

import sys
import time
from collections.abc import Generator, Sequence
from multiprocessing.connection import wait
from pathlib import Path

from lagcli.diagnostics import Diagnostic, Source
from lagcli.platform.failures import describe
from lagcli.sparing import keep_what_is_there, spare_sympy
from lagcli.studies.check.findings import Report
from lagcli.studies.check.one import broken, check_problem, too_long
from lagcli.studies.worker import Worker


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
    _import_what_workers_need()
    pool = _Pool(files, limit)
    try:
        pool.start(min(jobs, len(files)) if files else 0)
        for place in range(len(files)):
            while place not in pool.reports:
                pool.advance()
            yield pool.reports.pop(place)
    finally:
        pool.stop()


def _import_what_workers_need() -> None:
    spare_sympy()

    keep_what_is_there()


class _FileWorker(Worker):
    """A worker with the place of its file, and the end of the time that this has."""

    place: int | None = None
    deadline = float("inf")

    def begin(self, place: int, name: str, data: bytes | None, limit: float) -> None:
        """Send a file, or what standard input held; the clock of that file starts."""
        self.place = place
        self.deadline = time.monotonic() + limit
        self.connection.send((name, data))


class _Pool:
    """The workers, the files that wait, and the reports that are there."""

    def __init__(self, files: Sequence[str], limit: float) -> None:
        self.files = files
        self.limit = limit
        self.standard = sys.stdin.buffer.read() if "-" in files else None
        self.waiting = iter(range(len(files)))
        self.workers: list[_FileWorker] = []
        self.reports: dict[int, Report] = {}

    def start(self, count: int) -> None:
        """Start the workers and give each a file."""
        for _ in range(count):
            self._add()

    def _add(self) -> None:
        worker = _FileWorker(_report, self.workers)
        self.workers.append(worker)
        self._feed(worker)

    def _feed(self, worker: _FileWorker) -> None:
        place = next(self.waiting, None)
        if place is None:
            worker.place, worker.deadline = None, float("inf")
        else:
            name = self.files[place]
            worker.begin(place, name, self.standard if name == "-" else None, self.limit)

    def advance(self) -> None:
        """Wait for a report or a deadline, and note what came."""
        busy = [worker for worker in self.workers if worker.place is not None]
        rest = max(0.0, min(worker.deadline for worker in busy) - time.monotonic())
        ready = wait([worker.connection for worker in busy], timeout=rest)
        for worker in busy:
            assert worker.place is not None
            name = self.files[worker.place]
            if worker.connection in ready:
                self._receive(worker, worker.place, name)
            elif time.monotonic() >= worker.deadline:
                self._replace(worker, worker.place, too_long(name, self.limit))

    def _receive(self, worker: _FileWorker, place: int, name: str) -> None:
        try:
            self.reports[place] = worker.connection.recv()
        except EOFError:
            ending = f"the process ended with status {worker.ended()}"
            self._replace(worker, place, broken(name, ending))
        else:
            self._feed(worker)

    def _replace(self, worker: _FileWorker, place: int, report: Report) -> None:
        self.reports[place] = report
        worker.kill()
        self.workers.remove(worker)
        self._add()

    def stop(self) -> None:
        """End all workers."""
        for worker in self.workers:
            worker.kill()


def _report(name: str, data: bytes | None) -> Report:
    try:
        return check_problem(name, Path(name).read_bytes() if data is None else data)
    except OSError as error:
        sentence = error.strerror or str(error)
        return Report(Source(name, ""), diagnostics=(Diagnostic(sentence),))
    except Exception as error:  # noqa: BLE001 - one file's failure is not the others'
        return broken(name, describe(error))
