"""What is expected of `algebra`: the Lie algebra, the counts, special values of parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lagcli.problem_data import ExpectAlgebra, ExpectSpecial
from lagcli.reader.nodes import DocumentNode
from lagcli.reader.scope import CONSTANTS, Role

if TYPE_CHECKING:
    from lagcli.reader.expectations import ExpectReader

_COUNTS = ("dimension", "independent", "in_involution")
_KEYS = (*_COUNTS, "name", "integrable", "special")
_SPECIAL = ("where", "charges", "discovered")
_CHARGE = Role(order=1, why="an answer is free of accelerations")


def read_algebra(reader: ExpectReader, node: DocumentNode) -> ExpectAlgebra:
    """`expect: {algebra: {dimension, name, independent, in_involution, integrable, special}}`."""
    sections, spans = reader.sections, reader.spans
    found: dict[str, Any] = {}
    for name, (key, value) in sections.attributes(node, "'algebra'", _KEYS).items():
        spans["algebra", name] = key.span
        if name in _COUNTS:
            found[name] = reader.count(value, name)
        elif name == "special":
            items = sections.items(value, "'special'", "write [] where there are none")
            found[name] = tuple(
                _special(reader, item, ("algebra", name, str(place)))
                for place, item in enumerate(items)
            )
        elif name == "integrable":
            found[name] = sections.yes_or_no(value, name)
        elif (text := sections.scalar(value, f"'{name}'")) is not None:
            found[name] = text.value.strip()
    return ExpectAlgebra(**found)


def _special(reader: ExpectReader, node: DocumentNode, path: tuple[str, ...]) -> ExpectSpecial:
    """`{where: n = -1, charges: 4, discovered: {name: charge}}`."""
    sections, spans = reader.sections, reader.spans
    spans[path] = node.span
    found: dict[str, Any] = {}
    entries = sections.attributes(node, "a special value", _SPECIAL)
    if "where" not in entries:
        sections.error("a special value needs 'where', such as where: n = -1", node.span)
    for name, (key, value) in entries.items():
        spans[(*path, name)] = key.span
        if name == "where":
            found[name] = sections.equation(value, "the special value", CONSTANTS)
        elif name == "charges":
            found[name] = reader.count(value, name)
        else:
            found[name] = {}
            for label, charge in sections.entries(value, "'discovered'"):
                spans[(*path, name, label.label)] = label.span
                what = f"the expected charge '{label.label}'"
                found[name][label.label] = sections.expression(charge, what, _CHARGE)
    return ExpectSpecial(**found)
