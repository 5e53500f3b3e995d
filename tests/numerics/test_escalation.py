"""`auto` carries more digits wherever they reach what rounding has lost."""

import mpmath
import pytest

from lagcli.numerics.compiled.engine import engine

from .running import last, simulated

FALL = """
coordinates: [x, y]
L: "(x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)"
initial: {{x: 1, y': {speed}}}
"""


@pytest.mark.long
@pytest.mark.parametrize("speed", ["1e-5", "1e-7"])
@pytest.mark.skipif(not engine().quadruple, reason="no numbers of 128 bits")
def test_a_perihelion_that_doubles_take_for_a_collision_is_passed(speed):
    """From the aphelion 1: a = 1/(2 - v^2), e = 1 - v^2; the perihelion is at v^2/2."""
    result = simulated(FALL.format(speed=speed), 3, 1e-9)
    assert result.certificate.reached
    with mpmath.workdps(40):
        v = mpmath.mpf(speed)
        a, e = 1 / (2 - v**2), 1 - v**2
        anomaly = mpmath.pi + 3 / mpmath.sqrt(a**3)
        found = mpmath.findroot(lambda u: u - e * mpmath.sin(u) - anomaly, anomaly + 0.5)
        x = -a * (mpmath.cos(found) - e)
        y = -a * mpmath.sqrt(1 - e**2) * mpmath.sin(found)
    assert last(result, "x") == pytest.approx(float(x), abs=1e-9)
    assert last(result, "y") == pytest.approx(float(y), abs=1e-9 * float(v))


def test_a_collision_stays_one():
    result = simulated(FALL.format(speed="0"), 3, 1e-9)
    assert not result.certificate.reached
    assert "grows without bound" in result.refusal
    assert result.events[-1].t == pytest.approx(float(mpmath.pi / mpmath.sqrt(8)), abs=1e-9)


@pytest.mark.skipif(not engine().quadruple, reason="no numbers of 128 bits")
def test_a_motion_that_loses_no_bit_of_doubles_has_the_whole_span_as_its_horizon():
    """Two runs of it in doubles agree in every bit; 1e-17 is for more of them."""
    text = "{coordinates: [x], T: x'^2/2, V: exp(-x^2), initial: {x: -3, x': 1.414121289559}}"
    assert last(simulated(text, 18, 1e-17, samples=9), "t") == 18
