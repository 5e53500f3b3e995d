"""The symmetries of the file and the evident ones, with their conserved quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Heading, Label, Paragraph, Row
from lagcli.expression import ZERO, Expression
from lagcli.formatters.json_values import (
    FORMULA,
    OR_NULL,
    Object,
    by_name,
    inequalities,
    map_of,
    record_of,
    string,
)
from lagcli.letters import own
from lagcli.problem_data import NOT_CONSERVED
from lagcli.reader.nodes import DocumentNode, Scalar
from lagcli.reader.schema_parts import FORMULAS
from lagcli.reader.scope import ANSWER
from lagcli.statements.answers import Answers, Charge, ChargesSection
from lagcli.statements.declaration import Declaration, Expected, always
from lagcli.statements.wording import conditions

if TYPE_CHECKING:
    from lagcli.mechanics.large_charges import LargeCharge
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.noether import NoetherCharge
    from lagcli.mechanics.statements import Statements
    from lagcli.reader.expectations import ExpectReader
    from lagcli.studies.check.expectations import Expectations, Found

_SOURCES = {
    "candidate": "candidate",
    "cyclic": "cyclic coordinate",
    "time": "translation in time",
    "discovered": "discovered",
    "momentum equation": "momentum equation",
}

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
    from lagcli.mechanics.impacts import between_impacts
    from lagcli.mechanics.real_forces import UNSOLVED

    if charge.conserved is None:
        why = charge.broken_by or "its rate needs the solved motion"
        statements.lacks(f"whether '{charge.name}' is conserved", why)
    elif charge.conserved is False and charge.rate is None:
        statements.warnings.append(f"the rate of '{charge.name}' has no formula: {UNSOLVED}")
    statements.note_check(f"the rate of '{charge.name}'", charge.verified)
    system, change = statements.system, charge.transformation
    named = dict(zip(system.names, change.changes, strict=True)) | {"t": change.time}
    timed = charge.source == "time"
    function = statements.derivation.energy.readable_function if timed else charge.charge
    return Charge(
        name=charge.name,
        source=charge.source,
        transformation={
            name: statements.as_written(each) for name, each in named.items() if each != 0
        },
        gauge=None if charge.gauge is None else statements.as_written(charge.gauge),
        conserved=charge.conserved,
        charge=statements.by_terms(function, as_given=timed) if charge.complete else None,
        rate=None if charge.rate is None else statements.on_surface(charge.rate),
        verified=charge.verified,
        broken_by=charge.broken_by,
        when=between_impacts(system, change.changes, change.time, charge.gauge)
        if charge.conserved
        else "",
    )


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


def blocks(section: ChargesSection, _: Answers) -> Iterator[Block]:
    """Say what each symmetry changes, its gauge, its charge, and whether that is conserved."""
    if not section.charges:
        yield Paragraph(("None." if section.sought else "Not found.",))
    for charge in section.charges:
        yield Heading(f"{charge.name} ({_SOURCES[charge.source]})", 2)
        rows = [
            Row(Label(name, change=True), change) for name, change in charge.transformation.items()
        ]
        if charge.gauge is not None and charge.gauge != ZERO:
            rows.append(Row(Label("G"), charge.gauge, "gauge"))
        if charge.charge is not None:
            rows.append(Row(Label("Q"), charge.charge))
        if charge.rate is not None and not charge.conserved:
            rows.append(Row(own("Q", 1), charge.rate))
        if rows:
            yield Equations(tuple(rows))
        yield Paragraph((_verdict(charge),))
        if charge.where:
            rest = "; elsewhere its real and its imaginary part are conserved."
            yield Paragraph(("Real where ", *conditions(charge.where), rest))


def _verdict(charge: Charge) -> str:
    checked = _CHECKED[charge.verified]
    if charge.conserved:
        when = f" {charge.when}" if charge.when else ""
        return f"Conserved{when}: dQ/dt = 0 on the motion{checked}."
    if charge.conserved is None:
        words = "Whether it is conserved is undecided"
        return f"{words}: {charge.broken_by}." if charge.broken_by else f"{words}."
    if charge.source == "momentum equation":
        return f"Not conserved: its rate is the momentum equation{checked}."
    words = f"Not conserved{checked}"
    return f"{words}, because of {charge.broken_by}." if charge.broken_by else f"{words}."


def charges_json(section: ChargesSection) -> list[Object] | None:
    """The list of charges; null where the search found none and did not come to its end."""
    return [_charge(each) for each in section.charges] if section.sought else None


def _charge(charge: Charge) -> Object:
    where: Object = {"where": inequalities(charge.where)} if charge.where else {}
    return where | {
        "name": charge.name,
        "source": charge.source,
        "transformation": by_name(charge.transformation),
        "gauge": string(charge.gauge),
        "conserved": charge.conserved,
        "charge": string(charge.charge),
        "rate": string(charge.rate),
    }


def json(section: ChargesSection) -> Object:
    """The list of charges."""
    return {"charges": charges_json(section)}


#: A list of charges as JSON Schema.
CHARGES = {
    "type": ["array", "null"],
    "items": record_of(
        ("name", "source", "transformation", "gauge", "conserved", "charge", "rate"),
        {
            "name": {"type": "string"},
            "source": {"type": "string"},
            "transformation": map_of(FORMULA, null=False),
            "gauge": OR_NULL,
            "conserved": {"type": ["boolean", "null"]},
            "charge": OR_NULL,
            "rate": OR_NULL,
        },
    ),
}


def read(reader: ExpectReader, node: DocumentNode) -> dict[str, Expression | str]:
    """Formulas by symmetry, or `not conserved`."""
    momenta = [f"p_{name}" for name in reader.sections.scope.of_kind("coordinate")]
    known = [*reader.symmetries, "energy", *momenta]
    entries = reader.known(node, "charges", known, "charge")
    return {key.label: read_charge(reader, key, value) for key, value in entries}


def read_charge(reader: ExpectReader, key: Scalar, value: DocumentNode) -> Expression | str:
    """One formula, or `not conserved`."""
    if isinstance(value, Scalar) and " ".join(value.value.split()) == NOT_CONSERVED:
        return NOT_CONSERVED
    return reader.sections.expression(value, f"the expected charge '{key.label}'", ANSWER)


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


SECTION = Declaration(
    name="charges",
    heading="Symmetries and conserved quantities",
    order=140,
    derive=derive,
    blocks=blocks,
    json=json,
    large=large,
    schema=CHARGES,
    unasked=always,
    expected=(Expected(key="charges", schema=FORMULAS, read=read, compare=compare),),
)
