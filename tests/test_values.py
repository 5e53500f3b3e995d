"""Numbers in place of parameters, before anything is derived."""

from __future__ import annotations

import random

import pytest

from lagcli.pipeline import Request, derive, read, state
from lagcli.values import off_constraints

FILE = b"""\
coordinates: [x]
parameters:
  m: {assume: positive, value: 2}
  k: {value: m*w^2}
  w: {value: 3}
  n: {integer: true}
functions: {U: [x]}
T: m*x'^2/2
V: k*x^2/2
find:
  stop: {where: "x' = 0", for: w}
"""


def accelerations(*settings, numeric=False):
    request = Request(sections=("accelerations",), settings=settings, numeric=numeric)
    problem = read("file.yaml", FILE, request).problem
    answers = state(derive(problem), request)
    from lagcli.formatters.grammar import to_grammar

    section = answers.sections["accelerations"]
    return answers.parameters, to_grammar(section.accelerations["x"])


def mistakes(*settings, numeric=False):
    found = read("file.yaml", FILE, Request(settings=settings, numeric=numeric))
    assert found.problem is None
    return [diagnostic.message for diagnostic in found.diagnostics]


def test_values_of_the_file_stay_symbols():
    assert accelerations() == (("m", "k", "w", "n"), "-k*x/m")


def test_a_setting_replaces_its_parameter():
    assert accelerations("m=1/2") == (("k", "w", "n"), "-2*k*x")


def test_settings_may_use_each_other():
    assert accelerations("k=4*m", "m=2*n") == (("w", "n"), "-4*x")


def test_numeric_puts_in_the_values_but_for_what_is_asked():
    names, formula = accelerations(numeric=True)
    assert names == ("w", "n")
    assert formula == "-w^2*x"


def test_a_setting_goes_before_the_value_of_the_file():
    assert accelerations("m=5", "k=10", numeric=True)[1] == "-2*x"


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("m=-1", "'m' is positive, and its value is not"),
        ("m=0", "'m' is positive, and its value is not"),
        ("n=1/2", "'n' is an integer, and its value is not"),
        ("m=sqrt(-1)", "the value of 'm' is not a real number"),
        ("w=1", "'w' can have no value here: a `find` solves for it"),
        ("x=1", "--set x=1: there is no parameter 'x'"),
    ],
)
def test_values_that_cannot_be(setting, message):
    assert mistakes(setting) == [message]


def test_every_setting_that_is_wrong_is_named():
    assert len(mistakes("a=1", "b", "m=q")) == 3


def test_a_division_by_zero_is_seen():
    file = FILE.replace(b"V: k*x^2/2", b"V: x^2/(k - 4)")
    found = read("file.yaml", file, Request(settings=("k=4",)))
    assert [d.message for d in found.diagnostics] == [
        "with these values something is divided by zero"
    ]


def test_every_division_by_zero_is_seen_also_of_a_name():
    file = FILE.replace(b"V: k*x^2/2", b"V: x^2/(k - 4) + 1/(x*(k - 4)) + ((k - 4)/m)^(-1)")
    found = read("file.yaml", file, Request(settings=("k=4",)))
    assert len(found.diagnostics) == 3
    assert len({d.span for d in found.diagnostics}) == 3


@pytest.mark.parametrize(
    ("initial", "number"),
    [
        ("{x: 3/10, y: -4/10}", 0),
        ("{x: sqrt(1/8), y: -sqrt(l/4)}", 0),
        ("{x: 3/10, y: -4/10 - 1e-6}", 1),
        ("{x: 3/10}", 0),  # y follows
        ("{x: 3/10, y: -4/10, x': 1, y': 3/4}", 0),
        ("{x: 3/10, y: -4/10, x': 1, y': 1}", 1),
    ],
)
def test_an_initial_state_beside_the_constraints_is_a_warning(initial, number):
    text = f"""
coordinates: [x, y]
parameters: {{l: 0.5, k: {{}}}}
definitions: {{r: sqrt(x^2 + y^2)}}
L: (x'^2 + y'^2)/2 - k*y
constraints: {{rod: r = l, along: x*x' + y*y'}}
initial: {initial}
"""
    problem = read("file.yaml", text.encode()).problem
    assert problem is not None
    found = off_constraints(problem)
    assert len(found) == number
    assert all(not each.is_error and each.span.line in {6, 7} for each in found)


@pytest.mark.parametrize(
    ("initial", "hint"),
    [
        ("{x: 1, y: 1}", "write y: 3, or leave it out"),
        ("{x: 1, y: 3, x': 0, y': 1}", "write y': 0, or leave it out"),
        ("{x: 1, y: 3, x': 2, y': -2}", ""),
        ("{y: 1, x: 1}", "write x: 3, or leave it out"),
        ("{x: 1, y: 3, y': 1}", ""),  # x' follows
    ],
)
def test_the_entry_of_a_state_beside_a_constraint_is_named_with_its_value(initial, hint):
    written = f"""coordinates: [x, y]
parameters: {{l: 4}}
L: (x'^2 + y'^2)/2 + x
constraints: {{rope: x + y = l}}
initial: {initial}
"""
    problem = read("file.yaml", written.encode()).problem
    assert problem is not None
    found = off_constraints(problem)
    assert len(found) == bool(hint)
    assert all(each.hint.endswith(hint) and each.span.line == 5 for each in found)


@pytest.mark.parametrize(
    ("gap", "hint"),
    [("x - y >= d", "write y - x >= d"), ("y - x >= d", None), ("x - y + d >= 0", None),
     ("y <= 0", "write y >= 0: a gap"), ("0 >= y", "write 0 <= y: a gap"), ("x <= 0", None),
     ("x >= d", "start where x >= d: write x: d")],
)  # fmt: skip
def test_a_negative_gap_of_the_initial_state_is_a_warning(gap, hint):
    written = f"""coordinates: [x, y]
parameters: {{d: 1.5}}
L: (x'^2 + y'^2)/2
contacts: {{buffer: {gap}}}
initial: {{x: 0, y: {3 if "+" not in gap else 1}}}
"""
    problem = read("file.yaml", written.encode()).problem
    assert problem is not None
    found = off_constraints(problem)
    assert [each.hint.startswith(hint) for each in found] == ([True] if hint else [])


@pytest.mark.parametrize("seed", range(8))
def test_a_state_beside_a_curve_is_moved_along_its_last_entry(seed):
    draw = random.Random(seed)
    constraint = draw.choice(["x^2 + y^2 = l^2", "y = x^2/2", "x*y = 1", "sin(y) = x/2"])
    x, y = draw.choice([0.6, -0.7, 0.9]), draw.choice([0.85, -0.9, 1.1])
    y = abs(y) if "x^2 +" not in constraint else y
    begin = f"coordinates: [x, y]\nparameters: {{l: 1}}\nL: (x'^2 + y'^2)/2 - y\nconstraints: {{c: {constraint}}}\n"

    def found(last):
        problem = read("f.yaml", f"{begin}initial: {{x: {x}, y: {last}}}\n".encode()).problem
        return off_constraints(problem)

    [only] = found(y)
    assert only.span.line == 5
    assert found(only.hint.partition("write y: ")[2].partition(",")[0]) == []


def test_a_state_that_no_value_of_one_entry_moves_to_the_constraint_is_shown_there():
    begin = "coordinates: [x, y]\nL: (x'^2 + y'^2)/2\nconstraints: {c: x^2 + y^2 = -1}\n"
    [only] = off_constraints(read("f.yaml", f"{begin}initial: {{x: 1, y: 2}}\n".encode()).problem)
    assert "write" not in only.hint
