"""What JSON is made of, and the version of the contract about its keys."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.statements.motions import Above

#: The version of the contract.
SCHEMA = 1

Value = None | bool | int | str | Sequence["Value"] | Mapping[str, "Value"]
Object = dict[str, Value]
Schema = dict[str, Any]

_Some = TypeVar("_Some")


def unless_none(value: _Some | None, shown: Callable[[_Some], Value]) -> Value:
    """Null where there is no value."""
    return None if value is None else shown(value)


def string(expression: Expression | None) -> str | None:
    """One formula."""
    return None if expression is None else to_grammar(expression)


def strings(expressions: Sequence[Expression]) -> list[str]:
    """A list of formulas."""
    return [to_grammar(each) for each in expressions]


def by_name(expressions: Mapping[str, Expression | None]) -> Object:
    """Formulas by name."""
    return {name: string(expression) for name, expression in expressions.items()}


def above(inequality: Above) -> str:
    """An inequality."""
    return f"{to_grammar(inequality.left)} > {to_grammar(inequality.right)}"


def inequalities(where: Sequence[Above]) -> list[str]:
    """Inequalities, all of which hold."""
    return [above(each) for each in where]


def place(at: Mapping[str, Expression], on: tuple[Expression, Expression] | None = None) -> Object:
    """A state, or a family of them on a line."""
    result: Object = {"at": by_name(at)}
    if on is not None:
        result["on"] = " = ".join(map(to_grammar, on))
    return result


# -- the same as JSON Schema ------------------------------------------------------------------

FORMULA: Schema = {"type": "string", "description": "in the grammar of the problem format"}
OR_NULL: Schema = {"type": ["string", "null"]}


def map_of(values: Schema, *, null: bool = True) -> Schema:
    """Names to values."""
    return {"type": ["object", "null"] if null else "object", "additionalProperties": values}


def record_of(required: tuple[str, ...], properties: dict[str, Schema]) -> Schema:
    """An object with these keys."""
    return {"type": "object", "required": list(required), "properties": properties}
