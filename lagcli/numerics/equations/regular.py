"""M a = F + A^T lambda, A a + c = 0 by numbers, where M is positive definite and A has full rank.

    | M  A^T | |   a     |   |  F |
    | A   0  | | -lambda | = | -c |

as L D L^T without exchanges: quick for many coordinates.  Where a pivot vanishes beside what
it is left of there is no answer, and `null_space` has one.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., section 4.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import mul

from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE

Vector = list[float]
Matrix = Sequence[Sequence[float]]


def regular_motion(
    mass: Matrix, forcing: Sequence[float], rows: Matrix, bias: Sequence[float]
) -> tuple[Vector, Vector] | None:
    """The accelerations and the multipliers; None where they are not determined so."""
    n = len(forcing)
    whole = [*(list(row[: j + 1]) for j, row in enumerate(mass))]
    whole += [[*row, *[0.0] * (k + 1)] for k, row in enumerate(rows)]
    pivots: Vector = []
    for i, row in enumerate(whole):
        for j in range(i):
            row[j] -= sum(map(mul, row[:j], whole[j]))
        pivot = row[i]
        size = abs(pivot)
        for j, d in enumerate(pivots):
            part = row[j] / d
            pivot -= row[j] * part
            size = max(size, abs(pivot))
            row[j] = part
        if not abs(pivot) > PIVOT_TOLERANCE * size:
            return None
        pivots.append(pivot)
    x = [*forcing, *(-c for c in bias)]
    for i, row in enumerate(whole):
        x[i] -= sum(map(mul, row[:i], x))
    x = [value / pivot for value, pivot in zip(x, pivots, strict=True)]
    for i in reversed(range(len(x))):
        value = x[i]
        for j, part in enumerate(whole[i][:i]):
            x[j] -= part * value
    return x[:n], [-value for value in x[n:]]
