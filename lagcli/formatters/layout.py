"""A formula as a row of pieces, and where to break it when the line is too short.

A line may break before a piece that has a `rank`.  The best break is the one outside the
most brackets, before + and − rather than a factor, that still fills the line.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.record import record, replace

#: What is added to the rank of a break inside a short bracket.
WHOLE = 100
#: How bad a break is, apart from its brackets.
RELATION, SUM, COMMA, QUOTIENT, BRACKETS, PRODUCT, OPENING, DIGITS = 0, 1, 1, 5, 5, 25, 40, 50

#: One more pair of brackets around a break: worse than a slash, or a break between two brackets,
#: outside of them.  A bracket is parted from a letter only where nothing else fits.
_NESTING = 6.0
#: An empty line is as bad as this many ranks.
_RAGGEDNESS = 6.0


@record
class TextPiece:
    """A bit of text that is never broken.

    Attributes
    ----------
    text, width
        What stands in the line, and how wide it is (columns or points).
    nesting
        +1 where a bracket opens, -1 where it closes.
    rank
        How bad a break before this piece is; None where there can be none.
    broken, broken_width
        What stands instead of `text` at the start of a new line.
    tail
        What is left behind at the end of the old line.
    """

    text: str
    width: float
    nesting: int = 0
    rank: int | None = None
    broken: str = ""
    broken_width: float = 0
    tail: str = ""


Layout = tuple[TextPiece, ...]

#: Behind an opening bracket: the last resort where functions are deeply nested.
AFTER_BRACKET = TextPiece("", 0, rank=OPENING)


@record
class Line:
    """One line of a broken formula; it is to be indented `depth` times."""

    text: str
    depth: int
    width: float


def kept_whole(layout: Layout, width: float) -> Layout:
    """Pieces that are no wider are parted last of all: (m1 + m2), sin(x - y)."""
    if sum(piece.width for piece in layout) > width:
        return layout
    return tuple(p if p.rank is None else replace(p, rank=p.rank % WHOLE + WHOLE) for p in layout)


def joined(layout: Sequence[TextPiece]) -> str:
    """Set the formula on one line."""
    return "".join(piece.text for piece in layout)


def width_of(layout: Sequence[TextPiece]) -> float:
    """Measure the width of the formula on one line."""
    return sum(piece.width for piece in layout)


def break_lines(
    layout: Sequence[TextPiece], first: float, others: float, indent: float = 0, deepest: int = 0
) -> list[Line]:
    """Lines no wider than `first` (the first one) and `others`, where breaks allow it.

    A line that starts inside n brackets is indented by n * `indent`, for `deepest` at most.
    """
    depths = _depths(layout)
    lines: list[Line] = []
    start = 0
    while start < len(layout):
        depth = min(depths[start], deepest) if lines else 0
        room = first if not lines else others - indent * depth
        stop, width = _next_break(layout, depths, start, room, fresh=bool(lines))
        lines.append(Line(_text(layout, start, stop, fresh=bool(lines)), depth, width))
        start = stop
    return lines or [Line("", 0, 0)]


def _depths(layout: Sequence[TextPiece]) -> list[int]:
    """How many brackets are open before each piece."""
    depths, depth = [], 0
    for piece in layout:
        depths.append(depth)
        depth += piece.nesting
    return depths


def _next_break(
    layout: Sequence[TextPiece], depths: Sequence[int], start: int, room: float, *, fresh: bool
) -> tuple[int, float]:
    """Where the line that begins at `start` ends best, and its width there."""
    best: tuple[float, int, float] | None = None
    width = layout[start].broken_width if fresh else layout[start].width
    for index in range(start + 1, len(layout)):
        piece = layout[index]
        overfull = width + len(piece.tail) > room
        if piece.rank is not None and (not overfull or best is None):
            empty = max(0.0, 1 - width / room) if room > 0 else 0.0
            cost = piece.rank + _NESTING * depths[index] + _RAGGEDNESS * empty**2
            if best is None or cost <= best[0]:
                best = (cost, index, width)
        if overfull and best is not None:
            return best[1], best[2]
        width += piece.width
    if width <= room or best is None:
        return len(layout), width
    return best[1], best[2]


def _text(layout: Sequence[TextPiece], start: int, stop: int, *, fresh: bool) -> str:
    head = layout[start].broken if fresh else layout[start].text
    tail = layout[stop].tail if stop < len(layout) else ""
    return (head + joined(layout[start + 1 : stop]) + tail).rstrip()
