"""Units of what stands beside the formulas of a file: observables, `--set`, `--show`."""

from __future__ import annotations

import pytest

from lagcli.diagnostics import ProblemError
from lagcli.pipeline import Request, read
from lagcli.reader.columns import read_columns

ROLLING = """
coordinates: {x: {unit: m}, theta: {unit: rad}}
parameters:
  M: {unit: kg, assume: positive}
  R: {unit: m, assume: positive}
  l: {unit: m}
  g: {unit: m/s^2}
T: M*x'^2/2 + M*R^2*theta'^2/2
V: -M*g*x
constraints: {rolling: x = R*theta}
"""
PLAIN = ROLLING.replace("unit: m/s^2", "").replace("unit: kg, ", "").replace("unit: rad", "")
PLAIN = PLAIN.replace("unit: m, ", "").replace("unit: m", "")


def messages(text: str, setting: str) -> list[str]:
    return [
        d.message for d in read("a.yaml", text.encode(), Request(settings=(setting,))).diagnostics
    ]


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("R=g", "'g' is an acceleration (m/s^2), the value of 'R' must be a length (m)"),
        ("R=l/20 + g", "'g' is an acceleration (m/s^2), the value of 'R' must be a length (m)"),
        ("M=pi*l", "'pi*l' is a length (m), the value of 'M' must be a mass (kg)"),
    ],
)
def test_a_value_of_another_unit_is_refused(setting: str, said: str):
    assert messages(ROLLING, setting) == [f"--set {setting}: {said}"]


@pytest.mark.parametrize("setting", ["R=2", "R=l/20", "R=l/20 + 1", "g=0", "l=3*R"])
def test_a_value_of_its_unit_or_a_number_is_taken(setting: str):
    assert messages(ROLLING, setting) == []


def test_without_units_nothing_is_said():
    assert messages(PLAIN, "R=g") == []


def columns(text: str, word: str, *settings: str) -> list[str]:
    problem = read("a.yaml", text.encode(), Request(settings=settings)).problem
    assert problem is not None
    try:
        return [name for name, _ in read_columns(problem, [word])]
    except ProblemError as error:
        return [d.message for d in error.diagnostics]


@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("x + theta", "'theta' is a number where 'x' is a length (m)"),
        ("x'' - x'", "is a velocity (m/s) where"),
        ("energy + M*x'", "where 'energy' is an energy"),
        ("lambda_rolling*R + M*g", "where"),
        ("p_theta - p_x", "where 'p_theta' is an angular momentum"),
        ("sin(x)", "sin"),
    ],
)
def test_a_column_of_two_units_is_refused(word: str, said: str):
    [message] = columns(ROLLING, word)
    assert said in message
    assert columns(PLAIN, word) == ["t", word]


@pytest.mark.parametrize(
    "word",
    ["x", "x - R*theta", "x - 1", "energy - M*x'^2", "lambda_rolling + M*g", "rolling.theta",
     "p_theta - R*p_x", "x''", "M*(x - R)/2"],
)  # fmt: skip
def test_a_column_of_one_unit_is_written(word: str):
    assert columns(ROLLING, word) == ["t", word]


def test_a_problem_that_has_lost_units_to_numbers_is_not_checked():
    """With R = 1 put in, x - theta is what x - R theta was."""
    assert columns(ROLLING, "x - theta", "R=1") == ["t", "x - theta"]


def test_an_observable_is_checked_where_it_stands():
    found = read("a.yaml", (ROLLING + "observables: {A: x*p_x, B: A + x*p_theta}\n").encode())
    [mistake] = found.diagnostics
    assert "where 'A' is" in mistake.message
    assert mistake.span.line == 11
    well = ROLLING + "observables: {A: x*p_x, B: A + theta*p_theta}\n"
    assert read("a.yaml", well.encode()).diagnostics == ()
