"""What a body touches: the places where the gap of a one-sided contact closes.

The gap is a function of two coordinates, the place of a point another: where the gap is 0 in the
plane of the coordinates is found by `contours`, and taken to the plane of the picture.
"""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression, Name, Negative, Sum, walk
from lagcli.graph.nodes import Node
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.pictures.contours import Contours, grid, quiet
from lagcli.pictures.drawing import Piece, Point
from lagcli.pictures.points import Track
from lagcli.problem_data import Constraint, Contact, Problem

_CELLS = 120
_FULL_TURN = 3.15


def surfaces(
    problem: Problem,
    found: tuple[Track, ...],
    low: Point | tuple[float, ...],
    high: tuple[float, ...],
) -> Mapping[str, tuple[Piece, ...]]:
    """The lines of the contacts that can be drawn, by name; only in the plane."""
    if len(low) != 2:
        return {}
    return {
        contact.name: lines
        for contact in one_sided(problem)
        if (lines := _surface(problem, contact, found, low, high))
    }


def one_sided(problem: Problem) -> tuple[Constraint | Contact, ...]:
    """What can be lost and close again."""
    kept = [c for c in problem.constraints if c.holds_while is not None]
    return (*kept, *problem.contacts)


def _surface(
    problem: Problem,
    contact: Constraint | Contact,
    found: tuple[Track, ...],
    low: tuple[float, ...],
    high: tuple[float, ...],
) -> tuple[Piece, ...]:
    gap = Sum((contact.equation.left, Negative(contact.equation.right)))
    names = {c.name for c in problem.coordinates}
    in_gap = _coordinates(problem, gap, names)
    for track in found:
        in_place = sorted(_coordinates(problem, Sum(track.position), names) or ())
        if in_gap and len(in_place) == 2 and in_gap <= set(in_place) and track.axes == "xy":
            return _mapped(problem, gap, track, in_place, low, high)
    return ()


def _coordinates(problem: Problem, formula: Expression, names: set[str]) -> set[str] | None:
    """The coordinates of a formula; None where it has velocities or the time."""
    found: set[str] = set()
    pending = [formula]
    while pending:
        for node in walk(pending.pop()):
            if isinstance(node, Name):
                if node.primes or node.name == "t":
                    return None
                if node.name in problem.definitions:
                    pending.append(problem.definitions[node.name])
                elif node.name in names:
                    found.add(node.name)
    return found


def _mapped(
    problem: Problem,
    gap: Expression,
    track: Track,
    names: list[str],
    low: tuple[float, ...],
    high: tuple[float, ...],
) -> tuple[Piece, ...]:
    e = EquationsOfMotion(with_contacts(problem))
    nodes: list[Node] = [e.form.read(formula) for formula in (gap, *track.position)]
    arithmetic = Doubles()
    function = straight_line(
        [e.graph.symbol(name) for name in names],
        nodes,
        constants_of(e, nodes, arithmetic),
        arithmetic,
    )
    field = quiet(lambda a, b: float(function(a, b)[0]))
    cartesian = list(track.position) == [Name(name) for name in names]
    reach = max(abs(x) for x in (*low, *high))
    spans = (
        list(zip(low, high, strict=True))
        if cartesian
        else [_span(problem, name, reach) for name in names]
    )
    lines = Contours(field, *(grid(a, b, _CELLS) for a, b in spans)).at(0.0)
    return tuple(
        tuple((float(x), float(y)) for _, x, y in (function(*point) for point in line))
        for line in lines
    )


def _span(problem: Problem, name: str, reach: float) -> tuple[float, float]:
    """A coordinate that is no Cartesian one: an angle once round, a length as far as is seen."""
    from lagcli.pictures.labels import Labels

    coordinate = next(c for c in problem.coordinates if c.name == name)
    if Labels(problem).is_angle(Name(name)):
        return -_FULL_TURN, _FULL_TURN
    if coordinate.assume in {"positive", "nonnegative"}:
        return 1e-6 * reach, 2 * reach
    return -2 * reach, 2 * reach
