"""A picture in characters: Braille where the terminal has Unicode, letters where it has not."""

from __future__ import annotations

import math
from collections.abc import Iterable

from lagcli.formatters.display_width import display_width
from lagcli.formatters.plain import filled, harmless
from lagcli.pictures.canvas import Canvas, Cell
from lagcli.pictures.drawing import (
    Axis,
    Band,
    Curve,
    DrawnName,
    Item,
    Marks,
    Panel,
    Picture,
    Point,
    Rule,
    drawn_by,
)
from lagcli.pictures.ticks import Tick, ticks
from lagcli.record import record

#: The usual colours of a terminal that are told apart: blue, red, green, magenta, yellow, cyan.
_ANSI = (94, 91, 92, 95, 93, 96)
_SIGNS = {
    "stable": ("●", "O"), "unstable": ("✕", "X"), "turning": ("◆", "#"), "start": ("○", "o"),
    "event": ("▼", "V"), "dots": ("•", "."), "impact": ("◇", "v"),
}  # fmt: skip
_UPRIGHT = {"certificate": ("┃", "|"), "event": ("┊", ":")}
_LEVEL = {"bound": ("╌", "-"), "energy": ("╌", "-"), "zero": ("·", " ")}
_SHADE = ("░", "/")
#: Heights in rows of one panel, of each of two, and of each of more.
_HEIGHTS = (18, 12, 9)
_TALLEST = 30
_LEVELS_HEIGHT = 24


@record(kw_only=True)
class Terminal:
    """How wide it is, and what it can show."""

    width: int = 80
    unicode: bool = True
    colour: bool = False


def to_text(picture: Picture, terminal: Terminal) -> str:
    """The picture as lines, none wider than the terminal."""
    writer = _Writer(terminal)
    height = _HEIGHTS[min(len(picture.panels), len(_HEIGHTS)) - 1]
    lines = [*filled(harmless(picture.title).split(), terminal.width)]
    for panel in picture.panels:
        lines += ["", *writer.panel(panel, height)]
    lines.append("")
    for note in picture.notes:
        lines += filled(harmless(writer.spelled(note)).split(), terminal.width)
    text = "\n".join(line.rstrip() for line in lines) + "\n"
    return text if terminal.unicode else text.encode("ascii", "replace").decode()


