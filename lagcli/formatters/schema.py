"""The JSON that `lagcli solve` writes as a JSON Schema (draft 7)."""

from __future__ import annotations

from typing import Any

Schema = dict[str, Any]

_FORMULA: Schema = {"type": "string", "description": "in the grammar of the problem format"}
_OR_NULL: Schema = {"type": ["string", "null"]}
_MATRIX: Schema = {"type": "array", "items": {"type": "array", "items": _FORMULA}}
_COLUMN: Schema = {"type": "array", "items": _FORMULA}


def _map(values: Schema, *, null: bool = True) -> Schema:
    return {"type": ["object", "null"] if null else "object", "additionalProperties": values}


def _record(required: tuple[str, ...], properties: dict[str, Schema]) -> Schema:
    return {"type": "object", "required": list(required), "properties": properties}


_CHARGE = _record(
    ("name", "source", "transformation", "gauge", "conserved", "charge", "rate"),
    {
        "name": {"type": "string"},
        "source": {"type": "string"},
        "transformation": _map(_FORMULA, null=False),
        "gauge": _OR_NULL,
        "conserved": {"type": ["boolean", "null"]},
        "charge": _OR_NULL,
        "rate": _OR_NULL,
    },
)
_MULTIPLIER = _record(
    ("symbol", "value", "kind"),
    {
        "symbol": {"type": "string"},
        "value": _OR_NULL,
        "kind": {"enum": ["holonomic", "integrable", "nonholonomic", None]},
    },
)
_SECTIONS: dict[str, Schema] = {
    "lagrangian": _OR_NULL,
    "equations": {
        "type": ["array", "null"],
        "items": _record(
            ("coordinate", "equation"), {"coordinate": {"type": "string"}, "equation": _FORMULA}
        ),
    },
    "matrix_form": _record(
        ("mass_matrix", "constraint_jacobian", "forcing", "constraint_bias", "shared"),
        {
            "mass_matrix": _MATRIX,
            "constraint_jacobian": _MATRIX,
            "forcing": _COLUMN,
            "constraint_bias": _COLUMN,
            "shared": _map(_FORMULA, null=False),
        },
    ),
    "accelerations": _map(_FORMULA),
    "multipliers": _map(_MULTIPLIER),
    "constraint_forces": _map({"type": ["object", "null"]}),
    "momenta": _map(_FORMULA),
    "energy": _record(
        ("function", "conserved", "is_total_energy", "reason"),
        {
            "function": _OR_NULL,
            "conserved": {"type": ["boolean", "null"]},
            "is_total_energy": {"type": ["boolean", "null"]},
            "reason": {"type": "string"},
        },
    ),
    "hamiltonian": _OR_NULL,
    "canonical_equations": _map(_record(("q", "p"), {"q": _FORMULA, "p": _FORMULA})),
    "charges": {"type": ["array", "null"], "items": _CHARGE},
    "discovered": {"type": ["array", "null"], "items": _CHARGE},
}


def _or_null(section: Schema) -> Schema:
    """A section that could not be made is null."""
    kinds = section["type"]
    return section if isinstance(kinds, list) else {**section, "type": [kinds, "null"]}


def answers_schema() -> Schema:
    """One object for one file, an array for several."""
    answer = _record(
        ("schema", "title", "coordinates", "parameters", "degrees_of_freedom", "warnings"),
        {
            "schema": {"const": 1},
            "title": {"type": "string"},
            "coordinates": {"type": "array", "items": {"type": "string"}},
            "parameters": {"type": "array", "items": {"type": "string"}},
            "degrees_of_freedom": {"type": "integer", "minimum": 0},
            **{name: _or_null(section) for name, section in _SECTIONS.items()},
            "where": _map(_FORMULA, null=False),
            "warnings": {"type": "array", "items": {"type": "string"}},
        },
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
