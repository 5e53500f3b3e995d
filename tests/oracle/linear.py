"""Linear systems in numbers: one elimination that also tells what is not determined."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mpmath import mpf

Matrix = list[list[mpf]]

#: Below this, relative to the largest entry, a pivot is taken for 0 (at 40 digits).
NEGLIGIBLE = mpf(10) ** -26


@dataclass(frozen=True)
class Solution:
    """x + span(kernel); `consistent` says whether the equations have a solution at all."""

    x: list[mpf]
    kernel: list[list[mpf]]
    consistent: bool

    def determined(self, index: int) -> bool:
        """Whether every solution has the same component."""
        return all(abs(v[index]) < NEGLIGIBLE for v in self.kernel)


def solve(rows: Sequence[Sequence[mpf]], right: Sequence[mpf], columns: int) -> Solution:
    """Every solution of `rows . x = right`, by Gauss-Jordan with full pivoting."""
    work = [[*row, value] for row, value in zip(rows, right, strict=True)]
    largest = max((abs(x) for row in work for x in row), default=mpf(0))
    tiny = max(largest, mpf(1)) * NEGLIGIBLE
    pivots: list[int] = []
    for step in range(min(len(work), columns)):
        size, i, j = max(
            (abs(work[i][j]), i, j)
            for i in range(step, len(work))
            for j in range(columns)
            if j not in pivots
        )
        if size < tiny:
            break
        work[step], work[i] = work[i], work[step]
        pivot = work[step][j]
        work[step] = [x / pivot for x in work[step]]
        for other in range(len(work)):
            factor = work[other][j]
            if other != step and factor:
                work[other] = [x - factor * y for x, y in zip(work[other], work[step], strict=True)]
        pivots.append(j)
    x = [mpf(0)] * columns
    for step, j in enumerate(pivots):
        x[j] = work[step][-1]
    kernel = []
    for free in range(columns):
        if free not in pivots:
            vector = [mpf(0)] * columns
            vector[free] = mpf(1)
            for step, j in enumerate(pivots):
                vector[j] = -work[step][free]
            kernel.append(vector)
    consistent = all(abs(row[-1]) < 100 * tiny for row in work[len(pivots) :])
    return Solution(x, kernel, consistent)


def rank(rows: Sequence[Sequence[mpf]], columns: int) -> int:
    """The number of independent rows."""
    return columns - len(solve(rows, [mpf(0)] * len(rows), columns).kernel)


def least_step(rows: Sequence[Sequence[mpf]], residual: Sequence[mpf], columns: int) -> list[mpf]:
    """The shortest d with rows . d = -residual: d = A^T y, A A^T y = -residual."""
    gram = [[sum((a * b for a, b in zip(p, q, strict=True)), mpf(0)) for q in rows] for p in rows]
    y = solve(gram, [-r for r in residual], len(rows)).x
    return [sum((rows[k][j] * y[k] for k in range(len(rows))), mpf(0)) for j in range(columns)]
