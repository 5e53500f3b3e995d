"""The accuracy is relative to the scale of each column, in whatever units the file is written."""

import math

import pytest

from .running import column, simulated

ORBITS = """
coordinates: [x, y]
L: "(x'^2 + y'^2)/2 + {k!r}/sqrt(x^2 + y^2)"
initial: {{x: {x!r}, y': {v!r}}}
"""
BALL = """
coordinates: [y]
L: "y'^2/2 - {g!r}*y"
contacts: {{floor: {{gap: y >= 0, restitution: 0.6, multiplier: N}}}}
initial: {{y: {h!r}}}
"""


def test_nanometres_are_known_as_well_as_metres():
    """Fifty orbits at e = 0.9, at whose ends the motion is where it began."""
    nano = ORBITS.format(k=1e-27, x=1e-10, v=math.sqrt(19) * 1e-9)
    until = 100 * math.pi
    result = simulated(nano, until, 1e-3, samples=6)
    assert result.certificate.reached
    peaks = {"x": 1.9e-9, "y": 4.4e-10, "x'": 2.3e-9, "y'": 4.4e-9}
    for name, peak in peaks.items():
        start = column(result, name)[0]
        assert max(abs(x - start) for x in column(result, name)) <= 1e-3 * peak


@pytest.mark.parametrize(("metre", "second"), [(1e-9, 1.0), (1.0, 1e-9), (1e12, 1e9)])
def test_a_ball_bounces_as_often_in_any_units(metre, second):
    """The n-th impact is at sqrt(2 h/g) (1 + 2 e + ... + 2 e^(n - 1))."""
    ball = BALL.format(g=9.81 * metre / second**2, h=2 * metre)
    result = simulated(ball, 4 * second, 1e-3, samples=3)
    assert result.certificate.reached
    impacts = [event.t for event in result.events if event.what == "impact"]
    first = math.sqrt(4 / 9.81) * second
    for n, t in enumerate(impacts):
        assert t == pytest.approx(first * (1 + 2 * sum(0.6**k for k in range(1, n + 1))), rel=1e-9)
    # every flight that is longer than 1e-3 of the span is told
    assert 0.6 ** len(impacts) * 2 * first < 1e-3 * 4 * second


def test_what_is_0_but_for_rounding_is_no_obstacle():
    """A pendulum in space that stays in the plane y = 0, where the file says cos(pi/2)."""
    pendulum = """
coordinates: [x, y, z]
L: (x'^2 + y'^2 + z'^2)/2 - z
constraints: {rod: x^2 + y^2 + z^2 = 1}
initial: {x: 0.8*cos(0.3), y: 0.8*cos(pi/2), z: -0.6, x': 0, y': 0.3*sin(2*pi)}
"""
    result = simulated(pendulum, 20, 1e-9, project=True)
    assert result.certificate.reached
    assert all(abs(y) < 1e-12 for y in column(result, "y"))


def test_an_energy_of_0_is_measured_against_its_terms():
    parabola = ORBITS.format(k=1.0, x=0.5, v=2.0)
    result = simulated(parabola, 20, 1e-9, show="x,energy")
    assert result.certificate.reached
    assert all(abs(x) < 1e-9 for x in column(result, "energy"))
