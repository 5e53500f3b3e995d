"""λ ∂f/∂q along each coordinate, their sum, and the force on each point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Heading, Label, Paragraph, Row, equations_of
from lagcli.expression import ZERO, Expression
from lagcli.formatters.json_values import Object, map_of, plain
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.schema_parts import FORMULAS
from lagcli.reader.schema_parts import map_of as names_to
from lagcli.reader.scope import ANSWER
from lagcli.statements.answers import Answers, ConstraintForcesSection
from lagcli.statements.declaration import Expected, declared
from lagcli.statements.wording import only_along_its_path

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.mechanics.stating import Stating
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.nodes import DocumentNode
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements) -> ConstraintForcesSection:
    """Those of the solved motion, also where redundancy leaves single ones undetermined."""
    from lagcli.mechanics.constraint_force import fixed_axes, forces_on_points

    dynamics = statements.dynamics
    equations = dynamics.constraints.equations
    if statements.motion is None and equations:
        found = _abbreviated(statements)
        if found is not None:
            if dynamics.system.particles:
                from lagcli.mechanics.real_forces import UNSOLVED

                statements.warnings.append(f"the forces on the points have no formulas: {UNSOLVED}")
            return found
        statements.unsolved()
    total = dynamics.total_constraint_force
    return ConstraintForcesSection(
        forces={
            equation.name: None if force is None else statements.by_coordinate(force)
            for equation, force in zip(equations, dynamics.constraint_forces, strict=True)
        },
        total=None if total is None else statements.by_coordinate(total),
        on_points={
            constraint: {
                point: tuple(
                    None if axis in fixed_axes(dynamics, point) else statements.on_surface(part)
                    for axis, part in zip("xyz", components, strict=False)
                )
                for point, components in points.items()
            }
            for constraint, points in forces_on_points(dynamics).items()
        },
    )


def large(statements: LargeStatements) -> ConstraintForcesSection:
    """By elimination with abbreviations."""
    constraints = statements.problem.constraints
    if constraints:
        found = _abbreviated(statements)
        if found is not None:
            return found
        statements.unsolved(statements.why_missing)
    return ConstraintForcesSection(forces={c.name: None for c in constraints}, total=None)


def _abbreviated(statements: Stating) -> ConstraintForcesSection | None:
    found = statements.abbreviated(lambda form: form.constraint_forces)
    if found is None:
        return None
    names = [q.name for q in statements.problem.coordinates]
    count = len(names)
    rows = [
        dict(zip(names, found.values[k : k + count], strict=True))
        for k in range(0, len(found.values), count)
    ]
    *single, total = rows
    return ConstraintForcesSection(
        forces=dict(zip((c.name for c in statements.problem.constraints), single, strict=True)),
        total=total,
    )


def blocks(section: ConstraintForcesSection, _: Answers) -> Iterator[Block]:
    """By constraint, then the total."""
    if not section.forces:
        yield Paragraph(("There are no constraints.",))
    for constraint, forces in section.forces.items():
        yield Heading(constraint, 2)
        if forces is None or None in forces.values():
            yield Paragraph(("Not determined.",))
        else:
            yield _forces({name: each for name, each in forces.items() if each is not None})
        for point, components in (section.on_points or {}).get(constraint, {}).items():
            along = dict(zip("xyz", components, strict=False))
            known = {
                part: Label("Q", (name,))
                for name, part in (forces or {}).items()
                if part not in (None, ZERO)
            }
            yield equations_of(
                (Label("F", (point, axis)), known.get(part, part), "force on the point")
                for axis, part in along.items()
                if part is not None
            )
            yield from only_along_its_path(point, [axis for axis in along if along[axis] is None])
    if section.total is not None and len(section.forces) > 1:
        yield Heading("All constraints together", 2)
        yield _forces(section.total)


def _forces(forces: Mapping[str, Expression]) -> Equations:
    """The components that are not 0; one 0 where all are."""
    rows = [Row(Label("Q", (name,)), force) for name, force in forces.items() if force != ZERO]
    return Equations(tuple(rows) or (Row(Label("Q"), ZERO),))


def json(section: ConstraintForcesSection) -> Object:
    """By constraint; the total and the forces on points have keys of their own."""
    result: Object = {"constraint_forces": plain(section.forces)}
    if section.forces:
        result["total_constraint_force"] = plain(section.total)
    if section.on_points:
        result["point_forces"] = plain(section.on_points)
    return result


def read(reader: ExpectReader, node: DocumentNode) -> dict[str, dict[str, Expression]]:
    """Formulas by constraint and coordinate."""
    found = {}
    for key, value in reader.known(node, ("constraint_forces",), reader.constraints, "constraint"):
        what = f"the expected force of '{key.label}' along '{{}}'"  # no braces in a name
        forces = read_by_coordinate(reader.file, value, f"'{key.label}'", what, ANSWER)
        found[key.label] = forces
        reader.note(value, "constraint_forces", key.label)
    return found


def compare(
    check: Expectations,
    section: ConstraintForcesSection,
    expected: Mapping[str, Mapping[str, Expression]],
) -> Found:
    """Each is the same on the constraints."""
    for name, forces in expected.items():
        path = ["constraint_forces", name]
        yield from check.compare_each(path, section.forces.get(name), forces)


SECTION = declared(
    globals(),
    heading="Constraint forces",
    order=60,
    schema=map_of({"type": ["object", "null"]}),
    by_default=attrgetter("constraints"),
    content="forces",
    abbreviated=True,
    expected=(
        Expected(key="constraint_forces", schema=names_to(FORMULAS), read=read, compare=compare),
    ),
)
