"""What is said of a parameter: positive, nonzero, an integer; and the values that break it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from lagcli.problem_data import Parameter

_BREAKS: dict[str, Callable[[Fraction | float], bool]] = {
    "positive": lambda value: value <= 0,
    "nonnegative": lambda value: value < 0,
    "nonzero": lambda value: value == 0,
    "negative": lambda value: value >= 0,
    "real": lambda _: False,
}


def broken(parameter: Parameter, value: Fraction | float) -> str | None:
    """The mistake where the value is not what the parameter is said to be, else None."""
    if _BREAKS[parameter.assume](value):
        return f"'{parameter.name}' is {parameter.assume}, and its value is not"
    if parameter.integer and value != int(value):
        return f"'{parameter.name}' is an integer, and its value is not"
    return None
