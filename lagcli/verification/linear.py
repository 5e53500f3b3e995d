"""Linear systems in balls: one elimination that also says what is not determined."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from lagcli.record import record

#: Of a matrix whose largest entries are 1: pivots below the first are 0 but for rounding (balls
#: of 128 bits have some 110 left), and none is expected between the two at a random state.
_ZERO = 2.0**-60
_CLEAR = 2.0**-36
#: Of the largest entry: smaller ones in a row or column by themselves are rounding, not units.
_NOISE = 2.0**-90


class Unclear(Exception):
    """A pivot is neither 0 but for rounding nor clearly not 0."""


@record
class SolutionSpace:
    """x + span(kernel); `consistent` says whether the equations have a solution at all."""

    x: tuple[arb, ...]
    kernel: tuple[tuple[arb, ...], ...]
    consistent: bool

    def determined(self, index: int) -> bool:
        """Whether every solution has the same component."""
        return all(size(vector[index]) < _CLEAR for vector in self.kernel)


def size(x: arb) -> float:
    """|x| to a few digits; infinity where x has no value."""
    return abs(float(x.mid())) if x.is_finite() else float("inf")


def solve(
    rows: Sequence[Sequence[arb]], right: Sequence[arb], columns: int, clear: float = _CLEAR
) -> SolutionSpace:
    """Every solution of `rows . x = right`, by Gauss-Jordan with full pivoting.

    Pivots must be larger than `clear`, or 0 but for rounding.

    Raises
    ------
    Unclear
        Where the rank cannot be seen, or an entry has no value.
    """
    work = [[*row, value] for row, value in zip(rows, right, strict=True)]
    scales = _equilibrated(work, columns)
    pivots: list[int] = []
    for step in range(min(len(work), columns)):
        largest, i, j = max(
            (size(work[i][j]), i, j)
            for i in range(step, len(work))
            for j in range(columns)
            if j not in pivots
        )
        if largest < _ZERO:
            break
        if not clear < largest < float("inf"):
            raise Unclear
        work[step], work[i] = work[i], work[step]
        _eliminate(work, step, j)
        pivots.append(j)
    return _solution(work, pivots, scales)


def _equilibrated(work: list[list[arb]], columns: int) -> list[arb]:
    """Divide rows and columns by powers of 2 near their largest entries; x = scale * unknown."""
    rounding = _NOISE * max((size(x) for row in work for x in row[:columns]), default=0.0)
    for row in work:
        factor = _near(row[:columns], rounding)
        row[:] = [x * factor for x in row]
    scales = [_near([row[j] for row in work], _NOISE) for j in range(columns)]
    for row in work:
        row[:columns] = [x * s for x, s in zip(row, scales, strict=False)]
    return scales


def _near(entries: Sequence[arb], rounding: float) -> arb:
    """The inverse of the largest entry, 1 where all are 0 but for rounding."""
    largest = max(map(size, entries), default=0.0)
    return arb(1 / largest) if rounding < largest < float("inf") else arb(1)


def _eliminate(work: list[list[arb]], step: int, j: int) -> None:
    pivot = work[step]
    factor = 1 / pivot[j]
    work[step] = pivot = [x * factor for x in pivot]
    for other, row in enumerate(work):
        if other != step and not row[j].is_zero():
            by = row[j]
            work[other] = [x - by * y for x, y in zip(row, pivot, strict=True)]


def _solution(work: list[list[arb]], pivots: list[int], scales: list[arb]) -> SolutionSpace:
    columns = len(scales)
    x = [arb(0)] * columns
    for step, j in enumerate(pivots):
        x[j] = work[step][-1] * scales[j]
    kernel = []
    for free in range(columns):
        if free not in pivots:
            vector = [arb(0)] * columns
            vector[free] = scales[free]
            for step, j in enumerate(pivots):
                vector[j] = -work[step][free] * scales[j]
            kernel.append(tuple(vector))
    rest = [size(row[-1]) for row in work[len(pivots) :]]
    largest = max([1.0, *(size(row[-1]) for row in work[: len(pivots)])])
    consistent = all(each < _CLEAR * largest for each in rest)
    return SolutionSpace(tuple(x), tuple(kernel), consistent)


def rank(rows: Sequence[Sequence[arb]], columns: int) -> int:
    """The number of independent rows."""
    return columns - len(solve(rows, [arb(0)] * len(rows), columns).kernel)


def least_step(rows: Sequence[Sequence[arb]], residual: Sequence[arb]) -> list[arb]:
    """The shortest d with rows . d = -residual: d = A^T y, A A^T y = -residual."""
    gram = [[dot(p, q) for q in rows] for p in rows]
    y = solve(
        gram, [-r for r in residual], len(rows), _ZERO
    ).x  # at a turning point nearly singular
    return [dot(y, column) for column in zip(*rows, strict=True)]


def dot(a: Sequence[arb], b: Sequence[arb]) -> arb:
    """sum_j a_j b_j."""
    total = arb(0)
    for x, y in zip(a, b, strict=True):
        total = total + x * y
    return total
