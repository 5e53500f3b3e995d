"""One file to one table: options read, run made, result written whole."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from lagcli.cli.choices import BINARY, TABLES
from lagcli.cli.delivering import has_place, place
from lagcli.cli.running import Numbers, is_known, shared, understood
from lagcli.cli.status import Status
from lagcli.cli.telling import tell, tell_line
from lagcli.diagnostics import ProblemError
from lagcli.formatters.grammar import to_grammar
from lagcli.problem import METHODS
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.numerics.asked import Asked
    from lagcli.problem import Problem

Value = TypeVar("Value")


@record(kw_only=True)
class Wish:
    """The command line, as it was written."""

    file: str
    until: str | None
    accuracy: str | None
    samples: int
    settings: tuple[str, ...]
    state: tuple[str, ...]
    show: tuple[str, ...]
    format_name: str
    output: Path | None
    project: bool
    precision: int | None
    method: str
    stop_when: str | None
    whole: bool


def simulate_file(wish: Wish) -> Status:
    """Run, write, and say how it ended."""
    known = is_known("--format", wish.format_name, TABLES)
    if not (known and _can_be_written(wish)) & has_place(wish.output):
        return Status.USAGE
    found = understood(wish.file, wish.settings, wish.state, lambda p: _asked(p, wish))
    return Status.USAGE if found is None else _run(*found, wish)


def _run(problem: Problem, asked: Asked, wish: Wish) -> Status:
    from lagcli.numerics.refusal import Refusal
    from lagcli.numerics.simulate import simulate
    from lagcli.numerics.writing import WRITERS

    try:
        with shared("integrating") as progress:
            result = simulate(problem, asked, progress)
    except Refusal as refusal:
        tell(problem.source, refusal.diagnostics)
        return Status.USAGE if refusal.mistake else Status.NOT_FOUND
    if not place(WRITERS[wish.format_name](result), wish.output):
        return Status.USAGE
    if result.refusal:
        tell_line(f"{problem.source.name}: {result.refusal}")
        return Status.NOT_FOUND
    return Status.WELL


def _can_be_written(wish: Wish) -> bool:
    """Whether there is what writes the format, and a place that takes bytes."""
    if wish.format_name == "parquet" and not _is_installed("pyarrow"):
        tell_line(
            "lagcli: error: --format parquet needs the package pyarrow: "
            "pip install 'lagcli[parquet]', or take --format npz, which needs nothing"
        )
        return False
    if wish.format_name in BINARY and wish.output is None and sys.stdout.isatty():
        tell_line(f"lagcli: error: --format {wish.format_name} is not for a terminal: give -o PATH")
        return False
    return True


def _is_installed(package: str) -> bool:
    from importlib.util import find_spec

    return find_spec(package) is not None


# -- options -----------------------------------------------------------------------------------


def _asked(problem: Problem, wish: Wish) -> Asked | None:
    """The options as values; every mistake is told."""
    from lagcli.numerics.asked import Asked
    from lagcli.numerics.columns import Column
    from lagcli.reader.columns import (
        pieces_of,
        read_along,
        read_columns,
        usual_columns,
    )

    run, numbers = problem.simulation, Numbers(problem.source)
    until = numbers.end(wish.file, wish.until, run.until)
    accuracy = numbers.accuracy(wish.accuracy, run.accuracy)
    method = run.method if wish.method == "auto" and run.method else wish.method
    good = is_known("--method", method, METHODS) and numbers.good

    def attempt(work: Callable[[], Value], otherwise: Value) -> Value:
        nonlocal good
        try:
            return work()
        except ProblemError as error:
            tell(error.source, error.diagnostics)
            good = False
            return otherwise

    shown = list(wish.show)
    columns = usual_columns(problem)
    if shown:
        found = dict(columns[:1])
        for piece in pieces_of(shown):
            found |= dict(attempt(partial(read_columns, problem, [piece]), columns[:0]))
        columns = list(found.items())
    text = wish.stop_when
    stop = None if text is None else attempt(lambda: read_along(problem, text, "--stop-when"), None)
    if not good or until is None:
        return None
    return Asked(
        until=until,
        accuracy=accuracy,
        samples=wish.samples,
        columns=tuple(Column(name, expression) for name, expression in columns),
        project=wish.project,
        stop_when=stop,
        stop_name=wish.stop_when or "",
        method=method,
        digits=wish.precision,
        whole=wish.whole,
        written=to_grammar,
    )
