"""One file to its extremes: options read, cases tried, the report written whole."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.cli.choices import STUDIES
from lagcli.cli.error_output import report_line, report_refusal
from lagcli.cli.motion_commands import StudyOptions, counted, is_known, option_reader, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.status import Status
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Problem
    from lagcli.studies.extremes.trial import Wanted


@record(kw_only=True)
class ExtremesOptions(StudyOptions):
    """The command line, as it was written."""

    cases: str | None = None
    accuracy: str | None = None


def stretch_file(wish: ExtremesOptions) -> Status:
    """Try all cases, write, and say how it ended."""
    good = is_known("--format", wish.format_name, STUDIES) & has_place(wish.output, wish.file)
    found = understood(wish, lambda p: _wanted(p, wish))
    return _study(*found, wish) if good and found is not None else Status.USAGE


def _study(problem: Problem, wanted: Wanted, wish: ExtremesOptions) -> Status:
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.reader.suggest import did_you_mean
    from lagcli.studies.extremes.study import NoSuchCase, study
    from lagcli.studies.extremes.writing import WRITERS

    words = [] if wish.cases is None else [word.strip() for word in wish.cases.split(",")]
    try:
        with counted("trying") as progress:
            made = study(problem, wanted, words, progress)
    except NoSuchCase as error:
        advice = did_you_mean(error.word, error.known) or f"there are {', '.join(error.known)}"
        report_line(f"lagcli: error: --cases: no case '{error.word}': {advice}")
        return Status.USAGE
    except Refusal as refusal:
        return report_refusal(problem.source, refusal)
    if not place(WRITERS[wish.format_name](made).encode(), wish.output):
        return Status.USAGE
    return Status.NOT_FOUND if made.bad else Status.WELL


def _wanted(problem: Problem, wish: ExtremesOptions) -> Wanted | None:
    """What each case measures; None where an option is not a number, which is reported."""
    from lagcli.studies.extremes.trial import Wanted

    options = option_reader(problem)
    until, accuracy = options.until(wish.until), options.accuracy(wish.accuracy)
    if not options.good:
        return None
    return Wanted(until=until, accuracy=accuracy, limit=wish.limit)
