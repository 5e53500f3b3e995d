"""Whether two lists of inequalities hold at the same values, however they are written.

w > sqrt(2) v and w² > 2 v² are one region of positive v and w.  Along random lines both begin and
end at the same points, which are found by halving to some 1e-25.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from random import Random

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import Evaluator, with_assumed_sign
from lagcli.evaluation import bisected

_DIGITS = 30
_LINES = 24
_STEPS = 32  # places on each
_HALVINGS = 80
_BESIDE = mpf(10) ** -18

Holds = Callable[[mpf], bool]


def same_region(found: Sequence[Expr], expected: Sequence[Expr]) -> bool:
    """Whether all of the first are positive where all of the second are, along random lines.

    False where they were seen nowhere to begin or to end.
    """
    random, bounds = Random(f"{len(found)} {len(expected)}"), 0
    symbols = sorted({s for e in (*found, *expected) for s in e.free_symbols}, key=str)
    with mpmath.workdps(_DIGITS):
        for _ in range(_LINES):
            ends = [{s: _drawn(s, random) for s in symbols} for _ in range(2)]
            one, other = (_along(each, ends) for each in (found, expected))
            try:
                places = [mpf(k) / _STEPS for k in range(_STEPS + 1)]
                if [one(x) for x in places] != [other(x) for x in places]:
                    return False
                for a, b in pairwise(places):
                    if one(a) != one(b):
                        bounds += 1
                        if not _turns(other, _bound(one, a, b)):
                            return False
            except (ArithmeticError, ValueError, TypeError):
                continue  # no value there
    return bounds > 0


def _drawn(symbol: Symbol, random: Random) -> mpf:
    return with_assumed_sign(random, symbol, mpf(random.randint(1, 4000)) / 1009)


def _along(expressions: Sequence[Expr], ends: Sequence[dict[Symbol, mpf]]) -> Holds:
    evaluate, (start, end) = Evaluator(list(expressions), _DIGITS), ends

    def holds(x: mpf) -> bool:
        values = {s: start[s] + x * (end[s] - start[s]) for s in start}
        return all(value > 0 for value in evaluate(values))

    return holds


def _bound(holds: Holds, a: mpf, b: mpf) -> mpf:
    left = holds(a)
    a, b = bisected(lambda x: holds(x) == left, a, b, _HALVINGS)
    return (a + b) / 2


def _turns(holds: Holds, x: mpf) -> bool:
    return holds(x - _BESIDE) != holds(x + _BESIDE)
