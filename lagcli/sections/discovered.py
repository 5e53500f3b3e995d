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
    from lagcli.mechanics.discovery.reality import real_where

    discovery = statements.derivation.discovery
    listed = (*discovery.charges, *discovery.momentum_equations)
    if discovery.stopped and not listed:
        statements.lacks("the symmetries", "; ".join(discovery.stopped))
        return ChargesSection(charges=(), sought=False, discovered=True)
    statements.warnings.extend(discovery.stopped)
    return ChargesSection(
        charges=tuple(
            replace(stated_charge(statements, each), where=real_where(each, statements.system))
            for each in listed
        ),
        discovered=True,
    )


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
