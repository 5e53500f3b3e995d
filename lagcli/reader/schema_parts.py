"""What the JSON Schema of a problem file is made of (draft 7)."""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]


def ref(name: str) -> Schema:
    """One of the definitions of `lagcli.reader.schema`."""
    return {"$ref": f"#/definitions/{name}"}


def map_of(values: Schema, least: int = 0) -> Schema:
    """Names to values."""
    return {"type": "object", "additionalProperties": values, "minProperties": least}


def record_of(required: tuple[str, ...] = (), /, **properties: Schema) -> Schema:
    """A map with these keys and no other."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def list_of(items: Schema) -> Schema:
    """A list."""
    return {"type": "array", "items": items}


TEXT: Schema = {"type": ["string", "number", "boolean"]}
COUNT: Schema = {
    "anyOf": [{"type": "integer", "minimum": 0}, {"type": "string", "pattern": r"^\s*\d+\s*$"}]
}
FORMULA = ref("expression")
FORMULAS = map_of(FORMULA)
YES_OR_NO: Schema = {"enum": ["yes", "no", True, False]}
STABLE: Schema = {"anyOf": [YES_OR_NO, ref("inequality"), list_of(ref("inequality"))]}
ONE_OR_MORE: Schema = {"anyOf": [FORMULA, list_of({"anyOf": [FORMULA, list_of(FORMULA)]})]}
