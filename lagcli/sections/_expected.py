"""What `expect` may state of a section whose record has one formula for each coordinate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lagcli.expression import Expression
from lagcli.reader.schema_parts import FORMULAS
from lagcli.statements.declaration import Expected

if TYPE_CHECKING:
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.nodes import DocumentNode
    from lagcli.studies.check.expectations import Expectations, Found


def expected_by_coordinate(key: str, what: str) -> Expected:
    """Formulas by coordinate, each the same on the constraints as that of the record.

    Parameters
    ----------
    key
        Of `expect`, and of the record.
    what
        What one of them is called in a message, with {} for the coordinate.
    """

    def read(reader: ExpectReader, node: DocumentNode) -> dict[str, Expression]:
        return reader.by_coordinate(node, key, what)

    def compare(check: Expectations, section: Any, expected: Mapping[str, Expression]) -> Found:
        return check.compare_each([key], getattr(section, key), expected)

    return Expected(key=key, schema=FORMULAS, read=read, compare=compare)