class _Writer:
    def __init__(self, terminal: Terminal) -> None:
        self.terminal = terminal
        self.form = 0 if terminal.unicode else 1

    def spelled(self, note: str) -> str:
        """A note with the letters that there are."""
        plain = {"θ": "theta", "′": "'", "−": "-", "–": "-", "…": "...", "≤": "<=", "·": "."}
        return note if self.terminal.unicode else "".join(plain.get(c, c) for c in note)

    def name(self, label: DrawnName) -> str:
        """A label in the letters that there are."""
        return label.plain if self.terminal.unicode else label.ascii

    def cut(self, text: str, width: int) -> str:
        """The text, or as much of it as fits."""
        if display_width(text) <= width:
            return text
        dots = ("…", "...")[self.form]
        while display_width(text + dots) > width:
            text = text[:-1]
        return text + dots

    def panel(self, panel: Panel, height: int) -> list[str]:
        """Axes, what is in them, and the key."""
        if panel.equal or any(isinstance(i, Curve) and i.role == "level" for i in panel.items):
            height = _TALLEST if panel.equal else _LEVELS_HEIGHT
        down = ticks(panel.y, max(3, height // 3))
        margin = max([display_width(self.name(tick.label)) for tick in down], default=1) + 1
        width = self.terminal.width - margin - 1
        low, high = (panel.x.low, panel.y.low), (panel.x.high, panel.y.high)
        if panel.equal:
            width, height = _fitted(low, high, width, height)
        across = ticks(panel.x, max(2, width // 11))
        canvas = self._canvas(width, height, _logged(panel, low), _logged(panel, high))
        for item in _fewer_levels(panel.items):
            self._draw(canvas, panel, item)
        lines = [" " * margin + self.cut(self.name(panel.y.label), width)]
        lines += self._framed(canvas, panel.y, down, margin)
        lines += self._bottom(panel.x, across, margin, width)
        return [*lines, *self._key(panel)]

    def _canvas(self, width: int, height: int, low: Point, high: Point) -> Canvas:
        unicode, dashed = self.terminal.unicode, not self.terminal.colour
        return Canvas(width, height, low, high, unicode=unicode, dashed=dashed)

    # -- what is in it ---------------------------------------------------------------------------

    def _draw(self, canvas: Canvas, panel: Panel, item: Item) -> None:
        match item:
            case Curve(pieces=pieces, role=role, colour=colour):
                thin = role in {"level", "surface"}
                for piece in pieces:
                    canvas.line([_logged(panel, p) for p in piece], colour, thin=thin)
            case Marks(points=points, role=role, colour=colour):
                for point in points:
                    if role == "dots":
                        canvas.dot(_logged(panel, point), colour)
                    else:
                        canvas.sign(_logged(panel, point), _SIGNS[role][self.form], colour)
            case Rule(at=at, of="x", role=role, colour=colour):
                sign = _UPRIGHT.get(role, _UPRIGHT["event"])[self.form]
                canvas.column(_logged(panel, (at, panel.y.low))[0], sign, colour)
            case Rule(at=at, role=role, colour=colour):
                place = _logged(panel, (panel.x.low, at))[1]
                canvas.row(place, _LEVEL.get(role, _LEVEL["bound"])[self.form], colour)
            case Band(low=low, high=high):
                canvas.shade(low, high, _SHADE[self.form])

    def _framed(self, canvas: Canvas, axis: Axis, marks: list[Tick], margin: int) -> list[str]:
        at_row: dict[int, str] = {}
        low, high = canvas.low[1], canvas.high[1]
        for tick in marks:
            place = _log(axis, tick.at)
            row = round((high - place) / (high - low) * (canvas.height - 1))
            at_row[row] = self.name(tick.label)
        lines = []
        for row, cells in enumerate(canvas.rows()):
            shown = at_row.get(row, "")
            wall = ("┤" if shown else "│", "+" if shown else "|")[self.form]
            lines.append(" " * (margin - display_width(shown)) + shown + wall + self._text(cells))
        return lines

    def _bottom(self, axis: Axis, marks: list[Tick], margin: int, width: int) -> list[str]:
        line = [("─", "-")[self.form]] * width
        below = [" "] * (width + 12)
        low, high = _log(axis, axis.low), _log(axis, axis.high)
        taken = -1
        for tick in marks:
            column = round((_log(axis, tick.at) - low) / (high - low) * (width - 1))
            shown = self.name(tick.label)
            start = min(max(0, column - len(shown) // 2), width - len(shown))
            if start <= taken:
                continue
            line[column] = ("┬", "+")[self.form]
            below[start : start + len(shown)] = shown
            taken = start + len(shown)
        pad = " " * margin
        name = self.cut(self.name(axis.label), width)
        corner = ("└", "+")[self.form]
        middle = max(0, (width - display_width(name)) // 2)
        return [
            pad + corner + "".join(line),
            pad + " " + "".join(below).rstrip(),
            pad + " " + " " * middle + name,
        ]

    def _key(self, panel: Panel) -> list[str]:
        """What the curves and signs are, as many in a line as fit."""
        lines: list[str] = []
        width = 0
        for item in drawn_by(panel):
            assert item.label is not None
            cells = self._sample(item)
            name = self.cut(self.name(item.label), self.terminal.width - 3 - len(cells))
            needed = 3 + len(cells) + display_width(name)
            if not lines or width + needed > self.terminal.width:
                lines.append("")
                width = 0
            lines[-1] += f"  {self._text(cells)} {name}"
            width += needed
        return lines

    def _sample(self, item: Curve | Marks | Rule) -> list[Cell]:
        match item:
            case Curve(role=role, colour=colour):
                canvas = self._canvas(4, 1, (0.0, 0.0), (1.0, 1.0))
                canvas.line([(0.0, 0.5), (1.0, 0.5)], colour, thin=role in {"level", "surface"})
                return next(canvas.rows())
            case Marks(role=role, colour=colour):
                return [(_SIGNS[role][self.form], colour)]
            case Rule(of="x", role=role, colour=colour):
                return [(_UPRIGHT.get(role, _UPRIGHT["event"])[self.form], colour)]
            case Rule(role=role, colour=colour):
                sign = _LEVEL.get(role, _LEVEL["bound"])[self.form]
                return [(sign, colour)] * 3

    def _text(self, cells: Iterable[Cell]) -> str:
        """Cells with the escapes of their colours."""
        if not self.terminal.colour:
            return "".join(sign for sign, _ in cells)
        shown, last = [], None
        for sign, colour in cells:
            if colour != last:
                code = 0 if colour is None else _ANSI[colour % len(_ANSI)]
                shown.append(f"\x1b[{code}m")
                last = colour
            shown.append(sign)
        return "".join(shown) + ("\x1b[0m" if last is not None else "")


def _fewer_levels(items: tuple[Item, ...]) -> list[Item]:
    """Without every second level line: dots are coarse."""
    levels = [item for item in items if isinstance(item, Curve) and item.role == "level"]
    left_out = set(map(id, levels[1::2]))
    return [item for item in items if id(item) not in left_out]


def _log(axis: Axis, value: float) -> float:
    return math.log10(max(value, axis.low)) if axis.logarithmic else value


def _logged(panel: Panel, point: Point) -> Point:
    return _log(panel.x, point[0]), _log(panel.y, point[1])


def _fitted(low: Point, high: Point, width: int, height: int) -> tuple[int, int]:
    """The cells of a panel with equal lengths along both axes: a cell is twice as high as wide."""
    ratio = (high[1] - low[1]) / (high[0] - low[0])  # of height by width
    wanted = max(1, round(width * ratio / 2))
    if wanted <= height:
        return width, max(wanted, 3)
    return max(10, min(width, round(2 * height / ratio))), height
