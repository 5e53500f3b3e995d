"""The problem format as a JSON Schema (draft 7), for editors that complete and underline.

Every scalar of the format is text to the reader, and a number or a boolean to other readers
of YAML, so an expression may be any of them.  What a schema cannot say (names that are not
declared, formulas that are wrong) the reader says.
"""

from __future__ import annotations

from typing import get_args

from lagcli.expression import RESERVED
from lagcli.problem_data import METHODS, Assumption
from lagcli.reader.schema_parts import (
    COUNT,
    FORMULA,
    FORMULAS,
    TEXT,
    YES_OR_NO,
    Schema,
    declarations_of,
    list_of,
    map_of,
    record_of,
    ref,
)
from lagcli.reader.trajectory import HAPPENINGS
from lagcli.statements.registry import every_section

_DRAFT = "http://json-schema.org/draft-07/schema#"
#: Without the characters of ASCII that no name has: \w of ECMAScript knows no Greek letter.
_ANY_NAME = r"^[^\x00-@\[-\^`{-\x7f][^\x00-/:-@\[-\^`{-\x7f]*$"
_MASSES: Schema = {"properties": {"points": {"additionalProperties": {"required": ["mass"]}}}}
#: One source of the kinetic energy, and no second one.
_ENERGY: Schema = {
    "anyOf": [*({"required": [key]} for key in "TLH"), {"required": ["points"], **_MASSES}],
    "allOf": [{"not": {"required": list(both)}} for both in ("LT", "LV", "HL", "HT", "HV")],
}


def problem_schema() -> Schema:
    """The schema of a problem file."""
    return {
        "$schema": _DRAFT,
        "title": "A problem of lagcli",
        "type": "object",
        "required": ["coordinates"],
        **_ENERGY,
        "additionalProperties": False,
        "properties": {
            **{key: _described(key, part) for key, part in _PARTS.items()},
            "expect": _described("expect", record_of((), **_expected())),
        },
        "definitions": _DEFINITIONS,
    }


def _expected() -> dict[str, Schema]:
    """What the sections may be compared with, and two keys of no section."""
    found = {e.key: dict(e.schema) for each in every_section() for e in each.expected}
    return {"degrees_of_freedom": COUNT, **found, "trajectory": _TRAJECTORY}


def _described(key: str, part: Schema) -> Schema:
    # a keyword beside $ref is not read in draft 7
    return {"description": _MEANING[key], "allOf": [part]}


_POSITION: Schema = {**list_of(FORMULA), "minItems": 1, "maxItems": 3}
_PAIR: Schema = {**list_of(TEXT), "minItems": 2, "maxItems": 2}

_QUANTITY: dict[str, Schema] = {
    "unit": {
        "anyOf": [{"type": "string"}, {"const": 1}],
        "description": "such as kg m^2/s^2; rad and 1 are numbers",
    },
    "symbol": {"type": "string", "description": "LaTeX for the name"},
    "description": TEXT,
    "assume": {"enum": list(get_args(Assumption)), "description": "real without it"},
}

_DEFINITIONS: dict[str, Schema] = {
    "expression": {
        "type": ["string", "number", "boolean"],
        "description": "a formula: + - * / ^, names, calls; x' is the velocity of x",
    },
    "equation": {
        "type": ["string", "number"],
        "description": "left = right, or an expression that is 0",
    },
    "inequality": {"type": "string", "pattern": "[<>]", "description": "such as N >= 0"},
    "name": {"type": "string", "pattern": _ANY_NAME},
    "declared": {"allOf": [ref("name"), {"not": {"enum": sorted(RESERVED)}}]},
    "coordinate": {"anyOf": [{"type": "null"}, record_of((), **_QUANTITY)]},
    "parameter": {
        "anyOf": [
            {"type": "null"},
            FORMULA,
            record_of((), **_QUANTITY, integer=YES_OR_NO, value=FORMULA),
        ]
    },
    "constraint": {
        "anyOf": [
            ref("equation"),
            record_of(
                ("equation",),
                equation=ref("equation"),
                multiplier=ref("name"),
                acts_as={"enum": ["normal", "friction", "tension"]},
                holds_while=ref("inequality"),
                on_loss={"enum": ["stop", "release"]},
                restitution=FORMULA,
            ),
        ]
    },
    "contact": {
        "anyOf": [
            FORMULA,
            record_of(("gap",), gap=FORMULA, restitution=FORMULA, multiplier=ref("name")),
        ]
    },
    "point": record_of(
        ("position",),
        position=_POSITION,
        mass=FORMULA,
        force={**list_of(FORMULA), "minItems": 1, "maxItems": 3},
    ),
    "question": {
        "anyOf": [
            record_of(("where", "for"), where=ref("equation"), **{"for": TEXT}),
            record_of(("value", "in_terms_of"), value=FORMULA, in_terms_of=list_of(TEXT)),
            record_of(("always", "for"), always=ref("inequality"), **{"for": TEXT}),
            record_of(("reaches", "for"), reaches=ref("equation"), **{"for": TEXT}),
        ]
    },
    "row": {"type": "object", "required": ["t"], "additionalProperties": FORMULA},
}

