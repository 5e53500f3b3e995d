"""A heat map by Matplotlib; where there are few values, as of a basin of attraction, a key."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
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
    edges = _edges(cells.x), _edges(cells.y)
    if len(kinds) <= _FEW:
        _draw_kinds(ax, cells, edges, given, kinds, style)
        return
    mesh = ax.pcolormesh(*edges, given, cmap=_COLOURS, rasterized=True)
    bar = ax.figure.colorbar(mesh, ax=ax)
    bar.set_label(tex(cells.label))
    bar.outline.set_edgecolor(style.ink)


def _draw_kinds(
    ax: Any,
    cells: Cells,
    edges: tuple[list[float], list[float]],
    given: list[list[float]],
    kinds: list[float],
    style: Style,
) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    numbers = {kind: place for place, kind in enumerate(kinds)}
    placed = [[numbers.get(x, math.nan) for x in row] for row in given]
    colours = style.series[: len(kinds)] or style.series[:1]
    top = max(1, len(kinds)) - 0.5
    ax.pcolormesh(
        *edges, placed, cmap=ListedColormap(colours), vmin=-0.5, vmax=top, rasterized=True
    )
    handles = [
        Patch(color=c, label=f"{x:g}".replace("-", "\N{MINUS SIGN}"))
        for c, x in zip(colours, kinds, strict=False)
    ]
    ax.legend(
        handles=handles, title=tex(cells.label), loc="upper left", bbox_to_anchor=(1.01, 1.0),
        fontsize=8, frameon=False, labelcolor=style.ink, borderaxespad=0.0,
    )  # fmt: skip


def _edges(middles: Sequence[float]) -> list[float]:
    """What lies half-way between the middles, and as far beyond the first and the last."""
    between = [(a + b) / 2 for a, b in pairwise(middles)]
    if not between:
        return [middles[0] - 0.5, middles[0] + 0.5]
    return [2 * middles[0] - between[0], *between, 2 * middles[-1] - between[-1]]
