"""One file to one animation: options read, motion computed, page or film written whole."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from lagcli.cli.choices import ANIMATIONS
from lagcli.cli.delivering import has_place
from lagcli.cli.plotting import drawn, ending, is_drawn_as
from lagcli.cli.running import shared, understood
from lagcli.cli.simulating import SimulateOptions, asked_of
from lagcli.cli.status import Status
from lagcli.cli.telling import tell_line
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import Asked
    from lagcli.pictures.scene import Scene
    from lagcli.problem_data import Problem


@record(kw_only=True)
class AnimationWish:
    """The command line, as it was written."""

    run: SimulateOptions
    forces: bool
    dark: bool


def animate_file(wish: AnimationWish) -> Status:
    """Compute, draw, and say how it ended."""
    run = wish.run
    if not is_drawn_as(run.output, ANIMATIONS) or not has_place(run.output, run.file):
        return Status.USAGE
    if run.output is not None and ending(run.output) == "mp4" and shutil.which("ffmpeg") is None:
        instead = run.output.with_suffix(".html")
        tell_line(
            f"lagcli: error: -o {run.output} needs the program ffmpeg, which is not installed; "
            f"-o {instead} needs nothing"
        )
        return Status.USAGE
    found = understood(run.file, run.settings, run.state, lambda p: asked_of(p, run))
    return Status.USAGE if found is None else _animate(*found, wish)


def _animate(problem: Problem, asked: Asked, wish: AnimationWish) -> Status:
    def work() -> tuple[bytes, str]:
        from lagcli.pictures.scene import scene

        with shared("integrating") as progress:
            made, refusal = scene(problem, asked, progress, forces=wish.forces)
        return _written(made, wish), refusal

    return drawn(problem, work, wish.run.output)


def _written(scene: Scene, wish: AnimationWish) -> bytes:
    output = wish.run.output
    kind = "html" if output is None else ending(output)
    if kind == "html":
        from lagcli.pictures.page import to_html

        return to_html(scene).encode()
    from lagcli.pictures.film import to_film

    with shared("drawing") as progress:
        return to_film(scene, kind, dark=wish.dark, progress=progress)
