"""Contacts that are lost, strings that go slack, `--stop-when`, grazing."""

import math
from random import Random

import pytest

from .running import column, last, simulated

HEMISPHERE = """
coordinates: [r, th]
T: (r'^2 + r^2*th'^2)/2
V: r*cos(th)
constraints: {surface: {equation: r = 1, multiplier: N, holds_while: N >= 0}}
initial: {r: 1, th: %s}
"""


def test_a_hemisphere_is_left_at_48_degrees():
    """From rest at th0: cos(th) = 2 cos(th0)/3; 48.189685104221 degrees from the top."""
    result = simulated(HEMISPHERE % "1e-8", 40, 1e-9, show="th,N")
    assert result.events[0].what == "contact lost"
    assert math.degrees(last(result, "th")) == pytest.approx(48.189685104221, abs=1e-7)
    assert last(result, "N") == pytest.approx(0, abs=1e-9)
    assert result.certificate.holds_until == result.events[0].t


def test_a_string_goes_slack():
    """v0^2 = 4 g l: cos(th) = -2/3, th = 2.300523983022."""
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: y
constraints: {string: {equation: x^2 + y^2 = 1, holds_while: lambda_string <= 0}}
initial: {x: 0, y: -1, x': 2}
"""
    result = simulated(text, 10, 1e-9, show="atan2(x, -y)")
    assert result.rows[-1][1] == pytest.approx(2.300523983022, abs=1e-9)


def test_contact_that_does_not_even_begin():
    text = "{coordinates: [y], L: y'^2/2 + y, constraints: {floor: {equation: y = 0, holds_while: lambda_floor >= 0}}}"
    result = simulated(text, 1)
    assert result.events[0].t == 0
    assert len(result.rows) == 1


def test_stop_when_changes_sign():
    result = simulated(
        "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}", 10, stop="x - 1/2", samples=11
    )
    assert result.events[0].t == pytest.approx(math.pi / 3, abs=1e-9)
    assert column(result, "t") == pytest.approx([0, 1, math.pi / 3])


def test_stop_when_begins_at_zero():
    """x' = 0 at the beginning; the next zero is half a period later."""
    result = simulated("{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}", 10, stop="x'")
    assert result.events[0].t == pytest.approx(math.pi, abs=1e-9)


@pytest.mark.parametrize("depth", [1e-3, 1e-6])
def test_a_root_that_almost_grazes(depth):
    """x = sin(t) dips below -1 + depth for a moment only."""
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 0, x': 1}}"
    result = simulated(text, 20, 1e-9, stop=f"x + 1 - {depth}")
    assert result.events[0].t == pytest.approx(math.pi + math.asin(1 - depth), abs=1e-5)


def test_no_event_where_it_does_not_reach():
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 0, x': 1}}"
    assert simulated(text, 20, 1e-9, stop="x + 1 + 1e-6").events == ()


@pytest.mark.parametrize("accuracy", [1e-6, 1e-9])
def test_a_root_of_even_multiplicity(accuracy):
    """x = sin(t) touches -1 at 3 pi/2 and does not pass it."""
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 0, x': 1}}"
    result = simulated(text, 20, accuracy, stop="x + 1")
    assert result.events[0].t == pytest.approx(3 * math.pi / 2, abs=accuracy)
    assert result.certificate.reached


def test_events_between_comparison_points_and_at_the_same_time():
    """Both conditions fail at one time; stopping comes first."""
    text = "{coordinates: [x], L: x'^2/2, contacts: {wall: {gap: x <= 1, restitution: 1}}, initial: {x': 0.77}}"
    result = simulated(text, 10, stop="x - 1")
    assert [event.what for event in result.events] == ["stopped"]
    assert result.events[0].t == pytest.approx(1 / 0.77, abs=1e-9)


def test_a_sign_that_an_impact_changes_stops_the_run():
    text = "{coordinates: [x], L: x'^2/2, contacts: {wall: {gap: x <= 1, restitution: 1}}, initial: {x': 0.5}}"
    result = simulated(text, 10, stop="x'", samples=3)
    assert [event.what for event in result.events] == ["impact", "stopped"]
    assert result.rows[-1][0] == pytest.approx(2, abs=1e-9)


def test_a_series_that_takes_long_steps_is_looked_at_closely():
    """One step of the series is longer than the dip of the margin."""
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 0, x': 1}}"
    for method in ("taylor64", "taylor"):
        result = simulated(text, 40, 1e-9, stop="x + 1 - 1e-4", method=method)
        assert result.events[0].t == pytest.approx(math.pi + math.asin(1 - 1e-4), abs=1e-7)


@pytest.mark.parametrize("accuracy", [1e-6, 1e-9])
def test_two_walls_are_struck_one_after_the_other(accuracy):
    """x and y return from their walls after different times, however little these differ."""
    draw = Random(16)
    for _ in range(3):
        late = 10 ** -draw.uniform(6, 11)
        result = simulated(
            "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: 0, contacts: {a: {gap: x >= 0, "
            f"restitution: 1}}, b: {{gap: y >= 0, restitution: 1}}}}, "
            f"initial: {{x: 1, y: {1 + late!r}, x': -1, y': -1}}}}",
            3,
            accuracy,
            samples=4,
        )
        assert result.certificate.reached
        bounds, row = result.certificate.global_error, result.rows[-1]
        assert abs(row[1] - 2) <= 3 * bounds["x"] + 2.0**-52
        assert abs(row[2] - (2 - ((1 + late) - 1))) <= 3 * bounds["y"] + 2.0**-51


@pytest.mark.parametrize("struck", [True, False])
def test_whether_a_ceiling_is_struck_does_not_depend_on_the_accuracy_asked_for(struck):
    """y = 2 t - t^2 has its top at 1, a little above the ceiling or below it."""
    d = 1e-8
    result = simulated(
        "{coordinates: [y], T: y'^2/2, V: 2*y, contacts: {ceiling: "
        f"{{gap: 1 {'-' if struck else '+'} {d!r} - y >= 0, restitution: 1}}}}, "
        "initial: {y: 0, y': 2}}",
        1.5,
        1e-6,
        samples=4,
    )
    assert result.certificate.reached
    assert result.certificate.accuracy == 1e-6
    t, y, speed = result.rows[-1]
    late = 2 * math.sqrt(d) if struck else 0.0  # as if thrown later, from the other side
    top = t - 1 + late if struck else t - 1
    assert speed == pytest.approx(-2 * top, abs=1e-10)
    assert y == pytest.approx(1 - top * top, abs=1e-10)
