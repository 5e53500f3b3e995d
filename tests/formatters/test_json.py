"""The JSON formatter: the contract's keys, in the contract's order."""

from __future__ import annotations

import json

from lagcli.formatters.built_in.json import render
from lagcli.formatters.options import Options
from lagcli.statements.registry import built_in

from .examples import HOOP, HOSTILE

HOOP_JSON = json.loads(render([HOOP], Options()))
HOSTILE_JSON = json.loads(render([HOSTILE], Options()))


def test_keys_come_in_the_order_of_the_contract():
    head = ["schema", "title", "coordinates", "parameters", "degrees_of_freedom"]
    beside = {"total_constraint_force", "point_forces"}
    keys = [key for key in HOOP_JSON if key not in beside]
    assert keys == [*head, *(each.name for each in built_in()), "warnings"]


def test_the_examples_of_the_contract():
    assert HOOP_JSON["equations"][0] == {
        "coordinate": "x",
        "equation": "M*x'' - M*g*sin(alpha) = lambda_rolling",
    }
    assert HOOP_JSON["accelerations"] == {"x": "g*sin(alpha)/2", "theta": "g*sin(alpha)/(2*R)"}
    assert HOOP_JSON["multipliers"]["rolling"] == {
        "symbol": "lambda_rolling",
        "value": "-M*g*sin(alpha)/2",
        "kind": "holonomic",
    }
    assert HOOP_JSON["canonical_equations"]["x"]["q"] == "p_x/M"
    assert list(HOOP_JSON["charges"][0]) == [
        "name",
        "source",
        "transformation",
        "gauge",
        "conserved",
        "charge",
        "rate",
    ]
    assert HOOP_JSON["charges"][0]["charge"] == "M*R*x' + M*R^2*theta' - M*R*g*t*sin(alpha)"
    assert HOOP_JSON["find"]["lift_off"] == {"solutions": ["acos(4/7)"]}
    assert HOOP_JSON["find"]["lost"] == {"value": None}


def test_what_is_not_found_is_null():
    assert HOSTILE_JSON["accelerations"] is None
    assert HOSTILE_JSON["regular"] is False
    assert HOSTILE_JSON["degenerate"] == ["phase"]
    assert HOSTILE_JSON["redundant"] == ["rod_1"]
    assert HOSTILE_JSON["multipliers"]["rod_1"]["value"] is None
    assert HOSTILE_JSON["constraint_forces"] == {"rod_1": None}
    assert HOSTILE_JSON["total_constraint_force"] is None
    for key in ("hamiltonian", "canonical_equations", "equilibria", "modes", "reduction"):
        assert HOSTILE_JSON[key] is None


def test_a_mode_that_is_not_real_tells_its_square():
    first, second = HOOP_JSON["modes"]
    assert "frequency_squared" not in first
    assert second["frequency"] is None
    assert second["frequency_squared"] == "-g/l"


def test_several_files_make_an_array_and_letters_are_kept():
    printed = render([HOOP, HOSTILE], Options())
    assert isinstance(json.loads(printed), list)
    assert "длина_волны" in printed
    assert printed == render([HOOP, HOSTILE], Options())
