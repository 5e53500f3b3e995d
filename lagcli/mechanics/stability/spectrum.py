"""What must be positive for all frequencies of M x'' + C x' + K x = 0 to be real and distinct.

Of coordinates that are coupled, with C antisymmetric, det(s^2 M + s C + K) is a polynomial of
degree n in W = -s^2.  Its roots are positive where the elementary symmetric functions e_1, …,
e_n are and where the roots are real; they are real and distinct where the leading minors of
Hermite's matrix of their power sums, (p_(i+j)) with i, j = 0, …, n - 1, are positive.  (For
n = 2 and 3 the last one, the discriminant, says so alone.)

References
----------
Gantmacher, *The Theory of Matrices*, vol. 2, chapter XV, sections 10 and 11.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.determinants import determinant, determinant_in
from lagcli.mechanics.rest.linearization import Linearization, Matrix

_MOST = 4  # coordinates that are coupled
_MOST_OPERATIONS = 400  # measured: at most 9
_ALL_BY_DISCRIMINANT = 3  # measured: at most 2


def real_and_distinct(linear: Linearization) -> list[Expr] | None:
    """The conditions, group by group of coupled coordinates; None where they are too long."""
    found: list[Expr] = []
    for group in _coupled((linear.M, linear.C, linear.K)):
        powers = _in_square(linear, group)
        if powers is None or len(powers) - 1 > _MOST:
            return None
        found += conditions_of([simplify(x / powers[-1]) for x in powers])
    if any(sympy.count_ops(each) > _MOST_OPERATIONS for each in found):
        return None
    return found


def _coupled(matrices: Sequence[Matrix]) -> Iterator[list[int]]:
    """The coordinates in groups with no entry of any matrix between two of them."""
    left = list(range(len(matrices[0])))
    while left:
        group = [left.pop(0)]
        for i in group:
            joined = [j for j in left if any(m[i][j] != 0 or m[j][i] != 0 for m in matrices)]
            group += joined
            left = [j for j in left if j not in joined]
        yield sorted(group)


def _in_square(linear: Linearization, group: Sequence[int]) -> list[Expr] | None:
    """The coefficients by powers of W, the constant term first."""
    s = Symbol("#s", real=True)
    M, C, K = linear.M, linear.C, linear.K
    powers = determinant_in(
        s, [[s**2 * M[i][j] + s * C[i][j] + K[i][j] for j in group] for i in group]
    )
    if powers is None or any(c != 0 for c in powers[1::2]):
        return None
    return [(-1) ** k * c for k, c in enumerate(powers[::2])]


def conditions_of(powers: Sequence[Expr]) -> list[Expr]:
    """What makes the roots of W^n + … + c_1 W + c_0 that are not 0 positive and distinct."""
    c = powers[next(k for k, power in enumerate(powers) if power != 0) :]
    if len(c) == 1:
        return []
    n = len(c) - 1
    e = [(-1) ** k * c[n - k] for k in range(n + 1)]  # e_0 = 1, e_1, …, e_n
    sums: list[Expr] = [sympy.Integer(n)]
    for m in range(1, 2 * n - 1):  # Newton's identities
        total = S.Zero
        for k in range(1, min(m, n) + 1):
            total += (-1) ** (k - 1) * e[k] * (S(m) if k == m else sums[m - k])
        sums.append(simplify(total))
    first = n if n <= _ALL_BY_DISCRIMINANT else 2
    minors = [
        determinant([[sums[i + j] for j in range(size)] for i in range(size)])
        for size in range(max(2, first), n + 1)
    ]
    return [*(simplify(m) for m in minors if m is not None), *reversed(e[1:])]
