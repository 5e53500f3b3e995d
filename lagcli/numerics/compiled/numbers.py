"""The numbers of machine code: of 64, of 80 and of 128 bits.

The hardware has the first two.  An extended number of 80 bits has a fraction of 64 bits: 19
digits.  It is a `long double` to C, and Python writes it as its 10 bytes.  One of 128 bits has
a fraction of 113 bits, 34 digits; what is done with it are calls of the C library.

References
----------
IEEE 754-2019, section 3.4 (binary64, binary128).
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

_FRACTION, _QUADRUPLE, _BIAS = 64, 113, 16383
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
    name : str
        Of the method that computes with them.
    root : str
        The square root, to LLVM.
    cost : int
        Of an operation, where it is more than a few of those with doubles.
    """

    type, suffix = "double", "f64"
    name = "taylor64"
    root = "@llvm.sqrt.f64"
    cost = 1
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

    def cell(self, value: float) -> Any:
        """A double, as what an entry of an array is set to."""
        return value

    def array(self, values: Iterable[Fraction | float]) -> Any:
        """The values in memory, each rounded once."""
        found = list(map(float, values))
        return (self.c_type * len(found))(*found)

    def difference(self, a: float, b: float) -> Any:
        """a - b, as a function takes it."""
        return a - b


class Extended(Numbers):
    """Numbers of 80 bits."""

    type, suffix = "x86_fp80", "f80"
    name = "taylor80"
    root = "@llvm.sqrt.f80"
    rounding = 2.0**-64
    c_type: Any = ctypes.c_longdouble
    _library = "l"
    _fraction = _FRACTION

    def literal(self, value: Fraction | float) -> str:
        """Its sign and exponent, then its fraction."""
        fraction, exponent = _bits(Fraction(value), _FRACTION)
        return f"0xK{exponent:04X}{fraction:016X}"

    def array(self, values: Iterable[Fraction | float]) -> Any:
        """The values in memory, each rounded once."""
        found = list(values)
        array = (self.c_type * len(found))()
        size = ctypes.sizeof(self.c_type)
        data = b"".join(
            self._written(*_bits(Fraction(value), self._fraction)).ljust(size, b"\0")
            for value in found
        )
        ctypes.memmove(array, data, len(data))
        return array

    def difference(self, a: float, b: float) -> Any:
        """a - b, as a function takes it: rounded to these numbers."""
        return self.c_type.from_buffer(self.array([Fraction(a) - Fraction(b)]))

    def parts(self, values: Any, count: int) -> list[tuple[int, int]]:
        """Of the first values in memory, exactly: (m, e) of m 2^e."""
        size = ctypes.sizeof(self.c_type)
        data = ctypes.string_at(ctypes.addressof(values), count * size)
        found = []
        for start in range(0, len(data), size):
            fraction, exponent = self._read(data, start)
            power = (exponent & ~_HIGHEST) - _BIAS - self._fraction + 1
            found.append((-fraction if exponent & _HIGHEST else fraction, power))
        return found

    def _written(self, fraction: int, exponent: int) -> bytes:
        return struct.pack("<QH", fraction, exponent)

    def _read(self, data: bytes, start: int) -> tuple[int, int]:
        fraction, exponent = struct.unpack_from("<QH", data, start)
        return fraction, exponent


class _Quadruple(ctypes.Structure):
    """A number of 128 bits in memory."""

    _fields_ = (("low", ctypes.c_uint64), ("high", ctypes.c_uint64))

    def __float__(self) -> float:
        [(fraction, power)] = QUADRUPLE.parts(self, 1)
        return float(fraction * Fraction(2) ** power)


class Quadruple(Extended):
    """Numbers of 128 bits."""

    type, suffix = "fp128", "f128"
    name = "taylor128"
    root = "@sqrtf128"
    cost = 100
    rounding = 2.0**-113
    c_type: Any = _Quadruple
    _library = "f128"
    _fraction = _QUADRUPLE

    def literal(self, value: Fraction | float) -> str:
        """Its lower half, then the one with the exponent."""
        low, high = self.cell(value)
        return f"0xL{low:016X}{high:016X}"

    def cell(self, value: Fraction | float) -> tuple[int, int]:
        """The two halves."""
        low, high = struct.unpack("<QQ", self._written(*_bits(Fraction(value), _QUADRUPLE)))
        return low, high

    def _written(self, fraction: int, exponent: int) -> bytes:
        # the first bit of the fraction is not kept: it is 1, but for 0
        kept = fraction & ~(1 << (_QUADRUPLE - 1))
        return (kept | exponent << (_QUADRUPLE - 1)).to_bytes(16, "little")

    def _read(self, data: bytes, start: int) -> tuple[int, int]:
        whole = int.from_bytes(data[start : start + 16], "little")
        fraction, exponent = whole & ((1 << (_QUADRUPLE - 1)) - 1), whole >> (_QUADRUPLE - 1)
        return fraction | (exponent & ~_HIGHEST != 0) << (_QUADRUPLE - 1), exponent


def _bits(value: Fraction, bits: int) -> tuple[int, int]:
    """The fraction of this number of bits, rounded to even, and the exponent with the sign.

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
    fraction = round(size * Fraction(2) ** (bits - 1 - exponent))
    if fraction >> bits:
        fraction >>= 1
        exponent += 1
    if exponent + _BIAS <= 0:
        return 0, 0
    if exponent >= _BIAS + 1:
        raise OverflowError("too large for 80 or 128 bits")
    return fraction, exponent + _BIAS + (_HIGHEST if value < 0 else 0)


DOUBLE, EXTENDED, QUADRUPLE = Numbers(), Extended(), Quadruple()
