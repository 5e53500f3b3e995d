"""The motion under an answer of HTML: its columns over time, and its bodies as they move."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from lagcli.interface.motion import Motion
    from lagcli.problem_data import Problem


#: Rows of a motion that is drawn: as `lagcli animate` has them.
_FRAMES = 601


def demand_pictures(form: str) -> None:
    """Make sure that pictures can be drawn.

    Raises
    ------
    click.UsageError
        Where the form is not HTML, or Matplotlib is missing.
    """
    if form != "html":
        raise click.UsageError(f"--with-motion needs --format html, not {form}")
    if find_spec("matplotlib") is None:
        raise click.UsageError(
            "--with-motion needs the package matplotlib: pip install 'lagcli[plot]'"
        )


def motion_below(problem: Problem) -> tuple[str, str]:
    """HTML of the motion, and why there is none or why it ends early; empty where it does not."""
    from lagcli.diagnostics import ProblemError
    from lagcli.interface.motion import integrate
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.pictures.drawing import CannotDraw
    from lagcli.pipeline import with_lagrangian

    if problem.simulation.until is None:
        return "", "the file gives no end: simulation: {until: T}"
    try:
        motion = integrate(with_lagrangian(problem), samples=_FRAMES)
        return _drawn(motion), motion.refusal
    except (Refusal, ProblemError) as mistake:
        return "", mistake.diagnostics[0].message
    except CannotDraw as reason:
        return "", str(reason)


def _drawn(motion: Motion) -> str:
    from lagcli.pictures.drawing import CannotDraw
    from lagcli.pictures.inline import image

    plot = image(motion.plot().picture, both=True)
    try:
        bodies = motion.animate().to_frame()
    except CannotDraw:  # the file does not state where its bodies are
        bodies = ""
    return f"<h2>Motion</h2>\n{plot}{bodies}"
