"""The system of units of a file, and its names for dimensions.

Units are coherent where each is the product of the file's base units, without a factor: only
then do formulas hold for the numbers.  A base unit is the one that the file names (`cm`), else
what its derived units make it, else that of the SI.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache
from math import isclose

from lagcli.diagnostics import Span
from lagcli.dimensions.forms import Form, plus
from lagcli.record import record
from lagcli.units import Unit, read_unit
from lagcli.units.table import BASES, Meaning, meaning

#: SI units that are printed for what they are; a charge has C rather than A s.
_NAMED = ("N", "J", "W", "C", "V", "T", "F", "H", "ohm", "N/m", "V/m")
_TOLERANCE = 1e-9


@record
class Named:
    """A unit's name where a file uses it."""

    name: str
    span: Span


@record
class Incoherent:
    """A name that is not the product of the file's base units: `other` or, if None, by `factor`."""

    named: Named
    factor: float
    base: str
    other: Named | None


def dimension_of(unit: Unit) -> Form:
    """The dimension of a unit."""
    total: Form = {}
    for name, exponent in unit.factors:
        total = plus(total, dict(meaning_of(name).powers), exponent)
    return total


def meaning_of(name: str) -> Meaning:
    """What a unit's name that was read from a file means."""
    found = meaning(name)
    if found is None:
        raise LookupError(f"the unit {name!r} was not read from a file")
    return found


class UnitSystem:
    """The base units of a file, their factors against the SI.

    Parameters
    ----------
    names
        Every unit's name in the file, in order.
    """

    def __init__(self, names: Iterable[Named]) -> None:
        self.factors: dict[str, float] = {}
        self.symbols: dict[str, Named] = {}
        self.incoherent: list[Incoherent] = []
        used = list(names)
        derived = [named for named in used if not self._take_base(named)]
        self.factors.setdefault("s", 1.0)
        for named in derived:
            self._take_derived(named)

    def _take_base(self, named: Named) -> bool:
        """Whether the name is that of a base unit, which then is the file's."""
        factor, powers = meaning_of(named.name)
        if len(powers) != 1 or powers[0][1] != 1:
            return False
        base = powers[0][0]
        known = self.symbols.setdefault(base, named)
        if not isclose(self.factors.setdefault(base, factor), factor, rel_tol=_TOLERANCE):
            ratio = factor / self.factors[base]
            self.incoherent.append(Incoherent(named, ratio, base, known))
        return True

    def _take_derived(self, named: Named) -> None:
        factor, powers = meaning_of(named.name)
        free = [(base, power) for base, power in powers if base not in self.factors]
        for base, _ in free[1:]:
            self.factors[base] = 1.0
        rest = factor / self.factor(dict(powers))
        if free:
            base, power = free[0]
            self.factors[base] = rest ** (1 / float(power))
        elif not isclose(rest, 1, rel_tol=_TOLERANCE):
            self.incoherent.append(Incoherent(named, rest, "", None))

    def factor(self, powers: Mapping[str, Fraction]) -> float:
        """How many SI units one unit of this dimension has here."""
        total = 1.0
        for base, power in powers.items():
            total *= self.factors.get(base, 1.0) ** float(power)
        return total

    def unit(self, form: Form) -> Unit:
        """The unit of a known dimension: that of the SI by name, or the product of base units."""
        powers = {base: form[base] for base in BASES if base in form}
        if all(self.factors.get(base, 1) == 1 or base not in self.symbols for base in powers):
            unit = _si_unit(tuple(powers.items()))
            factor = self.factor(powers)
            return Unit(unit.factors, 1 if isclose(factor, 1, rel_tol=_TOLERANCE) else factor)
        rest = self.factor({base: power for base, power in powers.items()
                            if base not in self.symbols})  # fmt: skip
        names = ((self.symbols[b].name if b in self.symbols else b, p) for b, p in powers.items())
        return Unit(tuple(names), 1 if isclose(rest, 1, rel_tol=_TOLERANCE) else rest)


@cache
def _si_unit(powers: tuple[tuple[str, Fraction], ...]) -> Unit:
    wanted = dict(powers)
    for text in _NAMED:
        unit = read_unit(text)
        if dimension_of(unit) == wanted:
            return unit
    return Unit(tuple(_with_charge(wanted)))


def _with_charge(powers: Mapping[str, Fraction]) -> Iterator[tuple[str, Fraction]]:
    """kg, m, s, and C = A s for the current."""
    charge = powers.get("A", Fraction(0))
    for base, power in powers.items():
        if base == "A":
            yield "C", charge
        elif base == "s":
            if power != charge:
                yield "s", power - charge
        else:
            yield base, power
    if charge and "s" not in powers:
        yield "s", -charge
