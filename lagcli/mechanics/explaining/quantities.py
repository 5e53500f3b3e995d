"""The steps on the model of a numerical run and on the units of all quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import cast

from lagcli.answers import DimensionsSection, ModelSection, QuantityUnit, Section
from lagcli.document import Block, Equations, Items, Label, Row
from lagcli.expression import Name
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import names, says
from lagcli.wording import unit_rows


def model(_: Teller, section: Section) -> Iterator[Block]:
    """What a numerical run integrates, and why not the rest."""
    found = cast(ModelSection, section)
    if found.kept is None:
        yield says("There is no such model.")
        return
    yield says(
        "A numerical run integrates no more than it must. A constraint that can be solved for a "
        "coordinate leaves that coordinate out."
    )
    if found.eliminated:
        yield says("Solved and put in:")
        yield Equations(tuple(Row(Name(name), value) for name, value in found.eliminated.items()))
    yield says("So it integrates ", names(found.kept), ".")
    if found.ignorable:
        yield says(
            names(found.ignorable),
            " is cyclic: it follows from the others by its constant momentum."
            if len(found.ignorable) == 1
            else " are cyclic: they follow from the others by their constant momenta.",
        )
    if found.dropped:
        yield says("On ", names(found.dropped), " the motion does not depend.")
    if found.reason:
        yield says("The reasons, one by one:")
        yield Items(tuple((Name(name), f": {why}.") for name, why in found.reason.items()))


def dimensions(teller: Teller, section: Section) -> Iterator[Block]:
    """From the units of the file to those of everything else."""
    found = cast(DimensionsSection, section)
    if not found.units_given:
        yield says("The file gives no units, so nothing is checked or inferred.")
        return
    own = {**found.coordinates, **found.parameters}
    yield says("The file gives")
    yield from _units({name: Label(name, unit=True) for name in own}, own, "given")
    derived = {**own, **found.functions, **found.definitions}
    inferred = {name: each for name, each in derived.items() if each.source == "inferred"}
    yield says(
        "The terms of a sum have one unit, and the argument of a sine, an exponential or the like "
        "has none. Every sum and every call in the file was compared in this way: all fit."
    )
    if any(each.unit for each in inferred.values()):
        yield says("This determines as well")
        yield from _units({n: Label(n, unit=True) for n in inferred}, inferred)
    L = teller.letters.L
    yield says("The unit of ", L, " is")
    yield from _units({"L": Label(L.name, unit=True)}, {"L": found.energy})
    yield says("A momentum has the unit of ", L, " over that of a velocity:")
    yield from _units({n: Label(f"p_{n}", unit=True) for n in found.momenta}, found.momenta)
    yield says("A generalized force has that of ", L, " over that of its coordinate:")
    yield from _units({n: Label("Q", (n,), unit=True) for n in found.forces}, found.forces)
    if found.multipliers:
        yield says("A multiplier has that of ", L, " over that of what its constraint keeps at 0:")
        yield from _units({n: Label(n, unit=True) for n in found.multipliers}, found.multipliers)
    if found.charges:
        yield says("A charge has that of the momentum times the change of the coordinate:")
        yield from _units({n: Label("Q", (n,), unit=True) for n in found.charges}, found.charges)
    left = [name for name, each in derived.items() if each.unit is None]
    if left:
        yield says("Not determined by the units of the file: ", names(left), ".")


def _units(
    labels: Mapping[str, Label], quantities: Mapping[str, QuantityUnit], source: str = ""
) -> Iterator[Block]:
    rows = unit_rows(labels, quantities, source)
    if rows:
        yield Equations(rows)
