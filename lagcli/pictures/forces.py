"""The forces that are drawn as arrows: those that the file applies, and those of constraints."""

from __future__ import annotations

from lagcli.expression import Expression, Product
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.statements import Statements
from lagcli.pictures.points import Track
from lagcli.problem_data import Problem
from lagcli.record import record
from lagcli.statements.forces import ForcesSection


@record(kw_only=True)
class Arrow:
    """A force on a point, by its Cartesian components."""

    name: str
    on: str
    components: tuple[Expression, ...]


def arrows(problem: Problem, found: tuple[Track, ...]) -> tuple[Arrow, ...]:
    """The forces on the points of the file; none on points made of coordinates."""
    made = [
        Arrow(name="applied force", on=track.name, components=track.force)
        for track in found
        if track.force is not None
    ]
    if not problem.points or not problem.constraints:
        return tuple(made)
    section = Statements(Derivation(problem)).answers(["forces"]).sections["forces"]
    assert isinstance(section, ForcesSection)
    for force in section.forces or ():
        if force.force is not None:
            components = tuple(Product((force.force, e)) for e in force.direction)
            made.append(Arrow(name=force.constraint, on=force.point, components=components))
    return tuple(made)
