"""Roots that only some parameters reach, against textbooks; each input is the YAML in the test."""

from __future__ import annotations

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.statements.questions import Solutions

from .formulas import formulas
from .questions import answers, roots

LADDER = """
coordinates: {x: FIRST, y: {}, theta: {}}
parameters: {m: POSITIVE, l: POSITIVE, g: POSITIVE, theta0: {}}
T: m*(x'^2 + y'^2)/2 + m*l^2*theta'^2/6
V: m*g*y
constraints:
  wall: {equation: x = l*cos(theta), multiplier: N, holds_while: N >= 0}
  floor: {equation: y = l*sin(theta), multiplier: K, holds_while: K >= 0}
initial: {theta: theta0}
find:
  asked: {where: N = 0, for: theta}
"""


@pytest.mark.long
def test_a_ladder_leaves_the_wall_at_two_thirds_of_its_height():
    """Morin, exercise 8.24 (method): sin(theta) = 2 sin(theta0)/3, on the side x > 0."""
    assert roots(LADDER.replace("FIRST", "POSITIVE")) == formulas("asin(2*sin(theta0)/3)")


@pytest.mark.long
def test_a_root_that_only_some_parameters_reach_is_listed_with_an_example():
    """Below the floor, -pi < theta0 < -pi/2, the contact lasts until the ladder hangs."""
    found = answers(LADDER.replace("FIRST", "{}"))["asked"]
    assert isinstance(found, Solutions)
    assert found.solutions is not None
    assert len(found.solutions) == 2
    assert "-pi/2 for some values of the parameters only, such as theta0 = -2" in found.note
    formulas_in_it = [to_grammar(part) for part in found.remarks if not isinstance(part, str)]
    assert {"-pi/2", "theta0"} <= set(formulas_in_it)


@pytest.mark.parametrize("power", [1, 2, 4])
def test_where_the_root_is_real_is_remarked_once(power):
    """From rest at x0 > 0 along a force that grows with x, x = b is reached wherever b > x0."""
    text = f"""
coordinates: {{x: POSITIVE}}
parameters: {{m: POSITIVE, k: POSITIVE, b: POSITIVE, x0: POSITIVE}}
T: m*x'^2/2
V: -k*x^{power}
initial: {{x: x0}}
find:
  asked: {{where: x = b, for: x'}}
"""
    speed = f"sqrt(2*k*(b^{power} - x0^{power})/m)"
    assert roots(text) == formulas(speed)
    note = answers(text)["asked"].note
    assert note.startswith("real for x0")
    assert "for some values" not in note
    assert "at x = b is not reached for the values tried" in note


def test_the_speed_that_a_turning_point_needs_is_a_function_of_the_place():
    """m v^2/2 = G M m (1/R - 1/r), from the energy."""
    text = """
coordinates: {r: POSITIVE}
parameters: {m: POSITIVE, k: POSITIVE, R: POSITIVE, v: POSITIVE}
T: m*r'^2/2
V: -k*m/r
initial: {r: R, r': v}
find:
  asked: {where: r' = 0, for: v}
"""
    assert roots(text) == formulas("sqrt(2*k*(1/R - 1/r))")


@pytest.mark.long
def test_the_values_of_the_file_are_used_where_no_general_root_is_found():
    """A bead leaves a hemisphere that slides: c^3/2 - 3 c + 2 = 0 for equal masses."""
    text = """
coordinates: {X: {}, r: POSITIVE, theta: {}}
parameters: {M: ONE, m: ONE, g: ONE, R: ONE}
T: M*X'^2/2 + m*((X' + r'*sin(theta) + r*theta'*cos(theta))^2
  + (r'*cos(theta) - r*theta'*sin(theta))^2)/2
V: m*g*r*cos(theta)
constraints: {surface: {equation: r = R, multiplier: N, holds_while: N >= 0}}
initial: {theta: 0}
find:
  asked: {where: N = 0, for: theta}
"""
    text = text.replace("ONE", "{assume: positive, value: 1}")
    assert roots(text) == formulas("acos(sqrt(3) - 1)")
    assert "values of the file" in answers(text)["asked"].note
