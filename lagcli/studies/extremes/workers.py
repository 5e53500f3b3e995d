"""Cases put to the test in a process of their own, which is ended where it does not return."""

from __future__ import annotations

import multiprocessing
import signal
import sys
import time
from collections.abc import Generator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from lagcli.platform.failures import describe
from lagcli.platform.stack import with_deep_stack
from lagcli.problem_data import Problem
from lagcli.sparing import spare_sympy
from lagcli.studies.extremes.case import Case, CaseFormula, Trial
from lagcli.studies.extremes.formulas import printed_formulas
from lagcli.studies.extremes.trial import Wanted, trial

_FORKS = sys.platform == "linux"
_PROCESSES = multiprocessing.get_context("fork") if _FORKS else multiprocessing.get_context("spawn")
#: Wall time for each second of processor time, before a process is ended.
_PATIENCE = 10.0

Task = tuple[str, tuple[Any, ...]]


class Bench:
    """A process that works on one task after another; a new one where the last was ended."""

    def __init__(self) -> None:
        self._process: Any = None
        self._connection: Connection | None = None

    def formulas(self, problem: Problem, limit: float) -> tuple[tuple[CaseFormula, ...], str]:
        """What `solve` prints, and why there is none."""
        found = self._asked(("formulas", (problem,)), limit)
        return ((), found) if isinstance(found, str) else (found, "")

    def trials(
        self, cases: Sequence[Case], formulas: Sequence[CaseFormula], wanted: Wanted
    ) -> Generator[Trial, None, None]:
        """What came of each case, in their order."""
        for case in cases:
            found = self._asked(("trial", (case, formulas, wanted)), wanted.limit)
            yield Trial(verdict="undecided", reason=found) if isinstance(found, str) else found

    def stop(self) -> None:
        """End the process."""
        if self._process is not None and self._connection is not None:
            self._process.kill()
            self._process.join()
            self._connection.close()
        self._process = self._connection = None

    def _asked(self, task: Task, limit: float) -> Any:
        """The answer; a sentence where there is none."""
        connection = self._connection or self._started()
        try:
            connection.send(task)
            end = time.monotonic() + _PATIENCE * limit
            if connection.poll(max(0.0, end - time.monotonic())):
                return connection.recv()
        except (EOFError, OSError):
            self.stop()
            return "the process ended without a word"
        self.stop()
        return f"it takes more than {limit:g} s"

    def _started(self) -> Connection:
        self._connection, theirs = _PROCESSES.Pipe()
        own = self._connection if _FORKS else None
        self._process = _PROCESSES.Process(target=_work, args=(theirs, own), daemon=True)
        self._process.start()
        theirs.close()
        return self._connection


def _work(connection: Connection, parents: Connection | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends its workers
    if parents is not None:  # else the end of the parent would not be seen here
        parents.close()
    spare_sympy()
    with_deep_stack(lambda: _serve(connection))


def _serve(connection: Connection) -> None:
    with suppress(EOFError, OSError):
        while True:
            what, given = connection.recv()
            try:
                work: Any = printed_formulas if what == "formulas" else trial
                answer = work(*given)
            except Exception as error:  # noqa: BLE001 - one case's failure is not the others'
                answer = describe(error)
            connection.send(answer)
