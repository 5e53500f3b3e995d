"""Units behind numbers, which stand where names are declared."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from lagcli.reader.habits import number_and_unit

if TYPE_CHECKING:
    from collections.abc import Container

_COUNT = re.compile(r"([\d.]+(?:[eE][-+]?\d+)?)\s*(?![eE]\d+$)([^\W\d]\w*)")
_ANGLE = re.compile("deg(/.*|)|rpm")
_TIME = (("s", Fraction(1)),)


def unit_mistake(
    text: str, names: Container[str] = (), *, declared: bool = False
) -> tuple[str, str] | None:
    """What is wrong with `10 kg`, and what to write; None where no unit stands behind a number.

    Numbers are in the units of the file, whose names may be letters that are units as well;
    a parameter is declared with its own.
    """
    number, unit = number_and_unit(text.replace("°", " deg"))
    if not unit:
        return None
    hint = f"write {number}: numbers are in the units of the file"
    factor, base = _in_base_units(unit)
    if abs(factor - 1) > 1e-9 and number.count(".") < 2:
        value = f"{float(Fraction(number)) * factor:.6g}"
        hint = (
            f"numbers are in the units of the file: write {number} with {unit}, {value} with {base}"
        )
    if declared:
        hint = f"write {{value: {number}, unit: {unit}}}"
    elif unit in {"min", "h"}:
        hint = f"write {number}*{60 if unit == 'min' else 3600} for seconds"
    if angle := _ANGLE.fullmatch(unit):
        per = "/s" if unit == "rpm" else angle[1]
        value = f"{number}*pi/{30 if unit == 'rpm' else 180}"
        if declared and per:
            value = f"{{value: {value}, unit: rad{per}}}"
        hint = f"angles are in radians: write {value}"
    if unit in names:
        hint += f"; the product is {number}*{unit}"
    return f"the unit '{unit}' cannot stand behind a number", hint


def _in_base_units(text: str) -> tuple[float, str]:
    """The factor of a unit and the product of base units of the SI that it is a multiple of."""
    from lagcli.units import Unit, UnitMistake, read_unit
    from lagcli.units.table import meaning

    try:
        unit = read_unit(text)
    except UnitMistake:
        return 1.0, text
    factor, powers = unit.number, dict[str, Fraction]()
    for name, exponent in unit.factors:
        meant = meaning(name)
        if meant is None:
            return 1.0, text
        factor *= meant.factor ** float(exponent)
        for base, power in meant.powers:
            powers[base] = powers.get(base, Fraction(0)) + power * exponent
    return factor, str(Unit(tuple((base, power) for base, power in powers.items() if power)))


def run_mistake(text: str, option: str) -> tuple[str, str] | None:
    """What is wrong with `3 T`, an end of a run, or with `8 digits`, an accuracy."""
    from lagcli.units.table import meaning

    found = _COUNT.fullmatch(text.strip())
    if found is None or found[2] in {"pi", "π"} or found[2] in {"min", "h", "deg"}:
        return unit_mistake(text)
    number, word = found.groups()
    unit = meaning(word)
    if unit is not None and unit.powers == _TIME:
        return unit_mistake(text)
    hint = f"write the number that {number} {word} is"
    if "accuracy" in option and number.isdigit():
        hint = f"write 1e-{number}"
    return f"'{word}' cannot stand behind a number", hint
