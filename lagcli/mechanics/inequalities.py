"""Whether inequalities exclude each other."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from itertools import combinations, permutations

from mpmath import mpf
from sympy import Dummy, Expr, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import simplify
from lagcli.algebra.numeric import Evaluator, with_assumed_sign
from lagcli.algebra.positivity import deciding, sign_of, weak_sign
from lagcli.algebra.signs import beyond

_DRAWS = 400  # a region that takes a hundredth of the values is missed once in 50 times
_DIGITS = 15  # those of a double: no draw is that near to an edge


def contradictory(conditions: Sequence[Expr], positive: Sequence[Expr] = ()) -> bool:
    """Whether conditions exclude each other: w² > 0 and -w² > 0, or no values fulfil them all.

    The latter by trying: what is left out then is a statement on values that may not exist.
    """
    if len(conditions) < 2:
        return False
    if any(sign_of(simplify(a / b), ()) == -1 for a, b in combinations(conditions, 2)):
        return True
    evaluate = Evaluator([*conditions, *positive], _DIGITS)
    symbols = sorted({s for e in (*conditions, *positive) for s in e.free_symbols}, key=str)
    if any(e.atoms(AppliedUndef) for e in (*conditions, *positive)):
        return False
    source = random.Random(0)
    return not any(_all_positive(evaluate, symbols, source) for _ in range(_DRAWS))


def never_together(positive: Sequence[Expr]) -> bool:
    """Whether one of these is never positive, or two never are together: k l > F > 2 k l."""
    return -1 in map(weak_sign, positive) or any(
        sum_ == 0 or weak_sign(sum_) == -1
        for pair in combinations(map(deciding, positive), 2)
        for sum_ in shorter_sums(*pair)
    )


def one_is_negative(conditions: Sequence[Expr], positive: Sequence[Expr] = ()) -> bool:
    """Whether for all values one is negative: one is wherever another is not."""
    plain, distance = [deciding(e, positive) for e in conditions], Dummy(nonnegative=True)
    return any(
        sign_of(sum_, positive) == -1
        for pair in permutations(plain, 2)
        for sum_ in shorter_sums(*pair)
    ) or any(
        sign_of(first.xreplace(put_in), [e.xreplace(put_in) for e in positive]) == -1
        for first, second in permutations(plain, 2)
        for put_in in beyond(second, first, distance)
    )


def shorter_sums(first: Expr, second: Expr) -> Iterator[Expr]:
    """first + c second for the c > 0 for which a term of the first is gone."""
    own, other = (e.expand().as_coefficients_dict() for e in (first, second))
    ratios = {-own[term] / other[term] for term in own if term in other}
    return (simplify(first + ratio * second) for ratio in ratios if ratio.is_positive)


def _all_positive(evaluate: Evaluator, symbols: Sequence[Symbol], source: random.Random) -> bool:
    """Whether all are at values of random sizes."""
    values = {s: with_assumed_sign(source, s, mpf(10 ** source.uniform(-1, 1))) for s in symbols}
    try:
        return all(isinstance(x, mpf) and x > 0 for x in evaluate(values))
    except (ArithmeticError, ValueError, TypeError):
        return False
