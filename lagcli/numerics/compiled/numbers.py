"""The two kinds of numbers that the hardware has: of 64 bits, and of 80 bits.

An extended number of 80 bits has a fraction of 64 bits: 19 digits.  It is a
`long double` to C, and Python writes it as its 10 bytes.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

_FRACTION, _BIAS = 64, 16383
_HIGHEST = 1 << 15


class Numbers:
    """Doubles.

    Attributes
    ----------
    type, suffix : str
        To LLVM, and at the end of its functions' names.
    rounding : float
        Half the distance from 1 to the next number.
    c_type
        To `ctypes`.
    """

    type, suffix = "double", "f64"
    rounding = 2.0**-53
    c_type: Any = ctypes.c_double
    _library = ""

    def literal(self, value: Fraction | float) -> str:
        """A number as it is written in LLVM's language."""
        [bits] = struct.unpack("<Q", struct.pack("<d", float(value)))
        return f"0x{bits:016X}"

    def function(self, name: str) -> str:
        """A function of the C library."""
        return f"@{name}{self._library}"

    def array(self, values: Iterable[Fraction | float]) -> Any:
        """The values in memory, each rounded once."""
        found = list(map(float, values))
        return (self.c_type * len(found))(*found)


class Extended(Numbers):
    """Numbers of 80 bits."""

    type, suffix = "x86_fp80", "f80"
    rounding = 2.0**-64
    c_type = ctypes.c_longdouble
    _library = "l"

    def literal(self, value: Fraction | float) -> str:
        """Its sign and exponent, then its fraction."""
        fraction, exponent = _bits(Fraction(value))
        return f"0xK{exponent:04X}{fraction:016X}"

    def array(self, values: Iterable[Fraction | float]) -> Any:
        """The values in memory, each rounded once."""
        found = list(values)
        array = (self.c_type * len(found))()
        size = ctypes.sizeof(self.c_type)
        data = b"".join(
            struct.pack("<QH", *_bits(Fraction(value))).ljust(size, b"\0") for value in found
        )
        ctypes.memmove(array, data, len(data))
        return array

    def fractions(self, values: Any) -> list[Fraction]:
        """The values in memory, exactly."""
        size = ctypes.sizeof(self.c_type)
        data = bytes(values)
        found = []
        for start in range(0, len(data), size):
            fraction, exponent = struct.unpack_from("<QH", data, start)
            sign = -1 if exponent & _HIGHEST else 1
            power = (exponent & ~_HIGHEST) - _BIAS - _FRACTION + 1
            found.append(sign * fraction * Fraction(2) ** power)
        return found


def _bits(value: Fraction) -> tuple[int, int]:
    """The fraction of 64 bits, rounded to even, and the exponent with the sign.

    Raises
    ------
    OverflowError
        Beyond 1.2e4932.
    """
    if not value:
        return 0, 0
    size = abs(value)
    exponent = size.numerator.bit_length() - size.denominator.bit_length()
    if size < Fraction(2) ** exponent:
        exponent -= 1
    fraction = round(size * Fraction(2) ** (_FRACTION - 1 - exponent))
    if fraction >> _FRACTION:
        fraction >>= 1
        exponent += 1
    if exponent + _BIAS <= 0:
        return 0, 0
    if exponent >= _BIAS + 1:
        raise OverflowError("too large for 80 bits")
    return fraction, exponent + _BIAS + (_HIGHEST if value < 0 else 0)


DOUBLE, EXTENDED = Numbers(), Extended()
