"""The parts of a name: `theta_1` is θ with the subscript 1, `x1` is x with the subscript 1."""

from __future__ import annotations

import re

from lagcli.record import record

_LETTERS_AND_DIGITS = re.compile(r"(?P<letters>.*[^0-9])(?P<digits>[0-9]*)", re.DOTALL)


@record
class NameParts:
    """A letter or word with its subscripts."""

    base: str
    subscripts: tuple[str, ...] = ()


def name_parts(name: str) -> NameParts:
    """Split a name at its underscores and before the digits at the end of its first part.

    A name whose underscores separate nothing (`_x`, `x__y`) is left whole.

    Examples
    --------
    >>> name_parts("theta_1"), name_parts("m12")
    (NameParts(base='theta', subscripts=('1',)), NameParts(base='m', subscripts=('12',)))
    """
    first, *others = name.split("_")
    match = _LETTERS_AND_DIGITS.fullmatch(first)
    if match is None or not all(others):
        return NameParts(name)
    digits = match["digits"]
    return NameParts(match["letters"], (*((digits,) if digits else ()), *others))