_TRAJECTORY: Schema = {
    "type": "object",
    "properties": {
        "until": FORMULA,
        "tolerance": FORMULA,
        "rigorous": YES_OR_NO,
        "at": list_of(ref("row")),
        "events": list_of(
            {
                "type": "object",
                "properties": {"what": {"enum": list(HAPPENINGS)}},
                "additionalProperties": FORMULA,
            }
        ),
    },
    "additionalProperties": FORMULA,
}

_PARTS: dict[str, Schema] = {
    "title": TEXT,
    "source": TEXT,
    "description": TEXT,
    "coordinates": {
        "anyOf": [
            {**list_of(ref("declared")), "minItems": 1},
            declarations_of(ref("coordinate"), 1),
        ]
    },
    "parameters": {"anyOf": [list_of(ref("declared")), declarations_of(ref("parameter"))]},
    "functions": declarations_of({**list_of(ref("name")), "minItems": 1}),
    "definitions": declarations_of(FORMULA),
    "points": map_of(ref("point")),
    "T": FORMULA,
    "V": FORMULA,
    "L": FORMULA,
    "H": FORMULA,
    "forces": FORMULAS,
    "dissipation": FORMULA,
    "constraints": map_of(ref("constraint")),
    "contacts": map_of(ref("contact")),
    "symmetries": map_of(
        {**map_of(FORMULA, 1), "not": {"required": ["gauge"], "maxProperties": 1}}
    ),
    "observables": declarations_of(FORMULA),
    "brackets": map_of({**list_of(FORMULA), "minItems": 2, "maxItems": 2}),
    "canonical_transformations": map_of(map_of(FORMULA, 1)),
    "initial": FORMULAS,
    "find": map_of(ref("question")),
    "simulation": record_of(until=FORMULA, accuracy=FORMULA, method={"enum": list(METHODS)}),
    "picture": record_of(
        places=map_of(_POSITION), rods=list_of(_PAIR), springs=list_of(_PAIR), trails=list_of(TEXT)
    ),
}

_MEANING = {
    "title": "the name of the system",
    "source": "where it comes from: text, edition, section",
    "description": "more about it",
    "coordinates": "the generalized coordinates: a list of names, or a map name -> attributes",
    "parameters": "every constant: a list of names, or a map name -> value or attributes",
    "functions": "functions left unspecified, name -> arguments: {U: [r]}",
    "definitions": "abbreviations in order, name -> expression",
    "points": "particles, name -> {position, mass, force}",
    "T": "the kinetic energy",
    "V": "the potential energy; 0 without it",
    "L": "the Lagrangian, instead of T and V",
    "H": "the Hamiltonian of coordinates and momenta p_x, instead of T and V",
    "forces": "generalized forces without a potential, coordinate -> expression",
    "dissipation": "Rayleigh's function D, which contributes -dD/dq'",
    "constraints": "name -> equation; linear in the velocities where it has any",
    "contacts": "one-sided contacts of a numerical run, name -> gap",
    "symmetries": "candidate transformations: the change of each coordinate, of t, and the gauge",
    "observables": "functions of coordinates, momenta p_x and t",
    "brackets": "requested Poisson brackets, name -> [A, B]",
    "canonical_transformations": "name -> new variables {Q: ..., p_Q: ..., F1: ...}",
    "initial": "the state at t = 0: {theta: 0.1, theta': 0}",
    "find": "questions about the motion",
    "simulation": "defaults of a numerical run",
    "picture": "what an animation draws in addition to the points: places, rods, springs, trails",
    "expect": "the known answers, for lagcli check",
}
