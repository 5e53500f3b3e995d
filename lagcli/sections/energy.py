"""h = Σ q' ∂L/∂q' − L, whether it is conserved, whether it is T + V, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Label, Paragraph
from lagcli.expression import Expression
from lagcli.formatters.json_values import OR_NULL, TEXT, TRUTH, Object, plain, record_of
from lagcli.reader.scope import STATE
from lagcli.reader.shapes import formula
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, EnergySection
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import capitalized, not_found, one_row

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.studies.check.expectations import Expectations, Found

_CONSERVED = {True: "Conserved.", False: "Not conserved.", None: "Conservation undecided."}
_TOTAL = {True: " It equals T + V.", False: " It does not equal T + V.", None: ""}


def derive(statements: Statements) -> EnergySection:
    """h, whether it is conserved, and whether it is T + V."""
    energy = statements.derivation.energy
    return EnergySection(
        function=statements.by_terms(energy.readable_function, as_given=True),
        conserved=energy.conserved,
        is_total_energy=energy.is_total_energy,
        reason=energy.reason,
    )


def large(statements: LargeStatements) -> EnergySection:
    """As the structure has it, unless that is too long."""
    charges = statements.charges
    found = statements.written("the energy", [charges.energy])
    return EnergySection(
        function=None if found is None else found[0],
        conserved=charges.energy_conserved,
        is_total_energy=charges.is_total_energy,
        reason=charges.energy_reason,
    )


def blocks(section: EnergySection, _: Answers) -> Iterator[Block]:
    """h = …, and the sentence on its conservation."""
    yield not_found() if section.function is None else one_row(Label("h"), section.function)
    words = _CONSERVED[section.conserved] + _TOTAL[section.is_total_energy]
    reason = section.reason.strip().rstrip(".")
    if reason.startswith(("conserved", "not conserved", "whether it is conserved")):
        yield Paragraph((f"{capitalized(reason)}.",))  # it says all of that, and why
    else:
        yield Paragraph((f"{words} {reason}.".replace(" .", ""),))


def json(section: EnergySection) -> Object:
    """The function and the verdicts."""
    return {"energy": plain(section)}


def compare(check: Expectations, section: EnergySection, expected: Expression) -> Found:
    """It is the same on the constraints."""
    yield check.compare(["energy"], section.function, expected)


SECTION = declared(
    globals(),
    heading="Energy",
    order=90,
    schema=record_of(function=OR_NULL, conserved=TRUTH, is_total_energy=TRUTH, reason=TEXT),
    by_default=always,
    expected=(expected_of("energy", formula("the expected energy", STATE), compare),),
)
