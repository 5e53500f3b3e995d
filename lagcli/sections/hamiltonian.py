"""H(q, p, t)."""

from __future__ import annotations

from collections.abc import Iterable
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Label
from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import OR_NULL
from lagcli.reader.scope import PHASE_SPACE
from lagcli.reader.shapes import formula
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, HamiltonianSection
from lagcli.statements.declaration import declared
from lagcli.statements.wording import fold, not_found, one_row

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.mechanics.stating import Stating
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements) -> HamiltonianSection:
    """By the Legendre transform, with abbreviations where the inverse of M grew too long."""
    hamiltonian = statements.derivation.hamiltonian
    try:
        written = statements.hamiltonian()
    except ArithmeticError:  # the inverse of M grew too long
        written = None
    if written is not None:
        return HamiltonianSection(hamiltonian=written, reason=hamiltonian.reason)
    meeting = fold_of(statements)
    return _abbreviated(statements) or _none(statements, hamiltonian.reason, meeting)


def large(statements: LargeStatements) -> HamiltonianSection:
    """By elimination with abbreviations."""
    return _abbreviated(statements) or _none(statements, statements.why_missing)


def phase_space(statements: PhaseSpaceStatements) -> HamiltonianSection:
    """As the file gives it."""
    return HamiltonianSection(hamiltonian=statements.as_written(statements.hamiltonian.function))


def _abbreviated(statements: Stating) -> HamiltonianSection | None:
    found = statements.abbreviated(lambda form: form.hamiltonian)
    return None if found is None else HamiltonianSection(hamiltonian=found.values[0])


def _none(
    statements: Stating, reason: str, meeting: Expression | None = None
) -> HamiltonianSection:
    statements.lacks("the Hamiltonian", reason)
    return HamiltonianSection(hamiltonian=None, reason=reason, fold=meeting)


def fold_of(statements: Statements) -> Expression | None:
    """What vanishes where two branches of the Legendre transform meet."""
    found = statements.derivation.hamiltonian.fold
    return None if found is None else statements.as_written(found)


def blocks(section: HamiltonianSection, _: Answers) -> Iterable[Block]:
    """H = …."""
    found = section.hamiltonian
    if found is None:
        return [not_found(section.reason), *fold(section.fold)]
    return [one_row(Label("H"), found)]


def compare(check: Expectations, section: HamiltonianSection, expected: Expression) -> Found:
    """H(q, p) is the same with p = dL/dq' put in; without a Lagrangian, everywhere."""
    path, found = ["hamiltonian"], section.hamiltonian
    if found is None:
        yield check.undecided(path, "no Hamiltonian was found")
        return
    if check.derivation.no_lagrangian:
        yield check.compare(path, found, expected, check.free)
        return
    system, lagrange = check.derivation.system, check.derivation.dynamics.lagrange
    momenta = dict(zip(system.momenta, lagrange.momenta, strict=True))
    difference = system.build(found) - system.build(expected)
    verdict = check.comparison.vanishes(difference.xreplace(momenta))
    yield check.judge(path, verdict, to_grammar(expected), to_grammar(found))


SECTION = declared(
    globals(),
    heading="Hamiltonian",
    order=100,
    schema=OR_NULL,
    by_default=attrgetter("hamiltonian"),
    abbreviated=True,
    expected=(
        expected_of("hamiltonian", formula("the expected Hamiltonian", PHASE_SPACE), compare),
    ),
)
