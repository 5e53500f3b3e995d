"""Noether's charge of each symmetry, given or evident, and its rate where it is not conserved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Heading, Label, Paragraph, Row
from lagcli.expression import ZERO, Expression, Name
from lagcli.formatters.json_values import (
    FORMULA,
    OR_NULL,
    TEXT,
    TRUTH,
    Object,
    fields_of,
    map_of,
    record_of,
)
from lagcli.notation.letters import own
from lagcli.problem_data import NOT_CONSERVED
from lagcli.reader.nodes import DocumentNode, Scalar
from lagcli.reader.schema_parts import FORMULA as EXPRESSION
from lagcli.reader.scope import ANSWER
from lagcli.reader.shapes import Shape, of_known
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, Charge, ChargesSection, EnergySection
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import TRIVIAL, listed, where_real

if TYPE_CHECKING:
    from lagcli.mechanics.large_charges import LargeCharge
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.noether import NoetherCharge
    from lagcli.mechanics.statements import Statements
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.shapes import Path
    from lagcli.studies.check.expectations import Expectations, Found

_SOURCES = {
    "candidate": "candidate",
    "cyclic": "cyclic coordinate",
    "time": "translation in time",
    "discovered": "discovered",
    "momentum equation": "momentum equation",
}

_CONSTRAINT = "the constraint"
_CHECKED = {
    "exact": ", checked exactly",
    "50 digits": ", checked at random states to 50 digits",
    None: "",
}


def derive(statements: Statements) -> ChargesSection:
    """By Noether's theorem."""
    found = statements.derivation.noether.charges
    return ChargesSection(charges=tuple(stated_charge(statements, each) for each in found))


def stated_charge(statements: Statements, charge: NoetherCharge) -> Charge:
    """One symmetry with its conserved quantity, in the shape in which it is read."""
    from lagcli.mechanics.impacts import when_constant

    if charge.conserved is None:
        why = charge.broken_by or "its rate needs the solved motion"
        statements.lacks(f"whether '{charge.name}' is conserved", why)
    elif charge.conserved is False and charge.rate is None:
        from lagcli.mechanics.real_forces import UNSOLVED

        statements.warnings.append(f"the rate of '{charge.name}' has no formula: {UNSOLVED}")
    statements.note_check(f"the rate of '{charge.name}'", charge.verified)
    system, change = statements.system, charge.transformation
    named = dict(zip(system.names, change.changes, strict=True)) | {"t": change.time}
    trivial = charge.source == "candidate" and statements.derivation.noether.is_trivial(charge)
    return Charge(
        name=charge.name,
        source=charge.source,
        transformation={
            name: statements.as_written(each) for name, each in named.items() if each != 0
        },
        gauge=None if charge.gauge is None else statements.as_written(charge.gauge),
        conserved=charge.conserved,
        charge=_function(statements, charge) if charge.complete and not trivial else None,
        rate=None if charge.rate is None else statements.on_surface(charge.rate),
        verified=charge.verified,
        broken_by=charge.broken_by,
        when=when_constant(system, change.changes, change.time, charge.gauge)
        if charge.conserved
        else "",
        trivial=trivial,
    )


def _function(statements: Statements, charge: NoetherCharge) -> Expression:
    """The charge, the energy and a momentum as they are written in their own sections."""
    from lagcli.algebra import is_zero

    energy = statements.derivation.energy.readable_function
    if charge.source == "time" or (
        charge.name == "energy" and is_zero(charge.charge - energy) is True
    ):
        return statements.by_terms(energy, as_given=True)
    momenta = statements.dynamics.lagrange.momenta
    if charge.source == "cyclic" or charge.charge in momenta:
        return statements.readable.linear(charge.charge)
    return statements.by_terms(charge.charge)


def large(statements: LargeStatements) -> ChargesSection:
    """From the structure of the system."""
    charges = statements.charges.charges
    undecided = [f"'{charge.name}'" for charge in charges if charge.conserved is None]
    if undecided:
        statements.lacks(f"whether conserved: {', '.join(undecided)}")
    return ChargesSection(charges=tuple(_large_charge(statements, each) for each in charges))


def _large_charge(statements: LargeStatements, charge: LargeCharge) -> Charge:
    what = f"the charge '{charge.name}'"
    write = statements.written
    shown = write(what, [charge.charge])
    rate = None if charge.rate is None else write(f"the rate of {what}", [charge.rate])
    gauge = None if charge.gauge is None else write(what, [charge.gauge])
    return Charge(
        name=charge.name,
        source=charge.source,
        transformation=statements.written_out(charge.changes),
        gauge=None if gauge is None else gauge[0],
        conserved=charge.conserved,
        charge=None if shown is None else shown[0],
        rate=None if rate is None else rate[0],
        verified=charge.verified,
        broken_by=charge.broken_by,
    )


