"""A picture written by Matplotlib: SVG, PDF and PNG, the same bytes for the same picture.

Glyphs of an SVG are outlines, a PDF has its fonts embedded as TrueType, and none has a date,
so that a file looks the same on every machine and a journal takes it.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

from lagcli.pictures.cells import draw_cells
from lagcli.pictures.drawing import (
    Axis,
    Band,
    Cells,
    Curve,
    Item,
    Marks,
    Panel,
    Picture,
    Rule,
    drawn_by,
)
from lagcli.pictures.mathtext import plainly, tex
from lagcli.pictures.palette import DARK, DASHES, LIGHT, Style
from lagcli.pictures.ticks import ticks

#: Inches: the text width of an article in two columns, and the height of panels below each other.
_WIDTH, _ALONE, _BELOW, _TALLEST = 6.4, 4.0, 2.2, 5.6
#: Inches of the title and the notes.
_REST = 0.7
_RESOLUTION = 200
_METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": "lagcli"},
    "pdf": {"CreationDate": None, "ModDate": None, "Creator": "lagcli", "Producer": "lagcli"},
    "png": {"Software": "lagcli"},
}
#: What has the colour of the lines, and what that of the page.
_INK = ("axes.edgecolor", "axes.labelcolor", "text.color", "xtick.color", "ytick.color")
_PAPER = ("axes.facecolor", "figure.facecolor")
#: What can be written, by the ending of the file.
FORMATS = tuple(_METADATA)
_MARKERS = {
    "stable": "o", "unstable": "X", "turning": "D", "start": "o", "event": "v", "dots": ".",
    "impact": "v",
}  # fmt: skip
_SIZES = {"start": 6.0, "turning": 5.0, "impact": 4.0}
#: Dots of a section are small where there are many, and are seen where there are few.
_SMALLEST, _LARGEST, _INK_OF_DOTS = 2.5, 9.0, 36.0
_RULES = {"event": ":", "bound": "--", "certificate": "-", "energy": "--", "zero": "-"}
#: Dashes of the kinds of events.
_EVENTS = ((1, 2), (5, 2), (5, 2, 1, 2), (9, 3), (1, 5), (3, 1, 1, 1, 1, 1))
_LONG_TITLE = 70
#: A key with a longer name stands above its panel, not beside it.
_WIDE_LABEL = 22


def to_bytes(picture: Picture, kind: str, *, dark: bool = False) -> bytes:
    """The picture as a file of one of the `FORMATS`.

    Parameters
    ----------
    picture
        With labels whose `tex` mathtext knows; others are written plainly.
    kind
        `svg`, `pdf` or `png`.
    dark
        Light lines on a dark page.
    """
    style = DARK if dark else LIGHT
    with settings(style):
        figure = drawn(picture, style)
        into = BytesIO()
        figure.savefig(into, format=kind, dpi=_RESOLUTION, metadata=_METADATA[kind])
    return into.getvalue()


@contextmanager
def settings(style: Style) -> Iterator[None]:
    """Matplotlib set up for one picture, whatever the user's own settings are."""
    import matplotlib as mpl

    with mpl.rc_context(), warnings.catch_warnings():
        # a title in a script that no font has is written with what there is
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        mpl.rcdefaults()
        mpl.rc_file(Path(__file__).with_name("lagcli.mplstyle"), use_default_template=False)
        mpl.rcParams.update(dict.fromkeys(_INK, style.ink) | dict.fromkeys(_PAPER, style.paper))
        yield


def drawn(picture: Picture, style: Style) -> Any:
    """The picture as a figure of Matplotlib, within `settings`."""
    from matplotlib.figure import Figure

    count = len(picture.panels)
    rows, columns = (1, count) if picture.beside else (count, 1)
    figure: Any = Figure(figsize=_size(picture), layout="constrained")
    heights = [1.0] * rows
    if not picture.beside and any(panel.equal for panel in picture.panels):
        heights = [_ratio(panel) for panel in picture.panels]
    axes: Any = figure.subplots(
        rows, columns, squeeze=False, sharex=not picture.beside and count > 1,
        gridspec_kw={"height_ratios": heights},
    )  # fmt: skip
    for place, (panel, ax) in enumerate(zip(picture.panels, axes.flat, strict=True)):
        last = picture.beside or place == count - 1
        _Panel(ax, style).draw(panel, with_x=last)
    size = 12 if len(picture.title) <= _LONG_TITLE else 10
    figure.suptitle(plainly(picture.title), fontsize=size, wrap=True)
    if picture.notes:
        figure.supxlabel(
            plainly("\n".join(picture.notes)), fontsize=7.5, color=style.second, ha="center"
        )
    return figure


def _size(picture: Picture) -> tuple[float, float]:
    count = len(picture.panels)
    if picture.beside:
        return min(3.4 * count, 10.0) if count > 1 else _WIDTH, _ALONE + 0.4
    if any(panel.equal for panel in picture.panels):
        return _WIDTH, min(sum(map(_fitted, picture.panels)), 1.6 * _TALLEST) + _REST
    if count == 1:
        return _WIDTH, _ALONE + _REST
    return _WIDTH, _BELOW * count + _REST


def _ratio(panel: Panel) -> float:
    """Height by width of what is shown."""
    return (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low)


def _fitted(panel: Panel) -> float:
    """The height of a panel with equal lengths along both axes."""
    return min(max(0.8 * _WIDTH * _ratio(panel), 1.6), _TALLEST) + 0.5


