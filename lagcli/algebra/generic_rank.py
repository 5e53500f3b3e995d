"""Full rank, shown by numbers: where it is full at one point, it is full nearly everywhere."""

from __future__ import annotations

import random
from collections.abc import Sequence

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import DIGITS, Evaluator, with_assumed_sign
from lagcli.algebra.row_rank import independent_rows, rows_of

_NONZERO = mpf(10) ** -25  # of a row; rounding is some 1e-48 of it


def has_full_rank(A: Sequence[Sequence[Expr]]) -> bool:
    """Whether the rank of A was seen to be the number of its columns at a random point.

    The minor that is not 0 there is not identically 0.  False says nothing.

    Examples
    --------
    >>> x = Symbol("x", real=True)
    >>> one, zero = x / x, x - x
    >>> has_full_rank([[x, one], [zero, x]]), has_full_rank([[x, x], [one, one]])
    (True, False)
    """
    width = len(A[0]) if A else 0
    if not width or len(A) < width:
        return width == 0
    entries = [x for row in A for x in row]
    source = random.Random(f"lagcli rank {len(A)} {width}")
    values = {s: _drawn(s, source) for s in sorted(_symbols(entries), key=str)}
    try:
        flat = Evaluator(entries)(values)
    except (ArithmeticError, ValueError, TypeError):
        return False
    with mpmath.workdps(DIGITS):
        return len(independent_rows(rows_of(flat, width), _NONZERO).independent) == width


def _symbols(entries: Sequence[Expr]) -> set[Symbol]:
    return {s for e in entries for s in e.free_symbols}


def _drawn(symbol: Symbol, source: random.Random) -> mpf:
    if symbol.is_integer:
        size = mpf(source.randint(2, 5))
    else:
        size = mpf(source.randint(3000, 17000)) / 10007
    return with_assumed_sign(source, symbol, size, 1)
