"""When all roots of a polynomial have negative real parts.

Of a_0 s^n + … + a_n with a_0 > 0: just where all a_k > 0 and Hurwitz's determinants
Delta_(n-1), Delta_(n-3), … > 0 (Liénard, Chipart).  Where one of these is negative, a root has a
positive real part: they are not negative at the limits of polynomials of that kind.

References
----------
Gantmacher, *The Theory of Matrices*, vol. 2, chapter XV, sections 6 and 13.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, S

from lagcli.algebra import simplify
from lagcli.algebra.determinants import determinant

_MOST_DEGREE = 8  # measured: at most 2
_MOST_OPERATIONS = 400  # measured: at most 4


def hurwitz_conditions(powers: Sequence[Expr]) -> list[Expr] | None:
    """What must be positive, by the coefficients with the constant term first; None: too long.

    The factors by which it was multiplied are positive where the leading coefficient is.
    """
    n = len(powers) - 1
    if n > _MOST_DEGREE:
        return None
    a = [simplify(c / powers[-1]) for c in reversed(powers)]
    found = a[1:]
    for size in range(n - 1, 1, -2):
        rows = [
            [a[2 * i - j + 1] if 0 <= 2 * i - j + 1 <= n else S.Zero for j in range(size)]
            for i in range(size)
        ]
        minor = determinant(rows)
        if minor is None:
            return None
        found.append(simplify(minor))
    if any(sympy.count_ops(each) > _MOST_OPERATIONS for each in found):
        return None
    return found
