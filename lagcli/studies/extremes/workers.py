"""Cases put to the test in a process of their own, which is ended where it does not return."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import Any

from lagcli.platform.failures import describe
from lagcli.problem_data import Problem
from lagcli.sparing import spare_sympy
from lagcli.studies.extremes.case import Case, CaseFormula, Trial
from lagcli.studies.extremes.formulas import printed_formulas
from lagcli.studies.extremes.trial import Wanted, trial
from lagcli.studies.worker import Worker

#: Wall time for each second of processor time, before a process is ended.
_PATIENCE = 10.0

Task = tuple[str, tuple[Any, ...]]


class Bench:
    """A process that works on one task after another; a new one where the last was ended."""

    def __init__(self) -> None:
        self._worker: Worker | None = None

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
        if self._worker is not None:
            self._worker.kill()
        self._worker = None

    def _asked(self, task: Task, limit: float) -> Any:
        """The answer; a sentence where there is none."""
        if self._worker is None:
            spare_sympy()
            self._worker = Worker(_answer)
        connection = self._worker.connection
        try:
            connection.send(task)
            if connection.poll(_PATIENCE * limit):
                return connection.recv()
        except (EOFError, OSError):
            self.stop()
            return "the process ended without a word"
        self.stop()
        return f"it takes more than {limit:g} s"


def _answer(what: str, given: tuple[Any, ...]) -> Any:
    work: Any = printed_formulas if what == "formulas" else trial
    try:
        return work(*given)
    except Exception as error:  # noqa: BLE001 - one case's failure is not the others'
        return describe(error)
