"""Inequalities in one ratio of positive parameters: 8 R > L + √(L² + 32 R²) is 2 R > L."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

import sympy
from mpmath import mpf
from sympy import Expr, Pow, Rational, S, Symbol

from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.weights import NotAPower, Weights, weights
from lagcli.record import record

_ZERO = mpf(10) ** -25  # measured: what is not 0 is above 5e-1


class _Undecided(Exception):
    """What these means do not decide."""


@record
class Ratio:
    """The ratio: a product of powers of parameters, with the one of them that stands for it."""

    weights: tuple[tuple[Symbol, Rational], ...]
    symbol: Symbol

    def above(self, bound: Expr, sign: int) -> Expr:
        """What is positive where the ratio is above the bound, or below it for the sign -1."""
        upper, lower = (
            sympy.Mul(*(s ** abs(w) for s, w in self.weights if w * side > 0)) for side in (1, -1)
        )
        value = sympy.radsimp(bound ** dict(self.weights)[self.symbol])
        inverse = sympy.radsimp(1 / value)
        if len(str(inverse)) < len(str(value)):
            value, upper, lower, sign = inverse, lower, upper, -sign
        return sympy.expand(sign * value.as_coeff_Mul()[0].q * (upper - value * lower))


def in_one_ratio(expressions: Sequence[Expr], positive: Sequence[Expr] = ()) -> list[Expr] | None:
    """Polynomials that are positive just where all the expressions are, `positive` being so.

    Parameters
    ----------
    expressions, positive
        Homogeneous ones in parameters that are positive, functions of one ratio of them.

    Returns
    -------
    list of Expr or None
        One for each bound on the ratio that `positive` does not imply; None where the expressions
        are not such functions, are nowhere all positive, are so in several ranges or up to a bound
        that is no root of a quadratic equation.
    """
    try:
        return _bounds(tuple(expressions), tuple(positive))
    except (_Undecided, NotAPower):
        return None


@lru_cache(maxsize=512)
def _bounds(expressions: tuple[Expr, ...], positive: tuple[Expr, ...]) -> list[Expr]:
    ratio = _ratio_of(expressions)
    given = [e for e in positive if _is_function_of(ratio, e)]
    (low, high), (least, most) = _range(ratio, expressions, given), _range(ratio, (), given)
    found = [] if low == least else [ratio.above(low, 1)]
    return found if high == most else [*found, ratio.above(high, -1)]


# -- the ratio ---------------------------------------------------------------------------------


def _ratio_of(expressions: Sequence[Expr]) -> Ratio:
    if any(e.has(sympy.Function) for e in expressions):
        raise _Undecided
    if any(not s.is_positive for e in expressions for s in e.free_symbols):
        raise _Undecided
    rows: list[Weights] = []
    for expression in expressions:
        weights(expression, rows)
    rows = [{s: w for s, w in row.items() if w != 0} for row in rows]
    first = next((row for row in rows if row), None)
    if first is None or len(first) < 2:
        raise _Undecided
    symbol = max(first, key=lambda s: (-abs(first[s]), s.name))
    whole = sympy.ilcm(*(w.q for w in first.values())) * sympy.sign(first[symbol])
    whole /= sympy.igcd(*(w * whole for w in first.values()))
    unit = {s: w * whole for s, w in first.items()}
    if any(not _is_multiple(row, unit, symbol) for row in rows):
        raise _Undecided
    return Ratio(tuple(sorted(unit.items(), key=lambda item: item[0].name)), symbol)


def _is_function_of(ratio: Ratio, expression: Expr) -> bool:
    rows: list[Weights] = []
    if expression.has(sympy.Function):
        return False
    try:
        weights(expression, rows)
    except NotAPower:
        return False
    return all(_is_multiple(row, dict(ratio.weights), ratio.symbol) for row in rows)


def _is_multiple(row: Weights, unit: Weights, symbol: Symbol) -> bool:
    factor = row.get(symbol, S.Zero) / unit[symbol]
    return all(row.get(s, 0) == factor * unit.get(s, 0) for s in {*row, *unit})


# -- the range ---------------------------------------------------------------------------------


def _range(ratio: Ratio, expressions: Sequence[Expr], given: Sequence[Expr]) -> tuple[Expr, Expr]:
    """The one range of the ratio's symbol, the other parameters being 1, where all are positive."""
    s = ratio.symbol
    functions = [
        e.xreplace(dict.fromkeys(e.free_symbols - {s}, S.One)) for e in (*given, *expressions)
    ]
    zeros = {zero for f in functions for zero in _possible_zeros(f, s)}
    places = sorted((mpf(sympy.N(zero, DIGITS)), zero) for zero in zeros)
    evaluate = Evaluator(functions)

    def inside(place: mpf) -> bool:
        """Whether all are positive; one that is 0 beside others that are not negative is open."""
        try:
            values = evaluate({s: place})
        except ZeroDivisionError:
            raise _Undecided from None
        if any(isinstance(x, mpf) and x <= _ZERO for x in values[: len(given)]):
            return False
        if not all(isinstance(x, mpf) for x in values):
            raise _Undecided
        if any(x < -_ZERO for x in values):
            return False
        if any(x < _ZERO for x in values):
            raise _Undecided
        return True

    numbers = [mpf(0), *(number for number, _ in places)]
    samples = [(a + b) / 2 for a, b in pairwise(numbers)]
    verdicts = [*map(inside, samples), inside(numbers[-1] + 1)]
    ends: list[Expr] = [S.Zero] if verdicts[0] else []
    for k, (number, zero) in enumerate(places):
        if verdicts[k] != verdicts[k + 1]:
            ends.append(zero)
        else:
            inside(number)
    ends += [S.Infinity] if verdicts[-1] else []
    if len(ends) != 2:
        raise _Undecided
    return ends[0], ends[1]


def _possible_zeros(function: Expr, s: Symbol) -> Iterator[Expr]:
    """Positive numbers among which are all at which the function is 0, infinite or not real."""
    for part in sympy.fraction(sympy.together(function)):
        for power in part.atoms(Pow):
            if power.exp.is_Rational and not power.exp.is_Integer and power.has(s):
                yield from _possible_zeros(power.base, s)
        yield from _positive_roots(_without_roots(part), s)


def _without_roots(expression: Expr) -> Expr:
    """A polynomial that is 0 where the expression is: resultants with g^n = radicand."""
    while True:
        roots = [p for p in expression.atoms(Pow) if p.exp.is_Rational and not p.exp.is_Integer]
        if not roots:
            return expression
        outer = max(roots, key=sympy.count_ops)
        g, n = sympy.Dummy(), outer.exp.q
        put_in = {p: g**p.exp.p for p in roots if p.base == outer.base and p.exp.q == n}
        equation = sympy.together(expression.xreplace(put_in))
        expression = sympy.resultant(sympy.fraction(equation)[0], g**n - outer.base, g)


def _positive_roots(polynomial: Expr, s: Symbol) -> Iterator[Expr]:
    if s not in polynomial.free_symbols:
        return
    for factor, _ in sympy.Poly(polynomial, s, domain="QQ").factor_list()[1]:
        if factor.degree() > 2 and factor.count_roots(0) > 0:
            raise _Undecided
        if factor.degree() <= 2:
            yield from (root for root in sympy.roots(factor) if root.is_positive)
