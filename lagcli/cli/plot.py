"""`lagcli plot`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import KINDS
from lagcli.cli.options import Output, State, flag, gathered, option
from lagcli.cli.simulate import Accuracy, File, Method, Project, Set, Show, StopWhen, Until

Kind = Annotated[
    str | None,
    option(
        "--kind -k",
        "NAME",
        "series, phase, path, potential, poincare, drift, error.  [default: series; "
        "phase without an end]",
        KINDS,
    ),
]
Samples = Annotated[int, option("--samples", "N", "Points of a curve.", min=2, max=1_000_000)]
Dark = Annotated[bool, flag("--dark", "Light lines on a dark page.")]
Section = Annotated[
    str | None,
    option(
        "--section",
        "X=VALUE",
        "Of poincare: where it is passed upwards, or t=T.  [default: the first coordinate = 0]",
    ),
]
Orbits = Annotated[int, option("--orbits", "N", "Of poincare: motions.", min=1, max=200)]
Width = Annotated[
    int | None, option("--width", "COLUMNS", "Of a picture in characters.", min=40, max=400)
]
Ascii = Annotated[bool, flag("--ascii", "Draw with letters, not with Braille.")]


def plot(
    file: File,
    kind: Kind = None,
    show: Show = None,
    output: Output = None,
    until: Until = None,
    accuracy: Accuracy = None,
    samples: Samples = 1001,
    settings: Set = None,
    state: State = None,
    section: Section = None,
    orbits: Orbits = 1,
    dark: Dark = False,
    width: Width = None,
    ascii_only: Ascii = False,
    project: Project = False,
    method: Method = "auto",
    stop_when: StopWhen = None,
) -> int:
    """Draw a motion over time, in space or in phase space.

    Or the effective potential, the drift of what is conserved, the error as it really is.

    The picture goes to the terminal, or with -o to a file whose ending says what it is: .svg,
    .pdf or .png, which need Matplotlib (pip install 'lagcli[plot]').  What the certificate of
    the motion does not hold for is not drawn.

    The exit status is 0; 1 when the accuracy was not reached to the end; 2 when there is no
    such picture, or the command line or the file is wrong.

    \b
    Examples:
      lagcli plot plane-pendulum
      lagcli plot plane-pendulum --kind phase -o pendulum.pdf
      lagcli plot kepler --kind path --dark -o kepler.svg
      lagcli plot kepler --show "x,y,energy" --until 20
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.plotting import PlotOptions, plot_file

    return plot_file(gathered(PlotOptions, locals()))
