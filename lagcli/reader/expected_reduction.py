"""The expectations of the sections that name constants of their own."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from lagcli.problem import ExpectReduction
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.nodes import Node
from lagcli.reader.scope import Role

if TYPE_CHECKING:
    from lagcli.diagnostics import Span
    from lagcli.expression import Expression
    from lagcli.reader.sections import Sections

#: What the answers call the energy and the amplitude: the first that the file does not use.
ENERGY_NAMES = ("E", "h", "E_0", "h_0")
AMPLITUDE_NAMES = ("a", "A", "a_0", "A_0")

_REDUCED = Role(order=1, why="an answer is free of accelerations", momenta=True)
_KEYS = ("routhian", "effective_potential", "reconstruction", "turning_points", "period")


@contextmanager
def constants(sections: Sections) -> Iterator[None]:
    """Let the constants of the answers stand in expressions, where the file has no such name."""
    kinds = sections.scope.kinds
    added = [name for name in (*ENERGY_NAMES, *AMPLITUDE_NAMES) if name not in kinds]
    kinds.update(dict.fromkeys(added, "parameter"))
    try:
        yield
    finally:
        for name in added:
            del kinds[name]


def read_reduction(
    sections: Sections, node: Node, spans: dict[tuple[str, ...], Span]
) -> ExpectReduction:
    """`expect: {reduction: {routhian, effective_potential, …}}`."""
    found: dict[str, Any] = {}
    with constants(sections):
        entries = sections.attributes(node, "'reduction'", _KEYS)
        for name, (key, value) in entries.items():
            spans["reduction", name] = key.span
            what = f"the expected {name.replace('_', ' ')}"
            match name:
                case "reconstruction":
                    what = "the expected velocity of '{}'"
                    found[name] = read_by_coordinate(sections, value, f"'{name}'", what, _REDUCED)
                case "turning_points":
                    found[name] = expressions(sections, value, name, what)
                case _:
                    found[name] = sections.expression(value, what, _REDUCED)
    return ExpectReduction(**found)


def expressions(sections: Sections, node: Node, name: str, what: str) -> tuple[Expression, ...]:
    """A list of expressions."""
    items = sections.items(node, f"'{name}'", "write [one, another]")
    return tuple(sections.expression(item, what, _REDUCED) for item in items)
