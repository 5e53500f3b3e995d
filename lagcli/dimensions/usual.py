"""The unit that a letter has in most books: of a wrong unit and a usual one, the first is meant."""

from __future__ import annotations

import re

from lagcli.dimensions.forms import Form
from lagcli.dimensions.system import dimension_of
from lagcli.units import UnitMistake, read_unit

_UNITS = {
    "kg": "m M",
    "m": "l L ℓ R r s h d x y z",
    "m/s^2": "g",
    "N/m": "k",
    "kg*m^2": "I J",
    "N": "F",
    "m^3/(kg*s^2)": "G",
    "rad": "theta Theta θ phi φ ϕ varphi psi ψ alpha α beta β th ph",
    "1/s": "omega ω Omega Ω",
}
_LETTERS = {letter: unit for unit, letters in _UNITS.items() for letter in letters.split()}
_INDEXED = re.compile(r"([^\W\d_]+?)(?:_?\d+|_\w+)?")


def is_usual(name: str, unit: str) -> bool:
    """Whether a unit has the dimension that its name has in most books."""
    try:
        return dimension_of(read_unit(unit)) == usual_dimension(name)
    except UnitMistake:  # 10^-3 kg m
        return False


def usual_dimension(name: str) -> Form | None:
    """The dimension of a name such as m, m_1 or l2; None for letters of several meanings."""
    found = _INDEXED.fullmatch(name)
    unit = _LETTERS.get(found[1]) if found else None
    return None if unit is None else dimension_of(read_unit(unit))
