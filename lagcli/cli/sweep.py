"""`lagcli sweep`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.options import Jobs, Output, State, flag, gathered, option
from lagcli.cli.simulate import Accuracy, File, Format, Method, Set, Show, StopWhen, Until

Vary = Annotated[
    list[str] | None,
    option(
        "--vary",
        "NAME=RANGE",
        "A parameter, coordinate or velocity: 0:3.14:200 (first, last, count), "
        "1e-3:1:50:log, or 1,2,4.  Several make all combinations.",
    ),
]
Random = Annotated[
    int | None, option("--random", "N", "N draws between FIRST:LAST instead.", min=1)
]
Seed = Annotated[int, option("--seed", "N", "Of the draws.")]
Samples = Annotated[int, option("--samples", "N", "With --along: rows.", min=2, max=1_000_000)]
Along = Annotated[bool, flag("--along", "Every row of each motion, not its end.")]
Times = Annotated[
    str | None, option("--times", "T,T", "Rows at these times: 100:250:25, or 1,2,5.")
]
Scheduler = Annotated[
    str | None, option("--scheduler", "ADDRESS", "A Dask cluster: tcp://host:8786.")
]


def sweep(
    file: File,
    vary: Vary = None,
    random: Random = None,
    seed: Seed = 0,
    until: Until = None,
    accuracy: Accuracy = None,
    show: Show = None,
    along: Along = False,
    samples: Samples = 101,
    times: Times = None,
    stop_when: StopWhen = None,
    settings: Set = None,
    state: State = None,
    method: Method = "auto",
    format_name: Format = None,
    output: Output = None,
    jobs: Jobs = None,
    scheduler: Scheduler = None,
) -> int:
    """Compute an ensemble of motions over parameters and initial states.

    Each row has the values that were varied, the columns at the end of its motion (with
    --along at every sample, with --times at these), and its certificate: `reached` (1 or
    0), `holds_until` and `error`, the bound on the global error.  The rows are in the order
    of the ranges, the last parameter or state varying fastest; `theta(0)` is an initial
    value.

    With -o, finished parts are kept next to the output: a sweep that was killed goes on
    where it ended when the same command is given again.

    \b
    Examples:
      lagcli sweep plane-pendulum --vary theta=0.1:3:30 --show theta,energy
      lagcli sweep plane-pendulum --vary l=0.5,1,2 --vary theta=0.1:3:20 -o a.csv
      lagcli sweep kepler --random 20 --seed 7 --vary "y'=0.5:1.2" -o orbits.npz
      lagcli sweep plane-pendulum --vary theta=-3:3:9 --vary l=1:2:9 -o map.png
      lagcli sweep kepler --vary "y'=0.5:1:9" --scheduler tcp://host:8786
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import PICTURES, TABLES, format_of
    from lagcli.cli.sweeping import SweepOptions, sweep_file

    form = format_of(format_name, output, TABLES | PICTURES, "table")
    rows = samples if along else 2
    others = {"samples": rows, "times": (), "at_times": times, "format_name": form}
    return sweep_file(gathered(SweepOptions, locals(), **others))