def blocks(section: ChargesSection, answers: Answers) -> Iterator[Block]:
    """Say what each symmetry changes, its gauge, its charge, and whether that is conserved."""
    if not section.charges:
        yield Paragraph(("None." if section.sought else "Not found.",))
    energy = answers.sections.get("energy")
    shown = energy.function if isinstance(energy, EnergySection) else None
    broken = [c for c in section.charges if c.source == "cyclic" and _CONSTRAINT in c.broken_by]
    for cause in dict.fromkeys(charge.broken_by for charge in broken):
        names = listed(charge.name for charge in broken if charge.broken_by == cause)
        yield Paragraph(("Not conserved, because of ", f"{cause}: ", *names, "."))
    for charge in (each for each in section.charges if each not in broken):
        yield _heading(charge)
        if rows := tuple(_rows(charge, shown)):
            yield Equations(rows)
        yield Paragraph(tuple(_verdict(charge)))
        yield from where_real(charge.where)


def _heading(charge: Charge) -> Heading:
    if charge.source == "cyclic":
        return Heading("momentum", 2, Name(charge.name))
    return Heading(f"{charge.name} ({_SOURCES[charge.source]})", 2)


def _rows(charge: Charge, energy: Expression | None) -> Iterator[Row]:
    """The transformation, the gauge, the charge; h where that is printed above."""
    for name, change in charge.transformation.items():
        yield Row(Label(name, change=True), change)
    if charge.gauge is not None and charge.gauge != ZERO:
        yield Row(Label("G"), charge.gauge, "gauge")
    if charge.charge is not None:
        yield Row(Label("Q"), own("h") if charge.charge == energy else charge.charge)
    if charge.rate is not None and not charge.conserved:
        yield Row(own("Q", 1), charge.rate)


def _verdict(charge: Charge) -> Iterator[str | Expression]:
    checked = _CHECKED[charge.verified]
    if charge.trivial:
        yield TRIVIAL
        return
    if charge.conserved:
        yield f"Conserved{' ' + charge.when if charge.when else ''}: "
        yield own("Q", 1)
        yield f" = 0 on the motion{checked}."
        return
    if charge.conserved is None:
        words = "Whether it is conserved is undecided"
    elif charge.source == "momentum equation":
        words = f"Not conserved: its rate is the momentum equation{checked}"
    else:
        words = f"Not conserved{checked}"
    joint = ": " if charge.conserved is None else ", because of "
    yield f"{words}{joint + charge.broken_by if charge.broken_by else ''}."


def charges_json(section: ChargesSection) -> list[Object] | None:
    """The list of charges; null where the search found none and did not come to its end."""
    return [_charge(each) for each in section.charges] if section.sought else None


def _charge(charge: Charge) -> Object:
    names = "name source transformation gauge conserved charge rate"
    return fields_of(charge, f"where {names}" if charge.where else names)


def json(section: ChargesSection) -> Object:
    """The list of charges."""
    return {"charges": charges_json(section)}


#: A list of charges as JSON Schema.
CHARGES = {
    "type": ["array", "null"],
    "items": record_of(
        name=TEXT,
        source=TEXT,
        transformation=map_of(FORMULA, null=False),
        gauge=OR_NULL,
        conserved=TRUTH,
        charge=OR_NULL,
        rate=OR_NULL,
    ),
}


def _read_charge(reader: ExpectReader, node: DocumentNode, path: Path) -> Expression | str:
    """One formula, or `not conserved`."""
    if isinstance(node, Scalar) and " ".join(node.value.split()) == NOT_CONSERVED:
        return NOT_CONSERVED
    return reader.file.expression(node, f"the expected charge '{path[-1]}'", ANSWER)


def _symmetries(reader: ExpectReader) -> list[str]:
    momenta = [f"p_{name}" for name in reader.file.scope.of_kind("coordinate")]
    return [*reader.symmetries, "energy", *momenta]


def compare(
    check: Expectations,
    section: ChargesSection,
    expected: Mapping[str, Expression | str],
    key: str = "charges",
) -> Found:
    """Each is conserved, and the same up to a factor and a constant; or it is not conserved."""
    from lagcli.studies.check.charges import conserved, not_conserved

    charges = {charge.name: charge for charge in section.charges}
    for name, formula in expected.items():
        path = [key, name]
        if isinstance(formula, str):
            yield not_conserved(check, path, charges.get(name))
        else:
            yield conserved(check, path, charges, formula)


EXPECTED_CHARGE = Shape(EXPRESSION, _read_charge)
SECTION = declared(
    globals(),
    heading="Symmetries and conserved quantities",
    order=140,
    schema=CHARGES,
    by_default=always,
    expected=(expected_of("charges", of_known("charge", _symmetries, EXPECTED_CHARGE), compare),),
)
