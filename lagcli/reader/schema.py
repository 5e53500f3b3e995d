"""The problem format as a JSON Schema (draft 7), for editors that complete and underline.

Every scalar of the format is text to the reader, and a number or a boolean to other readers
of YAML, so an expression may be any of them.  What a schema cannot say (names that are not
declared, formulas that are wrong) the reader says.
"""

from __future__ import annotations

from typing import Any, get_args

from lagcli.problem import METHODS, Assumption
from lagcli.reader.expectations import KEYS as EXPECTED
from lagcli.reader.phase_space import VERDICTS
from lagcli.reader.trajectory import HAPPENINGS

Schema = dict[str, Any]

_DRAFT = "http://json-schema.org/draft-07/schema#"
_ANY_NAME = r"^[^\W\d]\w*$"


def problem_schema() -> Schema:
    """The schema of a problem file."""
    return {
        "$schema": _DRAFT,
        "title": "A problem of lagcli",
        "type": "object",
        "required": ["coordinates"],
        "additionalProperties": False,
        "properties": {key: _described(key, part) for key, part in _PARTS.items()},
        "definitions": _DEFINITIONS,
    }


def _ref(name: str) -> Schema:
    return {"$ref": f"#/definitions/{name}"}


def _map(values: Schema) -> Schema:
    """Names to values; an empty value makes an empty map."""
    return {"type": ["object", "null"], "additionalProperties": values}


def _record(required: tuple[str, ...] = (), /, **properties: Schema) -> Schema:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _list(items: Schema) -> Schema:
    return {"type": "array", "items": items}


def _described(key: str, part: Schema) -> Schema:
    # a keyword beside $ref is not read in draft 7
    return {"description": _MEANING[key], "allOf": [part]}


_TEXT: Schema = {"type": ["string", "number", "boolean"]}
_FORMULA = _ref("expression")
_FORMULAS = _map(_FORMULA)
_YES_OR_NO: Schema = {"enum": ["yes", "no", True, False]}
_STABLE: Schema = {"anyOf": [_YES_OR_NO, _ref("inequality"), _list(_ref("inequality"))]}
_ONE_OR_MORE: Schema = {"anyOf": [_FORMULA, _list({"anyOf": [_FORMULA, _list(_FORMULA)]})]}

_POSITION: Schema = {**_list(_FORMULA), "minItems": 1, "maxItems": 3}
_PAIR: Schema = {**_list(_TEXT), "minItems": 2, "maxItems": 2}

_QUANTITY: dict[str, Schema] = {
    "unit": {
        "type": ["string", "number"],
        "description": "such as kg m^2/s^2; rad and 1 are numbers",
    },
    "symbol": {"type": "string", "description": "LaTeX for the name"},
    "description": _TEXT,
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
    "coordinate": {"anyOf": [{"type": "null"}, _record((), **_QUANTITY)]},
    "parameter": {
        "anyOf": [
            {"type": "null"},
            _FORMULA,
            _record((), **_QUANTITY, integer=_YES_OR_NO, value=_FORMULA),
        ]
    },
    "constraint": {
        "anyOf": [
            _ref("equation"),
            _record(
                ("equation",),
                equation=_ref("equation"),
                multiplier=_ref("name"),
                acts_as={"enum": ["normal", "friction", "tension"]},
                holds_while=_ref("inequality"),
                on_loss={"enum": ["stop", "release"]},
                restitution=_FORMULA,
            ),
        ]
    },
    "contact": {
        "anyOf": [
            _FORMULA,
            _record(("gap",), gap=_FORMULA, restitution=_FORMULA, multiplier=_ref("name")),
        ]
    },
    "point": _record(
        ("position",),
        position=_POSITION,
        mass=_FORMULA,
        force={**_list(_FORMULA), "minItems": 1, "maxItems": 3},
    ),
    "question": {
        "anyOf": [
            _record(("where", "for"), where=_ref("equation"), **{"for": _TEXT}),
            _record(("value", "in_terms_of"), value=_FORMULA, in_terms_of=_list(_TEXT)),
            _record(("always", "for"), always=_ref("inequality"), **{"for": _TEXT}),
            _record(("reaches", "for"), reaches=_ref("equation"), **{"for": _TEXT}),
        ]
    },
    "row": {"type": "object", "required": ["t"], "additionalProperties": _FORMULA},
}

