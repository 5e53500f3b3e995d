"""One file to its extremes: options read, cases tried, the report written whole."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.cli.choices import STUDIES
from lagcli.cli.delivering import has_place
from lagcli.cli.files import print_result, reason, write_output
from lagcli.cli.running import counted, is_known, number_of, problem_of
from lagcli.cli.status import Status
from lagcli.cli.telling import tell, tell_line
from lagcli.diagnostics import ProblemError
from lagcli.expression import Expression
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.extremes.study import Study
    from lagcli.extremes.trial import Wanted
    from lagcli.problem import Problem

_USUAL_ACCURACY = 1e-9


@record(kw_only=True)
class Wish:
    """The command line, as it was written."""

    file: str
    until: str | None
    settings: tuple[str, ...]
    cases: str | None
    accuracy: str | None
    limit: float
    format_name: str
    output: Path | None


def stretch_file(wish: Wish) -> Status:
    """Try all cases, write, and say how it ended."""
    good = is_known("--format", wish.format_name, STUDIES) & has_place(wish.output)
    problem = problem_of(wish.file, wish.settings)
    if problem is None:
        return Status.USAGE
    wanted = _wanted(problem, wish)
    if wanted is None or not good:
        return Status.USAGE
    return _study(problem, wanted, wish)


def _study(problem: Problem, wanted: Wanted, wish: Wish) -> Status:
    from lagcli.extremes.study import NoSuchCase, study
    from lagcli.numerics.refusal import Refusal
    from lagcli.reader.suggest import did_you_mean

    words = [] if wish.cases is None else [word.strip() for word in wish.cases.split(",")]
    try:
        with counted("trying") as progress:
            made = study(problem, wanted, words, progress)
    except NoSuchCase as error:
        advice = did_you_mean(error.word, error.known) or f"there are {', '.join(error.known)}"
        tell_line(f"lagcli: error: --cases: no case '{error.word}': {advice}")
        return Status.USAGE
    except Refusal as refusal:
        tell(problem.source, refusal.diagnostics)
        return Status.USAGE if refusal.mistake else Status.NOT_FOUND
    if not _written(made, wish):
        return Status.USAGE
    return Status.NOT_FOUND if made.bad else Status.WELL


def _written(made: Study, wish: Wish) -> bool:
    from lagcli.extremes.writing import WRITERS

    data = WRITERS[wish.format_name](made).encode()
    if wish.output is None:
        print_result(data)
        return True
    try:
        write_output(wish.output, data)
    except OSError as error:
        tell_line(f"{wish.output}: error: {reason(error)}")
        return False
    return True


def _wanted(problem: Problem, wish: Wish) -> Wanted | None:
    """What each case is asked; None where an option is no number, which is told."""
    from lagcli.extremes.trial import Wanted

    until = _number(wish.until, problem.simulation.until, "--until")
    accuracy = _number(wish.accuracy, problem.simulation.accuracy, "--accuracy")
    if accuracy is None:
        accuracy = _USUAL_ACCURACY
    good = True
    if until is not None and not 0 < until < math.inf:
        tell_line(f"lagcli: error: --until: the end must be a time after 0, not {until:g}")
        good = False
    if not 0 < accuracy < 1:
        tell_line(f"lagcli: error: --accuracy: it lies between 0 and 1, not {accuracy:g}")
        good = False
    return Wanted(until=until, accuracy=accuracy, limit=wish.limit) if good else None


def _number(text: str | None, given: Expression | None, option: str) -> float | None:
    """The option's value, or the file's; nan where it is none, which is told."""
    from lagcli.reader.columns import read_number

    try:
        formula = given if text is None else read_number(text, option)
    except ProblemError as error:
        tell(error.source, error.diagnostics)
        return math.nan
    return None if formula is None else number_of(formula)
