"""What JSON is made of, and the version of the contract about its keys."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from math import isfinite
from typing import Any, TypeVar

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.options import Options
from lagcli.record import field_names
from lagcli.statements.motions import Above
from lagcli.units import Unit

#: The version of the contract.
SCHEMA = 1
#: The fields with which an object begins.
HEAD = "title coordinates parameters degrees_of_freedom"

Value = None | bool | int | str | Sequence["Value"] | Mapping[str, "Value"]
Object = dict[str, Value]
Schema = dict[str, Any]

_Some = TypeVar("_Some")


def plain(value: Any) -> Any:
    """A value as JSON has it: formulas as text, records by their fields, no infinite number."""
    match value:
        case Expression():
            return to_grammar(value)
        case Above(left=left, right=right, besides=besides):
            sides = f"{to_grammar(left)} > {to_grammar(right)}"
            return " and ".join([sides, *map(plain, besides)])
        case Unit():
            return str(value)
        case Mapping():
            return {name: plain(each) for name, each in value.items()}
        case tuple() | list():
            return [plain(each) for each in value]
        case float():
            return value if isfinite(value) else None
    names = field_names(value)
    return {name: plain(getattr(value, name)) for name in names} if names else value


def fields_of(statement: object, names: str) -> Object:
    """These fields of a record, in this order."""
    return {name: plain(getattr(statement, name)) for name in names.split()}


def list_or_null(values: Sequence[_Some] | None, shown: Callable[[_Some], Value]) -> Value:
    """Each value as it is shown; null where there are none to show."""
    return None if values is None else [shown(each) for each in values]


def place(at: Mapping[str, Expression], on: tuple[Expression, Expression] | None = None) -> Object:
    """A state, or a family of them on a line."""
    result: Object = {"at": plain(at)}
    if on is not None:
        result["on"] = " = ".join(map(to_grammar, on))
    return result


# -- the same as JSON Schema ------------------------------------------------------------------

FORMULA: Schema = {"type": "string", "description": "in the grammar of the problem format"}
OR_NULL: Schema = {"type": ["string", "null"]}
TEXT: Schema = {"type": "string"}
TRUTH: Schema = {"type": ["boolean", "null"]}


def map_of(values: Schema, *, null: bool = True) -> Schema:
    """Names to values."""
    return {"type": ["object", "null"] if null else "object", "additionalProperties": values}


def record_of(required: tuple[str, ...] = (), /, **properties: Schema) -> Schema:
    """An object with these keys, of which all are required where none is named."""
    return {"type": "object", "required": list(required or properties), "properties": properties}


def written(objects: list[Object], options: Options) -> str:
    """One object for one file, an array for several."""
    value: Value = objects[0] if len(objects) == 1 and not options.several else objects
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"
