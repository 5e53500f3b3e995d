"""Cases put to the test in a process of their own, which is ended where it does not return."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from lagcli.platform.failures import describe
from lagcli.problem_data import Problem
from lagcli.studies.extremes.case import Case, CaseFormula, CaseTrial
from lagcli.studies.extremes.formulas import printed_formulas
from lagcli.studies.extremes.trial import Wanted, trial
from lagcli.studies.worker import NoAnswer, Pool

#: Wall time for each second of processor time, before a process is ended.
_PATIENCE = 10.0


def formulas_in(pool: Pool, problem: Problem, limit: float) -> tuple[tuple[CaseFormula, ...], str]:
    """What `solve` prints, and why there is none."""
    [found] = _answers(pool, [("formulas", (problem,))], limit)
    return ((), found) if isinstance(found, str) else (found, "")


def trials_in(
    pool: Pool, cases: Sequence[Case], formulas: Sequence[CaseFormula], wanted: Wanted
) -> Iterator[CaseTrial]:
    """What came of each case, in their order."""
    tasks = [("trial", (case, formulas, wanted)) for case in cases]
    for found in _answers(pool, tasks, wanted.limit):
        yield CaseTrial(verdict="undecided", reason=found) if isinstance(found, str) else found


def _answers(pool: Pool, tasks: Sequence[tuple[Any, ...]], limit: float) -> Iterator[Any]:
    """The answers, each missing one as a sentence."""
    for found in pool.answers(tasks, _PATIENCE * limit):
        if not isinstance(found, NoAnswer):
            yield found
        elif found.status is None:
            yield f"it takes more than {limit:g} s"
        else:
            yield "the process ended without a word"


def answer(what: str, given: tuple[Any, ...]) -> Any:
    """The work of a process: the printed formulas, or a trial; a sentence where it fails."""
    work: Any = printed_formulas if what == "formulas" else trial
    try:
        return work(*given)
    except Exception as error:  # noqa: BLE001 - one case's failure is not the others'
        return describe(error)
