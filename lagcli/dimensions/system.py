"""The system of units of a file, and its names for dimensions.

Units are coherent where each is the product of the file's base units, without a factor: only
then do formulas hold for the numbers.  A base unit is the one that the file names (`cm`), else
what its derived units make it, else that of the SI.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache
from math import isclose, prod

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
    units
        Every unit of the file with its place, in order.
    """

    def __init__(self, units: Iterable[tuple[str, Span]]) -> None:
        self.factors: dict[str, float] = {}
        self.symbols: dict[str, Named] = {}
        used = [(read_unit(text), text, span) for text, span in units]
        derived = [each for each in used if not all(_base(name) for name, _ in each[0].factors)]
        for unit, _, span in (*(each for each in used if each not in derived), *derived):
            for name, _ in unit.factors:
                if base := _base(name):
                    self.symbols.setdefault(base, Named(name, span))
                    self.factors.setdefault(base, meaning_of(name).factor)
        self.factors.setdefault("s", 1.0)
        for unit, *_ in derived:
            self._take_free(unit)
        found = (self._incoherence(*each) for each in used)
        self.incoherent = [each for each in found if each is not None]

    def _take_free(self, unit: Unit) -> None:
        """Of base units that the file does not name, those with which the unit has no factor."""
        powers = _powers(unit)
        free = [(base, power) for base, power in powers.items() if base not in self.factors]
        for base, _ in free[1:]:
            self.factors[base] = 1.0
        if free:
            base, power = free[0]
            self.factors[base] = self._ratio(unit) ** (1 / float(power))

    def _ratio(self, unit: Unit) -> float:
        """How many products of the file's base units a unit is: 1 for N/m beside kg and cm."""
        sizes = (meaning_of(name).factor ** float(power) for name, power in unit.factors)
        return float(prod(sizes)) / self.factor(_powers(unit))

    def _incoherence(self, unit: Unit, text: str, span: Span) -> Incoherent | None:
        """What is wrong with a unit: one of its names, or the whole; None where nothing is."""
        factor = self._ratio(unit)
        if isclose(factor, 1, rel_tol=_TOLERANCE):
            return None
        ratios = ((name, self._ratio(Unit(((name, Fraction(1)),)))) for name, _ in unit.factors)
        wrong = [each for each in ratios if not isclose(each[1], 1, rel_tol=_TOLERANCE)]
        if len(wrong) != 1:
            return Incoherent(Named(text, span), factor, None)
        [(name, ratio)] = wrong
        return Incoherent(Named(name, span), ratio, self.symbols.get(_base(name)))

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


def _powers(unit: Unit) -> dict[str, Fraction]:
    return {str(base): power for base, power in dimension_of(unit).items()}


def _base(name: str) -> str:
    """The base that a name is a unit of, as m for cm; nothing for N."""
    powers = meaning_of(name).powers
    return powers[0][0] if len(powers) == 1 and powers[0][1] == 1 else ""


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
