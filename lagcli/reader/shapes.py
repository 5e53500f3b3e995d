"""What may stand at a place of `expect`: its JSON Schema and how it is read, said once.

A list notes where its items stand, and a record where its keys do: a finding of `lagcli check`
names the place of what it is about.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from lagcli.reader import schema_parts
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.file_reader import YES_OR_NO
from lagcli.reader.nodes import DocumentNode, Scalar, Sequence
from lagcli.reader.schema_parts import FORMULA, FORMULAS, STABLE, TEXT, Schema, ref
from lagcli.reader.scope import Role
from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.problem_data import Inequality
    from lagcli.reader.expectations import ExpectReader

#: What the answers call the constants of separation: alpha_1, alpha_2, …
SEPARATION_NAMES = tuple(f"alpha_{number}" for number in range(1, 6))
#: What the answers call the energy and the amplitude: the first that the file does not use.
ENERGY_NAMES = ("E", "h", "E_0", "h_0")
AMPLITUDE_NAMES = ("a", "A", "a_0", "A_0")

CONSTANT_NAMES = (*ENERGY_NAMES, *AMPLITUDE_NAMES, *SEPARATION_NAMES)

REDUCED = Role(order=1, why="an answer is free of accelerations", momenta=True)
CHARGE = Role(order=1, why="an answer is free of accelerations")
PLACE = Role(order=0, why="an equilibrium is given by its coordinates")

#: Words for a stable and an unstable equilibrium.
_VERDICTS = {
    **dict.fromkeys("stable Stable True minimum center centre".split(), "yes"),
    **dict.fromkeys("unstable Unstable instable False maximum saddle".split(), "no"),
}

#: The keys that lead to a place.
Path = tuple[str, ...]


@record
class Shape:
    """What may stand at a place.

    Attributes
    ----------
    schema : mapping
        With the definitions of `lagcli.reader.schema`.
    read : function (reader, node, path) -> value
    """

    schema: Schema
    read: Callable[[ExpectReader, DocumentNode, Path], Any]


def formula(what: str, role: Role = REDUCED) -> Shape:
    """One formula, which messages call `what`, with its key in the place of braces."""

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> Any:
        return reader.file.expression(node, what.format(path[-1]), role)

    return Shape(FORMULA, read)


def formulas(what: str, role: Role = REDUCED, hint: str = "write [one, another]") -> Shape:
    """A list of formulas."""
    return list_of(formula(what, role), hint)


def by_coordinate(what: str, role: Role = REDUCED) -> Shape:
    """Formulas by coordinate, which stands for the braces in `what`."""

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> Any:
        return read_by_coordinate(reader.file, node, f"'{path[-1]}'", what, role)

    return Shape(FORMULAS, read)


def by_name(item: Shape) -> Shape:
    """By any name."""

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> dict[str, Any]:
        reader.note(node, *path)
        entries = reader.file.entries(node, f"'{path[-1]}'")
        return {key.label: item.read(reader, value, (*path, key.label)) for key, value in entries}

    return Shape(schema_parts.map_of(item.schema), read)


def of_known(kind: str, known: Callable[[ExpectReader], Iterable[str]], item: Shape) -> Shape:
    """By the names of a kind in the problem; another name is a mistake."""

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> dict[str, Any]:
        return {
            key.label: item.read(reader, value, (*path, key.label))
            for key, value in reader.known(node, path, [*known(reader)], kind)
        }

    return Shape(schema_parts.map_of(item.schema), read)


def equation(what: str, role: Role) -> Shape:
    """`left = right`, or an expression that is 0."""
    return Shape(ref("equation"), lambda reader, node, _: reader.file.equation(node, what, role))


def list_of(item: Shape, hint: str = "") -> Shape:
    """A list."""
    keys = item.schema.get("properties")

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> tuple[Any, ...]:
        found = []
        for place, each in enumerate(reader.file.items(node, f"'{path[-1]}'", hint, keys)):
            reader.spans[(*path, str(place))] = each.span
            found.append(item.read(reader, each, (*path, str(place))))
        return tuple(found)

    return Shape(schema_parts.list_of(item.schema), read)


def record_of(
    make: Callable[..., Any], what: str, needs: Mapping[str, str] | None = None, /, **parts: Shape
) -> Shape:
    """A record with these keys; `needs` has the sentence for each that must be there."""
    required = needs or {}

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> Any:
        entries = reader.file.attributes(node, what.format(*path[-1:]), parts)
        for name, sentence in required.items():
            if name not in entries:
                reader.file.error(sentence, node.span)
        found = {}
        for name, (key, value) in entries.items():
            reader.spans[(*path, name)] = key.span
            found[name] = parts[name].read(reader, value, (*path, name))
        return make(**found)

    schemas = {name: part.schema for name, part in parts.items()}
    return Shape(schema_parts.record_of(tuple(required), **schemas), read)


def one_of(words: tuple[str, ...]) -> Shape:
    """One of some words."""
    enumerated = {"enum": list(words)}
    return Shape(
        enumerated, lambda reader, node, path: reader.file.word(node, f"'{path[-1]}'", words)
    )


def with_constants(shape: Shape) -> Shape:
    """The same, where the constants of the answers may stand, such as E."""

    def read(reader: ExpectReader, node: DocumentNode, path: Path) -> Any:
        with reader.file.scope.also(CONSTANT_NAMES, "parameter"):
            return shape.read(reader, node, path)

    return Shape(shape.schema, read)


def _word(reader: ExpectReader, node: DocumentNode, path: Path) -> str | None:
    text = reader.file.scalar(node, f"'{path[-1]}'")
    return None if text is None else text.value.strip()


def _stable(
    reader: ExpectReader, node: DocumentNode, _: Path
) -> bool | tuple[Inequality, ...] | None:
    file = reader.file
    if isinstance(node, Scalar) and node.value.strip() in YES_OR_NO:
        return YES_OR_NO[node.value.strip()]
    what = "a condition of stability"
    word = node.value.strip().split()[-1:] if isinstance(node, Scalar) else []
    if word and word[0] in _VERDICTS:
        file.error("'stable' is yes, no or conditions", node.span, f"write {_VERDICTS[word[0]]}")
        return None
    items = node.items if isinstance(node, Sequence) else [node]
    read = [file.comparison(item, what, REDUCED) for item in items]
    for item, each in zip(items, read, strict=True):
        if each is not None and each.comparison not in (">", "<"):
            file.error(f"{what} has > or <", item.span)
    return tuple(each for each in read if each is not None)


STABILITY = Shape(STABLE, _stable)
WORD = Shape(TEXT, _word)
COUNT = Shape(schema_parts.COUNT, lambda reader, node, path: reader.count(node, path[-1]))
YES = Shape(
    schema_parts.YES_OR_NO, lambda reader, node, path: reader.file.yes_or_no(node, path[-1])
)
