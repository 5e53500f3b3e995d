"""`lagcli simulate`."""

from __future__ import annotations

from typing import Annotated

import typer

from lagcli.cli.choices import complete_column, complete_method, complete_problem, complete_table
from lagcli.cli.options import BY_ENDING, Output, State, format_option, gathered, samples_option

File = Annotated[
    str,
    typer.Argument(
        metavar="FILE",
        help="A problem, or its name in the library; - is stdin.",
        autocompletion=complete_problem,
    ),
]
Files = Annotated[
    list[str],
    typer.Argument(
        metavar="FILE...",
        help="Problems, or their names in the library; - is stdin.",
        autocompletion=complete_problem,
    ),
]
Until = Annotated[
    str | None, typer.Option("--until", metavar="T", help="The end, also 2*pi.  [default: file's]")
]
Accuracy = Annotated[
    str | None,
    typer.Option(
        "--accuracy",
        metavar="A",
        help="Bound on all errors.  [default: file's, or 1e-9]",
    ),
]
Samples = Annotated[int, samples_option("Rows.")]
Set = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NAME=VALUE", help="Give a parameter a value."),
]
Show = Annotated[
    list[str] | None,
    typer.Option(
        "--show",
        metavar="A,B,C",
        help="Columns: any expression, energy, p_x, rod.x (a force), or all coordinates, "
        "velocities, accelerations, multipliers, constraint_forces, momenta, charges.",
        autocompletion=complete_column,
    ),
]
Format = Annotated[
    str | None,
    format_option("table, json, csv, npz or parquet." + BY_ENDING.format("table"), complete_table),
]
Project = Annotated[
    bool, typer.Option("--project", help="Start from the nearest state on the constraints.")
]
Precision = Annotated[
    int | None,
    typer.Option(
        "--precision", metavar="DIGITS", min=20, max=1000, help="Go beyond doubles where needed."
    ),
]
Method = Annotated[
    str,
    typer.Option(
        "--method",
        metavar="NAME",
        help="See `lagcli help simulate`.",
        autocompletion=complete_method,
    ),
]
StopWhen = Annotated[
    str | None,
    typer.Option("--stop-when", metavar="EXPRESSION", help="Stop where it changes its sign."),
]
WholeModel = Annotated[
    bool,
    typer.Option(
        "--whole-model",
        help="Integrate every coordinate of the file.",
    ),
]

Rigorous = Annotated[
    bool,
    typer.Option("--rigorous", help="Prove every digit by enclosures of the exact motion."),
]
Shadow = Annotated[
    bool,
    typer.Option("--shadow", help="Prove that a nearby motion stays at these rows."),
]
Beyond = Annotated[
    bool,
    typer.Option("--beyond", help="Print rows without a certificate as well, marked."),
]


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
    wish = gathered(SimulateOptions, locals(), file=files[0], format_name=form)
    return simulate_files(files, wish)
