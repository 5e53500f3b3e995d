"""Numbers that carry their derivatives: automatic differentiation of any order.

A jet is a polynomial in infinitesimals e_1, e_2, ... .  The infinitesimals of one
*family* multiply to zero, e_i e_j = 0, so a family holds one gradient; those of different
families do not, so two families hold second derivatives, three the third ones:

    f(x + e_A + e_B) = f + f' e_A + f' e_B + f'' e_A e_B.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import factorial

from mpmath import mp, mpf

#: One infinitesimal: (family, index).  A product of several: a sorted tuple of them.
Infinitesimal = tuple[int, int]
Monomial = tuple[Infinitesimal, ...]


class OutsideDomain(Exception):
    """A real function was asked for where it has no real (smooth) value."""


class Jet:
    """A truncated polynomial: families (as a bit mask) -> monomial -> coefficient."""

    __slots__ = ("parts",)

    def __init__(self, parts: dict[int, dict[Monomial, mpf]]) -> None:
        self.parts = parts

    @property
    def real(self) -> mpf:
        """The value without infinitesimals."""
        return self.parts.get(0, {}).get((), mpf(0))

    @property
    def order(self) -> int:
        """The highest power of the infinitesimal part that does not vanish."""
        mask = 0
        for part in self.parts:
            mask |= part
        return mask.bit_count()

    def __add__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            other = constant(other)
        sums = {mask: dict(part) for mask, part in self.parts.items()}
        for mask, part in other.parts.items():
            mine = sums.setdefault(mask, {})
            for monomial, value in part.items():
                mine[monomial] = mine[monomial] + value if monomial in mine else value
        return Jet(sums)

    def __mul__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            return Jet(
                {
                    mask: {monomial: value * other for monomial, value in part.items()}
                    for mask, part in self.parts.items()
                }
            )
        products: dict[int, dict[Monomial, mpf]] = {}
        for mask, part in self.parts.items():
            for other_mask, other_part in other.parts.items():
                if mask & other_mask:
                    continue
                into = products.setdefault(mask | other_mask, {})
                for a, x in part.items():
                    for b, y in other_part.items():
                        both = a + b if not a or not b or a[-1] < b[0] else tuple(sorted(a + b))
                        into[both] = into[both] + x * y if both in into else x * y
        return Jet(products)

    __radd__ = __add__
    __rmul__ = __mul__

    def __neg__(self) -> Jet:
        return self * mpf(-1)

    def __sub__(self, other: Number) -> Jet:
        return self + -other

    def __rsub__(self, other: Number) -> Jet:
        return -self + other

    def __truediv__(self, other: Number) -> Jet:
        return self * power(other, mpf(-1))

    def __rtruediv__(self, other: Number) -> Jet:
        return power(self, mpf(-1)) * other


Number = Jet | mpf


def constant(value: mpf) -> Jet:
    """A jet without derivatives."""
    return Jet({0: {(): value}})


def real_part(x: Number) -> mpf:
    """The value without infinitesimals."""
    return x.real if isinstance(x, Jet) else x


def series(x: Jet, taylor: Sequence[mpf]) -> Jet:
    """f(x) from the Taylor coefficients f^(k)/k! at the real part of x (Horner)."""
    small = Jet({mask: part for mask, part in x.parts.items() if mask})
    result = constant(taylor[-1])
    for coefficient in reversed(taylor[:-1]):
        result = result * small + coefficient
    return result


def power(x: Number, exponent: mpf) -> Number:
    """x^a for a constant real exponent a."""
    at = real_part(x)
    whole = exponent == int(exponent)
    if at < 0 and not whole:
        raise OutsideDomain(f"({at})^({exponent})")
    if not isinstance(x, Jet):
        if at == 0 and exponent < 0:
            raise OutsideDomain("division by zero")
        return at ** int(exponent) if whole else at**exponent
    coefficients = []
    factor = mpf(1)  # a (a-1) ... (a-k+1) / k!
    for k in range(x.order + 1):
        if factor == 0:
            break
        coefficients.append(factor * power(at, exponent - k))
        factor *= (exponent - k) / (k + 1)
    return series(x, coefficients or [mpf(0)])


# Infinitesimals, and what they multiply.

_in_use = 0


@contextmanager
def family() -> Iterator[int]:
    """A family of infinitesimals that nothing else uses at the moment."""
    global _in_use  # noqa: PLW0603 - the depth of nested derivatives
    number = _in_use
    _in_use += 1
    try:
        yield number
    finally:
        _in_use -= 1


def infinitesimal(number: int, index: int = 0) -> Jet:
    """The infinitesimal e_index of a family."""
    return Jet({1 << number: {((number, index),): mpf(1)}})


def coefficient(x: Number, number: int, index: int = 0) -> Number:
    """What multiplies an infinitesimal: the derivative by the quantity that it was added to."""
    if not isinstance(x, Jet):
        return mpf(0)
    wanted = (number, index)
    parts: dict[int, dict[Monomial, mpf]] = {}
    for mask, part in x.parts.items():
        if not mask >> number & 1:
            continue
        rest = {
            tuple(e for e in monomial if e != wanted): value
            for monomial, value in part.items()
            if wanted in monomial
        }
        if rest:
            parts[mask & ~(1 << number)] = rest
    if not parts:
        return mpf(0)
    return parts[0][()] if parts.keys() == {0} else Jet(parts)


def sines(at: mpf, order: int) -> list[mpf]:
    """The Taylor coefficients of the sine."""
    return [mp.sin(at + k * mp.pi / 2) / factorial(k) for k in range(order + 1)]
