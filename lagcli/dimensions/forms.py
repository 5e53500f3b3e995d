"""A dimension as a linear form: known exponents of base units, and unknown quantities.

The form {"m": 1, ("parameter", "k"): 2} is the dimension of a length times that of k squared.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

#: A base unit of the SI, or a quantity whose dimension is not given.
Key = str | tuple[object, ...]
Form = Mapping[Key, Fraction]

NUMBER: Form = {}
_ONE = Fraction(1)
TIME: Form = {"s": _ONE}
ENERGY: Form = {"kg": _ONE, "m": Fraction(2), "s": Fraction(-2)}


def unknown(*key: object) -> Form:
    """The dimension of a quantity of which nothing is given."""
    return {key: _ONE}


def plus(first: Form, second: Form, times: Fraction | int = 1) -> Form:
    """The dimension of first * second^times."""
    if not second or not times:
        return first
    total = dict(first)
    for key, exponent in second.items():
        value = total.get(key, 0) + exponent * times
        if value:
            total[key] = Fraction(value)
        else:
            del total[key]
    return total


def minus(first: Form, second: Form) -> Form:
    """The dimension of first / second."""
    return plus(first, second, -1)


def times(form: Form, exponent: Fraction) -> Form:
    """The dimension of a power."""
    return {key: value * exponent for key, value in form.items()} if exponent else NUMBER


def unknowns(form: Form) -> list[Key]:
    """The quantities in a form whose dimension is not given."""
    return [key for key in form if not isinstance(key, str)]
