"""Lines of equal value of a function of two variables.

Marching squares on a grid; each place where a line crosses an edge is a root of the function
itself along that edge, to rounding, so a line is exact at its corners.

References
----------
Lorensen, Cline, "Marching cubes", Computer Graphics 21 (1987) 163, in two dimensions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from lagcli.evaluation import bisected
from lagcli.numerics.hybrid.extrema import crossing
from lagcli.pictures.drawing import Piece, Point

Field = Callable[[float, float], float]
#: The edge from a grid point to its right, or upper, neighbour.
Edge = tuple[int, int, bool]


#: At a root that is found to rounding, a value beside those around it.
_AT_ROOT = 1e-6


def quiet(f: Callable[..., float]) -> Callable[..., float]:
    """The function, with nan where it is not defined."""

    def value(*arguments: float) -> float:
        try:
            found = f(*arguments)
        except (ArithmeticError, ValueError):
            return math.nan
        return found if math.isfinite(found) else math.nan

    return value


def grid(low: float, high: float, count: int) -> list[float]:
    """Equally spaced values, both ends included."""
    return [low + (high - low) * k / (count - 1) for k in range(count)]


class Contours:
    """The lines of a function over a rectangle.

    Parameters
    ----------
    f
        Of x and y; nan where it is not defined, and no line comes there.
    xs, ys
        The grid.
    """

    def __init__(self, f: Field, xs: Sequence[float], ys: Sequence[float]) -> None:
        self.f, self.xs, self.ys = f, xs, ys
        self.values = [[f(x, y) for y in ys] for x in xs]

    def at(self, level: float) -> tuple[Piece, ...]:
        """The lines where the function has a value; a closed one ends where it begins."""
        ties: dict[Edge, list[Edge]] = {}
        for i in range(len(self.xs) - 1):
            for j in range(len(self.ys) - 1):
                for a, b in self._segments(i, j, level):
                    ties.setdefault(a, []).append(b)
                    ties.setdefault(b, []).append(a)
        ends = [edge for edge, others in ties.items() if len(others) == 1]
        chains = [_chain(ties, first) for first in [*ends, *ties] if ties[first]]
        return tuple(tuple(self._crossing(edge, level) for edge in chain) for chain in chains)

    def _segments(self, i: int, j: int, level: float) -> list[tuple[Edge, Edge]]:
        """The edges of one cell that lines join."""
        corners = [self.values[i][j], self.values[i + 1][j],
                   self.values[i + 1][j + 1], self.values[i][j + 1]]  # fmt: skip
        above = [value >= level for value in corners]
        if all(above) or not any(above) or any(map(math.isnan, corners)):
            return []
        edges: list[Edge] = [
            (i, j, True), (i + 1, j, False), (i, j + 1, True), (i, j, False),
        ]  # fmt: skip
        crossed = [k for k in range(4) if above[k] != above[(k + 1) % 4]]
        if len(crossed) == 2:
            return [(edges[crossed[0]], edges[crossed[1]])]
        middle = self.f((self.xs[i] + self.xs[i + 1]) / 2, (self.ys[j] + self.ys[j + 1]) / 2)
        apart = (middle >= level) == above[0]  # what is like the first corner hangs together
        first, second = ((0, 1), (2, 3)) if apart else ((3, 0), (1, 2))
        return [(edges[first[0]], edges[first[1]]), (edges[second[0]], edges[second[1]])]

    def _crossing(self, edge: Edge, level: float) -> Point:
        i, j, along_x = edge
        x, y = self.xs[i], self.ys[j]
        first = self.values[i][j] - level
        if along_x:
            second = self.values[i + 1][j] - level
            return _root(lambda u: self.f(u, y) - level, x, self.xs[i + 1], first, second), y
        second = self.values[i][j + 1] - level
        return x, _root(lambda u: self.f(x, u) - level, y, self.ys[j + 1], first, second)


def _root(f: Callable[[float], float], a: float, b: float, fa: float, fb: float) -> float:
    if fa >= 0 > fb:
        return crossing(f, a, b, fa, fb)
    return a + b - crossing(lambda u: f(a + b - u), a, b, fb, fa)


def _chain(ties: dict[Edge, list[Edge]], first: Edge) -> list[Edge]:
    """The edges from one to the end of its line, or round to itself; they are used up."""
    chain = [first]
    while ties[chain[-1]]:
        here = chain[-1]
        there = ties[here].pop()
        ties[there].remove(here)
        chain.append(there)
    return chain


def first_root(f: Callable[[float], float], halvings: int) -> float:
    """Where a function that is negative at 0 rises to 0: by doubling, then by halving."""
    low, high = 0.0, 1e-6
    while f(high) < 0 and high < 1e12:
        low, high = high, 2 * high
    return bisected(lambda x: f(x) < 0, low, high, halvings)[1]


def roots(f: Callable[[float], float], places: Sequence[float]) -> list[float]:
    """Where a function of one variable changes its sign between neighbouring places."""
    values = [f(x) for x in places]
    found = []
    for a, b, fa, fb in zip(places, places[1:], values, values[1:], strict=False):
        if math.isfinite(fa) and math.isfinite(fb) and (fa >= 0) != (fb >= 0):
            x = _root(f, a, b, fa, fb)
            value = f(x)
            if abs(value) <= _AT_ROOT * max(abs(fa), abs(fb)):  # no pole, no jump
                found.append(x)
    return found
