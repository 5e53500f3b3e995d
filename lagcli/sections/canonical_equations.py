"""q' = ∂H/∂p, p' = −∂H/∂q with multipliers, forces and dissipation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Row
from lagcli.expression import Expression, Name
from lagcli.formatters.json_values import FORMULA, map_of, record_of
from lagcli.sections.hamiltonian import fold_of
from lagcli.statements.answers import Answers, CanonicalPair, CanonicalSection
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.wording import fold, not_found

if TYPE_CHECKING:
    from sympy import Expr

    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.mechanics.stating import Stating


def derive(statements: Statements) -> CanonicalSection:
    """From the Hamiltonian, where there is one."""
    hamiltonian = statements.derivation.hamiltonian
    if hamiltonian.velocities is None or hamiltonian.growth is None:
        return _none(statements, hamiltonian.reason, fold_of(statements))
    shifts = hamiltonian.shifts
    rates = [statements.readable.rate(*parts, shifts) for parts in hamiltonian.growth]
    return _stated(statements, statements.system.names, hamiltonian.velocities, rates)


def large(statements: LargeStatements) -> CanonicalSection:
    """They are not derived."""
    return _none(statements, statements.why_missing)


def phase_space(statements: PhaseSpaceStatements) -> CanonicalSection:
    """From the H of the file."""
    names = [coordinate.name for coordinate in statements.problem.coordinates]
    hamiltonian = statements.hamiltonian
    rates = [statements.as_written(p) for p, _ in hamiltonian.growth]
    return _stated(statements, names, hamiltonian.velocities, rates)


def _stated(
    statements: Statements | PhaseSpaceStatements,
    names: Sequence[str],
    velocities: Sequence[Expr],
    rates: Sequence[Expression],
) -> CanonicalSection:
    return CanonicalSection(
        equations={
            name: CanonicalPair(q=statements.as_written(q), p=p)
            for name, q, p in zip(names, velocities, rates, strict=True)
        }
    )


def _none(statements: Stating, reason: str, meeting: Expression | None = None) -> CanonicalSection:
    statements.lacks("the canonical equations", reason)
    return CanonicalSection(equations=None, reason=reason, fold=meeting)


def blocks(section: CanonicalSection, _: Answers) -> Iterator[Block]:
    """The pair of each coordinate."""
    if section.equations is None:
        yield not_found(section.reason)
        yield from fold(section.fold)
        return
    rows = []
    for name, pair in section.equations.items():
        rows += [Row(Name(name, 1), pair.q), Row(Name(f"p_{name}", 1), pair.p)]
    yield Equations(tuple(rows))


SECTION = declared(
    globals(),
    abbreviated=True,
    heading="Canonical equations",
    order=110,
    schema=map_of(record_of(q=FORMULA, p=FORMULA)),
    by_default=attrgetter("hamiltonian"),
    explained=Explained(
        title="Canonical equations", blocks=step("phase_space:canonical_equations"), order=60
    ),
    content="equations",
)
