"""The schema of the format accepts what the reader accepts, and refuses what it can see."""

from __future__ import annotations

import json
import os
import re

import jsonschema
import pytest
import yaml

from lagcli.cli.run import run
from lagcli.formatters.schema import answers_schema
from lagcli.library import entries, folder
from lagcli.reader import read_problem
from lagcli.reader.habits import KEYS
from lagcli.reader.schema import problem_schema
from lagcli.templates import TEMPLATES, template

SCHEMA = jsonschema.Draft7Validator(problem_schema())
MODELINE = "# yaml-language-server: $schema="


class Core(yaml.SafeLoader):
    """YAML 1.2 as language servers read it: `on` and `yes` are text."""


Core.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag != "tag:yaml.org,2002:bool"]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
Core.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(?:true|false)$"), list("tf"))


def is_valid(text):
    return SCHEMA.is_valid(yaml.load(text, Core))


def test_the_schema_is_one_and_has_every_key():
    jsonschema.Draft7Validator.check_schema(problem_schema())
    jsonschema.Draft7Validator.check_schema(answers_schema())
    assert tuple(problem_schema()["properties"]) == KEYS


@pytest.mark.first_quick
@pytest.mark.parametrize("entry", entries(), ids=lambda entry: entry.name)
def test_every_problem_of_the_library_is_valid(entry):
    assert is_valid(entry.path.read_text("utf-8"))


@pytest.mark.parametrize("name", TEMPLATES)
def test_every_template_is_valid(name):
    assert is_valid(template(name).replace("{title}", "x"))


GOOD = "coordinates: [x]\nparameters: {m: {assume: positive}}\nT: m*x'^2/2\n"
MALFORMED = [
    "T: x'^2",
    "coordinates: []\nT: 1",
    "coordinates: x\nT: 1",
    "coordinates: {x: {asume: positive}}\nT: 1",
    "coordinates: {x: {assume: big}}\nT: 1",
    "coordinates: [2x]\nT: 1",
    GOOD + "dissapation: x'",
    GOOD + "constraints: [x = 0]",
    GOOD + "constraints: {a: {equation: x, on_loss: fall}}",
    GOOD + "constraints: {a: {multiplier: N}}",
    GOOD + "contacts: {floor: {restitution: 1}}",
    GOOD + "forces: F",
    GOOD + "points: {a: {mass: m}}",
    GOOD + "points: {a: {position: [x, x, x, x]}}",
    GOOD + "symmetries: {a: 1}",
    GOOD + "brackets: {a: [x]}",
    GOOD + "find: {a: {where: x = 0}}",
    GOOD + "find: {a: {where: x = 0, value: x}}",
    GOOD + "simulation: {method: euler}",
    GOOD + "simulation: {untill: 1}",
    GOOD + "expect: {modes: 1}",
    GOOD + "expect: {degrees_of_freedom: two}",
    GOOD + "expect: {degrees_of_freedom: -1}",
    GOOD + "expect: {constraint_forces: {rod: }}",
    GOOD + "functions: {U: []}",
    GOOD + "functions:",
    GOOD + "functions: {sin: [r]}",
    GOOD + "definitions: {2a: x}",
    GOOD + "observables: {t: x}",
    GOOD + "symmetries: {a: {}}",
    GOOD + "symmetries: {a: }",
    GOOD + "symmetries: {a: {gauge: x}}",
    GOOD + "canonical_transformations: {a: }",
    GOOD + "L: x'^2",
    GOOD + "H: p_x^2",
    "coordinates: [x]\nL: x'^2\nV: x",
    "coordinates: [x]\nV: x",
    "coordinates: [x]\npoints: {a: {position: [x, 0]}}",
    "coordinates: {t: }\nT: 1",
    "coordinates: [sin]\nT: 1",
    "coordinates: {x: {unit: 7}}\nT: x'^2",
    GOOD + "expect: {equilibria: [{at: {x: 0}, stabel: yes}]}",
    GOOD + "expect: {trajectory: {events: [{what: bang}]}}",
    GOOD + "initial: [0]",
    "- 1",
]


@pytest.mark.parametrize("word", ["yes", "no", "true", "false"])
def test_the_words_for_yes_and_no_are_the_same_in_the_schema_and_in_the_reader(word):
    text = GOOD.replace("positive}}", f"positive, integer: {word}}}}}")
    text += f"expect: {{trajectory: {{rigorous: {word}}}, equilibria: [{{at: {{x: 0}}, stable: {word}}}]}}\n"
    assert is_valid(text)
    assert read_problem("p.yaml", text.encode()).diagnostics == ()


@pytest.mark.parametrize("text", MALFORMED)
def test_what_the_schema_refuses_the_reader_refuses(text):
    assert not is_valid(text)
    assert read_problem("p.yaml", text.encode()).problem is None


@pytest.mark.parametrize("name", ["x", "θ", "θ_1", "_a", "été"])
def test_names_of_any_letters_are_valid_where_words_are_ascii(name):
    pattern = problem_schema()["definitions"]["name"]["pattern"]
    assert re.search(pattern, name, re.ASCII)  # as in ECMAScript
    assert is_valid(f"coordinates: [{name}]\nT: {name}'^2")


@pytest.mark.first_quick
@pytest.mark.parametrize("name", ["kepler", "hoop", "spherical-pendulum-cartesian", "ray-of-light"])
def test_answers_are_valid(name, capsysbinary):
    sections = "lagrangian,equations,matrix_form,accelerations,multipliers,constraint_forces"
    sections += ",momenta,energy,hamiltonian,canonical_equations,charges,discovered"
    for options in ([], ["--show", sections]):
        run(["solve", name, *options, "-f", "json"])
        jsonschema.validate(json.loads(capsysbinary.readouterr().out), answers_schema())


def test_the_command_prints_the_schema(capsysbinary):
    assert run(["schema"]) == 0
    assert json.loads(capsysbinary.readouterr().out) == problem_schema()
    assert run(["schema", "answers"]) == 0
    assert json.loads(capsysbinary.readouterr().out) == answers_schema()
    assert run(["schema", "answer"]) == 2
    assert b"did you mean 'answers'" in capsysbinary.readouterr().err


def test_every_problem_of_the_library_names_the_schema_beside_it():
    schema = folder() / "problem.schema.json"
    if os.environ.get("LAGCLI_UPDATE"):
        assert run(["schema", "-o", str(schema)]) == 0
    assert json.loads(schema.read_text("utf-8")) == problem_schema()
    for entry in entries():
        first = entry.path.read_text("utf-8").partition("\n")[0]
        assert first.startswith(MODELINE)
        assert (entry.path.parent / first.removeprefix(MODELINE)).resolve() == schema
