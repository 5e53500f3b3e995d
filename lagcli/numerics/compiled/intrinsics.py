"""What `kernels` may use beside the operations: for those who read or check it.

The functions exist in compiled code only; `series`, `in_doubles`, `positions`,
`velocities`, `sizes` and `inner` are generated for the problem.
"""

from __future__ import annotations

import math
from typing import Protocol


class Reals(Protocol):
    """A place in memory with real numbers from there on."""

    def __getitem__(self, index: int) -> float: ...

    def __setitem__(self, index: int, value: float) -> None: ...


class DoubleCells(Protocol):
    """A place in memory with doubles, whatever the other real numbers are."""

    def __getitem__(self, index: int) -> float: ...

    def __setitem__(self, index: int, value: float) -> None: ...


class Ints(Protocol):
    """A place in memory with whole numbers from there on."""

    def __getitem__(self, index: int) -> int: ...

    def __setitem__(self, index: int, value: int) -> None: ...


def at(place: Reals, index: int) -> Reals:
    """The address of the number `index` places further on."""
    raise NotImplementedError


def sqrt(x: float) -> float:
    """The square root; nan where there is none."""
    raise NotImplementedError


def log(x: float) -> float:
    """The natural logarithm."""
    return math.log(x)


def exp(x: float) -> float:
    """The exponential function."""
    return math.exp(x)


def fma(x: float, y: float, z: float) -> float:
    """x y + z, rounded once where the processor can."""
    raise NotImplementedError


def inner(a: Reals, b: Reals, n: int) -> float:
    """a_0 b_0 + ... + a_{n-1} b_{n-1}; it may read three numbers more, of which b has zeros."""
    raise NotImplementedError


def series(rows: Reals, signs: Reals, order: int) -> int:
    """The coefficients of q and q' up to an order, from those of order 0.

    The row of component i begins at `rows[i * STRIDE]`; the time comes after the 2 n
    components.  0 where a pivot of the elimination vanishes, else 1.
    """
    raise NotImplementedError


def in_doubles(rows: DoubleCells, signs: Reals, order: int) -> int:
    """`series` in doubles, of equations without kinks: it reads no sign."""
    raise NotImplementedError


def positions(state: Reals, out: Reals) -> int:
    """(d, f) of `Motion.position_correction`; 0 where a pivot vanishes, else 1."""
    raise NotImplementedError


def velocities(state: Reals, out: Reals) -> int:
    """(d, r) of `Motion.velocity_correction`; 0 where a pivot vanishes, else 1."""
    raise NotImplementedError


def sizes(state: Reals, out: Reals) -> int:
    """What the residuals of positions and rates are compared with."""
    raise NotImplementedError
