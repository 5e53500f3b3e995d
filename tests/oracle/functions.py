"""The functions of the grammar on jets, and smooth stand-ins for unspecified functions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from math import factorial
from random import Random

from mpmath import mp, mpf
from mpmath.calculus.quadrature import GaussLegendre

from .jets import Jet, Number, OutsideDomain, power, real_part, series, sines


def _exp(x: Number) -> Number:
    if not isinstance(x, Jet):
        return mp.exp(x)
    value = mp.exp(x.real)
    return series(x, [value / factorial(k) for k in range(x.order + 1)])


def _log(x: Number) -> Number:
    at = real_part(x)
    if at <= 0:
        raise OutsideDomain(f"log({at})")
    if not isinstance(x, Jet):
        return mp.log(x)
    return series(x, [mp.log(at), *(-((-1 / at) ** k) / k for k in range(1, x.order + 1))])


def _sin(x: Number) -> Number:
    return series(x, sines(x.real, x.order)) if isinstance(x, Jet) else mp.sin(x)


def _cos(x: Number) -> Number:
    return _sin(x + mp.pi / 2)


def _sqrt(x: Number) -> Number:
    return power(x, mpf(1) / 2)


def _atan(x: Number) -> Number:
    """atan(a + n) = atan(a) + atan(n / (1 + a (a + n))), the latter by its series."""
    if not isinstance(x, Jet):
        return mp.atan(x)
    at = x.real
    small = (x - at) / (x * at + 1)
    odd = [mpf(0) if k % 2 == 0 else mpf(1 if k % 4 == 1 else -1) / k for k in range(x.order + 2)]
    return series(small, odd) + mp.atan(at)


def _asin(x: Number) -> Number:
    if abs(real_part(x)) >= 1:
        raise OutsideDomain("asin")
    return _atan(x / _sqrt(1 - x * x))


def _acosh(x: Number) -> Number:
    if real_part(x) <= 1:
        raise OutsideDomain("acosh")
    return _log(x + _sqrt(x * x - 1))


def _sign(x: Number) -> Number:
    at = real_part(x)
    if at == 0:
        if isinstance(x, Jet):
            raise OutsideDomain("sign(0)")
        return mpf(0)
    return mpf(1 if at > 0 else -1)


def integral(integrand: Callable[[Number], Number], start: Number, end: Number) -> Number:
    """By Gauss and Legendre with 96 points: to all digits for what is as smooth as sin."""
    half, middle = (end - start) / 2, (end + start) / 2
    total: Number = mpf(0)
    for node, weight in _gauss_legendre(mp.prec):
        total = total + integrand(middle + half * node) * weight
    return total * half


@lru_cache
def _gauss_legendre(bits: int) -> Sequence[tuple[mpf, mpf]]:
    return GaussLegendre(mp).calc_nodes(6, bits)  # type: ignore[no-any-return]


def _atan2(y: Number, x: Number) -> Number:
    """The angle of the real parts, and from there the small angle by the atan."""
    x0, y0 = real_part(x), real_part(y)
    if x0 == y0 == 0:
        raise OutsideDomain("atan2(0, 0)")
    return _atan((y * x0 - x * y0) / (x * x0 + y * y0)) + mp.atan2(y0, x0)


ELEMENTARY: dict[str, Callable[..., Number]] = {
    "sqrt": _sqrt,
    "exp": _exp,
    "log": _log,
    "abs": lambda x: x * _sign(x),
    "sign": _sign,
    "sin": _sin,
    "cos": _cos,
    "tan": lambda x: _sin(x) / _cos(x),
    "cot": lambda x: _cos(x) / _sin(x),
    "sec": lambda x: 1 / _cos(x),
    "csc": lambda x: 1 / _sin(x),
    "asin": _asin,
    "acos": lambda x: mp.pi / 2 - _asin(x),
    "atan": _atan,
    "atan2": _atan2,
    "sinh": lambda x: (_exp(x) - _exp(-x)) / 2,
    "cosh": lambda x: (_exp(x) + _exp(-x)) / 2,
    "tanh": lambda x: 1 - 2 / (_exp(2 * x) + 1),
    "asinh": lambda x: _log(x + _sqrt(x * x + 1)),
    "acosh": _acosh,
    "atanh": lambda x: _log((1 + x) / (1 - x)) / 2,
}


class StandIn:
    """A function left unspecified, as sum_m c_m sin(b_m . x + d_m) + c: all derivatives known.

    The constant makes it positive, so that a root or a logarithm of it is real.
    """

    def __init__(self, name: str, arity: int) -> None:
        random = Random(f"{name}/{arity}")

        def number(low: float, high: float) -> mpf:
            return mpf(round(random.uniform(low, high), 4))

        self.offset = number(2, 3)
        self.terms = [
            (number(0.3, 0.7), [number(0.5, 1.3) for _ in range(arity)], number(-3, 3))
            for _ in range(3)
        ]

    def __call__(self, arguments: Sequence[Number], indices: Sequence[int] = ()) -> Number:
        """The derivative by the arguments `indices` (from 0) at the arguments."""
        total: Number = mpf(0) if indices else self.offset
        for amplitude, slopes, phase in self.terms:
            inner: Number = phase + len(indices) * mp.pi / 2
            for slope, x in zip(slopes, arguments, strict=True):
                inner = inner + x * slope
            factor = amplitude
            for index in indices:
                factor *= slopes[index]
            total = total + _sin(inner) * factor
        return total
