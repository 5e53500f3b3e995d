"""The functions of the grammar on balls, and smooth instances of unspecified functions.

Where a real function has no real value the ball is nan, and whoever compares it sees that.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from random import Random

from flint import arb, fmpq

_NAN = arb("nan")
_ONE = arb(1)


def ball(value: Fraction) -> arb:
    """The narrowest ball around a rational number."""
    if value.denominator == 1:
        return arb(value.numerator)
    return arb(fmpq(value.numerator, value.denominator))


def power(x: arb, exponent: Fraction) -> arb:
    """x^r, of negative x for whole r only."""
    if exponent.denominator == 1:
        whole = exponent.numerator
        return x**whole if whole > 0 else _ONE / (x**-whole if whole else _ONE)
    if not x > 0 and not (x == 0 and exponent > 0):
        return _NAN
    root = x.sqrt() if exponent.denominator == 2 else x.root(exponent.denominator)
    return power(root, Fraction(exponent.numerator))


def _sign(x: arb) -> arb:
    if x > 0:
        return _ONE
    return -_ONE if x < 0 else arb(0) if x == 0 else _NAN


def _flat(x: arb) -> arb:
    """The derivative of sign x: 0, and none where x is 0."""
    return arb(0) if x > 0 or x < 0 else _NAN


ELEMENTARY: dict[str, Callable[..., arb]] = {
    "sqrt": arb.sqrt,
    "exp": arb.exp,
    "log": arb.log,
    "abs": abs,
    "sign": _sign,
    "flat": _flat,
    "sin": arb.sin,
    "cos": arb.cos,
    "tan": arb.tan,
    "cot": arb.cot,
    "sec": arb.sec,
    "csc": arb.csc,
    "asin": arb.asin,
    "acos": arb.acos,
    "atan": arb.atan,
    "atan2": arb.atan2,
    "sinh": arb.sinh,
    "cosh": arb.cosh,
    "tanh": arb.tanh,
    "asinh": arb.asinh,
    "acosh": arb.acosh,
    "atanh": arb.atanh,
}


class Instance:
    """An unspecified function as c + sum_m c_m sin(b_m . x + d_m): positive, and smooth."""

    def __init__(self, name: str, arity: int) -> None:
        random = Random(f"{name} of {arity}")

        def number(low: int, high: int) -> arb:
            return ball(Fraction(random.randint(low, high), 1024))

        self.offset = number(2200, 2900)
        self.terms = [
            (number(300, 700), [number(500, 1300) for _ in range(arity)], number(-3000, 3000))
            for _ in range(3)
        ]

    def __call__(self, arguments: Sequence[arb], by: Sequence[int]) -> arb:
        """The derivative by the arguments `by` (from 0) at the arguments."""
        total = arb(0) if by else self.offset
        for amplitude, slopes, phase in self.terms:
            inner = phase
            for slope, x in zip(slopes, arguments, strict=True):
                inner = inner + slope * x
            factor = amplitude
            for index in by:
                factor = factor * slopes[index]
            turned = (inner.sin(), inner.cos())[len(by) % 2]
            total = total + (-factor if len(by) % 4 in {2, 3} else factor) * turned
        return total
