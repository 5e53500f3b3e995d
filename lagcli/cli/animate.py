"""`lagcli animate`."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, Annotated

from lagcli.cli.choices import ANIMATIONS
from lagcli.cli.error_output import report_line
from lagcli.cli.motion_commands import shared, understood
from lagcli.cli.options import Output, State, flag, gathered, option
from lagcli.cli.output import has_place
from lagcli.cli.plot import Dark
from lagcli.cli.plotting import drawn, ending, is_drawn_as
from lagcli.cli.simulate import Accuracy, File, Method, Project, Set, StopWhen, Until
from lagcli.cli.simulating import SimulateOptions, request_of
from lagcli.cli.status import Status

if TYPE_CHECKING:
    from pathlib import Path

    from lagcli.pictures.scene import Scene

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
    run = gathered(SimulateOptions, locals())
    if not is_drawn_as(run.output, ANIMATIONS) or not has_place(run.output, run.file):
        return Status.USAGE
    if run.output is not None and ending(run.output) == "mp4" and shutil.which("ffmpeg") is None:
        instead = run.output.with_suffix(".html")
        report_line(
            f"lagcli: error: -o {run.output} needs the program ffmpeg, which is not installed; "
            f"-o {instead} needs nothing"
        )
        return Status.USAGE
    found = understood(run, lambda p: request_of(p, run))
    if found is None:
        return Status.USAGE
    problem, request = found

    def work() -> tuple[bytes, str]:
        from lagcli.pictures.scene import scene

        with shared("integrating") as progress:
            made, refusal = scene(problem, request, progress, forces=forces)
        return _written(made, run.output, dark=dark), refusal

    return drawn(problem, work, run.output)


def _written(scene: Scene, output: Path | None, *, dark: bool) -> bytes:
    kind = "html" if output is None else ending(output)
    if kind == "html":
        from lagcli.pictures.page import to_html

        return to_html(scene).encode()
    from lagcli.pictures.film import to_film

    with shared("drawing") as progress:
        return to_film(scene, kind, dark=dark, progress=progress)
