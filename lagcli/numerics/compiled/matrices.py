"""M q'' = F order by order, with constraints or without, in the language of `language`.

With A q'' = -c the unknowns are q'' and the multipliers:

    | M  A^T | |  q''    |   |  F |
    | A   0  | | -lambda | = | -c |

The coefficient k of the unknowns x solves K_0 x_k = b_k - sum over 0 < j <= k of K_j x_{k-j},
with one factorization a step: N^2 convolutions an order, where an elimination written out
has N^3/6.  A row backwards has x_0 at its beginning, where no coefficient comes.

K is factored without exchanges, its rows so ordered that each constraint comes after the
coordinates it names: then every leading part of K is regular where M is positive definite
and A has full rank.  What stands left of the first entry of a row stays 0.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., sections 4.1 and 4.2.
George, Liu, *Computer Solution of Large Sparse Positive Definite Systems* (1981), chapter 4.
"""

from __future__ import annotations

from lagcli.numerics.compiled.intrinsics import Ints, Reals, at, inner

PIVOT_TOLERANCE = 1e-10


def factor(m: Reals, first: Ints, n: int) -> int:
    """L D L^T in the place of K; 0 where a pivot vanishes beside what it is left of, else 1."""
    for i in range(n):
        row = at(m, i * n)
        for j in range(first[i], i):
            other = at(m, j * n)
            total = row[j]
            for p in range(max(first[i], first[j]), j):
                total -= row[p] * other[p]
            row[j] = total
        d = row[i]
        size = abs(d)
        for p in range(first[i], i):
            part = row[p] / m[p * n + p]
            d -= row[p] * part
            size = max(size, abs(d))
            row[p] = part
        if not abs(d) > PIVOT_TOLERANCE * size:
            return 0
        row[i] = d
    return 1


def solve(m: Reals, first: Ints, x: Reals, n: int) -> None:
    """K^-1 x in the place of x, of what `factor` leaves."""
    for i in range(n):
        row = at(m, i * n)
        total = x[i]
        for p in range(first[i], i):
            total -= row[p] * x[p]
        x[i] = total
    for i in range(n):
        x[i] = x[i] / m[i * n + i]
    for i in range(n - 1, -1, -1):
        row = at(m, i * n)
        for p in range(first[i], i):
            x[p] = x[p] - row[p] * x[i]


def couple(rows: Reals, starts: Ints, places: Ints, x: Reals, n: int, k: int, behind: int) -> None:
    """x_i less the sum over l and 0 < j <= k of K_il,j x_l,k-j.

    From `starts[i]` on stand in `places` the row of K_il and that of x_l, backwards, for
    each l with a K_il that varies.
    """
    for i in range(n):
        total = x[i]
        for p in range(starts[i], starts[i + 1]):
            part = at(rows, places[2 * p])
            found = at(rows, places[2 * p + 1])
            total -= inner(at(part, 1), at(found, behind), k - 1) + part[k] * found[0]
        x[i] = total
