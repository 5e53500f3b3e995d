"""What an editor shows: mistakes, what may stand here, what stands here.

Lines and columns count from 0, columns in characters, as editors with UTF-32 positions have them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from lagcli.diagnostics import Diagnostic, ProblemError, Source
from lagcli.expression import FUNCTIONS, Expression, Number
from lagcli.reader import parse_text, read_problem
from lagcli.reader.compose import compose
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.schema import problem_schema
from lagcli.reader.text import Mistake, SourceText
from lagcli.record import record
from lagcli.rewriting import rebuilt

#: The keys whose entries have names that a formula may use.
_NAMED = ("coordinates", "parameters", "definitions", "functions", "observables")
_KEY = re.compile(r"^(\s*)([^\s:#{}\[\],-][^:#]*?)\s*:(\s|$)")
#: The end of `{unit: m, as` and of `{assume: po`.
_FLOW_KEY = re.compile(r"[{,]\s*[\w']*$")
_FLOW_VALUE = re.compile(r"[{,]\s*([\w']+):[^,{}]*$")
_WORD = re.compile(r"[^\W\d]\w*'*")


@record
class Suggestion:
    """One completion: what is put in, and what it is."""

    text: str
    detail: str
    is_key: bool = False


def mistakes(name: str, text: str) -> tuple[Diagnostic, ...]:
    """All mistakes of a file, as the command line shows them."""
    return tuple(read_problem(name, text.encode("utf-8", "replace")).diagnostics)


# -- completion ----------------------------------------------------------------------------------


def suggestions(text: str, line: int, column: int) -> list[Suggestion]:
    """What may stand at a place: keys of the format, its words, or names of the file."""
    lines = text.split("\n")
    before = lines[line][:column]
    path = _path(lines, line)
    is_key = True
    if ":" in before:
        path, is_key = _within_line(path, before)
    elif before.lstrip().startswith("- "):
        is_key = False
    part = _under(problem_schema(), path)
    found = _keys(part, _nodes(lines, line), path) if is_key else _words(part)
    return found or _names(lines, line)


def _within_line(path: list[str], before: str) -> tuple[list[str], bool]:
    """The keys up to the end of a line such as `m: {assume: `, and whether one is begun there."""
    key, _, rest = before.partition(":")
    path = [*path, key.strip().lstrip("- ")]
    if _FLOW_KEY.search(rest):
        return path, True
    inner = _FLOW_VALUE.search(rest)
    return ([*path, inner[1]] if inner else path), False


def _path(lines: list[str], line: int) -> list[str]:
    """The keys under which a line stands, by its indentation."""
    depth = len(lines[line]) - len(lines[line].lstrip())
    found: list[str] = []
    for above in reversed(lines[:line]):
        match = _KEY.match(above)
        if match and len(match[1]) < depth:
            found.insert(0, match[2])
            depth = len(match[1])
    return found


def _under(schema: dict[str, Any], path: list[str]) -> dict[str, Any]:
    """The part of the schema for what stands under a path of keys."""
    part = _resolved(schema, schema)
    for key in path:
        part = part.get("properties", {}).get(key) or part.get("additionalProperties") or {}
        part = _resolved(part, schema)
    return part


def _resolved(part: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """A part with its references put in, all alternatives together."""
    made: dict[str, Any] = {}
    parts: list[Any] = [part]
    while parts:
        each = parts.pop(0)
        if not isinstance(each, dict):  # `additionalProperties: false`
            continue
        if "$ref" in each:
            parts.append(schema["definitions"][each["$ref"].rpartition("/")[2]])
        parts += each.get("allOf", []) + each.get("anyOf", [])
        for key in ("properties", "additionalProperties", "enum", "description"):
            if each.get(key):
                made.setdefault(key, each[key])
    return made


def _keys(part: dict[str, Any], root: DocumentNode | None, path: list[str]) -> list[Suggestion]:
    """The keys of the format, and where those are names of the file, the coordinates."""
    found = [
        Suggestion(key, str(value.get("description", "")), is_key=True)
        for key, value in part.get("properties", {}).items()
    ]
    if not found and path and path[0] in ("forces", "initial", "symmetries"):
        found = [Suggestion(name, "coordinate", is_key=True) for name in _of(root, "coordinates")]
    return found


def _words(part: dict[str, Any]) -> list[Suggestion]:
    return [Suggestion(word, "") for word in part.get("enum", []) if isinstance(word, str)]


def _names(lines: list[str], line: int) -> list[Suggestion]:
    """The names of the file and the functions of the format."""
    root = _nodes(lines, line)
    found = []
    for key in _NAMED:
        for name in _of(root, key):
            found.append(Suggestion(name, key.removesuffix("s")))
            if key == "coordinates":
                found.append(Suggestion(f"{name}'", "velocity"))
    return [*found, *(Suggestion(name, "function") for name in FUNCTIONS), Suggestion("pi", "")]


def _nodes(lines: list[str], without: int) -> DocumentNode | None:
    """The document, without the line that is being written."""
    kept = [each if k != without else "" for k, each in enumerate(lines)]
    return _composed("\n".join(kept))


def _composed(text: str) -> DocumentNode | None:
    try:
        return compose(SourceText.of(Source("", text.encode("utf-8", "replace").decode())))[0]
    except Mistake:
        return None


def _of(root: DocumentNode | None, key: str) -> list[str]:
    """The names under a key, which has a map or a list."""
    match _entry(root, key):
        case Mapping(entries=entries):
            return [name.label for name, _ in entries]
        case Sequence(items=items):
            return [item.label for item in items if isinstance(item, Scalar)]
    return []


def _entry(root: DocumentNode | None, key: str) -> DocumentNode | None:
    entries = root.entries if isinstance(root, Mapping) else []
    return next((value for name, value in entries if name.label == key), None)


# -- hover ---------------------------------------------------------------------------------------


def hover(text: str, line: int, column: int) -> str | None:
    """What stands at a place, in Markdown: a key's meaning, a name's, a formula as printed."""
    root = _composed(text)
    if root is None:
        return None
    source = SourceText.of(Source("", text))
    if line >= len(source.line_starts):
        return None
    offset = source.line_starts[line] + column
    for path, node, is_key in _walk(root, ()):
        if node.start <= offset < node.end and isinstance(node, Scalar):
            if is_key:
                part = _under(problem_schema(), [*path, node.label])
                return part.get("description") or _name_said(root, node.label)
            return _said(root, node, offset - node.start)
    return None


def _walk(
    node: DocumentNode, path: tuple[str, ...]
) -> Iterator[tuple[tuple[str, ...], DocumentNode, bool]]:
    """Every node with the keys that it stands under, and whether it is one itself."""
    match node:
        case Mapping(entries=entries):
            for key, value in entries:
                yield path, key, True
                yield from _walk(value, (*path, key.label))
        case Sequence(items=items):
            for item in items:
                yield from _walk(item, path)
        case _:
            yield path, node, False


def _said(root: DocumentNode, node: Scalar, column: int) -> str | None:
    """The formula, and the name in it at a column."""
    try:
        shown = _printed(parse_text(node.value))
    except ProblemError:
        return None
    word = next((m[0] for m in _WORD.finditer(node.value) if m.start() <= column < m.end()), "")
    named = _name_said(root, word.rstrip("'"))
    return f"```\n{shown}\n```" + (f"\n\n{named}" if named else "")


def _name_said(root: DocumentNode, name: str) -> str | None:
    """What a name of the file is: `theta`: coordinate, rad."""
    for key in _NAMED:
        if name in _of(root, key):
            about = _entry(_entry(root, key), name)
            return f"`{name}`: {key.removesuffix('s')}{_attributes(about)}"
    return None


def _attributes(node: DocumentNode | None) -> str:
    if isinstance(node, Mapping):
        values = [value.label for _, value in node.entries if isinstance(value, Scalar)]
        return "".join(f", {value}" for value in values)
    return f" = {node.label}" if isinstance(node, Scalar) and not node.is_empty else ""


def _printed(expression: Expression) -> str:
    from lagcli.formatters.layout import joined
    from lagcli.formatters.unicode import UnicodePrinter

    return joined(UnicodePrinter().show(_as_written(expression)))


def _as_written(node: Expression) -> Expression:
    """9.81 with its decimal point: the reader makes fractions of decimals alone."""
    if isinstance(node, Number):
        return Number(node.value, decimal=node.value.denominator > 1)
    return rebuilt(node, _as_written)
