"""The JSON that `lagcli solve` writes as a JSON Schema (draft 7)."""

from __future__ import annotations

from lagcli.formatters.json_values import FORMULA, TEXT, Schema, map_of, record_of
from lagcli.statements.registry import every_section

_TEXTS: Schema = {"type": "array", "items": TEXT}


def _or_null(section: Schema) -> Schema:
    """A section that could not be made is null."""
    kinds = section["type"]
    return section if isinstance(kinds, list) else {**section, "type": [kinds, "null"]}


def answers_schema() -> Schema:
    """One object for one file, an array for several."""
    declared = [each for each in every_section() if each.schema is not None]
    answer = record_of(
        ("schema", "title", "coordinates", "parameters", "degrees_of_freedom", "warnings"),
        schema={"const": 1},
        title=TEXT,
        coordinates=_TEXTS,
        parameters=_TEXTS,
        degrees_of_freedom={"type": ["integer", "null"], "minimum": 0},
        **{each.name: _or_null(dict(each.schema or {})) for each in declared},
        where=map_of(FORMULA, null=False),
        warnings=_TEXTS,
    )
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Answers of lagcli solve",
        "definitions": {"answer": answer},
        "anyOf": [
            {"$ref": "#/definitions/answer"},
            {"type": "array", "items": {"$ref": "#/definitions/answer"}},
        ],
    }
