"""The steps on the model of a numerical run and on the units of all quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import cast

from lagcli.document import Block, Equations, Items, Label, equations_of
from lagcli.expression import Name
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, names, says
from lagcli.statements.answers import DimensionsSection, ModelSection, QuantityUnit, Section
from lagcli.statements.wording import unit_rows, with_names

_CHANGED = "that of the momentum times the change of the coordinate:"


def model(explainer: Explainer, section: Section) -> Iterator[Block]:
    """The coordinates that a numerical run integrates, and why not the others."""
    found = cast(ModelSection, section)
    if found.kept is None:
        yield says("There is no such model.")
        return
    yield says(
        "A numerical run leaves out coordinates where that saves work. ",
        "A constraint that can be solved for a coordinate then eliminates it."
        if explainer.problem.constraints
        else "",
    )
    if found.eliminated:
        yield says("Eliminated:")
        yield equations_of((Name(name), value) for name, value in found.eliminated.items())
    yield says("It integrates ", names(found.kept), ".")
    if found.ignorable:
        yield says(
            names(found.ignorable),
            " is cyclic: the equations of motion do not depend on its value."
            if len(found.ignorable) == 1
            else " are cyclic: the equations of motion do not depend on their values.",
        )
    if found.dropped:
        yield says("The motion does not depend on ", names(found.dropped), ".")
    if found.reason:
        yield says("The reasons:")
        given = {each.name for each in explainer.problem.constraints}
        reasons = (
            (f"'{name}'" if name in given else Name(name), ": ", *with_names(w), ".")
            for name, w in found.reason.items()
        )
        yield Items(tuple(reasons))


def dimensions(explainer: Explainer, section: Section) -> Iterator[Block]:
    """From the units of the file to those of all other quantities."""
    found = cast(DimensionsSection, section)
    if not found.units_given:
        yield says("The file gives no units, so none are checked or inferred.")
        return
    own = {**found.coordinates, **found.parameters}
    yield from _units("Given are", {name: Label(name, unit=True) for name in own}, own, "given")
    derived = {**own, **found.functions, **found.definitions}
    yield says(
        "All terms of a sum must have the same unit, and the argument of a sine or an exponential "
        "must have none. Every sum and every function in the file was checked: all are consistent."
    )
    labels = {name: Label(name, unit=True) for name in derived}
    yield from _units("This determines", labels, derived, "inferred")
    L = explainer.letters.L
    yield from _units(("The unit of ", L, " is"), {"L": Label(L.name, unit=True)},
                      {"L": found.energy})  # fmt: skip
    yield from _units(
        ("A momentum has the unit of ", L, " divided by that of the velocity:"),
        {n: Label(f"p_{n}", unit=True) for n in found.momenta},
        found.momenta,
    )
    yield from _units(
        ("A generalized force has that of ", L, " divided by that of its coordinate:"),
        {n: Label("Q", (n,), unit=True) for n in found.forces},
        found.forces,
    )
    quick = any(not e.holonomic for e in explainer.dynamics.constraints.equations)
    also = ", of one on velocities also by that of the time" if quick else ""
    yield from _units(
        ("A multiplier has that of ", L, f" divided by that of its constraint{also}:"),
        {n: Label(n, unit=True) for n in found.multipliers},
        found.multipliers,
    )
    yield from _units(
        ("The ", explainer.letters.Q, f" of a transformation has {_CHANGED}"),
        {n: Label("Q", (n,), unit=True) for n in found.charges},
        found.charges,
    )  # fmt: skip
    left = [name for name, each in derived.items() if each.unit is None]
    if left:
        yield says("Not determined by the units of the file: ", names(left), ".")


def _units(
    lead: str | tuple[Part, ...],
    labels: Mapping[str, Label],
    quantities: Mapping[str, QuantityUnit],
    source: str = "",
) -> Iterator[Block]:
    """The units that are known, below a sentence; nothing where none is."""
    if rows := unit_rows(labels, quantities, source):
        yield says(lead)
        yield Equations(rows)
