"""Digits: whole numbers of any length, and the decimals that `--numeric` makes."""

from __future__ import annotations

from decimal import Context, Decimal
from fractions import Fraction

from lagcli.record import record

#: Exact for everything that is printed as a decimal.
_EXACT = Context(prec=100)
#: Decimals between 1e-5 and 1e15 are written without a power of ten.
_SMALLEST, _LARGEST = -5, 15
#: Digits between which no line is broken.
_GROUP = 20


@record
class DecimalParts:
    """`digits` * 10^`exponent`; the exponent is 0 for numbers of ordinary size."""

    digits: str
    exponent: int = 0


def decimal_parts(value: Fraction) -> DecimalParts:
    """Write a terminating decimal.

    Examples
    --------
    >>> decimal_parts(Fraction(981, 100))
    DecimalParts(digits='9.81', exponent=0)
    """
    number = _EXACT.divide(Decimal(value.numerator), Decimal(value.denominator)).normalize(_EXACT)
    size = number.adjusted()
    if not number or _SMALLEST <= size < _LARGEST:
        return DecimalParts(f"{number:f}")
    return DecimalParts(f"{number.scaleb(-size):f}", size)


def digit_groups(value: int) -> list[str]:
    """Split the digits of a whole number into groups, between which a line may be broken."""
    digits = str(Decimal(value))  # str(int) refuses more than 4300 digits
    return [digits[i : i + _GROUP] for i in range(0, len(digits), _GROUP)]
