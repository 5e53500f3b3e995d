"""One file to one picture: options read, motion computed, picture written whole."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.cli.choices import KINDS, PICTURES
from lagcli.cli.error_output import report, report_line, report_refusal
from lagcli.cli.motion_commands import is_known, shared, understood
from lagcli.cli.output import has_place, place
from lagcli.cli.printing import PIPE_WIDTH
from lagcli.cli.simulating import SimulateOptions, asked_of
from lagcli.cli.status import Status
from lagcli.record import record, replace

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import Asked
    from lagcli.pictures.drawing import Picture
    from lagcli.problem_data import Problem

#: What is drawn without an end: states, not a motion.
_WITHOUT_MOTION = ("phase", "potential")
#: Stands for an end where only states are drawn.
_NO_END = 0.0


@record(kw_only=True)
class PlotWish(SimulateOptions):
    """The command line, as it was written."""

    kind: str | None = None
    section: str | None = None
    orbits: int
    dark: bool
    width: int | None = None
    ascii_only: bool


def plot_file(wish: PlotWish) -> Status:
    """Compute, draw, and say how it ended."""
    good = wish.kind is None or is_known("--kind", wish.kind, KINDS)
    if not (good & is_drawn_as(wish.output, PICTURES)) or not has_place(wish.output, wish.file):
        return Status.USAGE
    found = understood(wish, lambda p: _asked(p, wish))
    return Status.USAGE if found is None else _draw(*found, wish)


def _draw(problem: Problem, asked: Asked, wish: PlotWish) -> Status:
    def work() -> tuple[bytes, str]:
        from lagcli.pictures.kinds import PictureRequest, picture_of

        request = PictureRequest(
            kind=_kind(asked, wish),
            chosen=bool(wish.show),
            section=wish.section,
            orbits=wish.orbits,
        )
        with shared("integrating") as progress:
            picture, refusal = picture_of(problem, asked, request, progress)
        return _written(picture, wish), refusal

    return drawn(problem, work, wish.output)


def drawn(problem: Problem, work: Callable[[], tuple[bytes, str]], output: Path | None) -> Status:
    """Write the picture that the work makes, and report why its motion ends early, or is not."""
    from lagcli.diagnostics import ProblemError
    from lagcli.numerics.equations.refusal import Refusal
    from lagcli.pictures.drawing import CannotDraw

    try:
        data, refusal = work()
    except Refusal as mistake:
        return report_refusal(problem.source, mistake)
    except ProblemError as mistakes:
        report(mistakes.source, mistakes.diagnostics)
    except CannotDraw as reason:
        report_line(f"{problem.source.name}: error: {reason}")
    else:
        if not place(data, output):
            return Status.USAGE
        if refusal:
            report_line(f"{problem.source.name}: {refusal}")
        return Status.NOT_FOUND if refusal else Status.WELL
    return Status.USAGE


def _asked(problem: Problem, wish: PlotWish) -> Asked | None:
    """The options of the run; of a picture over time the coordinates, unless others are given."""
    needs_no_end = wish.kind in {*_WITHOUT_MOTION, None} and not wish.show
    if not wish.show and wish.kind in {None, "series"}:
        wish = replace(wish, show=("coordinates",))
    return asked_of(problem, wish, without_end=_NO_END if needs_no_end else None)


def _kind(asked: Asked, wish: PlotWish) -> str:
    """The kind that was named; else the motion where it has an end, else the phase portrait."""
    if wish.kind is not None:
        return wish.kind
    return "series" if asked.until > 0 else "phase"


def _written(picture: Picture, wish: PlotWish) -> bytes:
    if wish.output is not None:
        from lagcli.pictures.figure import to_bytes

        return to_bytes(picture, ending(wish.output), dark=wish.dark)
    from lagcli.pictures.terminal import Terminal, to_text

    encoding = (sys.stdout.encoding or "utf-8").lower()
    terminal = Terminal(
        width=wish.width or _columns(),
        unicode=encoding.startswith("utf") and not wish.ascii_only,
        colour=sys.stdout.isatty() and "NO_COLOR" not in os.environ,
    )
    return to_text(picture, terminal).encode(encoding, "replace")


def _columns() -> int:
    if not sys.stdout.isatty():
        return PIPE_WIDTH
    from shutil import get_terminal_size

    return max(40, get_terminal_size((PIPE_WIDTH, 24)).columns)


# -- files ---------------------------------------------------------------------------------------


def ending(path: Path) -> str:
    """`svg` of `pendulum.SVG`."""
    return path.suffix.lower().removeprefix(".")


def is_drawn_as(output: Path | None, endings: tuple[str, ...], option: str = "-o") -> bool:
    """Whether the ending is one of these, and what writes it is installed; reported if not."""
    if output is None:
        return True
    kind = ending(output)
    if kind not in endings:
        first = output.with_suffix(f".{endings[0]}")
        known = ", ".join(f".{each}" for each in endings)
        what = f"'.{kind}' is not one of" if kind else "the ending says the form, one of"
        report_line(
            f"lagcli: error: {option} {output}: {what} {known}: for example {option} {first}"
        )
        return False
    if kind != "html" and find_spec("matplotlib") is None:
        report_line(
            f"lagcli: error: {option} {output} needs the package matplotlib: "
            "pip install 'lagcli[plot]'"
        )
        return False
    return True
