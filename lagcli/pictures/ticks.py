"""Where an axis has its marks, and what stands at them."""

from __future__ import annotations

import math
from fractions import Fraction

from lagcli.pictures.drawing import Axis, DrawnName
from lagcli.record import record


@record(kw_only=True)
class Tick:
    """A mark of an axis."""

    at: float
    label: DrawnName


_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
_PARTS_OF_PI = (
    Fraction(1, 12), Fraction(1, 6), Fraction(1, 4), Fraction(1, 2), Fraction(1), Fraction(2),
    Fraction(5), Fraction(10), Fraction(20), Fraction(50), Fraction(100),
)  # fmt: skip
_ANGLE_FROM = 0.9 * math.pi


def ticks(axis: Axis, most: int = 7) -> list[Tick]:
    """Round values within the axis, at most this number of them."""
    if axis.logarithmic:
        return _powers(axis, most)
    if axis.angle and _ANGLE_FROM <= axis.high - axis.low <= 600:
        return _parts_of_pi(axis, most)
    step = _step((axis.high - axis.low) / most)
    first, last = math.ceil(axis.low / step - 1e-9), math.floor(axis.high / step + 1e-9)
    return [Tick(at=k * step, label=_number(k * step, step)) for k in range(first, last + 1)]


def _step(least: float) -> float:
    """The first of 1, 2, 2.5, 5 times a power of ten that is large enough."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * step for step in _STEPS if power * step >= least * (1 - 1e-9))


def _number(value: float, step: float) -> DrawnName:
    value = 0.0 if abs(value) < step / 2 else value
    size = max(abs(value), step)
    if 1e-4 <= size < 1e6 and step >= 1e-6:
        digits = max(0, -math.floor(math.log10(step) + 1e-9))
        shown = f"{value:.{digits}f}"
        if not math.isclose(float(shown), value, abs_tol=step * 1e-6):
            shown = f"{value:.{digits + 1}f}"
        return _plain(shown)
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    if not exponent:
        return _plain(mantissa)
    return DrawnName(
        plain=f"{_minus(mantissa)}e{int(exponent)}",
        ascii=f"{mantissa}e{int(exponent)}",
        tex=rf"${mantissa} \times 10^{{{int(exponent)}}}$",
    )


def _plain(shown: str) -> DrawnName:
    return DrawnName(plain=_minus(shown), ascii=shown, tex=_minus(shown))


def _minus(shown: str) -> str:
    return shown.replace("-", "\N{MINUS SIGN}")


def _parts_of_pi(axis: Axis, most: int) -> list[Tick]:
    part = next(
        (p for p in _PARTS_OF_PI if (axis.high - axis.low) / (p * math.pi) <= most),
        _PARTS_OF_PI[-1],
    )
    step = float(part) * math.pi
    first, last = math.ceil(axis.low / step - 1e-9), math.floor(axis.high / step + 1e-9)
    return [Tick(at=k * step, label=_of_pi(k * part)) for k in range(first, last + 1)]


def _of_pi(times: Fraction) -> DrawnName:
    if not times:
        return _plain("0")
    sign = "-" if times < 0 else ""
    above, below = abs(times.numerator), times.denominator
    letters = "" if above == 1 else str(above)
    under = "" if below == 1 else f"/{below}"
    return DrawnName(
        plain=f"{_minus(sign)}{letters}π{under}",
        ascii=f"{sign}{letters}pi{under}",
        tex=rf"${sign}{letters}\pi{under}$",
    )


def _powers(axis: Axis, most: int) -> list[Tick]:
    """Powers of ten; within less than two decades 1, 2 and 5 of each."""
    first, last = math.ceil(math.log10(axis.low)), math.floor(math.log10(axis.high))
    if last - first < 2:
        parts = (m * 10.0**k for k in range(first - 1, last + 1) for m in (1, 2, 5))
        return [Tick(at=x, label=_plain(f"{x:g}")) for x in parts if axis.low <= x <= axis.high]
    every = max(1, math.ceil((last - first + 1) / most))
    return [Tick(at=10.0**k, label=_power(k)) for k in range(first, last + 1) if k % every == 0]


_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def _power(exponent: int) -> DrawnName:
    return DrawnName(
        plain="1" if exponent == 0 else "10" + str(exponent).translate(_RAISED),
        ascii=f"1e{exponent}",
        tex=rf"$10^{{{exponent}}}$",
    )