_TRAJECTORY: Schema = {
    "type": "object",
    "properties": {
        "until": _FORMULA,
        "tolerance": _FORMULA,
        "at": _list(_ref("row")),
        "events": _list(
            {
                "type": "object",
                "properties": {"what": {"enum": list(HAPPENINGS)}},
                "additionalProperties": _FORMULA,
            }
        ),
    },
    "additionalProperties": _FORMULA,
}

_EXPECTED: dict[str, Schema] = {
    "degrees_of_freedom": {"type": ["integer", "string"]},
    "equations": _list(_ref("equation")),
    "accelerations": _FORMULAS,
    "multipliers": _FORMULAS,
    "constraint_forces": _map(_FORMULAS),
    "forces": _map(_map({"anyOf": [_FORMULA, _list(_FORMULA)]})),
    "friction_needed": _FORMULAS,
    "momenta": _FORMULAS,
    "hamiltonian": _FORMULA,
    "energy": _FORMULA,
    "charges": _FORMULAS,
    "discovered": _FORMULAS,
    "equilibria": _list(_record(at=_FORMULAS, on=_ref("equation"), stable=_STABLE)),
    "modes": _list(_FORMULA),
    "find": _map(_ONE_OR_MORE),
    "trajectory": _TRAJECTORY,
    "reduction": _record(
        routhian=_FORMULA,
        effective_potential=_FORMULA,
        reconstruction=_FORMULAS,
        turning_points=_list(_FORMULA),
        period=_FORMULA,
    ),
    "steady_motions": _list(
        _record(
            at=_FORMULAS, rates=_FORMULAS, momenta=_FORMULAS, frequencies_squared=_list(_FORMULA),
            stable=_STABLE,
        )
    ),
    "hamilton_jacobi": _record(separable=_YES_OR_NO, derivatives=_FORMULAS, functions=_FORMULAS),
    "brackets": _FORMULAS,
    "canonical": _map(
        _record(
            kind={"enum": list(VERDICTS)}, valence=_FORMULA, generates=_YES_OR_NO,
            hamiltonian=_FORMULA,
        )
    ),
    "algebra": _record(
        dimension={"type": ["integer", "string"]},
        independent={"type": ["integer", "string"]},
        in_involution={"type": ["integer", "string"]},
        name=_TEXT,
        integrable=_YES_OR_NO,
        special=_list(
            _record(
                ("where",), where=_ref("equation"), charges={"type": ["integer", "string"]},
                discovered=_FORMULAS,
            )
        ),
    ),
}  # fmt: skip

_PARTS: dict[str, Schema] = {
    "title": _TEXT,
    "source": _TEXT,
    "description": _TEXT,
    "coordinates": {
        "anyOf": [
            {**_list(_ref("name")), "minItems": 1},
            {**_map(_ref("coordinate")), "minProperties": 1, "type": "object"},
        ]
    },
    "parameters": {"anyOf": [_list(_ref("name")), _map(_ref("parameter"))]},
    "functions": _map(_list(_TEXT)),
    "definitions": _FORMULAS,
    "points": _map(_ref("point")),
    "T": _FORMULA,
    "V": _FORMULA,
    "L": _FORMULA,
    "H": _FORMULA,
    "forces": _FORMULAS,
    "dissipation": _FORMULA,
    "constraints": _map(_ref("constraint")),
    "contacts": _map(_ref("contact")),
    "symmetries": _map(_FORMULAS),
    "observables": _FORMULAS,
    "brackets": _map({**_list(_FORMULA), "minItems": 2, "maxItems": 2}),
    "canonical_transformations": _map(_FORMULAS),
    "initial": _FORMULAS,
    "find": _map(_ref("question")),
    "simulation": _record(until=_FORMULA, accuracy=_FORMULA, method={"enum": list(METHODS)}),
    "picture": _record(
        places=_map(_POSITION), rods=_list(_PAIR), springs=_list(_PAIR), trails=_list(_TEXT)
    ),
    "expect": _record((), **{key: _EXPECTED[key] for key in EXPECTED}),
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
    "brackets": "Poisson brackets that are asked for, name -> [A, B]",
    "canonical_transformations": "name -> new variables {Q: ..., p_Q: ..., F1: ...}",
    "initial": "the state at t = 0: {theta: 0.1, theta': 0}",
    "find": "questions about the motion",
    "simulation": "defaults of a numerical run",
    "picture": "what an animation draws beside the points: places, rods, springs, trails",
    "expect": "the known answers, for lagcli check",
}
