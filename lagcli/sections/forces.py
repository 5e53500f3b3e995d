"""The force of each constraint on each point, torques, and the friction that is needed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Formula, Heading, Label, Paragraph, Row, equations_of
from lagcli.expression import Call, Expression, Product, operation_count, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, fields_of, plain
from lagcli.reader.nodes import DocumentNode, Sequence
from lagcli.reader.schema_parts import FORMULA, list_of
from lagcli.reader.scope import ANSWER
from lagcli.reader.shapes import Shape, formula, of_known
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.statements.wording import only_along_its_path

if TYPE_CHECKING:
    from lagcli.mechanics.statements import Statements
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.shapes import Path
    from lagcli.studies.check.expectations import Expectations, Found

#: The most operations that the components of a vector within a sentence have in all.
_SHORT = 9

_ORIGIN = "origin"
_KINDS = {"normal": "normal force", "friction": "friction", "tension": "tension"}


def derive(statements: Statements) -> ForcesSection:
    """The force of each constraint on each point, as a vector."""
    from lagcli.mechanics.real_forces import RealForces

    real = RealForces(statements.dynamics)
    section = real.section()
    statements.warnings.extend(real.warnings)
    return statements.noted((section, real.missing))


def blocks(section: ForcesSection, _: Answers) -> Iterator[Block]:
    """Say each force with its direction, by constraint, then the friction needed."""
    if section.forces is None:
        yield Paragraph((f"Not found: {section.reason}.",))
        return
    names = dict.fromkeys([each.constraint for each in section.forces])
    names.update(dict.fromkeys(section.torques))
    if not names:
        yield Paragraph(("There are no constraints.",))
    for name in names:
        forces = [each for each in section.forces if each.constraint == name]
        kind = forces[0].kind if forces else None
        yield Heading(f"{name} ({_KINDS[kind]})" if kind else name, 2)
        for force in forces:
            yield from _force(force)
            yield from only_along_its_path(force.point, force.fixed)
        torques = section.torques.get(name, {})
        if torques:
            note = "no point depends on it"
            yield equations_of((Label("Q", (q,)), value, note) for q, value in torques.items())
    for needed in section.friction_needed:
        yield from _friction(needed)


def _force(force: PointForce) -> Iterator[Block]:
    magnitude = Label("F", (force.point,))
    if force.force is None:
        yield Paragraph((magnitude, ": redundant, so not determined."))
        return
    yield Equations((Row(magnitude, force.force),))
    parts: list[str | Formula] = ["On ", f"{force.point}, "]
    if sum(map(operation_count, force.direction)) <= _SHORT:
        parts += ["along ("]
        for place, component in enumerate(force.direction):
            parts += [", " if place else "", component]
        parts += [")"]
    else:
        parts += ["along the unit vector below"]
    yield Paragraph((*parts, *_sense(force, magnitude)))
    if parts[-1] != ")":
        unit = tuple(
            Row(Label("e", (axis,)), component)
            for axis, component in zip("xyz", force.direction, strict=False)
        )
        yield Equations(unit)


def _sense(force: PointForce, magnitude: Label) -> tuple[str | Formula, ...]:
    """Where the unit vector points, and what the sign of the force says."""
    where = ""
    if force.towards is not None:
        where = f", towards {force.towards or 'the origin'}"
    elif force.away_from is not None:
        where = f", away from {force.away_from or 'the origin'}"
    words: list[str | Formula] = [where]
    if force.allowed is not None:
        taut = force.kind == "tension"
        words += ["; it is taut while " if taut else "; the contact lasts while ", magnitude]
        words += [" is not negative." if force.allowed > 0 else " is not positive."]
    elif force.kind == "tension" and force.towards is not None:
        words += [": a pull where ", magnitude, " is positive, a push where it is negative."]
    else:
        words += ["."]
    return tuple(words)


def _friction(needed: FrictionNeeded) -> Iterator[Block]:
    names = " and ".join(needed.frictions)
    yield Heading(f"Coefficient of friction for {names}", 2)
    if needed.coefficient is None:
        yield Paragraph((f"Not found: {needed.reason}.",))
        return
    yield Equations((Row(Label("mu", ("min",)), needed.coefficient),))
    words: list[str | Formula] = [
        f"The least coefficient of static friction: |{names}| / |{needed.normal}|"
    ]
    for position, positive in enumerate(needed.where):
        words += [" and " if position else ", where ", positive, " > 0"]
    yield Paragraph((*words, "."))


def json(section: ForcesSection) -> Object:
    """Null where they were not found."""
    if section.forces is None:
        return {"forces": None}
    return {
        "forces": {
            "on_points": [_force_json(each) for each in section.forces],
            "torques": plain(section.torques),
            "friction_needed": [_friction_json(each) for each in section.friction_needed],
        }
    }


def _force_json(force: PointForce) -> Object:
    result = fields_of(force, "constraint point") | {"acts_as": force.kind}
    result |= fields_of(force, "force direction")
    if force.towards is not None:
        result["towards"] = force.towards or _ORIGIN
    if force.away_from is not None:
        result["away_from"] = force.away_from or _ORIGIN
    if force.allowed is not None:
        result["holds_while"] = "force >= 0" if force.allowed > 0 else "force <= 0"
    return result


def _friction_json(needed: FrictionNeeded) -> Object:
    where = [f"{to_grammar(each)} > 0" for each in needed.where]
    return fields_of(needed, "frictions normal coefficient") | {"where": where}


def _read_force(
    reader: ExpectReader, node: DocumentNode, path: Path
) -> Expression | tuple[Expression, ...]:
    """The signed force, or a list of components."""
    what = f"the expected force of '{path[-2]}' on '{path[-1]}'"
    if not isinstance(node, Sequence):
        return reader.file.expression(node, what, ANSWER)
    return tuple(reader.file.expression(item, what, ANSWER) for item in node.items)


def compare(
    check: Expectations,
    section: ForcesSection,
    expected: Mapping[str, Mapping[str, Expression | tuple[Expression, ...]]],
) -> Found:
    """Each signed force or component is the same on the constraints."""
    found = {(each.constraint, each.point): each for each in section.forces or ()}
    for constraint, by_point in expected.items():
        for point, force in by_point.items():
            path = ["forces", constraint, point]
            yield from _compared(check, path, found.get((constraint, point)), force)


def _compared(
    check: Expectations,
    path: list[str],
    found: PointForce | None,
    expected: Expression | tuple[Expression, ...],
) -> Found:
    force = None if found is None else found.force
    if not isinstance(expected, tuple):
        yield check.compare(path, force, expected)
        return
    for place, component in enumerate(expected):
        product = None
        if found is not None and force is not None and len(found.direction) == len(expected):
            product = Product((force, found.direction[place]))
        yield check.compare([*path, "xyz"[place]], product, component)


def compare_friction(
    check: Expectations, section: ForcesSection, expected: Mapping[str, Expression]
) -> Found:
    """Each coefficient is the same, its modulus where the file states that."""
    needed = {each.normal: each for each in section.friction_needed}
    for normal, wanted in expected.items():
        each = needed.get(normal)
        size = None if each is None else each.coefficient
        modulus = any(isinstance(n, Call) and n.function == "abs" for n in walk(wanted))
        if each is not None and each.where and size is not None and modulus:
            size = Call("abs", (size,))
        yield check.compare(["friction_needed", normal], size, wanted)


_CONSTRAINTS = attrgetter("constraints")
_FORCE = Shape({"anyOf": [FORMULA, list_of(FORMULA)]}, _read_force)
_EXPECTED = of_known("constraint", _CONSTRAINTS, of_known("point", attrgetter("points"), _FORCE))
_FRICTION = formula("the expected coefficient of friction at '{}'", ANSWER)
SECTION = declared(
    globals(),
    heading="Forces",
    order=70,
    explained=Explained(title="Forces", blocks=step("real_forces:real_forces"), order=120),
    expected=(
        expected_of("forces", _EXPECTED, compare),
        expected_of(
            "friction_needed", of_known("constraint", _CONSTRAINTS, _FRICTION), compare_friction
        ),
    ),
)
