"""One file to one study: options read, runs made, tables and plot written whole."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.cli.choices import COSTS, STUDIES
from lagcli.cli.delivering import has_place, place
from lagcli.cli.running import NumericOptions, counted, is_known, understood
from lagcli.cli.status import Status
from lagcli.cli.telling import tell, tell_line
from lagcli.problem_data import METHODS
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Problem
    from lagcli.studies.tradeoff.study import Study
    from lagcli.studies.tradeoff.trial import Given


@record(kw_only=True)
class TradeoffOptions:
    """The command line, as it was written."""

    file: str
    until: str | None
    settings: tuple[str, ...]
    state: tuple[str, ...]
    samples: int
    methods: str | None
    cost: str
    repeat: int
    limit: float
    project: bool
    format_name: str
    output: Path | None
    plot: Path | None


def weigh_file(wish: TradeoffOptions) -> Status:
    """Run, write, and say how it ended."""
    good = is_known("--format", wish.format_name, STUDIES) & is_known("--cost", wish.cost, COSTS)
    methods = _methods(wish.methods)
    good = good & (methods is not None) & _can_be_drawn(wish.plot)
    good = good & has_place(wish.output, wish.file) & has_place(wish.plot, wish.file)
    found = understood(wish.file, wish.settings, wish.state, lambda p: _end(p, wish))
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
    numbers = NumericOptions(problem.source)
    until = numbers.end(wish.file, wish.until, problem.simulation.until)
    return until if numbers.good else None


def _study(
    problem: Problem, given: Given, methods: tuple[str, ...], wish: TradeoffOptions
) -> Status:
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.studies.tradeoff.study import study

    try:
        with counted("measuring") as progress:
            made = study(given, methods, cost=wish.cost, repeat=wish.repeat, progress=progress)
    except Refusal as refusal:
        tell(problem.source, refusal.diagnostics)
        return Status.USAGE if refusal.mistake else Status.NOT_FOUND
    if not _written(made, wish):
        return Status.USAGE
    return Status.NOT_FOUND if made.broken else Status.WELL


def _written(made: Study, wish: TradeoffOptions) -> bool:
    from lagcli.studies.tradeoff.writing import WRITERS

    parts: list[tuple[Path | None, bytes]] = [
        (wish.output, WRITERS[wish.format_name](made).encode())
    ]
    if wish.plot is not None:
        from lagcli.studies.tradeoff.plot import to_svg

        try:
            parts.insert(0, (wish.plot, _drawn(to_svg(made), wish.plot)))
        except ValueError as error:
            tell_line(f"{wish.plot}: warning: nothing to draw: {error}")
    return all(place(data, path) for path, data in parts)


def _drawn(svg: str, path: Path) -> bytes:
    """The plot as the file's name has it."""
    if path.suffix.lower() == ".svg":
        return svg.encode()
    made: bytes = import_module("cairosvg").svg2png(bytestring=svg.encode(), scale=2)
    return made


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
        tell_line(f"lagcli: error: --methods: unknown name '{word}': {advice}")
    return None if wrong else tuple(asked)


def _can_be_drawn(path: Path | None) -> bool:
    """SVG, or PNG where there is what makes one."""
    kind = "" if path is None else path.suffix.lower()
    if path is None or kind == ".svg" or (kind == ".png" and find_spec("cairosvg") is not None):
        return True
    svg = path.with_suffix(".svg")
    tell_line(
        f"lagcli: error: --plot: '{path}' needs the package cairosvg: pip install cairosvg, or "
        f"name it {svg}, of which any browser makes a PNG"
        if kind == ".png"
        else f"lagcli: error: --plot: '{path}' is neither SVG nor PNG: name it {svg}"
    )
    return False
