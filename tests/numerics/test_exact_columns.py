"""Columns near a coordinate singularity are as exact as the states they are worked out at."""

import pytest

import lagcli

from .running import column, simulated

TOP = """
coordinates: [theta, phi, psi]
parameters: {A: 1.1, C: 0.5, w: 2}
T: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2
V: w*cos(theta)
initial: {theta: 0.00001, phi: 0, psi: 0, theta': 0.2, phi': 2, psi': 7}
"""


def precession(theta, speed, phi_speed, psi_speed):
    """phi'' and psi'' of the symmetric top, by its two momenta, with 40 digits.

    A sin^2 phi' + C w3 cos and C w3 = C (psi' + phi' cos) are constant: Landau, Lifshitz,
    Mechanics, 3rd ed., section 35.
    """
    from mpmath import cos, mpf, sin, workdps

    with workdps(40):
        a, c = mpf(11) / 10, mpf(1) / 2
        s, k = sin(mpf(theta)), cos(mpf(theta))
        spin = psi_speed + k * phi_speed
        phi = (c * spin - 2 * a * k * phi_speed) * speed / (a * s)
        return float(phi), float(s * speed * phi_speed - k * phi)


@pytest.mark.long
@pytest.mark.parametrize(("method", "until"), [("auto", 2), ("dop853", 2e-3)])
def test_the_acceleration_of_a_top_that_is_almost_upright(method, until):
    """M is singular to 1e-10 at the first row, alike in both runs: they agree in 8 wrong digits."""
    show = "theta, theta', phi', psi', phi'', psi''"
    result = simulated(TOP, until, 1e-9, samples=11, show=show, method=method)
    assert result.certificate.reached == (method == "auto")  # dop853 stops at once
    _, *state, phi, psi = result.rows[0]
    true = precession(*state)
    for name, value, exact in zip(("phi''", "psi''"), (phi, psi), true, strict=True):
        claimed = result.certificate.global_error[name] + 2.0**-52
        assert abs(value - exact) <= claimed * abs(exact)


def test_a_difference_of_constants_that_no_two_runs_can_tell():
    """100000 (sqrt(a + 1) - sqrt(a)) with doubles is wrong by 6e-7, whatever the run."""
    text = (
        "coordinates: [x]\nparameters: {a: 10000000000.1}\nT: x'^2/2\nV: x^2/2\ninitial: {x: 0}\n"
    )
    show = "x, 100000*(sqrt(a + 1) - sqrt(a))"
    values = column(simulated(text, 10, 1e-9, show=show), show[3:])
    assert values == pytest.approx([0.5 - 1.5e-11] * 2, abs=1e-14)


def test_redundant_constraints_are_left_to_doubles():
    """A pivot of rounding is no number to divide by, with whatever digits."""
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: 9.81*y
constraints:
  rod: x^2 + y^2 = 1
  again: 2*x^2 + 2*y^2 = 2
initial: {x: 0.6, y: -0.8, x': 0.8, y': 0.6}
"""
    result = simulated(text, 2, 1e-9, samples=11, show="x, y, x', y', x'', y''")
    assert result.certificate.reached
    for _, x, y, v, w, a, b in result.rows:
        held = 9.81 * y - v * v - w * w  # along the rod: r r'' = -v^2
        assert a == pytest.approx(held * x, abs=1e-7)
        assert b == pytest.approx(held * y - 9.81, abs=1e-7)


@pytest.mark.parametrize("accuracy", [1e-11, 1e-12])
def test_rows_of_more_digits_are_at_the_times_that_are_written(accuracy):
    """x'' = 5000 cos(5000 t) - x at multiples of 11/30, which are not doubles."""
    from mpmath import mpf, sin, workdps

    text = "{coordinates: [x], T: x'^2/2, V: x^2/2, forces: {x: 5000*cos(5000*t)}, initial: {x: 0}}"
    shown = ["x'", "5000*t"]
    result = lagcli.simulate(lagcli.loads(text), 1.1, accuracy=accuracy, samples=4, show=shown)
    assert result.method in {"taylor80", "taylor128"}
    with workdps(40):
        for k, row in enumerate(result.rows):
            t, w = mpf(11) * k / 30, mpf(5000)
            exact = w / (1 - w**2) * (sin(t) - w * sin(w * t))
            assert row[1] == pytest.approx(float(exact), abs=1e-14)
            assert row[2] == float(w * t)
