"""A rectangle of characters to draw in: lines of Braille dots, signs over them.

A character cell is about twice as high as wide and Braille has 2 by 4 dots in it, so dots lie
as far apart along x as along y.  Where only ASCII is to be had, a cell is one dot.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, product

from lagcli.pictures.drawing import Point

_BRAILLE = 0x2800  # U+2800, the pattern without dots
#: The bit of the dot in column 0 or 1 and row 0 to 3: Unicode, chapter 21.1.
_BITS = ((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80))
#: Lengths of dash and gap in dots; of lines in ASCII, the letter.
_DASHES: tuple[tuple[int, int], ...] = ((1, 0), (5, 5), (1, 3), (9, 4), (2, 2), (1, 6))
_LETTERS = "*+ox#%"

Cell = tuple[str, int | None]


class Canvas:
    """`width` by `height` cells over the rectangle from `low` to `high`."""

    def __init__(
        self, width: int, height: int, low: Point, high: Point, *, unicode: bool, dashed: bool
    ) -> None:
        self.width, self.height = width, height
        self.low, self.high = low, high
        self.unicode, self.dashed = unicode, dashed
        self.cell = across, down = (2, 4) if unicode else (1, 1)
        self.dots = (width * across, height * down)
        self._bits = [[0] * width for _ in range(height)]
        self._letters: list[list[str]] = [[""] * width for _ in range(height)]
        self._colours: list[list[int | None]] = [[None] * width for _ in range(height)]
        self._signs: dict[tuple[int, int], Cell] = {}

    def line(self, points: Sequence[Point], colour: int | None, *, thin: bool = False) -> None:
        """A line through points, dashed by its colour where colours are not shown."""
        place = colour or 0
        dash, gap = (1, 2) if thin else _DASHES[place % len(_DASHES)] if self.dashed else (1, 0)
        passed = 0
        last = (-1, -1)
        for a, b in pairwise(points):
            for column, row in self._between(a, b):
                if not self.unicode or passed % (dash + gap) < dash:
                    self._dot(column, row, colour, thin=thin)
                passed += (column, row) != last
                last = (column, row)
        if len(points) == 1:
            self.dot(points[0], colour)

    def dot(self, point: Point, colour: int | None) -> None:
        """One dot."""
        found = self._place(point)
        if found is not None:
            self._dot(*found, colour, thin=False)

    def sign(self, point: Point, sign: str, colour: int | None) -> None:
        """A character over whatever is drawn there."""
        found = self._place(point)
        if found is not None:
            self._signs[found[1] // self.cell[1], found[0] // self.cell[0]] = sign, colour

    def column(self, x: float, sign: str, colour: int | None) -> None:
        """A line from top to bottom, behind the curves."""
        found = self._place((x, self.low[1]))
        if found is not None:
            self._behind(range(self.height), [found[0] // self.cell[0]], sign, colour)

    def row(self, y: float, sign: str, colour: int | None) -> None:
        """A line from left to right, behind the curves."""
        found = self._place((self.low[0], y))
        if found is not None:
            self._behind([found[1] // self.cell[1]], range(self.width), sign, colour)

    def shade(self, low: float, high: float, sign: str) -> None:
        """Fill what lies between two x, behind everything."""
        scale = self.width / (self.high[0] - self.low[0])
        first = max(0, round((low - self.low[0]) * scale))
        last = min(self.width, round((high - self.low[0]) * scale))
        self._behind(range(self.height), range(first, last), sign, None)

    def _behind(
        self, rows: Sequence[int], columns: Sequence[int], sign: str, colour: int | None
    ) -> None:
        """A sign in many cells where nothing else is drawn."""
        for place in product(rows, columns):
            self._signs.setdefault(place, ("behind" + sign, colour))

    def rows(self) -> Iterator[list[Cell]]:
        """The cells from top to bottom, each a character and its colour."""
        for row in range(self.height):
            yield [self._cell(row, column) for column in range(self.width)]

    def _cell(self, row: int, column: int) -> Cell:
        sign, colour = self._signs.get((row, column), ("", None))
        if sign and not sign.startswith("behind"):
            return sign, colour
        if self._bits[row][column]:
            return chr(_BRAILLE + self._bits[row][column]), self._colours[row][column]
        if self._letters[row][column]:
            return self._letters[row][column], self._colours[row][column]
        return (sign.removeprefix("behind"), colour) if sign else (" ", None)

    def _dot(self, column: int, row: int, colour: int | None, *, thin: bool) -> None:
        if not (0 <= column < self.dots[0] and 0 <= row < self.dots[1]):
            return
        if self.unicode:
            i, j = row // 4, column // 2
            self._bits[i][j] |= _BITS[column % 2][row % 4]
        else:
            i, j = row, column
            if thin and self._letters[i][j]:
                return
            self._letters[i][j] = "." if thin else _LETTERS[(colour or 0) % len(_LETTERS)]
        if not thin or self._colours[i][j] is None:
            self._colours[i][j] = None if thin else colour

    def _scaled(self, point: Point) -> tuple[float, float]:
        (x, y), (left, bottom), (right, top) = point, self.low, self.high
        across, down = self.dots
        return ((x - left) / (right - left) * (across - 1), (top - y) / (top - bottom) * (down - 1))

    def _place(self, point: Point) -> tuple[int, int] | None:
        column, row = self._scaled(point)
        inside = -0.5 <= column <= self.dots[0] - 0.5 and -0.5 <= row <= self.dots[1] - 0.5
        return (round(column), round(row)) if inside else None

    def _between(self, a: Point, b: Point) -> Iterator[tuple[int, int]]:
        """The dots from one point up to another."""
        found = _clipped(self._scaled(a), self._scaled(b), self.dots)
        if found is None:
            return
        (x, y), (u, v) = found
        steps = max(1, round(max(abs(u - x), abs(v - y))))
        for k in range(steps + 1):
            yield round(x + (u - x) * k / steps), round(y + (v - y) * k / steps)


def _clipped(a: Point, b: Point, dots: tuple[int, int]) -> tuple[Point, Point] | None:
    """The part of a line within the canvas: Liang and Barsky, ACM Trans. Graphics 3 (1984) 1."""
    first, last = 0.0, 1.0
    for axis in (0, 1):
        move, low, high = b[axis] - a[axis], -0.5 - a[axis], dots[axis] - 0.5 - a[axis]
        if move == 0:
            if low > 0 or high < 0:
                return None
            continue
        enter, leave = sorted((low / move, high / move))
        first, last = max(first, enter), min(last, leave)
    if first > last:
        return None
    return _along(a, b, first), _along(a, b, last)


def _along(a: Point, b: Point, part: float) -> Point:
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])
