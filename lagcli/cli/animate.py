"""`lagcli animate`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.options import Output, State, flag, gathered, option
from lagcli.cli.plot import Dark
from lagcli.cli.simulate import Accuracy, File, Method, Project, Set, StopWhen, Until

Samples = Annotated[int, option("--samples", "N", "Frames of the page.", min=2, max=20_000)]
Forces = Annotated[bool, flag("--forces", "Show forces, also of constraints, as arrows.")]


def animate(
    file: File,
    output: Output = None,
    until: Until = None,
    accuracy: Accuracy = None,
    samples: Samples = 601,
    settings: Set = None,
    state: State = None,
    forces: Forces = False,
    dark: Dark = False,
    project: Project = False,
    method: Method = "auto",
    stop_when: StopWhen = None,
) -> int:
    """Show a motion as a page to play, a GIF or an MP4.

    The ending of -o says which: .html, which is also what goes to standard output, has
    everything in one file and needs no network; .gif and .mp4 need Matplotlib (pip install
    'lagcli[plot]'), and .mp4 the program ffmpeg.  Bodies are the points of the file, or
    coordinates with the names x, y, z, x1, y1; its key `picture` adds rods and springs.

    The exit status is 0; 1 when the accuracy was not reached to the end; 2 when there is
    nothing to show, or the command line or the file is wrong.

    \b
    Examples:
      lagcli animate double-pendulum -o double.html
      lagcli animate bouncing-ball --until 4 -o ball.gif
      lagcli animate pendulum-cartesian --until 5 --forces -o forces.html
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.animating import animate_file
    from lagcli.cli.simulating import SimulateOptions

    run = gathered(SimulateOptions, locals())
    return animate_file(run, forces=forces, dark=dark)
