"""Each λ solved, and whether its constraint is holonomic, integrable or nonholonomic."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING, get_args

from lagcli.document import Block, Equations, Paragraph, Row
from lagcli.expression import Expression, Name
from lagcli.formatters.json_values import OR_NULL, TEXT, Object, fields_of, map_of, record_of
from lagcli.reader.scope import ANSWER
from lagcli.reader.shapes import formula, of_known
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, ConstraintKind, Multiplier, MultipliersSection
from lagcli.statements.declaration import declared
from lagcli.statements.wording import substituted

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.mechanics.stating import Stating
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements) -> MultipliersSection:
    """Those of the solved motion; None for one that redundancy leaves undetermined."""
    dynamics = statements.dynamics
    motion, kinds = statements.motion, dynamics.constraints.kinds
    equations = dynamics.constraints.equations
    if motion is None:
        solved = _abbreviated(statements, [kinds[e.name] for e in equations])
        if solved is not None:
            return solved
        statements.unsolved()
        values, verified = dynamics.determined_multipliers
    else:
        values, verified = motion.multipliers, motion.verified
    statements.note_redundant(dynamics.redundant)
    return MultipliersSection(
        multipliers={
            equation.name: Multiplier(
                symbol=equation.multiplier.name,
                value=None if value is None else statements.on_surface(value),
                kind=kinds[equation.name],
                verified=None if value is None else verified,
            )
            for equation, value in zip(equations, values, strict=True)
        },
        redundant=dynamics.redundant,
    )


def large(statements: LargeStatements) -> MultipliersSection:
    """By elimination with abbreviations; their kinds where not even that is possible."""
    form, constraints = statements.form, statements.problem.constraints
    kinds: list[ConstraintKind | None] = [
        "holonomic" if row.holonomic else None for row in form.constraints
    ]
    solved = _abbreviated(statements, kinds)
    if solved is not None:
        return solved
    statements.unsolved(statements.why_missing)
    kept = set(form.independent)
    redundant = tuple(c.name for k, c in enumerate(constraints) if k not in kept)
    statements.note_redundant(redundant)
    return MultipliersSection(
        multipliers={
            c.name: Multiplier(symbol=c.multiplier, value=None, kind=kind)
            for c, kind in zip(constraints, kinds, strict=True)
        },
        redundant=redundant,
    )


def _abbreviated(
    statements: Stating, kinds: Sequence[ConstraintKind | None]
) -> MultipliersSection | None:
    found = statements.abbreviated(lambda form: form.motion)
    if found is None:
        return None
    rows = zip(statements.problem.constraints, found.multipliers, kinds, strict=True)
    return MultipliersSection(
        multipliers={
            c.name: Multiplier(symbol=c.multiplier, value=value, kind=kind, verified="50 digits")
            for c, value, kind in rows
        }
    )


def blocks(section: MultipliersSection, _: Answers) -> Iterator[Block]:
    """lambda = … with the kind of its constraint, and how that was verified."""
    found = []
    for constraint, each in section.multipliers.items():
        note = f"{constraint}: {each.kind}"
        if each.value is not None:
            found.append(Row(Name(each.symbol), each.value, note))
        else:
            undetermined = "redundant, so not determined"
            why = undetermined if section.redundant else "not found"
            yield Paragraph((Name(each.symbol), f" ({note}): {why}."))
    if found:
        yield Equations(tuple(found))
    elif not section.multipliers:
        yield Paragraph(("There are no constraints.",))
    if section.redundant:
        yield Paragraph(("Redundant: " + ", ".join(section.redundant) + ".",))
    for level in ("exact", "50 digits"):
        symbols = [each.symbol for each in section.multipliers.values() if each.verified == level]
        all_alike = len(symbols) == len(found)
        if symbols:
            yield from substituted(level, () if all_alike else symbols)


def json(section: MultipliersSection) -> Object:
    """By constraint; one more key where some are redundant."""
    multipliers: Object = {
        constraint: fields_of(each, "symbol value kind")
        for constraint, each in section.multipliers.items()
    }
    redundant: Object = {"redundant": section.redundant} if section.redundant else {}
    return {"multipliers": multipliers, **redundant}


def compare(
    check: Expectations, section: MultipliersSection, expected: Mapping[str, Expression]
) -> Found:
    """Each is the same on the constraints."""
    found = {name: each.value for name, each in section.multipliers.items()}
    return check.compare_each(["multipliers"], found, expected)


_EXPECTED = of_known(
    "constraint", attrgetter("constraints"), formula("the expected multiplier of '{}'", ANSWER)
)
SECTION = declared(
    globals(),
    heading="Multipliers",
    order=50,
    schema=map_of(
        record_of(symbol=TEXT, value=OR_NULL, kind={"enum": [*get_args(ConstraintKind), None]})
    ),
    by_default=attrgetter("constraints"),
    abbreviated=True,
    expected=(expected_of("multipliers", _EXPECTED, compare),),
)
