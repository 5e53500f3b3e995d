"""Sets m + B r: a point, a matrix of points, and a box of radii (Lohner 1987, section 4)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

from lagcli.numerics.equations.null_space import dot

#: What the enclosure of the derivative may mix of one axis into another, in a step.
_MIXED = 1e-4


class LohnerSet:
    """A box in turned axes.

    Parameters
    ----------
    middle : sequence of arb
        m, exact.
    frame : arb_mat
        B.
    radii : arb_mat
        r, a column.
    """

    def __init__(self, middle: Sequence[Any], frame: Any, radii: Any) -> None:
        self.middle, self.frame, self.radii = list(middle), frame, radii

    @cached_property
    def spread(self) -> list[Any]:
        """Bounds of |B r|."""
        return [x.abs_upper() for x in (self.frame * self.radii).entries()]

    @property
    def box(self) -> list[Any]:
        """A ball around each component."""
        return [m + type(m)(0, x) for m, x in zip(self.middle, self.spread, strict=True)]

    def moved(self, middle: Sequence[Any], derivative: Any) -> LohnerSet:
        """The set that a map makes of this one, from its value at m and its derivative."""
        matrix, n = type(self.frame), len(middle)
        points = [x.mid() for x in middle]
        rest = matrix(n, 1, [x - m for x, m in zip(middle, points, strict=True)])
        turned = derivative * self.frame
        frame, inverse = _carried(turned) or orthonormal(turned, _by_length(turned, self.radii))
        return LohnerSet(points, frame, (inverse * turned) * self.radii + inverse * rest)


def _carried(turned: Any) -> tuple[Any, Any] | None:
    """The axes as the flow carries them, of length 1, and their inverse; None where too flat.

    In these axes the derivative of the flow is diagonal up to the radii of its enclosure.
    """
    n = turned.nrows()
    rows = [[float(x.mid()) for x in row] for row in turned.tolist()]
    lengths = [math.hypot(*column) for column in zip(*rows, strict=True)]
    if not all(0 < x < math.inf for x in lengths):
        return None
    frame = type(turned)(n, n, [x / y for row in rows for x, y in zip(row, lengths, strict=True)])
    try:
        inverse = frame.inv()
    except ZeroDivisionError:
        return None
    widest = max(float(x.rad()) for x in (inverse * turned).entries())
    return (frame, inverse) if widest < _MIXED * max(lengths) else None


def around(state: Sequence[Any]) -> LohnerSet:
    """The box of an initial state, in the axes of the components."""
    from flint import arb_mat

    n = len(state)
    points = [x.mid() for x in state]
    radii = arb_mat(n, 1, [x - m for x, m in zip(state, points, strict=True)])
    return LohnerSet(points, arb_mat(n, n, 1), radii)


def _by_length(turned: Any, radii: Any) -> list[int]:
    """The sides of the set, the longest first."""
    lengths = [
        float(radius.abs_upper()) * math.hypot(*(float(x.mid()) for x in column))
        for radius, column in zip(radii.entries(), turned.transpose().tolist(), strict=True)
    ]
    return sorted(range(len(lengths)), key=lambda j: -lengths[j])


def orthonormal(turned: Any, order: Sequence[int]) -> tuple[Any, Any]:
    """Orthogonal axes along columns in an order, by Gram and Schmidt, and the inverse.

    It need not be exact: whatever it is, its inverse is enclosed.
    """
    n = turned.nrows()
    columns = [[float(x.mid()) for x in column] for column in turned.transpose().tolist()]
    units = [[float(i == k) for i in range(n)] for k in range(n)]
    frame: list[list[float]] = []
    for candidate in [*(columns[j] for j in order), *units]:
        before = math.hypot(*candidate)
        for other in (*frame, *frame):  # twice is enough
            along = dot(candidate, other)
            candidate = [a - along * b for a, b in zip(candidate, other, strict=True)]
        after = math.hypot(*candidate)
        if len(frame) < n and after > 1e-8 * before:  # else the direction is there already
            frame.append([x / after for x in candidate])
    found = type(turned)(n, n, [frame[j][i] for i in range(n) for j in range(n)])
    return found, found.inv()
