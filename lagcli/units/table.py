"""The units that a file may name: their factors and dimensions, and the prefixes.

The numbers are those of pint's registry, kept in `table.json` by `lagcli.units.make`:
importing pint and making its registry takes 0.6 to 0.7 s of CPU, reading the table 1 ms.
"""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import NamedTuple

TABLE = Path(__file__).with_name("table.json")

#: The base units of the SI, in the order in which a unit is written.
BASES = ("kg", "m", "s", "A", "K", "mol", "cd")


class Meaning(NamedTuple):
    """What a name stands for, in the base units of the SI."""

    factor: float
    powers: tuple[tuple[str, Fraction], ...]  # of `BASES`


@cache
def meaning(name: str) -> Meaning | None:
    """The meaning of a unit's name or symbol, with a prefix or without; None: there is none."""
    units, prefixes = _table()
    if name in _WORDS:
        return None
    for shown in (name, name[:-1] if len(name) > _SHORTEST_PLURAL and name[-1] == "s" else ""):
        if shown in units:
            return _meaning(units[shown], 1)
        for size in range(len(shown) - 1, 0, -1):
            if shown[:size] in prefixes and _takes_prefix(shown[size:], units):
                return _meaning(units[shown[size:]], prefixes[shown[:size]])
    return None


def known_names() -> list[str]:
    """Every name and symbol, without prefixes."""
    return list(_table()[0])


#: `feet` is not `fees`: shorter names have no plural with s.
_SHORTEST_PLURAL = 4
#: kg, no kiloseconds; the degree of German, no gigaradian; its minute, no megainch.
_WORDS = frozenset("kilos Grad Gradian Gradians Min".split())
_NEVER_PREFIXED = frozenset("min h d kg % °".split())

_Units = dict[str, tuple[float, list[str]]]


def _takes_prefix(name: str, units: _Units) -> bool:
    return name in units and name not in _NEVER_PREFIXED


def _meaning(entry: tuple[float, list[str]], prefix: float) -> Meaning:
    factor, exponents = entry
    powers = zip(BASES, map(Fraction, exponents), strict=False)  # trailing zeros are left out
    return Meaning(factor * prefix, tuple((base, power) for base, power in powers if power))


@cache
def _table() -> tuple[_Units, dict[str, float]]:
    table = json.loads(TABLE.read_bytes())
    return {**table["units"], "°": table["units"]["deg"]}, table["prefixes"]
