"""M q'' = F order by order, in the language of `language`.

The coefficient k of q'' solves M_0 a_k = F_k - sum over 0 < j <= k of M_j a_{k-j}, with one
factorization a step: n^2 convolutions an order, where an elimination written out has n^3/6.
A row backwards has a_0 at its beginning, where no coefficient comes.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., section 4.1.
"""

from __future__ import annotations

from lagcli.numerics.compiled.intrinsics import Ints, Reals, at, inner

PIVOT_TOLERANCE = 1e-10


def factor(m: Reals, work: Reals, n: int) -> int:
    """L D L^T in the place of M; 0 where a pivot vanishes beside its entry, else 1."""
    for j in range(n):
        row = at(m, j * n)
        d = row[j]
        least = PIVOT_TOLERANCE * abs(d)
        for p in range(j):
            work[p] = row[p] * m[p * n + p]
            d -= row[p] * work[p]
        if not abs(d) > least:
            return 0
        row[j] = d
        for i in range(j + 1, n):
            below = at(m, i * n)
            total = below[j]
            for p in range(j):
                total -= below[p] * work[p]
            below[j] = total / d
    return 1


def solve(m: Reals, x: Reals, n: int) -> None:
    """M^-1 x in the place of x, of what `factor` leaves."""
    for i in range(n):
        row = at(m, i * n)
        total = x[i]
        for p in range(i):
            total -= row[p] * x[p]
        x[i] = total
    for i in range(n - 1, -1, -1):
        row = at(m, i * n)
        x[i] = x[i] / row[i]
    for i in range(n - 1, -1, -1):
        row = at(m, i * n)
        for p in range(i):
            x[p] = x[p] - row[p] * x[i]


def couple(rows: Reals, starts: Ints, places: Ints, x: Reals, n: int, k: int, behind: int) -> None:
    """x_i less the sum over l and 0 < j <= k of M_il,j a_l,k-j.

    From `starts[i]` on stand in `places` the row of M_il and that of a_l, backwards, for
    each l with an M_il that varies.
    """
    for i in range(n):
        total = x[i]
        for p in range(starts[i], starts[i + 1]):
            mass = at(rows, places[2 * p])
            a = at(rows, places[2 * p + 1])
            total -= inner(at(mass, 1), at(a, behind), k - 1) + mass[k] * a[0]
        x[i] = total
