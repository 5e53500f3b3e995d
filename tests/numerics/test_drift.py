"""The drift of a charge in units in which it is nowhere near 1."""

import pytest

from .running import column, simulated

ORBIT = """
coordinates: [x, y]
parameters: {{m: {m}, k: {k}}}
T: m*(x'^2 + y'^2)/2
V: -k/sqrt(x^2 + y^2)
initial: {{x: {x}, y: 0, x': 0, y': {v}}}
symmetries:
  rotation: {{x: -y, y: x}}
"""
#: an electron about a proton and the Earth about the Sun, in SI units.
ATOM = {"m": 9.1093837e-31, "k": 2.3070776e-28, "x": 5.29177e-11, "v": 1.5e6}
EARTH = {"m": 5.972e24, "k": 7.926e44, "x": 1.471e11, "v": 30290}


@pytest.mark.long
@pytest.mark.parametrize(("given", "until"), [(ATOM, 1.5e-15), (EARTH, 3e8)])
def test_a_charge_is_measured_against_its_own_terms(given, until):
    result = simulated(ORBIT.format(**given), until, 1e-3, samples=101, method="dop853")
    m, k = given["m"], given["k"]
    rows = list(zip(*(column(result, name) for name in ("x", "y", "x'", "y'")), strict=True))
    spins = [m * (x * w - y * v) for x, y, v, w in rows]
    energies = [m * (v**2 + w**2) / 2 - k / (x**2 + y**2) ** 0.5 for x, y, v, w in rows]
    for name, values in (("rotation", spins), ("energy", energies)):
        changed = max(abs(value - values[0]) for value in values) / abs(values[0])
        drift = result.certificate.charges[name]
        assert changed > 1e-12
        assert changed / 20 < drift <= 1.01 * changed


def test_a_charge_that_is_a_difference_of_large_terms_is_not_measured_against_what_is_left():
    """x = y to 3e-7: L is the rounding of two terms of 1."""
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: (x^2 + y^2)/2
initial: {x: 1, y: 1, x': 0.7, y': 0.7000003}
symmetries:
  rotation: {x: -y, y: x}
"""
    result = simulated(text, 20, 1e-9, samples=101)
    assert result.certificate.charges["rotation"] < 1e-14


def test_a_charge_of_nothing_does_not_drift():
    text = "coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: x^2/2\ninitial: {x: 1, y: 0}\n"
    assert simulated(text, 20).certificate.charges["p_y"] == 0
