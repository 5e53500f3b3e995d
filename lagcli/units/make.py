"""Makes `table.json` from pint, which is needed for nothing else.

After a change of `CHOSEN` or of pint:

    python -m lagcli.units.make

Physical constants and units of other trades are left out, so that a letter means here
what it means in a textbook of mechanics: no `c`, no `Nm` for the fineness of a yarn.
"""

from __future__ import annotations

import json
from fractions import Fraction
from math import log10
from typing import Any

from lagcli.units.table import TABLE

#: The units taken over, by the names that pint gives them; with all their other names.
CHOSEN = (
    "meter", "second", "gram", "ampere", "kelvin", "mole", "candela",
    "radian", "steradian", "degree", "arcminute", "arcsecond", "turn", "percent",
    "newton", "joule", "watt", "pascal", "hertz",
    "coulomb", "volt", "farad", "ohm", "siemens", "weber", "tesla", "henry",
    "minute", "hour", "day", "week", "year", "sidereal_day",
    "angstrom", "micron", "fermi", "bohr", "astronomical_unit", "light_year", "parsec",
    "inch", "foot", "yard", "mile", "nautical_mile", "liter", "hectare",
    "metric_ton", "unified_atomic_mass_unit", "dalton", "electron_mass", "pound", "ounce",
    "slug", "carat",
    "dyne", "kilogram_force", "force_pound", "poundal",
    "erg", "electron_volt", "calorie", "rydberg", "hartree", "watt_hour", "british_thermal_unit",
    "horsepower", "metric_horsepower",
    "bar", "standard_atmosphere", "torr", "pound_force_per_square_inch",
    "poise", "stokes", "knot", "kilometer_per_hour", "mile_per_hour", "galileo", "standard_gravity",
    "revolutions_per_minute", "revolutions_per_second", "franklin", "gauss", "biot", "debye",
)  # fmt: skip


#: Spellings of pint's that nobody writes; `mu` and `u` are read as micro.
_NO_PREFIX = frozenset({"", "mc"})


def make_table() -> str:
    """The text of `table.json`, from pint's registry."""
    import pint

    registry: Any = pint.UnitRegistry(non_int_type=Fraction)
    dimensions = ("mass", "length", "time", "current", "temperature", "substance", "luminosity")
    units: dict[str, tuple[float, list[str]]] = {}
    for chosen in CHOSEN:
        definition = registry._units[chosen]  # noqa: SLF001 - aliases have no public name
        powers = registry.get_dimensionality(chosen)
        exponents = [str(Fraction(powers.get(f"[{name}]", 0))) for name in dimensions]
        while exponents and exponents[-1] == "0":
            exponents.pop()
        factor = float(registry.Quantity(1, chosen).to_base_units().magnitude)
        for name in sorted({definition.name, definition.symbol, *definition.aliases}):
            units.setdefault(name, (factor, exponents))
    prefixes = {
        name: float(prefix.value)
        for name, prefix in registry._prefixes.items()  # noqa: SLF001
        if name not in _NO_PREFIX and log10(prefix.value).is_integer()
    }
    table = {"pint": pint.__version__, "units": units, "prefixes": prefixes}
    return json.dumps(table, ensure_ascii=False, separators=(",", ":")) + "\n"


if __name__ == "__main__":
    TABLE.write_text(make_table(), "utf-8")
