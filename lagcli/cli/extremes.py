"""`lagcli extremes`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from lagcli.cli.choices import STUDIES
from lagcli.cli.error_output import report_line, report_refusal
from lagcli.cli.motion_commands import StudyOptions, counted, is_known, option_reader, understood
from lagcli.cli.options import Output, State, StudyFormat, gathered, option
from lagcli.cli.output import has_place, place
from lagcli.cli.simulate import Accuracy, File, Set
from lagcli.cli.status import Status
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Problem
    from lagcli.studies.extremes.trial import Wanted

Until = Annotated[
    str | None,
    option(
        "--until",
        "T",
        "The longest span of a run.  [default: the file's; short where it moves quickly]",
    ),
]
Cases = Annotated[
    str | None,
    option(
        "--cases",
        "A,B,C",
        "Only these: given, ratios, angles, singular, separatrix, light, zero, spans, or "
        "names with * for anything.  [default: all]",
    ),
]
Limit = Annotated[float, option("--limit", "SECONDS", "Processor time of one case.", min=0.1)]


def extremes(
    file: File,
    until: Until = None,
    settings: Set = None,
    state: State = None,
    cases: Cases = None,
    accuracy: Accuracy = None,
    limit: Limit = 10.0,
    format_name: StudyFormat = None,
    output: Output = None,
) -> int:
    """Take a problem to where it breaks.

    The cases follow from the problem: ratios of its parameters, angles near 0, pi/2 and pi,
    zeros of the mass matrix, the energy of an unstable equilibrium, the speed of light, zero
    masses and forces, a long span.  Each is reported with the digits that the printed formulas
    lose in doubles, before and after they are rewritten, the condition of the mass matrix, and
    the outcome of a certified run, confirmed with more digits.

    The exit status is 0 when every case is right or refused with its reason; 1 when one is
    wrong or undecided; 2 when the command line or the file is wrong.

    \b
    Examples:
      lagcli extremes plane-pendulum
      lagcli extremes kepler --cases 'k = 0' -f csv
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import STUDIES, format_of

    form = format_of(format_name, output, STUDIES, "text")
    return _tried(gathered(ExtremesOptions, locals(), format_name=form))


@record(kw_only=True)
class ExtremesOptions(StudyOptions):
    """The command line, as it was written."""

    cases: str | None = None
    accuracy: str | None = None


def _tried(options: ExtremesOptions) -> Status:
    """Try all cases, write, and say how it ended."""
    good = is_known("--format", options.format_name, STUDIES) & has_place(
        options.output, options.file
    )
    found = understood(options, lambda p: _wanted(p, options))
    return _study(*found, options) if good and found is not None else Status.USAGE


def _study(problem: Problem, wanted: Wanted, options: ExtremesOptions) -> Status:
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.reader.suggest import did_you_mean
    from lagcli.studies.extremes.study import NoSuchCase, study
    from lagcli.studies.extremes.writing import WRITERS

    words = [] if options.cases is None else [word.strip() for word in options.cases.split(",")]
    try:
        with counted("trying") as progress:
            made = study(problem, wanted, words, progress)
    except NoSuchCase as error:
        advice = did_you_mean(error.word, error.known) or f"there are {', '.join(error.known)}"
        report_line(f"lagcli: error: --cases: no case '{error.word}': {advice}")
        return Status.USAGE
    except Refusal as refusal:
        return report_refusal(problem.source, refusal)
    if not place(WRITERS[options.format_name](made).encode(), options.output):
        return Status.USAGE
    return Status.NOT_FOUND if made.bad else Status.WELL


def _wanted(problem: Problem, options: ExtremesOptions) -> Wanted | None:
    """What each case measures; None where an option is not a number, which is reported."""
    from lagcli.studies.extremes.trial import Wanted

    reader = option_reader(problem)
    until, accuracy = reader.until(options.until), reader.accuracy(options.accuracy)
    if not reader.good:
        return None
    return Wanted(until=until, accuracy=accuracy, limit=options.limit)
