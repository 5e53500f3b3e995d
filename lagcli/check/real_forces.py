"""What is expected of the forces on the points against what was derived."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import cast

from lagcli.answers import Answers
from lagcli.expression import Call, Expression, Product, walk
from lagcli.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.problem import Expect

#: The path of an expectation, what was derived and what was expected.
Pair = tuple[list[str], Expression | None, Expression]


def expected_forces(expect: Expect, answers: Answers) -> Iterator[Pair]:
    """Each signed force or component, and each coefficient of friction, with its expectation."""
    if not expect.forces and not expect.friction_needed:
        return
    section = cast(ForcesSection, answers.sections["forces"])
    found = {(each.constraint, each.point): each for each in section.forces or ()}
    for constraint, by_point in expect.forces.items():
        for point, expected in by_point.items():
            path = ["forces", constraint, point]
            yield from _of_force(path, found.get((constraint, point)), expected)
    needed: Mapping[str | None, FrictionNeeded] = {
        each.normal: each for each in section.friction_needed
    }
    for normal, expected_size in expect.friction_needed.items():
        each = needed.get(normal)
        size = None if each is None else each.coefficient
        if each is not None and each.where and size is not None and _has_modulus(expected_size):
            size = Call("abs", (size,))
        yield ["friction_needed", normal], size, expected_size


def _has_modulus(expression: Expression) -> bool:
    return any(isinstance(node, Call) and node.function == "abs" for node in walk(expression))


def _of_force(
    path: list[str], force: PointForce | None, expected: Expression | tuple[Expression, ...]
) -> Iterator[Pair]:
    if not isinstance(expected, tuple):
        yield path, None if force is None else force.force, expected
        return
    known = force is not None and force.force is not None and len(force.direction) == len(expected)
    for place, component in enumerate(expected):
        if not known or force is None or force.force is None:
            yield [*path, "xyz"[place]], None, component
        else:
            product = Product((force.force, force.direction[place]))
            yield [*path, "xyz"[place]], product, component
