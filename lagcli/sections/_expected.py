"""What `expect` may state of a section whose record has one formula for each coordinate."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from itertools import starmap
from typing import TYPE_CHECKING, Any

from lagcli.expression import Expression
from lagcli.reader.schema_parts import FORMULAS
from lagcli.statements.declaration import Expected

if TYPE_CHECKING:
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.nodes import DocumentNode
    from lagcli.reader.shapes import Shape
    from lagcli.studies.check.expectations import Expectations, Found


def expected_of(
    key: str,
    shape: Shape,
    compare: Callable[[Any, Any, Any], Found],
    wanted: Callable[[Any], bool] | None = None,
) -> Expected:
    """What has a shape under a key of `expect`; see `Expected`."""

    def read(reader: ExpectReader, node: DocumentNode) -> Any:
        return shape.read(reader, node, (key,))

    return Expected(key=key, schema=shape.schema, read=read, compare=compare, wanted=wanted)


def judged(place: str) -> Callable[[Any, Any, Any], Found]:
    """Compares by the verdicts of `module:name` of `lagcli.studies.check`, imported when called."""
    module, _, name = place.partition(":")

    def compare(check: Expectations, section: Any, expected: Any) -> Found:
        verdicts = getattr(import_module(f"lagcli.studies.check.{module}"), name)
        return starmap(check.judge, verdicts(check, section, expected))

    return compare


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
