"""q'' solved, free of accelerations and multipliers, with the constraints used."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Paragraph
from lagcli.formatters.json_values import FORMULA, Object, fields_of, map_of
from lagcli.sections._expected import expected_by_coordinate
from lagcli.statements.answers import AccelerationsSection, Answers
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import listed, not_found, rows_by_name, substituted

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.mechanics.stating import Stating


def derive(statements: Statements) -> AccelerationsSection:
    """The solved motion, by elimination with abbreviations where it grew too long."""
    dynamics, motion = statements.dynamics, statements.motion
    if motion is not None:
        statements.note_check("the accelerations", motion.verified)
        return AccelerationsSection(
            accelerations=statements.by_coordinate(motion.accelerations), verified=motion.verified
        )
    abbreviated = _abbreviated(statements)
    if abbreviated is not None:
        return abbreviated
    statements.unsolved()
    degenerate = tuple(statements.system.names[i] for i in dynamics.undetermined)
    return AccelerationsSection(accelerations=None, regular=not degenerate, degenerate=degenerate)


def large(statements: LargeStatements) -> AccelerationsSection:
    """By elimination with abbreviations."""
    found = _abbreviated(statements)
    if found is None:
        statements.unsolved(statements.why_missing)
    return found or AccelerationsSection(accelerations=None)


def _abbreviated(statements: Stating) -> AccelerationsSection | None:
    found = statements.abbreviated(lambda form: form.motion)
    if found is None:
        return None
    names = (q.name for q in statements.problem.coordinates)
    return AccelerationsSection(
        accelerations=dict(zip(names, found.accelerations, strict=True)), verified="50 digits"
    )


def blocks(section: AccelerationsSection, _: Answers) -> Iterator[Block]:
    """q'' = …, how that was verified, and what is degenerate."""
    if section.accelerations is None:
        yield not_found()
    else:
        yield rows_by_name(section.accelerations, primes=2)
        yield from substituted(section.verified)
    if not section.regular:
        yield Paragraph(
            ("The Lagrangian is singular; degenerate: ", *listed(section.degenerate), ".")
        )


def json(section: AccelerationsSection) -> Object:
    """Formulas by coordinate; two more keys where the Lagrangian is singular."""
    names = "accelerations" if section.regular else "accelerations regular degenerate"
    return fields_of(section, names)


SECTION = declared(
    globals(),
    heading="Accelerations",
    order=40,
    schema=map_of(FORMULA),
    by_default=always,
    abbreviated=True,
    expected=(expected_by_coordinate("accelerations", "the expected acceleration of '{}'"),),
)
