"""M a = F + A^T lambda, A a + c = 0 where the rank is in question: the null-space way.

The rows are scaled and eliminated with full pivoting; those whose largest entry falls
below 1e-5, which is 1e-10 in A M^-1 A^T, are combinations of the others.  With
A a_p = -c and A Z = 0,

    (Z^T M Z) w = Z^T (F - M a_p),    a = a_p + Z w,

which needs M on the motions that the constraints allow and nowhere else.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., sections 3.4 and 6.2.
The tolerance: a four-bar linkage passes its singular position at 1e-10, not at 1e-13.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from operator import mul
from typing import Any

from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE
from lagcli.pivoting import reduced
from lagcli.record import record

Vector = list[float]
Matrix = Sequence[Sequence[float]]

#: What is left of a dependent row, as a part of its length.
_DEPENDENT = math.sqrt(PIVOT_TOLERANCE)
#: A pivot of Z^T M Z smaller than this part of the largest is no mass.
_NO_MASS = 1e-13
#: A row takes no part in a combination with a smaller weight than this.
_WEIGHTLESS = 1e-5


class NoMass(ArithmeticError):
    """The mass matrix is singular on the motions that the constraints allow."""


@record
class Held:
    """A solution, with rows that imply the others and which multipliers it determines."""

    accelerations: Vector
    multipliers: Vector
    independent: tuple[int, ...]
    determined: tuple[bool, ...]


def held_motion(mass: Matrix, forcing: Vector, rows: Matrix, bias: Vector) -> Held:
    """The accelerations and the multipliers; those not determined are 0.

    Raises
    ------
    NoMass
        When the accelerations are not determined.
    """
    n = len(forcing)
    scales, lengths, unit = _scaled([mass[j][j] for j in range(n)], rows)
    work = [
        [*row, -c / (length or 1.0)] for row, length, c in zip(unit, lengths, bias, strict=True)
    ]
    pivots = reduced(work, n, _DEPENDENT)
    free = [j for j in range(n) if j not in {column for _, column in pivots}]
    particular = [0.0] * n
    for i, column in pivots:
        particular[column] = work[i][n]
    null: list[Vector] = []
    for j in free:
        direction = [0.0] * n
        direction[j] = 1.0
        for i, column in pivots:
            direction[column] = -work[i][j]
        null.append(direction)
    scaled = [[mass[i][j] * scales[i] * scales[j] for j in range(n)] for i in range(n)]
    force = [f * s for f, s in zip(forcing, scales, strict=True)]
    rest = [f - dot(row, particular) for f, row in zip(force, scaled, strict=True)]
    moved = [[dot(row, z) for row in scaled] for z in null]
    weights = solved([[dot(z, m) for m in moved] for z in null], [dot(z, rest) for z in null])
    a = [
        p + sum(w * z[j] for w, z in zip(weights, null, strict=True))
        for j, p in enumerate(particular)
    ]
    # A^T lambda = M a - F, in the columns of the pivots: no square of a small pivot appears
    pull = [dot(row, a) - f for row, f in zip(scaled, force, strict=True)]
    used, columns = [i for i, _ in pivots], [j for _, j in pivots]
    block = [[unit[i][j] for i in used] for j in columns]
    held = solved(block, [pull[j] for j in columns], least=0.0)
    multipliers = [0.0] * len(rows)
    for i, value in zip(used, held, strict=True):
        multipliers[i] = value / lengths[i]
    return Held(
        [x * s for x, s in zip(a, scales, strict=True)],
        multipliers,
        tuple(sorted(used)),
        _determined(unit, block, used, columns),
    )


def _scaled(masses: Sequence[float], rows: Matrix) -> tuple[Vector, Vector, list[Vector]]:
    """What makes the columns of A alike in the metric of M; its rows then: lengths, directions."""
    scales = [1 / math.sqrt(abs(mass)) if mass else 1.0 for mass in masses]
    lengths = [math.hypot(*map(mul, row, scales)) for row in rows]
    unit = [
        [x * s / (length or 1.0) for x, s in zip(row, scales, strict=True)]
        for row, length in zip(rows, lengths, strict=True)
    ]
    return scales, lengths, unit


def pivots_of(masses: Sequence[float], rows: Matrix) -> Vector:
    """The distance of each row of A from those before it, the farthest first; 1 of the first."""
    _, _, left = _scaled(masses, rows)
    found: Vector = []
    while left:
        squares = [dot(row, row) for row in left]
        square = max(squares)
        found.append(math.sqrt(square))
        top = left.pop(squares.index(square))
        if square:
            parts = [dot(row, top) / square for row in left]
            left = [
                [x - part * y for x, y in zip(row, top, strict=True)]
                for row, part in zip(left, parts, strict=True)
            ]
    return found


def _determined(
    unit: Matrix, block: Matrix, used: list[int], columns: list[int]
) -> tuple[bool, ...]:
    """Whether a row is no combination of the others: then its multiplier is determined."""
    determined = [i in used for i in range(len(unit))]
    for i, row in enumerate(unit):
        if i not in used:
            weights = solved(block, [row[j] for j in columns], least=0.0)
            for k, weight in zip(used, weights, strict=True):
                if abs(weight) > _WEIGHTLESS:
                    determined[k] = False
    return tuple(determined)


def solved(matrix: Matrix, right: Vector, least: float = _NO_MASS) -> Vector:
    """x of matrix x = right, with full pivoting; `least` is that of a pivot beside the largest.

    Raises
    ------
    NoMass
        When the matrix is singular.
    """
    n, x, right = len(right), [0.0] * len(right), list(right)
    work = [list(row) for row in matrix]
    least *= max((_largest(row) for row in work), default=0.0)
    rows, order = list(range(n)), list[tuple[int, int]]()
    while rows:
        i = max(rows, key=lambda k: _largest(work[k]))
        top = work[i]
        j = max(range(n), key=lambda k: _size(top[k]))
        if not _size(top[j]) > least:
            raise NoMass("the mass matrix is singular along motions that are allowed")
        order.append((i, j))
        rows.remove(i)
        for k in rows:
            if work[k][j]:
                factor = work[k][j] / top[j]
                work[k] = [a - factor * b for a, b in zip(work[k], top, strict=True)]
                work[k][j] = 0.0
                right[k] -= factor * right[i]
    for i, j in reversed(order):
        x[j] = (right[i] - dot(work[i], x)) / work[i][j]
    return x


def _largest(row: Sequence[Any]) -> Any:
    return max(map(_size, row))


def _size(x: Any) -> Any:
    """The magnitude; of a power series, that of its first term."""
    return abs(x if not hasattr(x, "coeffs") else x[0])


def dot(left: Sequence[Any], right: Sequence[Any]) -> Any:
    """The scalar product."""
    return sum(map(mul, left, right), 0.0)
