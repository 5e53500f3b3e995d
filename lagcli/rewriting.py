"""Rewriting every expression inside a value: a problem, answers, a tree."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, TypeVar, cast

from lagcli.expression import Expression, Name
from lagcli.record import field_names, replace

Value = TypeVar("Value")


def rewritten(value: Value, rewrite: Callable[[Expression], Expression]) -> Value:
    """The same value with `rewrite` applied to the outermost expressions in it.

    Looks into tuples, the values of maps, and the fields of dataclasses.
    """
    return cast(Value, _rewritten(value, rewrite))


def expressions_in(value: object) -> Iterator[Expression]:
    """The outermost expressions in a value, in order."""
    yield from parts_in(value, Expression)


def parts_in(value: object, kind: type[Value]) -> Iterator[Value]:
    """The outermost parts of this class in a value, in order."""
    parts: Iterable[object] = ()
    match value:
        case kind():
            yield value
        case tuple() | list():
            parts = value
        case Mapping():
            parts = value.values()
        case _ if not isinstance(value, (Expression, type)):
            parts = (getattr(value, each) for each in field_names(value))
    for part in parts:
        yield from parts_in(part, kind)


def rebuilt(node: Expression, rewrite: Callable[[Expression], Expression]) -> Expression:
    """The node with `rewrite` applied to its direct parts."""
    return cast(Expression, _with_fields(node, rewrite))


def put_in(node: Expression, whole: Mapping[Expression, Expression]) -> Expression:
    """The tree with other trees for some of its parts."""
    return whole[node] if node in whole else rebuilt(node, lambda part: put_in(part, whole))


def substituted(value: Value, values: Mapping[str, Expression]) -> Value:
    """A tree, or anything that holds trees, with values in place of those names."""

    def with_values(node: Expression) -> Expression:
        if isinstance(node, Name):
            return values.get(node.name, node)
        return rebuilt(node, with_values)

    return rewritten(value, with_values)


def _rewritten(value: Any, rewrite: Callable[[Expression], Expression]) -> Any:
    match value:
        case Expression():
            return rewrite(value)
        case tuple():
            parts = tuple(_rewritten(part, rewrite) for part in value)
            return parts if any(a is not b for a, b in zip(parts, value, strict=True)) else value
        case Mapping():
            return {key: _rewritten(part, rewrite) for key, part in value.items()}
        case _:
            return _with_fields(value, rewrite)


def _with_fields(value: Any, rewrite: Callable[[Expression], Expression]) -> Any:
    changes = {}
    for name in field_names(value):
        old = getattr(value, name)
        new = _rewritten(old, rewrite)
        if new is not old:
            changes[name] = new
    return replace(value, **changes) if changes else value
