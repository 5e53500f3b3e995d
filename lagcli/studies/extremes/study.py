"""All cases of a problem, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fnmatch import fnmatchcase

from lagcli.problem_data import Problem
from lagcli.record import record
from lagcli.sparing import spare_sympy
from lagcli.studies.extremes.case import BAD, KINDS, Case, CaseFormula, CaseTrial
from lagcli.studies.extremes.cases import cases_of
from lagcli.studies.extremes.scene import ExtremeScene, with_all_values
from lagcli.studies.extremes.trial import Wanted
from lagcli.studies.extremes.workers import answer, formulas_in, trials_in
from lagcli.studies.worker import Pool

#: Seconds for the formulas that `solve` prints.
_SOLVING = 60.0

#: Called before each case: how many are done, of how many.
Progress = Callable[[int, int], None]


@record(kw_only=True)
class ExtremesStudy:
    """What came of it.

    Attributes
    ----------
    name
        Of the problem.
    formulas
        Those that `solve` prints.
    trials : tuple of (Case, CaseTrial)
        In the order of the cases.
    wanted
        The request for each.
    notes
        What is to be known of all of them.
    """

    name: str
    formulas: tuple[CaseFormula, ...]
    trials: tuple[tuple[Case, CaseTrial], ...]
    wanted: Wanted
    notes: tuple[str, ...] = ()

    @property
    def bad(self) -> int:
        """How many are neither right nor refused."""
        return sum(trial.verdict in BAD for _, trial in self.trials)


class NoSuchCase(Exception):
    """A word of `--cases` that fits none."""

    def __init__(self, word: str, known: Sequence[str]) -> None:
        super().__init__(word)
        self.word, self.known = word, known


def study(
    problem: Problem, wanted: Wanted, words: Sequence[str] = (), progress: Progress | None = None
) -> ExtremesStudy:
    """Make the cases and put each to the test.

    Parameters
    ----------
    problem
        As it is read; parameters without a value get one that is not special.
    wanted
        The request for each case.
    words
        Kinds, or patterns of names; all cases without it.
    progress
        Called for each case.

    Raises
    ------
    Refusal
        When there are no numbers for the problem.
    NoSuchCase
        When a word fits no case.
    """
    problem, missing = with_all_values(problem)
    values = ", ".join(f"{name} = {float(value):g}" for name, value in missing.items())
    notes = [f"without a value, taken as {values}"] if missing else []
    scene = ExtremeScene(problem)
    if not problem.initial:
        notes.append("without an initial state: one in which nothing is special is taken")
    cases = chosen(cases_of(scene), words)
    spare_sympy()
    pool = Pool(answer, 1)
    trials: list[tuple[Case, CaseTrial]] = []
    try:
        formulas, why = formulas_in(pool, problem, _SOLVING)
        if why:
            notes.append(f"no printed formulas: {why}")
        found = trials_in(pool, cases, formulas, wanted)
        for done, case in enumerate(cases):
            if progress is not None:
                progress(done, len(cases))
            trials.append((case, next(found)))
    finally:
        pool.stop()
    return ExtremesStudy(
        name=problem.source.name,
        formulas=formulas,
        trials=tuple(trials),
        wanted=wanted,
        notes=tuple(notes),
    )


def chosen(cases: Sequence[Case], words: Sequence[str]) -> list[Case]:
    """Those of a kind, or whose name fits a pattern.

    Raises
    ------
    NoSuchCase
        When a word fits none.
    """
    if not words:
        return list(cases)
    for word in words:
        if word not in KINDS and not any(fnmatchcase(case.name, word) for case in cases):
            raise NoSuchCase(word, [*KINDS, *(case.name for case in cases)])
    return [
        case
        for case in cases
        if case.kind in words or any(fnmatchcase(case.name, word) for word in words)
    ]
