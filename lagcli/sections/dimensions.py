"""The unit of every quantity, given or inferred."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Formula, Heading, Label, Paragraph
from lagcli.formatters.json_values import Object, fields_of
from lagcli.statements.answers import Answers, DimensionsSection, QuantityUnit
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.wording import unit_rows

if TYPE_CHECKING:
    from lagcli.mechanics.stating import Stating


def derive(statements: Stating) -> DimensionsSection:
    """The units that the file gives, and those that follow."""
    from lagcli.mechanics.quantity_units import dimensions_section

    return dimensions_section(statements.problem)


def blocks(section: DimensionsSection, _: Answers) -> Iterator[Block]:
    """Say the unit of each quantity, in its kind, and which are not determined."""
    if not section.units_given:
        yield Paragraph(("The file gives no units, so nothing is checked or inferred.",))
        return
    own = {**section.coordinates, **section.parameters}
    yield from _part("Given", _labels(own), own, "given")
    derived = {**own, **section.functions, **section.definitions}
    yield from _part("Inferred", _labels(derived), derived, "inferred")
    yield from _part("Energy", {"L": Label("L", unit=True)}, {"L": section.energy})
    yield from _part(
        "Momenta",
        {name: Label(f"p_{name}", unit=True) for name in section.momenta},
        section.momenta,
    )
    yield from _part("Forces along the coordinates", _indexed(section.forces), section.forces)
    yield from _part("Multipliers", _labels(section.multipliers), section.multipliers)
    yield from _part("Charges of the symmetries", _indexed(section.charges), section.charges)
    undetermined = [name for name, each in derived.items() if each.unit is None]
    if undetermined:
        yield Heading("Not determined", 2)
        parts: list[str | Formula] = []
        for name in undetermined:
            parts += [", ", Label(name, unit=True)] if parts else [Label(name, unit=True)]
        yield Paragraph((*parts, ": the units of the file leave them open."))


def _labels(quantities: Mapping[str, QuantityUnit]) -> dict[str, Label]:
    return {name: Label(name, unit=True) for name in quantities}


def _indexed(quantities: Mapping[str, QuantityUnit]) -> dict[str, Label]:
    return {name: Label("Q", (name,), unit=True) for name in quantities}


def _part(
    heading: str,
    labels: Mapping[str, Label],
    quantities: Mapping[str, QuantityUnit],
    source: str = "",
) -> Iterator[Block]:
    """One kind of quantities, those with a unit."""
    rows = unit_rows(labels, quantities, source)
    if rows:
        yield Heading(heading, 2)
        yield Equations(rows)


def json(section: DimensionsSection) -> Object:
    """The unit of each quantity, and where it comes from."""
    names = "coordinates parameters functions definitions energy momenta forces multipliers charges"
    return {"dimensions": fields_of(section, names)}


SECTION = declared(
    globals(),
    heading="Dimensions",
    order=240,
    large=derive,
    phase_space=derive,
    explained=Explained(title="Units", blocks=step("quantities:dimensions"), order=140),
)
