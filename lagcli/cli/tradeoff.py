"""`lagcli tradeoff`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from lagcli.cli.choices import COSTS, methods
from lagcli.cli.options import Output, State, StudyFormat, gathered, option
from lagcli.cli.simulate import File, Project, Set, Until

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
    from lagcli.cli.tradeoff_run import TradeoffOptions, weigh_file

    form = format_of(format_name, output, STUDIES, "text")
    return weigh_file(gathered(TradeoffOptions, locals(), format_name=form))
