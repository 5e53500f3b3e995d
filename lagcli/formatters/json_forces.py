"""Real forces for machines."""

from __future__ import annotations

from lagcli.forces import ForcesSection, FrictionNeeded, PointForce
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, Value

_ORIGIN = "origin"


def of_forces(section: ForcesSection) -> Value:
    """Give the value of the key `forces`."""
    if section.forces is None:
        return None
    return {
        "on_points": [_force(each) for each in section.forces],
        "torques": {
            constraint: {q: to_grammar(value) for q, value in torques.items()}
            for constraint, torques in section.torques.items()
        },
        "friction_needed": [_friction(each) for each in section.friction_needed],
    }


def _force(force: PointForce) -> Object:
    result: Object = {
        "constraint": force.constraint,
        "point": force.point,
        "acts_as": force.kind,
        "force": None if force.force is None else to_grammar(force.force),
        "direction": [to_grammar(component) for component in force.direction],
    }
    if force.towards is not None:
        result["towards"] = force.towards or _ORIGIN
    if force.away_from is not None:
        result["away_from"] = force.away_from or _ORIGIN
    if force.allowed is not None:
        result["holds_while"] = "force >= 0" if force.allowed > 0 else "force <= 0"
    return result


def _friction(needed: FrictionNeeded) -> Object:
    coefficient = needed.coefficient
    return {
        "frictions": needed.frictions,
        "normal": needed.normal,
        "coefficient": None if coefficient is None else to_grammar(coefficient),
        "where": [f"{to_grammar(each)} > 0" for each in needed.where],
    }
