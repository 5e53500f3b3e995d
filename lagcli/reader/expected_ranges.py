"""The known answers to questions for which values of a parameter something is so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.reader.nodes import DocumentNode, Sequence
from lagcli.reader.scope import CONSTANTS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from lagcli.expression import Name
    from lagcli.problem_data import Inequality
    from lagcli.reader.file_reader import FileReader


def read_ranges(
    file: FileReader, items: Iterable[DocumentNode], unknown: Name, what: str
) -> tuple[tuple[Inequality, ...], ...]:
    """`[v <= a, [v > b, v < c]]`: each item one range, by one bound or a list of them."""
    return tuple(
        tuple(
            bound
            for each in (item.items if isinstance(item, Sequence) else [item])
            if (bound := _bound(file, each, unknown, what)) is not None
        )
        for item in items
    )


def _bound(file: FileReader, node: DocumentNode, unknown: Name, what: str) -> Inequality | None:
    bound = file.comparison(node, what, CONSTANTS)
    if bound is not None and bound.left != unknown:
        file.error(f"{what} is a bound of {unknown}", node.span, f"write {unknown} >= 0")
        return None
    return bound
