"""Poisson brackets of observables, and dA/dt = {A, H} + ∂A/∂t."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Bracket, Equations, Paragraph, Row, equations_of
from lagcli.expression import Expression, Name
from lagcli.formatters.json_values import Object, fields_of
from lagcli.reader.phase_space import BRACKETED
from lagcli.reader.shapes import formula, of_known
from lagcli.rewriting import substituted
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.phase_space import BracketsSection

if TYPE_CHECKING:
    from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements | PhaseSpaceStatements) -> BracketsSection:
    """The brackets of the file, or those of all pairs of its observables."""
    from lagcli.mechanics.canonical.statement import PhaseSpace

    phase = PhaseSpace(statements.derivation)
    return statements.noted((phase.brackets(), phase.missing))


def blocks(section: BracketsSection, _: Answers) -> Iterator[Block]:
    """Say the observables, their brackets and their rates."""
    if section.observables:
        yield equations_of((Name(name), f) for name, f in section.observables.items())
    yield Paragraph(("Poisson brackets, with the sign of {q, p} = 1:",))
    rows = []
    for each in section.brackets:
        left = Bracket(each.left, each.right)
        if each.value is None:
            yield Paragraph((f"{each.name}: not found.",))
        elif each.named is None:
            rows.append(Row(left, each.value))
        else:
            rows.append(Row(left, each.named))
    if rows:
        yield Equations(tuple(rows))
    elif not section.brackets:
        yield Paragraph(("None: the file names no two functions.",))
    if section.rates:
        yield Paragraph(("Rates on the motion, from the brackets with H:",))
        yield equations_of((Name(name, 1), value) for name, value in section.rates.items())
    elif section.reason:
        yield Paragraph((f"No rates: {section.reason}.",))


def json(section: BracketsSection) -> Object:
    """Observables, brackets and rates."""
    return {"brackets": fields_of(section, "observables brackets rates")}


def compare(
    check: Expectations, section: BracketsSection, expected: Mapping[str, Expression]
) -> Found:
    """Each is the same on the whole of phase space."""
    found = {each.name: each.value for each in section.brackets}
    known: dict[str, Expression] = {}
    for name, observable in check.derivation.given.observables.items():
        known[name] = substituted(observable, known)
    for name, value in expected.items():
        wanted = substituted(value, known)
        yield check.compare(["brackets", name], found[name], wanted, check.free)


_EXPECTED = of_known(
    "bracket", attrgetter("brackets"), formula("the expected bracket '{}'", BRACKETED)
)
SECTION = declared(
    globals(),
    heading="Poisson brackets",
    order=120,
    phase_space=derive,
    by_default=attrgetter("brackets"),
    explained=Explained(title="Poisson brackets", blocks=step("phase_space:brackets"), order=70),
    expected=(expected_of("brackets", _EXPECTED, compare),),
)
