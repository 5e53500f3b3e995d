"""Full rank, shown by numbers: where it is full at one point, it is full nearly everywhere."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import Evaluator

_DIGITS = 50
_NONZERO = mpf(10) ** -25  # of the largest entry; rounding is some 1e-48 of it


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
        flat = Evaluator(entries, _DIGITS)(values)
    except (ArithmeticError, ValueError, TypeError):
        return False
    rows = [flat[i * width : (i + 1) * width] for i in range(len(A))]
    with mpmath.workdps(_DIGITS):
        return _rank(rows, width) == width


def _symbols(entries: Sequence[Expr]) -> set[Symbol]:
    return {s for e in entries for s in e.free_symbols}


def _drawn(symbol: Symbol, source: random.Random) -> mpf:
    if symbol.is_integer:
        size = mpf(source.randint(2, 5))
    else:
        size = mpf(source.randint(3000, 17000)) / 10007
    return -size if symbol.is_negative else size


def _rank(rows: list[list[Any]], width: int) -> int:
    """By elimination with the largest pivot of all."""
    largest = max((abs(x) for row in rows for x in row), default=mpf(0))
    for done in range(width):
        pivot, i, j = max(
            (abs(rows[i][j]), i, j) for i in range(done, len(rows)) for j in range(done, width)
        )
        if not pivot > _NONZERO * largest:
            return done
        rows[done], rows[i] = rows[i], rows[done]
        for row in rows:
            row[done], row[j] = row[j], row[done]
        for row in rows[done + 1 :]:
            factor = row[done] / rows[done][done]
            for k in range(done, width):
                row[k] -= factor * rows[done][k]
    return width
