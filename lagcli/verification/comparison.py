"""Whether two balls can be the same number.

Values that are enclosed are equal only if their balls overlap, so a disagreement is a proof,
but for the distance of a state from the constraints, onto which Newton's method moved it.
"""

from __future__ import annotations

from enum import Enum

from flint import arb

#: Of the larger value: what the rounding of a projected state (some 2^-100 of 128 bits) may do.
_ROUNDING = arb(2) ** -64
#: Below it a value is 0 but for that rounding.
_NOTHING = arb(2) ** -90
#: Of the larger value: balls no wider decide; an agreement of wider ones says nothing.
_THIN = arb(2) ** -40


class ComparisonVerdict(Enum):
    """What came of a comparison."""

    EQUAL = "equal"
    DIFFERENT = "different"
    UNDECIDED = "undecided"  # balls too wide
    UNDEFINED = "undefined"  # no real value


def is_zero(x: arb) -> bool:
    """Whether a value is 0."""
    return compare(x, arb(0)) is ComparisonVerdict.EQUAL


def compare(a: arb, b: arb) -> ComparisonVerdict:
    """Whether a and b are equal."""
    if not (a.is_finite() and b.is_finite()):
        return ComparisonVerdict.UNDEFINED
    difference = abs(a - b)
    largest = abs(a).union(abs(b)).abs_upper()
    if difference.abs_lower() > largest * _ROUNDING + _NOTHING:
        return ComparisonVerdict.DIFFERENT
    wide = difference.abs_upper() > largest * _THIN + _NOTHING
    return ComparisonVerdict.UNDECIDED if wide else ComparisonVerdict.EQUAL
