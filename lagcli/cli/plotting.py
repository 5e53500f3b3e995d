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
from lagcli.cli.simulating import SimulateOptions, request_of
from lagcli.cli.status import Status
from lagcli.record import record, replace

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.pictures.drawing import Picture
    from lagcli.problem_data import Problem

#: What is drawn without an end: states, not a motion.
_WITHOUT_MOTION = ("phase", "potential")
#: Stands for an end where only states are drawn.
_NO_END = 0.0
#: Where no portrait can be drawn without an end.
_ASKED_FOR_END = "when does it end? give --until T, or simulation: {until: T}, for curves over time"


@record(kw_only=True)
class PlotOptions(SimulateOptions):
    """The command line, as it was written."""

    kind: str | None = None
    section: str | None = None
    orbits: int
    dark: bool
    width: int | None = None
    ascii_only: bool


def plot_file(options: PlotOptions) -> Status:
    """Compute, draw, and say how it ended."""
    good = options.kind is None or is_known("--kind", options.kind, KINDS)
    if not (good & is_drawn_as(options.output, PICTURES)) or not has_place(
        options.output, options.file
    ):
        return Status.USAGE
    found = understood(options, lambda p: _request(p, options))
    return Status.USAGE if found is None else _draw(*found, options)


def _draw(problem: Problem, request: RunRequest, options: PlotOptions) -> Status:
    def work() -> tuple[bytes, str]:
        from lagcli.pictures.drawing import CannotDraw
        from lagcli.pictures.kinds import PictureRequest, picture_of

        drawing = PictureRequest(
            kind=_kind(request, options),
            chosen=bool(options.show),
            section=options.section,
            orbits=options.orbits,
        )
        try:
            with shared("integrating") as progress:
                picture, refusal = picture_of(problem, request, drawing, progress)
        except CannotDraw:
            if options.kind is None and request.until == _NO_END:
                raise CannotDraw(_ASKED_FOR_END) from None
            raise
        return _written(picture, options), refusal

    return drawn(problem, work, options.output)


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


def _request(problem: Problem, options: PlotOptions) -> RunRequest | None:
    """The options of the run; of a picture over time the coordinates, unless others are given."""
    needs_no_end = options.kind in {*_WITHOUT_MOTION, None} and not options.show
    if not options.show and options.kind in {None, "series"}:
        options = replace(options, show=("coordinates",))
    return request_of(problem, options, without_end=_NO_END if needs_no_end else None)


def _kind(request: RunRequest, options: PlotOptions) -> str:
    """The kind that was named; else the motion where it has an end, else the phase portrait."""
    if options.kind is not None:
        return options.kind
    return "series" if request.until > 0 else "phase"


def _written(picture: Picture, options: PlotOptions) -> bytes:
    if options.output is not None:
        from lagcli.pictures.figure import to_bytes

        return to_bytes(picture, ending(options.output), dark=options.dark)
    from lagcli.pictures.terminal import Terminal, to_text

    encoding = (sys.stdout.encoding or "utf-8").lower()
    terminal = Terminal(
        width=options.width or _columns(),
        unicode=encoding.startswith("utf") and not options.ascii_only,
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
