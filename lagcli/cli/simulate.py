"""`lagcli simulate`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import COLUMNS, TABLES, methods, problems
from lagcli.cli.options import BY_ENDING, Output, State, argument, flag, gathered, option

File = Annotated[
    str, argument("FILE", "A problem, or its name in the library; - is stdin.", problems)
]
Files = Annotated[
    list[str], argument("FILE...", "Problems, or their names in the library; - is stdin.", problems)
]
Until = Annotated[str | None, option("--until", "T", "The end, also 2*pi.  [default: file's]")]
Accuracy = Annotated[
    str | None, option("--accuracy", "A", "Bound on all errors.  [default: file's, or 1e-9]")
]
Samples = Annotated[int, option("--samples", "N", "Rows.", min=2, max=1_000_000)]
Set = Annotated[list[str] | None, option("--set", "NAME=VALUE", "Give a parameter a value.")]
Show = Annotated[
    list[str] | None,
    option(
        "--show",
        "A,B,C",
        "Columns: any expression, energy, p_x, rod.x (a force), or all coordinates, "
        "velocities, accelerations, multipliers, constraint_forces, momenta, charges.",
        COLUMNS,
    ),
]
Format = Annotated[
    str | None,
    option(
        "--format -f",
        "NAME",
        "table, json, csv, npz or parquet." + BY_ENDING.format("table"),
        TABLES,
    ),
]
Project = Annotated[bool, flag("--project", "Start from the nearest state on the constraints.")]
Precision = Annotated[
    int | None, option("--precision", "DIGITS", "Go beyond doubles where needed.", min=20, max=1000)
]
Method = Annotated[str, option("--method", "NAME", "See `lagcli help simulate`.", methods)]
StopWhen = Annotated[
    str | None, option("--stop-when", "EXPRESSION", "Stop where it changes its sign.")
]
WholeModel = Annotated[bool, flag("--whole-model", "Integrate every coordinate of the file.")]

Rigorous = Annotated[
    bool, flag("--rigorous", "Prove every digit by enclosures of the exact motion.")
]
Shadow = Annotated[bool, flag("--shadow", "Prove that a nearby motion stays at these rows.")]
Beyond = Annotated[bool, flag("--beyond", "Print rows without a certificate as well, marked.")]


def simulate(
    files: Files,
    until: Until = None,
    accuracy: Accuracy = None,
    samples: Samples = 101,
    settings: Set = None,
    state: State = None,
    show: Show = None,
    format_name: Format = None,
    output: Output = None,
    project: Project = False,
    precision: Precision = None,
    method: Method = "auto",
    stop_when: StopWhen = None,
    whole: WholeModel = False,
    rigorous: Rigorous = False,
    shadow: Shadow = False,
    beyond: Beyond = False,
) -> int:
    """Compute the motion to a stated accuracy, with a certificate.

    The accuracy is global: it bounds the error of every printed number, relative to the
    largest magnitude of its column.  Where it cannot be reached the rows end at the time
    until which it holds.

    The exit status is 0 when the accuracy was reached, 1 when it was not, and 2 when the
    command line or the file is wrong.

    Several files make a JSON array or one table under another; CSV, NPZ and Parquet
    then need a folder after -o, which gets one file each.

    \b
    Examples:
      lagcli simulate plane-pendulum
      lagcli simulate kepler --until 100 --accuracy 1e-6 --show x,y,energy
      lagcli simulate mass-sliding-off-sphere --until 5 -f json -o run.json
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import TABLES, format_of
    from lagcli.cli.simulating import SimulateOptions, simulate_files

    form = format_of(format_name, output, TABLES, "table")
    options = gathered(SimulateOptions, locals(), file=files[0], format_name=form)
    return simulate_files(files, options)
