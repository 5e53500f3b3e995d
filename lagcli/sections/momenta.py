"""p = ∂L/∂q', and the cyclic coordinates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Paragraph
from lagcli.formatters.json_values import FORMULA, map_of
from lagcli.sections._expected import expected_by_coordinate
from lagcli.statements.answers import Answers, MomentaSection
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import listed, not_found, rows_by_name

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> MomentaSection:
    """The momenta, and which coordinates are cyclic."""
    names, momenta = statements.system.names, statements.dynamics.lagrange.momenta
    return MomentaSection(
        momenta={
            name: statements.readable.linear(p) for name, p in zip(names, momenta, strict=True)
        },
        cyclic=tuple(names[j] for j in statements.derivation.noether.cyclic),
    )


def large(statements: LargeStatements) -> MomentaSection:
    """As the structure has them, unless that is too long."""
    names = [q.name for q in statements.form.q]
    found = statements.written("the momenta", statements.form.momenta)
    return MomentaSection(
        momenta=None if found is None else dict(zip(names, found, strict=True)),
        cyclic=tuple(names[i] for i in statements.charges.cyclic),
    )


def blocks(section: MomentaSection, _: Answers) -> Iterator[Block]:
    """p = … and the cyclic coordinates."""
    if section.momenta is None:
        yield not_found()
    else:
        yield rows_by_name({f"p_{name}": p for name, p in section.momenta.items()})
    if section.cyclic:
        yield Paragraph(("Cyclic: ", *listed(section.cyclic), "."))


SECTION = declared(
    globals(),
    heading="Momenta",
    order=80,
    schema=map_of(FORMULA),
    by_default=always,
    expected=(expected_by_coordinate("momenta", "the expected momentum of '{}'"),),
)
