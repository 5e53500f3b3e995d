"""One file to one study: options read, runs made, tables and plot written whole."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING

from lagcli.cli.choices import COSTS, PICTURES, STUDIES
from lagcli.cli.error_output import report_line, report_refusal
from lagcli.cli.motion_commands import StudyOptions, counted, is_known, option_reader, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.plotting import ending, is_drawn_as
from lagcli.cli.status import Status
from lagcli.problem_data import METHODS
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Problem
    from lagcli.studies.tradeoff.front import RunPoint
    from lagcli.studies.tradeoff.study import Study, Teller
    from lagcli.studies.tradeoff.trial import Given

#: Seconds after which each run is reported as it is made.
_PATIENCE = 10.0


@record(kw_only=True)
class TradeoffOptions(StudyOptions):
    """The command line, as it was written."""

    samples: int
    methods: str | None = None
    cost: str
    repeat: int
    project: bool
    plot: Path | None = None


def weigh_file(wish: TradeoffOptions) -> Status:
    """Run, write, and say how it ended."""
    good = is_known("--format", wish.format_name, STUDIES) & is_known("--cost", wish.cost, COSTS)
    methods = _methods(wish.methods)
    good = good & (methods is not None) & is_drawn_as(wish.plot, PICTURES, "--plot")
    good = good & has_place(wish.output, wish.file) & has_place(wish.plot, wish.file)
    found = understood(wish, lambda p: _end(p, wish))
    if found is None or not good or methods is None:
        return Status.USAGE
    problem, until = found
    from lagcli.studies.tradeoff.trial import Given

    given = Given(
        name=problem.source.name,
        text=problem.source.text,
        settings=wish.settings,
        state=wish.state,
        until=until,
        samples=wish.samples,
        project=wish.project,
        method="auto",
        tolerance=None,
        accuracy=None,
        limit=wish.limit,
    )
    return _study(problem, given, methods, wish)


def _end(problem: Problem, wish: TradeoffOptions) -> float | None:
    options = option_reader(problem)
    until = options.end(wish.until)
    return until if options.good else None


def _study(
    problem: Problem, given: Given, methods: tuple[str, ...], wish: TradeoffOptions
) -> Status:
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.studies.tradeoff.study import study

    try:
        with counted("measuring") as progress:
            made = study(
                given,
                methods,
                cost=wish.cost,
                repeat=wish.repeat,
                progress=progress,
                teller=_row_printer(),
            )
    except Refusal as refusal:
        return report_refusal(problem.source, refusal)
    if not _written(made, wish):
        return Status.USAGE
    return Status.NOT_FOUND if made.broken else Status.WELL


def _row_printer() -> Teller:
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


def _written(made: Study, wish: TradeoffOptions) -> bool:
    from lagcli.studies.tradeoff.writing import WRITERS

    parts: list[tuple[Path | None, bytes]] = [
        (wish.output, WRITERS[wish.format_name](made).encode())
    ]
    if wish.plot is not None:
        from lagcli.pictures.drawing import CannotDraw
        from lagcli.pictures.figure import to_bytes
        from lagcli.studies.tradeoff.plot import picture_of

        try:
            parts.insert(0, (wish.plot, to_bytes(picture_of(made), ending(wish.plot))))
        except CannotDraw as error:
            report_line(f"{wish.plot}: warning: nothing to draw: {error}")
    return all(place(data, path) for path, data in parts)


# -- options -------------------------------------------------------------------------------------


def _methods(text: str | None) -> tuple[str, ...] | None:
    """Those requested; None where one is unknown."""
    every = METHODS[1:]  # without auto
    if text is None:
        return every
    asked = [word.strip() for word in text.split(",")]
    wrong = [word for word in asked if word not in every]
    for word in wrong:
        advice = did_you_mean(word, every) or f"there are {', '.join(every)}"
        report_line(f"lagcli: error: --methods: unknown name '{word}': {advice}")
    return None if wrong else tuple(asked)
