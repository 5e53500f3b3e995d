"""The symmetries that a search finds, with their conserved quantities."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.answers import ChargesSection
from lagcli.document import Block
from lagcli.formatters.json_values import Object
from lagcli.record import replace
from lagcli.sections.charges import CHARGES, blocks, charges_json, stated_charge
from lagcli.statements.declaration import Declaration, Told

if TYPE_CHECKING:
    from lagcli.mechanics.explaining.teller import Teller
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> ChargesSection:
    """What the ansatz holds, each proved on the motion."""
    from lagcli.mechanics.discovery.reality import real_where

    discovery = statements.derivation.discovery
    listed = (*discovery.charges, *discovery.momentum_equations)
    if discovery.stopped and not listed:
        statements.lacks("the symmetries", "; ".join(discovery.stopped))
        return ChargesSection(charges=(), sought=False)
    statements.warnings.extend(discovery.stopped)
    return ChargesSection(
        charges=tuple(
            replace(stated_charge(statements, each), where=real_where(each, statements.system))
            for each in listed
        )
    )


def json(section: ChargesSection) -> Object:
    """The list of charges."""
    return {"discovered": charges_json(section)}


def tell(teller: Teller, section: ChargesSection) -> Iterator[Block]:
    """The ansatz, the condition, and each conserved quantity."""
    from lagcli.mechanics.explaining.symmetries import discovered

    return discovered(teller, section)


SECTION = Declaration(
    name="discovered",
    heading="Discovered symmetries",
    order=150,
    derive=derive,
    blocks=blocks,
    json=json,
    schema=CHARGES,
    told=Told(title="Discovered symmetries", blocks=tell, order=100),
    content="charges",
)
