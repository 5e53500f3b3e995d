"""`lagcli tradeoff`."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated

from lagcli.cli.choices import COSTS, PICTURES, STUDIES, methods
from lagcli.cli.error_output import report_line, report_refusal
from lagcli.cli.motion_commands import StudyOptions, counted, is_known, option_reader, understood
from lagcli.cli.options import Output, State, StudyFormat, gathered, option
from lagcli.cli.output import has_place, place
from lagcli.cli.plotting import ending, is_drawn_as
from lagcli.cli.simulate import File, Project, Set, Until
from lagcli.cli.status import Status
from lagcli.problem_data import METHODS
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Problem
    from lagcli.studies.tradeoff.front import RunPoint
    from lagcli.studies.tradeoff.study import RunPrinter, Study
    from lagcli.studies.tradeoff.trial import Given

#: Seconds after which each run is reported as it is made.
_PATIENCE = 10.0

Samples = Annotated[
    int, option("--samples", "N", "Times at which errors are taken.", min=2, max=1_000_000)
]
Plot = Annotated[
    Path | None,
    option(
        "--plot", "FILE.svg", "Draw cost against error, a line for each method, as SVG, PDF or PNG."
    ),
]
Methods = Annotated[
    str | None,
    option("--methods", "A,B,C", "Only these.  [default: all]", lambda: [*methods()][1:]),
]
CostOption = Annotated[
    str,
    option(
        "--cost",
        "NAME",
        "What the front and the plot weigh: total, integration or evaluations.",
        COSTS,
    ),
]
Repeat = Annotated[int, option("--repeat", "N", "Make each run N times; the best counts.", min=1)]
Limit = Annotated[
    float,
    option(
        "--limit",
        "SECONDS",
        "Processor time of one run; all together take 20 times as much.",
        min=0.1,
    ),
]


def tradeoff(
    file: File,
    until: Until = None,
    settings: Set = None,
    state: State = None,
    samples: Samples = 51,
    methods: Methods = None,
    cost: CostOption = "total",
    repeat: Repeat = 1,
    limit: Limit = 10.0,
    project: Project = False,
    format_name: StudyFormat = None,
    output: Output = None,
    plot: Plot = None,
) -> int:
    """Measure what accuracy costs: every method against a known reference.

    Each run is made in a fresh process; times are the processor's.  The error is the
    largest of any coordinate or velocity, relative to its largest magnitude.  For 1e-3,
    1e-6, 1e-9 and 1e-12 it names the cheapest method with its certificate, and the one
    that lagcli simulate takes by itself.  All methods take a minute or more.

    The exit status is 0; 1 when there is no reference to measure against, or a certificate
    promises more than is true; 2 when the command line or the file is wrong.

    \b
    Examples:
      lagcli tradeoff plane-pendulum --methods dop853
      lagcli tradeoff kepler --methods taylor64 --plot kepler.svg -o kepler.csv
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import STUDIES, format_of

    form = format_of(format_name, output, STUDIES, "text")
    return _measured(gathered(TradeoffOptions, locals(), format_name=form))


@record(kw_only=True)
class TradeoffOptions(StudyOptions):
    """The command line, as it was written."""

    samples: int
    methods: str | None = None
    cost: str
    repeat: int
    project: bool
    plot: Path | None = None


def _measured(options: TradeoffOptions) -> Status:
    """Run, write, and say how it ended."""
    good = is_known("--format", options.format_name, STUDIES) & is_known(
        "--cost", options.cost, COSTS
    )
    methods = _methods(options.methods)
    good = good & (methods is not None) & is_drawn_as(options.plot, PICTURES, "--plot")
    good = good & has_place(options.output, options.file) & has_place(options.plot, options.file)
    found = understood(options, lambda p: _end(p, options))
    if found is None or not good or methods is None:
        return Status.USAGE
    problem, until = found
    from lagcli.studies.tradeoff.trial import Given

    given = Given(
        name=problem.source.name,
        text=problem.source.text,
        settings=options.settings,
        state=options.state,
        until=until,
        samples=options.samples,
        project=options.project,
        method="auto",
        tolerance=None,
        accuracy=None,
        limit=options.limit,
    )
    return _study(problem, given, methods, options)


def _end(problem: Problem, options: TradeoffOptions) -> float | None:
    reader = option_reader(problem)
    until = reader.end(options.until)
    return until if reader.good else None


def _study(
    problem: Problem, given: Given, methods: tuple[str, ...], options: TradeoffOptions
) -> Status:
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.studies.tradeoff.study import study

    try:
        with counted("measuring") as progress:
            made = study(
                given,
                methods,
                cost=options.cost,
                repeat=options.repeat,
                progress=progress,
                run_printer=_row_printer(),
            )
    except Refusal as refusal:
        return report_refusal(problem.source, refusal)
    if not _written(made, options):
        return Status.USAGE
    return Status.NOT_FOUND if made.broken else Status.WELL


def _row_printer() -> RunPrinter:
    """Tells the runs that are made while others go on, once that has taken a while."""
    from lagcli.studies.tradeoff.writing import line_of

    waiting: list[str] = []
    begun = monotonic()

    def show_run(point: RunPoint) -> None:
        waiting.append(line_of(point))
        if monotonic() - begun > _PATIENCE:
            for line in waiting:
                report_line(line)
            waiting.clear()

    return show_run


def _written(made: Study, options: TradeoffOptions) -> bool:
    from lagcli.studies.tradeoff.writing import WRITERS

    parts: list[tuple[Path | None, bytes]] = [
        (options.output, WRITERS[options.format_name](made).encode())
    ]
    if options.plot is not None:
        from lagcli.pictures.drawing import CannotDraw
        from lagcli.pictures.figure import to_bytes
        from lagcli.studies.tradeoff.plot import picture_of

        try:
            parts.insert(0, (options.plot, to_bytes(picture_of(made), ending(options.plot))))
        except CannotDraw as error:
            report_line(f"{options.plot}: warning: nothing to draw: {error}")
    return all(place(data, path) for path, data in parts)


# -- options -------------------------------------------------------------------------------------


def _methods(text: str | None) -> tuple[str, ...] | None:
    """Those requested; None where one is unknown."""
    every = METHODS[1:]  # without auto
    if text is None:
        return every
    request = [word.strip() for word in text.split(",")]
    known = [is_known("--methods", word, every) for word in request]
    return tuple(request) if all(known) else None
