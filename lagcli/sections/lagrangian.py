"""L = T − V, or L as given."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from lagcli.document import Block, Label
from lagcli.expression import sum_of
from lagcli.formatters.json_values import OR_NULL
from lagcli.statements.answers import Answers, LagrangianSection
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import not_found, one_row

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> LagrangianSection:
    """Term by term, in the shape that the file gives it."""
    L = statements.by_terms(statements.system.L, as_given=True)
    return LagrangianSection(lagrangian=L)


def large(statements: LargeStatements) -> LagrangianSection:
    """With T by the mass matrix, unless that is too long."""
    found = statements.written("the Lagrangian", statements.form.collected_lagrangian)
    if found is None:
        return LagrangianSection(lagrangian=None)
    return LagrangianSection(lagrangian=sum_of(found))


def phase_space(statements: PhaseSpaceStatements) -> LagrangianSection:
    """There is none."""
    statements.lacks("the Lagrangian")
    return LagrangianSection(lagrangian=None)


def blocks(section: LagrangianSection, _: Answers) -> Iterable[Block]:
    """L = …."""
    found = section.lagrangian
    return [not_found() if found is None else one_row(Label("L"), found)]


SECTION = declared(globals(), heading="Lagrangian", order=10, schema=OR_NULL, by_default=always)
