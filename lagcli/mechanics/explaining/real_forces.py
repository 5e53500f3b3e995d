"""The step from multipliers to forces: normal force, friction, tension, and their limits."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from lagcli.document import Block, Heading, Label, equations_of
from lagcli.expression import Name, walk
from lagcli.mechanics.constraint_force import on_points
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, says, shows
from lagcli.statements.answers import Section
from lagcli.statements.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.statements.wording import constraints_named, only_along_its_path

_KINDS = {"normal": "normal force", "friction": "friction", "tension": "tension"}


def real_forces(explainer: Explainer, section: Section) -> Iterator[Block]:
    """From lambda df/dr to a signed magnitude along a unit vector."""
    found = cast(ForcesSection, section)
    if found.forces is None:
        yield says(f"These were not found: {found.reason}.")
        return
    equations = explainer.dynamics.constraints.equations
    contacts = [contact.name for contact in explainer.problem.contacts]
    if not equations:
        closed = f"only from {constraints_named('the contact', contacts)}, while closed"
        yield says(f"Forces of constraint come {closed}." if contacts
                   else "The file states no constraints. The forces that hold the system to its "
                        "coordinates do not occur in their equations.")  # fmt: skip
        return
    yield says(
        "For every displacement a constraint does the same virtual work as a force on its "
        "points: the "
        "multiplier times the gradient of the constraint with respect to the Cartesian "
        "coordinates of "
        "the point. The force is written as a magnitude with a sign, times a unit vector e."
    )
    gradients = on_points(explainer.dynamics, {e.name: e.row for e in equations})
    for equation in equations:
        forces = [each for each in found.forces if each.constraint == equation.name]
        torques = found.torques.get(equation.name, {})
        if not forces and not torques:
            continue
        kind = next((each.kind for each in forces if each.kind), None)
        yield Heading(f"{equation.name} ({_KINDS[kind]})" if kind else equation.name, 2)
        for force in forces:
            gradient = gradients.get(equation.name, {}).get(force.point, ())
            rows = zip("xyz", gradient, strict=False)
            multiplier = Name(equation.multiplier.name)
            yield says(f"On {force.point} the force has the components")
            yield equations_of(
                (
                    Label("F", (force.point, axis)),
                    explainer.readable.on_surface(equation.multiplier * slope),
                )
                for axis, slope in rows
                if axis not in force.fixed
            )
            yield from _magnitude(force, multiplier)
            yield from only_along_its_path(force.point, force.fixed)
        if torques:
            yield says("Along an angle on which no point depends it acts as a torque:")
            yield equations_of((Label("Q", (q,)), value) for q, value in torques.items())
    for needed in found.friction_needed:
        yield from _friction(explainer, needed)


def _magnitude(force: PointForce, multiplier: Name) -> Iterator[Block]:
    F = Label("F", (force.point,))
    if force.force is None:
        yield says("The constraints are redundant, so ", multiplier, " is not determined.")
        return
    where = "."
    if force.allowed is not None:
        pushes = "string pulls" if force.kind == "tension" else "contact pushes"
        where = f", in the direction in which the {pushes}," if force.allowed > 0 else "."
    if force.towards is not None:
        where = f" towards {force.towards or 'the origin'}"
    elif force.away_from is not None:
        where = f" away from {force.away_from or 'the origin'}"
    yield says("Its unit vector", f"{where.rstrip('.')} is" if where != "." else " is")
    yield equations_of(
        (Label("e", (axis,)), part) for axis, part in zip("xyz", force.direction, strict=False)
    )
    yield says("With the value of ", multiplier, ", the force along it is")
    yield shows(F, force.force)
    if force.allowed is not None:
        bound = " ≥ 0." if force.allowed > 0 else " ≤ 0."
        taut = force.kind == "tension"
        yield says("It can only pull: it is taut while " if taut else
                   "The contact is one-sided: it holds while ", F, bound)  # fmt: skip
    elif force.kind == "tension" and force.towards is not None:
        yield says("It is a pull where this is positive, a push where it is negative.")


def _friction(explainer: Explainer, needed: FrictionNeeded) -> Iterator[Block]:
    frictions = " and ".join(needed.frictions)
    yield Heading(f"The coefficient of friction of {frictions}", 2)
    if needed.coefficient is None:
        yield says(f"This was not found: {needed.reason}.")
        return
    several = len(needed.frictions) > 1
    yield says(
        "Static friction is at most its coefficient times the normal force. There is no slipping "
        "while the coefficient is at least the magnitude of ",
        f"the sum of {frictions}" if several else frictions,
        f" divided by that of {needed.normal}:",
    )
    yield shows(Label("mu", ("min",)), needed.coefficient)
    parts: list[Part] = []
    for position, positive in enumerate(needed.where):
        parts += [" and " if position else "This form holds where ", positive, " > 0"]
    if parts:
        yield says(*parts, ".")
    if _leaves(explainer, needed):
        yield says(f"Where {needed.normal} vanishes and {frictions} does not, it is infinite: the "
                   "slipping begins before the contact is lost.")  # fmt: skip


def _leaves(explainer: Explainer, needed: FrictionNeeded) -> bool:
    """Whether the normal force is one-sided and |F|/N depends on the state."""
    one_sided = any(
        c.name == needed.normal and c.holds_while for c in explainer.problem.constraints
    )
    assert needed.coefficient is not None
    state = {node.name for node in walk(needed.coefficient) if isinstance(node, Name)}
    return one_sided and not state.isdisjoint(explainer.system.names)
