"""One file to one table: options read, run made, result written whole."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.cli.choices import BINARY, TABLES
from lagcli.cli.endings import TABLES as ENDINGS
from lagcli.cli.error_output import report_line, report_refusal
from lagcli.cli.motion_commands import is_known, option_reader, shared, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.status import Status
from lagcli.record import record, replace
from lagcli.studies.run_options import RunOptions

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.problem_data import Problem


@record(kw_only=True)
class SimulateOptions(RunOptions):
    """The command line of a run, as it was written."""

    file: str
    settings: tuple[str, ...] = ()
    state: tuple[str, ...] = ()
    format_name: str = "table"
    output: Path | None = None
    rigorous: bool = False
    shadow: bool = False


def simulate_files(files: Sequence[str], options: SimulateOptions) -> Status:
    """Run each file, write the tables, and say how it ended; the worst is the exit status."""
    known = is_known("--format", options.format_name, TABLES)
    if not (known and can_be_written(options)):
        return Status.USAGE
    if len(files) == 1:
        return _simulate_one(options)
    if options.output is not None and options.output.is_dir():
        return _simulate_into(options.output, files, options)
    return _simulate_together(files, options)


def _simulate_one(options: SimulateOptions) -> Status:
    if not has_place(options.output, options.file):
        return Status.USAGE
    data, status = _table(options)
    if data is not None and not place(data, options.output):
        return Status.USAGE
    return status


def _simulate_into(folder: Path, files: Sequence[str], options: SimulateOptions) -> Status:
    """One file each, in a folder, with the names of the problems."""
    ending = next(ending for ending, name in ENDINGS.items() if name == options.format_name)
    targets = [folder / f"{Path(file).stem}{ending}" for file in files]
    if len(set(targets)) < len(targets):
        report_line(f"lagcli: error: -o {folder}: two of the files have the same name")
        return Status.USAGE
    runs = zip(files, targets, strict=True)
    return max(_simulate_one(replace(options, file=file, output=target)) for file, target in runs)


def _simulate_together(files: Sequence[str], options: SimulateOptions) -> Status:
    """One text: tables under their titles, or a JSON array."""
    if options.format_name not in ("table", "json"):
        report_line(
            f"lagcli: error: several files in the format {options.format_name} need a folder: "
            "-o FOLDER, which exists"
        )
        return Status.USAGE
    if not has_place(options.output, *files):
        return Status.USAGE
    made = [(file, *_table(replace(options, file=file))) for file in files]
    tables = [(file, data.decode()) for file, data, _ in made if data is not None]
    if options.format_name == "json":
        text = "[\n" + ",\n".join(table.rstrip("\n") for _, table in tables) + "\n]\n"
    else:
        text = "\n".join(f"{file}\n{table}" for file, table in tables)
    if not place(text.encode(), options.output):
        return Status.USAGE
    return max(status for _, _, status in made)


def _table(options: SimulateOptions) -> tuple[bytes | None, Status]:
    """The table of one run, or None, and how the run ended."""
    found = understood(options, lambda p: request_of(p, options))
    return (None, Status.USAGE) if found is None else _run(*found, options)


def _run(
    problem: Problem, request: RunRequest, options: SimulateOptions
) -> tuple[bytes | None, Status]:
    """The table of a run, or None, and how it ended."""
    from lagcli.numerics.equations.refusal import Refusal

    try:
        made = _proved if options.rigorous or options.shadow else _integrated
        data, why = made(problem, request, options)
    except Refusal as refusal:
        return None, report_refusal(problem.source, refusal)
    if why:
        report_line(f"{problem.source.name}: {why}")
    return data, Status.NOT_FOUND if why else Status.WELL


def _integrated(
    problem: Problem, request: RunRequest, options: SimulateOptions
) -> tuple[bytes, str]:
    """The table of a run, and why it ends early."""
    from lagcli.numerics.certified.simulate import simulate
    from lagcli.numerics.tables.formats import WRITERS

    with shared("integrating") as progress:
        result = simulate(problem, request, progress)
    return WRITERS[options.format_name](result), result.refusal


def _proved(problem: Problem, request: RunRequest, options: SimulateOptions) -> tuple[bytes, str]:
    """The table of a proof, and why it ends early."""
    from lagcli.numerics.rigorous import Shadowing, prove
    from lagcli.numerics.rigorous.writing import WRITERS

    with shared("proving") as progress:
        proof = prove(problem, request, progress, Shadowing if options.shadow else None)
    return WRITERS[options.format_name](proof), proof.refusal


def can_be_written(options: SimulateOptions) -> bool:
    """Whether there is what writes the format, and a place that takes bytes."""
    proof = "--shadow" if options.shadow else "--rigorous" if options.rigorous else ""
    if proof and options.format_name not in ("table", "json", "csv"):
        report_line(
            f"lagcli: error: {proof} has no format {options.format_name}: take table, json or csv"
        )
        return False
    if proof and options.beyond:
        report_line(f"lagcli: error: {proof} prints what is proved: leave out --beyond")
        return False
    if options.format_name == "parquet" and not _is_installed("pyarrow"):
        report_line(
            "lagcli: error: --format parquet needs the package pyarrow: "
            "pip install 'lagcli[parquet]', or take --format npz, which needs nothing"
        )
        return False
    if options.format_name in BINARY and options.output is None and sys.stdout.isatty():
        report_line(
            f"lagcli: error: --format {options.format_name} is not for a terminal: give -o PATH"
        )
        return False
    return True


def _is_installed(package: str) -> bool:
    from importlib.util import find_spec

    return find_spec(package) is not None


# -- options -----------------------------------------------------------------------------------


def request_of(
    problem: Problem, options: SimulateOptions, *, without_end: float | None = None
) -> RunRequest | None:
    """The run; None where there are mistakes, which are reported.

    Where neither the options nor the file give an end, it is `without_end`, if that is given.
    """
    return option_reader(problem).request(options, without_end=without_end)
