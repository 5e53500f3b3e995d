"""One file to one animation: options read, motion computed, page or film written whole."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from lagcli.cli.choices import ANIMATIONS
from lagcli.cli.error_output import report_line
from lagcli.cli.motion_commands import shared, understood
from lagcli.cli.output import has_place
from lagcli.cli.plotting import drawn, ending, is_drawn_as
from lagcli.cli.simulating import SimulateOptions, asked_of
from lagcli.cli.status import Status

if TYPE_CHECKING:
    from pathlib import Path

    from lagcli.pictures.scene import Scene


def animate_file(run: SimulateOptions, *, forces: bool, dark: bool) -> Status:
    """Compute, draw, and say how it ended."""
    if not is_drawn_as(run.output, ANIMATIONS) or not has_place(run.output, run.file):
        return Status.USAGE
    if run.output is not None and ending(run.output) == "mp4" and shutil.which("ffmpeg") is None:
        instead = run.output.with_suffix(".html")
        report_line(
            f"lagcli: error: -o {run.output} needs the program ffmpeg, which is not installed; "
            f"-o {instead} needs nothing"
        )
        return Status.USAGE
    found = understood(run, lambda p: asked_of(p, run))
    if found is None:
        return Status.USAGE
    problem, asked = found

    def work() -> tuple[bytes, str]:
        from lagcli.pictures.scene import scene

        with shared("integrating") as progress:
            made, refusal = scene(problem, asked, progress, forces=forces)
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
