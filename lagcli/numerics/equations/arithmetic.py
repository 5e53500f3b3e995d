"""Where the numbers come from: doubles, or balls of any precision and their power series.

A generated function asks for `number`, `power` and the functions of the grammar only, so
the same text serves both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, Protocol

from lagcli.evaluation import FUNCTIONS


class Arithmetic(Protocol):
    """What a generated function needs to know of its numbers."""

    #: whether numbers can be compared, so that pivots can be watched
    ordered: bool

    def number(self, value: Fraction) -> Any:
        """A rational."""

    @property
    def functions(self) -> Mapping[str, Callable[..., Any]]:
        """The functions of the grammar, "power" and "pi" (of no arguments)."""


class UndefinedFunction(Exception):
    """A function that the file leaves unspecified has no numbers."""


class Doubles:
    """Double precision; whatever is not defined raises ArithmeticError or ValueError."""

    ordered = True

    functions: Mapping[str, Callable[..., Any]] = {
        **FUNCTIONS,
        "side": lambda x: math.copysign(1.0, x),
    }

    def number(self, value: Fraction) -> float:
        """A rational; OverflowError beyond 1.8e308."""
        return float(value)


class Balls:
    """FLINT's arb and arb_series at the precision of `flint.ctx`.

    A ball knows its rounding error.  What is not defined is nan, so results are to be
    tested for being finite.
    """

    ordered = False

    def __init__(self) -> None:
        from flint import arb, arb_series

        self.ball, self.series = arb, arb_series
        self.functions = self._functions()

    def number(self, value: Fraction) -> Any:
        """A rational."""
        return self.ball(value.numerator) / value.denominator

    def _functions(self) -> dict[str, Callable[..., Any]]:
        """Methods of the numbers; series lack some, which are put together."""
        one = self.ball(1)
        half = one / 2

        def method(name: str) -> Callable[[Any], Any]:
            return lambda x: getattr(x, name)()

        def sinh(x: Any) -> Any:
            e = x.exp()
            return (e - one / e) * half

        def cosh(x: Any) -> Any:
            e = x.exp()
            return (e + one / e) * half

        def tanh(x: Any) -> Any:
            # with one exp, which decays, a wide ball far from 0 stays next to 1 or -1
            side = -1 if self._constant(x).mid() < 0 else 1
            return side * (2 / ((-2 * side * x).exp() + one) - one)

        found: dict[str, Callable[..., Any]] = {
            name: method(name) for name in "sqrt exp log sin cos tan asin acos atan".split()
        }
        return found | {
            "sinh": sinh,
            "cosh": cosh,
            "tanh": tanh,
            "asinh": lambda x: (x + (x * x + one).sqrt()).log(),
            "acosh": lambda x: (x + (x - one).sqrt() * (x + one).sqrt()).log(),
            "atanh": lambda x: ((one + x) / (one - x)).log() * half,
            "cot": lambda x: x.cos() / x.sin(),
            "sec": lambda x: one / x.cos(),
            "csc": lambda x: one / x.sin(),
            "atan2": self._atan2,
            "abs": lambda x: x * self._sign(x),
            "sign": self._sign,
            "side": lambda x: self.ball(-1 if self._constant(x).mid() < 0 else 1),
            "power": self._power,
            "pi": self.ball.pi,
        }

    def _constant(self, x: Any) -> Any:
        """x, or its value at the beginning of the step."""
        return x[0] if isinstance(x, self.series) else x

    def _sign(self, x: Any) -> Any:
        return self._constant(x).sgn()

    def _atan2(self, y: Any, x: Any) -> Any:
        """atan(y/x) on the branch of the point, by the quotient that is no larger than 1."""
        above, below = self._constant(y), self._constant(x)
        if not (below > 0 or above > 0 or above < 0 or above.is_zero()):
            return self.ball.nan()  # the cut is in the ball
        angle = self.ball.atan2(above, below)
        if not (isinstance(y, self.series) or isinstance(x, self.series)):
            return angle
        turned = (y / x).atan() if abs(below) > abs(above) else -(x / y).atan()
        return turned - self._constant(turned) + angle

    def _power(self, base: Any, exponent: Any) -> Any:
        if not isinstance(exponent, self.series) and exponent.is_integer():
            whole = int(exponent.unique_fmpz())
            if whole >= 0 or not isinstance(base, self.series):
                return base**whole
            return self.ball(1) / base**-whole
        if not (isinstance(base, self.series) or isinstance(exponent, self.series)):
            return base**exponent
        return (base.log() * exponent).exp()
