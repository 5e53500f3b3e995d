"""Angles within one turn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from lagcli.pictures.drawing import Piece, Point


def is_periodic(f: Callable[[float], float]) -> bool:
    """Whether a function of an angle is the same one turn later."""
    pairs = [(f(x), f(x + 2 * math.pi)) for x in (0.3, 1.1, 2.7)]
    return all(abs(a - b) <= 1e-9 * (1 + abs(a)) for a, b in pairs)


def all_wrapped(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """Lines over an angle between -pi and pi."""
    return tuple(part for piece in pieces for part in wrapped(piece))


def wrapped(piece: Piece) -> list[Piece]:
    """A line over an angle between -pi and pi: it goes on at the other side.

    Two points of a piece may lie beyond, where it is cut off.
    """
    found: list[list[Point]] = []
    last: int | None = None
    before = piece[0]
    for angle, rate in piece:
        turn = math.floor((angle + math.pi) / (2 * math.pi))
        if turn != last:
            begin = []
            if last is not None:  # to the edge, and from the edge
                found[-1].append((angle - 2 * math.pi * last, rate))
                begin = [(before[0] - 2 * math.pi * turn, before[1])]
            found.append(begin)
            last = turn
        before = (angle, rate)
        found[-1].append((angle - 2 * math.pi * turn, rate))
    return [tuple(part) for part in found]
