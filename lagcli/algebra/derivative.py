"""Derivatives of what is built of sums, products and powers, by the rules as they stand.

SymPy's `diff` gives an equal expression, but asks each part for its signs on the way: the
derivatives of the ansatz for a heavy top take it four times as long.
"""

from __future__ import annotations

from functools import lru_cache

import sympy
from sympy import Expr, Symbol


@lru_cache(maxsize=20_000)
def derivative(f: Expr, x: Symbol) -> Expr:
    """df/dx."""
    if f == x:
        return sympy.S.One
    if x not in _symbols(f):
        return sympy.S.Zero
    if f.is_Add:
        return sympy.Add(*(derivative(a, x) for a in f.args))
    if f.is_Mul:
        a = f.args
        return sympy.Add(
            *(sympy.Mul(*a[:k], derivative(a[k], x), *a[k + 1 :]) for k in range(len(a)))
        )
    if f.is_Pow and f.exp.is_Number:
        return f.exp * f.base ** (f.exp - 1) * derivative(f.base, x)
    return f.diff(x)


@lru_cache(maxsize=20_000)
def _symbols(f: Expr) -> frozenset[Expr]:
    """The free symbols, known of each part once."""
    if f.is_Add or f.is_Mul or f.is_Pow:
        return frozenset().union(*map(_symbols, f.args))
    return frozenset(f.free_symbols)
