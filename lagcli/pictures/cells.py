"""A heat map by Matplotlib; where there are few values, as of a basin of attraction, a key."""

from __future__ import annotations

import math
from typing import Any

from lagcli.pictures.drawing import Cells
from lagcli.pictures.mathtext import tex
from lagcli.pictures.palette import Style

#: As many values are kinds, each with a colour of its own.
_FEW = 6
#: Perceptually uniform, and the same order of lightness for the colour-blind
#: (Nunez, Anderton, Renslow, PLoS ONE 13 (2018) e0199239).
_COLOURS = "cividis"


def draw_cells(ax: Any, cells: Cells, style: Style) -> None:
    """Draw the cells into the axes."""
    given = [[math.nan if x is None else x for x in row] for row in cells.values]
    kinds = sorted({x for row in given for x in row if not math.isnan(x)})
    if len(kinds) <= _FEW:
        _draw_kinds(ax, cells, given, kinds, style)
        return
    mesh = ax.pcolormesh(cells.x, cells.y, given, cmap=_COLOURS, rasterized=True)
    bar = ax.figure.colorbar(mesh, ax=ax)
    bar.set_label(tex(cells.label))
    bar.outline.set_edgecolor(style.ink)


def _draw_kinds(
    ax: Any, cells: Cells, given: list[list[float]], kinds: list[float], style: Style
) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    numbers = {kind: place for place, kind in enumerate(kinds)}
    placed = [[numbers.get(x, math.nan) for x in row] for row in given]
    colours = style.series[: len(kinds)] or style.series[:1]
    top = max(1, len(kinds)) - 0.5
    ax.pcolormesh(
        cells.x, cells.y, placed, cmap=ListedColormap(colours), vmin=-0.5, vmax=top,
        rasterized=True,
    )  # fmt: skip
    handles = [
        Patch(color=c, label=f"{x:g}".replace("-", "\N{MINUS SIGN}"))
        for c, x in zip(colours, kinds, strict=False)
    ]
    ax.legend(
        handles=handles, title=tex(cells.label), loc="upper left", bbox_to_anchor=(1.01, 1.0),
        fontsize=8, frameon=False, labelcolor=style.ink, borderaxespad=0.0,
    )  # fmt: skip
