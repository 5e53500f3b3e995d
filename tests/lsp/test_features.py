"""What an editor shows of a problem file."""

from __future__ import annotations

import pytest

from lagcli.lsp.features import hover, mistakes, suggestions
from lagcli.reader.habits import KEYS

FILE = """title: Pendulum
coordinates:
  theta: {unit: rad}
parameters:
  m: {assume: positive, unit: kg}
  l: {unit: m, value: 1/2}
  g: {unit: m/s^2, value: 9.81}
T: m*l^2*theta'^2/2
V: -m*g*l*cos(theta)
initial: {theta: 1}
"""


def suggested(text):
    """Where the sign | stands in a text."""
    line, column = next((k, x.index("|")) for k, x in enumerate(text.split("\n")) if "|" in x)
    return [each.text for each in suggestions(text.replace("|", ""), line, column)]


def test_the_keys_of_the_format_stand_at_the_beginning_of_a_line():
    assert set(suggested(FILE + "|")) == set(KEYS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("coordinates:\n  x:\n    |", {"unit", "symbol", "description", "assume"}),
        ("parameters:\n  m: {|", {"unit", "assume", "value", "integer"}),
        ("parameters:\n  m: {unit: kg, as|", {"unit", "assume", "value"}),
        ("parameters:\n  m: {assume: |", {"positive", "real"}),
        ("simulation: {method: |", {"dop853", "taylor"}),
        ("constraints:\n  rod:\n    acts_as: |", {"tension", "normal"}),
        (FILE + "forces:\n  |", {"theta"}),
        (FILE.replace("V: -m*g", "V: |"), {"theta", "theta'", "m", "l", "cos", "pi"}),
        (FILE + "find:\n  angle: {where: |", {"theta", "m"}),
        (FILE + "points:\n  bob: {position: [|", {"theta", "l"}),
    ],
)
def test_what_may_stand_at_a_place(text, expected):
    assert expected <= set(suggested(text))


def test_names_are_suggested_while_the_line_cannot_be_read():
    assert "theta" in suggested(FILE.replace("V: -m*g*l*cos(theta)", "V: m*(l - [|"))


@pytest.mark.parametrize(
    ("line", "column", "expected"),
    [
        (8, 0, "the potential energy; 0 without it"),
        (2, 4, "`theta`: coordinate, rad"),
        (8, 15, "```\n−m g l cos(θ)\n```\n\n`theta`: coordinate, rad"),
        (7, 3, "```\nm l² θ̇²/2\n```\n\n`m`: parameter, positive, kg"),
        (4, 6, "real without it"),
        (0, 9, "```\nPendulum\n```"),
        (10, 0, None),
        (99, 0, None),
    ],
)
def test_what_stands_at_a_place(line, column, expected):
    assert hover(FILE, line, column) == expected


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        ("9.81*m", "9.81 m"),
        ("m*x'^2/2 + 0.25*x", "m ẋ²/2 + 0.25 x"),
        ("x^1.5", "x^1.5"),
        ("1e-3*cos(0.5*x)", "0.001 cos(0.5 x)"),
    ],
)
def test_decimals_are_shown_as_they_are_written(formula, shown):
    assert hover(f"T: {formula}", 0, 3) == f"```\n{shown}\n```"


def test_mistakes_are_those_of_the_command_line():
    (found,) = mistakes("p.yaml", FILE.replace("cos(theta)", "cos(tetha)"))
    assert found.message == "unknown name 'tetha' in V"
    assert (found.span.line, found.span.column) == (9, 15)
    assert mistakes("p.yaml", FILE) == ()


@pytest.mark.parametrize(
    "text", ["", "\n", "{", "a: [", "- x", "coordinates", "T: \U0001f600", "T: \ud83d"]
)
def test_nothing_that_is_half_written_is_too_much(text):
    for line in range(text.count("\n") + 1):
        for column in range(len(text) + 1):
            suggestions(text, line, column)
            hover(text, line, column)