class _Panel:
    def __init__(self, ax: Any, style: Style) -> None:
        self.ax, self.style = ax, style

    def draw(self, panel: Panel, *, with_x: bool) -> None:
        """Axes, items and key."""
        ax = self.ax
        ax.set_xlim(panel.x.low, panel.x.high)
        ax.set_ylim(panel.y.low, panel.y.high)
        if panel.x.logarithmic:
            ax.set_xscale("log")
        if panel.y.logarithmic:
            ax.set_yscale("log")
        if panel.equal:
            ax.set_aspect("equal")
        self._ticks(ax.xaxis, panel.x)
        self._ticks(ax.yaxis, panel.y)
        ax.grid(visible=True, color=self.style.faint, linewidth=0.35, alpha=0.7)
        ax.set_axisbelow(True)
        if with_x:
            ax.set_xlabel(tex(panel.x.label))
        ax.set_ylabel(tex(panel.y.label))
        for item in panel.items:
            self._item(item)
        listed = drawn_by(panel)
        if listed:
            wide = max(len(item.label.plain) for item in listed if item.label) > _WIDE_LABEL
            ax.legend(  # outside of the panel: it covers nothing
                handles=[self._handle(item) for item in listed],
                fontsize=8,
                loc="lower left" if wide else "upper left",
                bbox_to_anchor=(0.0, 1.01) if wide else (1.01, 1.0),
                ncols=2 if wide else 1,
                borderaxespad=0.0,
                frameon=False,
                labelcolor=self.style.ink,
                handlelength=2.2,
            )

    def _ticks(self, axis: Any, given: Axis) -> None:
        from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

        found = ticks(given)
        axis.set_major_locator(FixedLocator([tick.at for tick in found]))
        axis.set_major_formatter(FixedFormatter([tex(tick.label) for tick in found]))
        axis.set_minor_locator(NullLocator())

    def _item(self, item: Item) -> None:
        ax, style = self.ax, self.style
        match item:
            case Curve(pieces=pieces):
                look = self._line(item)
                for piece in pieces:
                    xs, ys = zip(*piece, strict=True)
                    if len(piece) == 1:
                        ax.plot(xs, ys, marker=".", markersize=3, color=look["color"])
                    else:
                        ax.plot(xs, ys, **look)
            case Marks(points=points) if points:
                xs, ys = zip(*points, strict=True)
                ax.plot(xs, ys, **self._mark(item))
            case Rule(at=at, of="x"):
                ax.axvline(at, **self._rule(item))
            case Rule(at=at):
                ax.axhline(at, **self._rule(item))
            case Cells():
                draw_cells(ax, item, style)
            case Band(low=low, high=high):
                ax.axvspan(
                    low, high, facecolor=style.grey, edgecolor=style.faint, linewidth=0,
                    zorder=0.5, hatch="///",
                )  # fmt: skip
            case _:
                pass

    def _line(self, curve: Curve) -> dict[str, Any]:
        colour = self.style.colour(curve.colour)
        match curve.role:
            case "level":
                return {"color": self.style.second, "linewidth": 0.6, "zorder": 2}
            case "surface":
                return {"color": self.style.ink, "linewidth": 1.2, "zorder": 2}
            case "separatrix":
                return {"color": colour, "linewidth": 1.6, "linestyle": "--", "zorder": 3}
            case "motion" | "potential":
                return {"color": colour, "linewidth": 1.7, "zorder": 4}
            case "series":
                dash = DASHES[curve.colour % len(DASHES)]
                look = {"color": colour, "linewidth": 1.3, "zorder": 3}
                return {**look, "linestyle": (0, dash)} if dash else look

    def _mark(self, marks: Marks) -> dict[str, Any]:
        colour = self.style.colour(marks.colour)
        hollow = marks.role in {"start", "impact"}
        size = _SIZES.get(marks.role, 7.0)
        if marks.role == "dots":
            size = max(_SMALLEST, min(_LARGEST, _INK_OF_DOTS / math.sqrt(len(marks.points) or 1)))
        return {
            "linestyle": "none",
            "marker": _MARKERS[marks.role],
            "markersize": size,
            "markerfacecolor": self.style.paper if hollow else colour,
            "markeredgecolor": colour if hollow or marks.role == "dots" else self.style.paper,
            "markeredgewidth": 0.0 if marks.role == "dots" else 0.9,
            "zorder": 6,
            "clip_on": marks.role not in {"stable", "unstable", "start"},
        }

    def _rule(self, rule: Rule) -> dict[str, Any]:
        look = {"linestyle": _RULES[rule.role], "linewidth": 0.9, "zorder": 2.5}
        match rule.role:
            case "event":
                dash = _EVENTS[rule.colour % len(_EVENTS)]
                return {**look, "color": self.style.second, "linestyle": (0, dash)}
            case "certificate":
                return {**look, "color": self.style.ink, "linewidth": 1.6}
            case "zero":
                return {**look, "color": self.style.faint}
            case _:
                return {**look, "color": self.style.colour(rule.colour)}

    def _handle(self, item: Curve | Marks | Rule) -> Any:
        from matplotlib.lines import Line2D

        match item:
            case Curve():
                look = self._line(item)
            case Marks():
                look = self._mark(item)
            case Rule():
                look = self._rule(item)
        assert item.label is not None
        return Line2D([], [], label=tex(item.label), **look)
