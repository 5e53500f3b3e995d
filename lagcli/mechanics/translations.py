"""Translations of several coordinates at once that do no work, as of block and wedge along x.

Each of the columns of A alone may be a function of q; wanted are the constant c with

    A(q, q', t) c = 0   identically.

With a basis c_i of the null space over the functions, in which every c_i is 1 at its own
free component and 0 at those of the others, any c is sum a_i c_i with constant a_i, hence

    sum_i a_i dc_i/dx = 0   for x = q, q', t,

which is the same question about fewer unknowns, unless all c_i are constant already.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, nullspace, simplify


def constant_nullspace(
    rows: Sequence[Sequence[Expr]], variables: Sequence[Symbol]
) -> list[list[Expr]]:
    """A basis of the c free of the variables with A c = 0 identically.

    Parameters
    ----------
    rows
        The rows of A, at least one.
    """
    basis = nullspace([list(row) for row in rows])
    rates = [
        [c[j].diff(x) for c in basis]
        for j in range(len(rows[0]))
        for x in variables
        if any(x in c[j].free_symbols for c in basis)
    ]
    rates = [row for row in rates if any(is_zero(r) is not True for r in row)]
    if not rates:
        return basis
    return [
        [
            simplify(sympy.Add(*(a * c[j] for a, c in zip(combination, basis, strict=True))))
            for j in range(len(rows[0]))
        ]
        for combination in constant_nullspace(rates, variables)
    ]
