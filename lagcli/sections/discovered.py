"""The symmetries that a search finds, with their conserved quantities."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from lagcli.formatters.json_values import Object
from lagcli.reader.shapes import by_name
from lagcli.record import replace
from lagcli.sections._expected import expected_of
from lagcli.sections.charges import (
    CHARGES,
    EXPECTED_CHARGE,
    blocks,
    charges_json,
    compare,
    stated_charge,
)
from lagcli.statements.answers import ChargesSection
from lagcli.statements.declaration import Explained, declared, step

if TYPE_CHECKING:
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> ChargesSection:
    """What the ansatz holds, each proved on the motion."""
    from lagcli.mechanics.discovery.reality import finite_where, real_where

    discovery = statements.derivation.discovery
    listed = (*discovery.charges, *discovery.momentum_equations)
    if discovery.stopped and not listed:
        statements.lacks("the symmetries", "; ".join(discovery.stopped))
        return ChargesSection(charges=(), sought=False, discovered=True)
    statements.warnings.extend(discovery.stopped)
    system, charges = statements.system, []
    for each in listed:
        stated = stated_charge(statements, each)
        trees = [f for f in (*stated.transformation.values(), stated.gauge, stated.charge) if f]
        where = (*finite_where(trees, system), *real_where(each, system))
        charges.append(replace(stated, where=where))
    return ChargesSection(charges=tuple(charges), discovered=True)


def json(section: ChargesSection) -> Object:
    """The list of charges."""
    return {"discovered": charges_json(section)}


SECTION = declared(
    globals(),
    blocks=blocks,
    abbreviated=True,
    heading="Discovered symmetries",
    order=150,
    schema=CHARGES,
    explained=Explained(
        title="Discovered symmetries", blocks=step("symmetries:discovered"), order=100
    ),
    content="charges",
    expected=(
        expected_of("discovered", by_name(EXPECTED_CHARGE), partial(compare, key="discovered")),
    ),
)
