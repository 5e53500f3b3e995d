"""The printed units: in other units of mass, length, time, … all quantities change together.

If [q] is the product of base units to powers a_b, q becomes q prod_b s_b^a_b where the base units
are 1/s_b of what they were, and then L becomes L prod_b s_b^e_b with the powers e_b of its unit.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction

from flint import arb

from lagcli.expression import ZERO
from lagcli.statements.answers import DimensionsSection, QuantityUnit
from lagcli.units import Unit
from lagcli.units.table import meaning
from lagcli.verification.examination import Examination
from lagcli.verification.functions import ball, power
from lagcli.verification.linear import dot
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State

#: Independent numbers for the base units.
_SCALES = {
    "kg": Fraction(5, 4), "m": Fraction(7, 4), "s": Fraction(3, 4), "A": Fraction(9, 8),
    "K": Fraction(11, 8), "mol": Fraction(13, 16), "cd": Fraction(15, 8),
}  # fmt: skip
_GROUPS = (
    "coordinates", "parameters", "functions", "definitions", "momenta", "forces",
    "multipliers", "charges",
)  # fmt: skip
_UNKNOWN = QuantityUnit(unit=None, source="undetermined")


def dimensions(x: Examination, section: DimensionsSection) -> DimensionsSection:
    """Every printed unit, by the values in two systems of units."""
    scaled = ScaledUnits(x, section)
    if not section.units_given or not scaled.possible:
        return section
    if scaled.agrees():
        return section
    groups = {name: _given(getattr(section, name)) for name in _GROUPS}
    return DimensionsSection(units_given=True, energy=_UNKNOWN, **groups)


def _given(units: Mapping[str, QuantityUnit]) -> dict[str, QuantityUnit]:
    return {n: each if each.source == "given" else _UNKNOWN for n, each in units.items()}


class ScaledUnits:
    """The values of the quantities in other units.

    Attributes
    ----------
    possible
        Whether every symbol of L has a unit.
    """

    def __init__(self, x: Examination, section: DimensionsSection) -> None:
        self.x, self.section = x, section
        given = {**section.coordinates, **section.parameters}
        self.factors = {name: factor(each.unit) for name, each in given.items() if each.unit}
        self.second = ball(_SCALES["s"])
        known = all(each.unit is not None for each in given.values())
        plain = not x.problem.functions and not x.reference.of_phase_space
        self.possible = known and plain and not x.reference.large

    def environment(self, known: Environment) -> Environment:
        """The values in the other units."""
        names = set(self.x.reference.names)
        found = dict(known)
        for (name, primes), value in known.items():
            if name == "t":
                found[name, primes] = value * self.second
            elif name in self.factors:
                change = self.factors[name]
                found[name, primes] = (
                    value * change / self.second ** (primes if name in names else 0)
                )
        return found

    def agrees(self) -> bool:
        """Whether all quantities change by the factors of their units."""
        return all(
            self.x.decide(f"the units of the {what}", lambda s, what=what: self._sides(s, what))  # type: ignore[misc]
            for what in ("energy", "momenta", "forces", "definitions", "multipliers", "charges")
            if self._units(what)
        )

    def _units(self, what: str) -> Mapping[str, QuantityUnit]:
        if what == "energy":
            return {"": self.section.energy}
        found: Mapping[str, QuantityUnit] = getattr(self.section, what)
        return found

    def _sides(self, s: State, what: str) -> tuple[list[arb], list[arb]]:
        there = State(self.x.reference, self.environment(s.environment))
        pairs = [
            (new, old * factor(unit.unit))
            for (_, unit), new, old in zip(
                self._units(what).items(),
                self._values(there, what),
                self._values(s, what),
                strict=True,
            )
            if unit.unit is not None and old.is_finite()
        ]
        return [a for a, _ in pairs], [b for _, b in pairs]

    def _values(self, s: State, what: str) -> Iterable[arb]:
        laws, reference = s.laws, self.x.reference
        if what == "momenta":
            return laws.momenta
        if what == "forces":
            t = s.at(reference.time)  # what is 0 has any unit, a momentum over a time has not
            parts = zip(laws.slopes, laws.applied, laws.momenta, strict=True)
            return [a + b + p / t for a, b, p in parts]
        if what == "definitions":
            return [s.at(reference.place(e)) for e in self.x.problem.definitions.values()]
        if what == "multipliers":
            size = laws.size
            fixed = [laws.motion.determined(size + k) for k in range(len(laws.multipliers))]
            return [m if d else arb("nan") for m, d in zip(laws.multipliers, fixed, strict=True)]
        if what == "charges":
            return [self._charge(s, each.name) for each in self.x.problem.symmetries]
        program, L = reference.program, reference.lagrangian
        if any(program.steps[place].what == "log" for place in program.order([L])):
            return [dot(laws.momenta, laws.velocities)]  # the unit of its argument adds a constant
        return [laws.lagrangian]

    def _charge(self, s: State, name: str) -> arb:
        """sum p (Dq - q' Dt) + L Dt; no value where a boundary term is to be found."""
        [each] = [e for e in self.x.problem.symmetries if e.name == name]
        place, names = self.x.reference.place, self.x.reference.names
        time = arb(0) if each.time is None else s.at(place(each.time))
        moved = [
            s.at(place(each.changes.get(n, ZERO))) - v * time
            for n, v in zip(names, s.laws.velocities, strict=True)
        ]
        return dot(s.laws.momenta, moved) + s.laws.lagrangian * time


def factor(unit: Unit | None) -> arb:
    """prod_b s_b^a_b of a unit."""
    total = arb(1)
    for name, exponent in unit.factors if unit is not None else ():
        known = meaning(name)
        for base, inner in () if known is None else known.powers:
            total = total * power(ball(_SCALES[base]), exponent * inner)
    return total
