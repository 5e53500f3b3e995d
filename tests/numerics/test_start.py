"""The initial state: completed, refused, projected."""

import math

import pytest

from lagcli.numerics.equations.refusal import Refusal

from .running import simulated

ROD = "{coordinates: [x, y], L: (x'^2+y'^2)/2 - y, constraints: {rod: x^2 + y^2 = 25}, initial: %s}"


def first(text, **asked):
    return simulated(text, 1, **asked).rows[0][1:]


def test_what_the_constraints_determine_is_filled_in():
    text = "{coordinates: [x, th], L: (x'^2+th'^2)/2, constraints: {roll: x = 2*th}, initial: {th: 3, x': 4}}"
    assert first(text) == pytest.approx((6, 3, 4, 2))


def test_what_several_constraints_determine_together_is_filled_in():
    text = """{coordinates: [x, y, z], L: (x'^2+y'^2+z'^2)/2,
      constraints: {one: x + y = 3, two: x - y = 1, three: y' + z' = z*x'}, initial: {z: 5}}"""
    assert first(text) == pytest.approx((2, 1, 5, 0, 0, 0))
    blades = """{coordinates: [x, y, u, v], L: (x'^2+y'^2+u'^2+v'^2)/2,
      constraints: {one: u' + 2*v' = x', two: 3*u' - v' = 7*y'}, initial: {x': 1, y': 2}}"""
    assert first(blades) == pytest.approx((0, 0, 0, 0, 1, 2, 29 / 7, -11 / 7))


def test_of_dependent_constraints_what_is_open_is_0():
    text = """{coordinates: [x, y, z], L: (x'^2+y'^2+z'^2)/2,
      constraints: {one: x' + y' + z' = 1, two: x' + y' + 2*z' = 3, three: 2*x' + 2*y' + 3*z' = 4}}"""
    assert first(text) == pytest.approx((0, 0, 0, 0, -1, 2))


def test_what_is_not_determined_is_0():
    assert first("{coordinates: [x, y], L: (x'^2+y'^2)/2, initial: {y': 1}}") == (0, 0, 0, 1)


def test_a_double_root_is_one_value():
    assert first(ROD % "{x: 5, x': 0}") == pytest.approx((5, 0, 0, 0))


def test_two_values_are_asked_for():
    with pytest.raises(Refusal, match=r"'y' could be any of -4\.0, 4\.0"):
        first(ROD % "{x: 3}")


def test_an_assumption_decides():
    text = ROD.replace("[x, y]", "{x: , y: {assume: negative}}") % "{x: 3}"
    assert first(text)[:2] == pytest.approx((3, -4))


def test_off_the_surface_is_refused_with_the_nearest_state():
    text = ROD % "{x: 6, y: 0, x': 1}"
    with pytest.raises(Refusal, match="does not satisfy the constraint 'rod'") as caught:
        first(text)
    assert "--project" in caught.value.diagnostics[0].hint
    assert "x: 5.0" in caught.value.diagnostics[0].hint
    assert first(text, project=True) == pytest.approx((5, 0, 0, 0))


def test_not_tangent_is_refused():
    with pytest.raises(Refusal, match="does not move along the constraint 'rod'"):
        first(ROD % "{x: 3, y: 4, x': 1, y': 0}")


def test_contradictory_constraints_are_refused():
    text = ROD.replace("{rod:", "{other: x^2 + y^2 = 16, rod:") % "{x: 5, y: 0}"
    with pytest.raises(Refusal) as caught:
        first(text, project=True)
    assert "contradict" in caught.value.diagnostics[0].hint


def test_the_given_state_breaks_an_assumption():
    with pytest.raises(Refusal, match="'r' is positive"):
        first("{coordinates: {r: {assume: positive}}, L: r'^2/2, initial: {r: -1}}")


def test_a_redundant_constraint_leaves_the_motion_and_takes_the_multipliers():
    once = "{coordinates: [x, y], L: (x'^2+y'^2)/2 - y, constraints: {a: x^2 + y^2 = 1}, initial: {x: 1, y: 0}}"
    twice = once.replace("{a:", "{b: 2*x^2 + 2*y^2 = 2, a:")
    single, double = simulated(once, 10), simulated(twice, 10)
    assert double.rows[-1] == pytest.approx(single.rows[-1], abs=1e-9)
    shown = simulated(twice, 1, show="lambda_a, x''")
    assert shown.rows[-1][1] is None
    assert "redundant" in shown.warnings[0]
    assert all(max(pair) <= 1e-12 for pair in double.certificate.constraints.values())


def test_a_four_bar_linkage_passes_its_flat_position():
    """A parallelogram of rods 1, 2, 1: through the flat state it stays a parallelogram."""
    text = """
coordinates: [x1, y1, x2, y2]
T: (x1'^2 + y1'^2 + x2'^2 + y2'^2)/2
constraints:
  left: x1^2 + y1^2 = 1
  right: (x2 - 2)^2 + y2^2 = 1
  bar: (x2 - x1)^2 + (y2 - y1)^2 = 4
initial: {x1: 0.6, y1: 0.8, x2: 2.6, y2: 0.8, x1': 0.8, y1': -0.6, x2': 0.8, y2': -0.6}
"""
    result = simulated(text, 5, 1e-6, samples=11)
    assert result.certificate.reached
    for t, x1, y1, x2, y2 in (row[:5] for row in result.rows):
        angle = math.atan2(0.8, 0.6) - t
        assert (x1, y1) == pytest.approx((math.cos(angle), math.sin(angle)), abs=1e-6)
        assert (x2 - 2, y2) == pytest.approx((x1, y1), abs=1e-6)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_mass_and_constraint_singular_together_may_still_move(number):
    """A coordinate without mass that a constraint ties to one with mass."""
    text = "{coordinates: [x, y], L: x'^2/2 - y, constraints: {tie: y = %d*x}, initial: {x: 0}}"
    result = simulated(text % number, 2)
    assert result.rows[-1][1] == pytest.approx(-2 * number, abs=1e-9)


def test_a_constraint_by_an_unspecified_function_is_refused():
    """Its value at the beginning would have to be known to fill in the rest."""
    text = "{coordinates: [x, z], functions: {f: [x]}, L: (x'^2 + z'^2)/2, constraints: {bowl: z = f(x)}, initial: {x: 1}}"
    with pytest.raises(Refusal, match="the function 'f' is left unspecified"):
        simulated(text, 1)
