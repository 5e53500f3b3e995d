"""The real forces of the constraints, and the friction that they need."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.answers import Answers
from lagcli.document import Block, Equations, Formula, Heading, Label, Paragraph, Row
from lagcli.expression import operation_count
from lagcli.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, by_name, string, strings
from lagcli.statements.declaration import Declaration, Told

if TYPE_CHECKING:
    from lagcli.mechanics.explaining.teller import Teller
    from lagcli.mechanics.statements import Statements

#: A vector whose components have so many operations in all stands within a sentence.
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
        torques = section.torques.get(name, {})
        if torques:
            note = "no point depends on it"
            yield Equations(
                tuple(Row(Label("Q", (q,)), value, note) for q, value in torques.items())
            )
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
            "torques": {
                constraint: by_name(torques) for constraint, torques in section.torques.items()
            },
            "friction_needed": [_friction_json(each) for each in section.friction_needed],
        }
    }


def _force_json(force: PointForce) -> Object:
    result: Object = {
        "constraint": force.constraint,
        "point": force.point,
        "acts_as": force.kind,
        "force": string(force.force),
        "direction": strings(force.direction),
    }
    if force.towards is not None:
        result["towards"] = force.towards or _ORIGIN
    if force.away_from is not None:
        result["away_from"] = force.away_from or _ORIGIN
    if force.allowed is not None:
        result["holds_while"] = "force >= 0" if force.allowed > 0 else "force <= 0"
    return result


def _friction_json(needed: FrictionNeeded) -> Object:
    return {
        "frictions": needed.frictions,
        "normal": needed.normal,
        "coefficient": string(needed.coefficient),
        "where": [f"{to_grammar(each)} > 0" for each in needed.where],
    }


def tell(teller: Teller, section: ForcesSection) -> Iterator[Block]:
    """From the multipliers to the forces."""
    from lagcli.mechanics.explaining.real_forces import real_forces

    return real_forces(teller, section)


SECTION = Declaration(
    name="forces",
    heading="Forces",
    order=70,
    derive=derive,
    blocks=blocks,
    json=json,
    told=Told(title="Forces", blocks=tell, order=120),
)
