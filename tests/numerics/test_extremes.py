"""Cases at the edge, each with its known outcome."""

import math

import mpmath
import pytest

from lagcli.numerics.equations.refusal import Refusal

from .running import column, last, simulated

PENDULUM = "{coordinates: [th], L: th'^2/2 + cos(th), initial: {th: %s}}"
SPRING = "{coordinates: [x], L: x'^2/2 - x^4/4, initial: {x: %s, x': %s}}"


def test_a_tiny_amplitude_is_known_relative_to_itself():
    result = simulated(PENDULUM % "1e-8", 1000)
    assert last(result, "th") == pytest.approx(5.6237907629070816e-9, rel=1e-9)


def test_units_scaled_by_1e12_give_the_same_relative_answer():
    text = "{coordinates: [x], parameters: {u: 1}, L: x'^2/2 - u^2*(1-cos(x/u)), initial: {x: 1.5*u, x': 0.5*u}}"
    usual = simulated(text, 20)
    for unit in ("1e-12", "1e12"):
        scaled = simulated(text, 20, settings=(f"u={unit}",))
        assert last(scaled, "x") / float(unit) == pytest.approx(last(usual, "x"), rel=1e-9)


def test_at_rest_on_top_it_stays():
    assert last(simulated(PENDULUM % "0", 100), "th") == 0


@pytest.mark.long
def test_pi_as_a_decimal_falls_with_more_digits_and_is_refused_in_doubles():
    """d = pi - 3.141592653589793 = 2.4e-16 grows as d cosh(t)."""
    text = PENDULUM % "3.141592653589793"
    refused = simulated(text, 42, 1e-6, samples=43, method="taylor64")
    assert not refused.certificate.reached
    assert 15 < refused.certificate.holds_until < 36
    fallen = simulated(text, 42, 1e-6, samples=43, digits=40)
    assert fallen.certificate.reached
    with mpmath.workdps(30):
        d = mpmath.pi - mpmath.mpf("3.141592653589793")
        assert column(fallen, "th")[30] == pytest.approx(
            float(mpmath.pi - d * mpmath.cosh(30)), abs=1e-6
        )
    assert abs(last(fallen, "th") - math.pi) > 1


@pytest.mark.long
def test_the_period_next_to_the_separatrix():
    """4 K(sin(th0/2)) for th0 = pi - 1e-12 is 118.84185063, which doubles cannot tell."""
    text = PENDULUM % "pi - 1e-12"
    doubles = simulated(text, 62, 1e-6, stop="th'", method="taylor64")
    assert not doubles.certificate.reached
    for digits, accuracy in ((None, 1e-6), (50, 1e-9)):
        result = simulated(text, 62, accuracy, stop="th'", digits=digits)
        assert 2 * result.events[0].t == pytest.approx(118.84185063, rel=accuracy)


def test_released_at_90_degrees_the_energy_stays():
    result = simulated(PENDULUM % "pi/2", 100, 1e-9, show="energy", samples=101)
    assert max(map(abs, column(result, "energy"))) < 1e-12


def test_the_cubic_spring():
    assert last(simulated(SPRING % (0, 1), 1), "x") == pytest.approx(0.95199877, abs=1e-8)


def test_the_quartic_oscillator_of_small_amplitude():
    result = simulated(SPRING % ("1e-6", 0), 1e7, stop="x'", samples=2)
    assert 2 * result.events[0].t == pytest.approx(7416298.709, abs=1e-3)


def test_a_relativistic_particle_under_a_constant_force():
    text = "{coordinates: [x], L: x - sqrt(1 - x'^2), initial: {x: 0}}"
    assert last(simulated(text, 1e5), "x") == pytest.approx(99999.000005, abs=1e-6)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("{coordinates: [x], L: x - sqrt(1 - x'^2), initial: {x': 1}}", "divided by zero"),
        ("{coordinates: [x], L: x - sqrt(1 - x'^2), initial: {x': 2}}", "no real value"),
        ("{coordinates: [x, y], L: x*y' - x^2 - y^2, initial: {x: 1}}", "mass matrix"),
        ("{coordinates: [x, y], parameters: {m: 0}, L: x'^2/2 + m*y'^2/2 - x^2}", "mass matrix"),
        ("{coordinates: [x, y], L: (x'^2+y'^2)/2 + 1/abs(x-y)}", "divided by zero"),
        ("{coordinates: [x], L: x'^2/2 + exp(x), initial: {x: 1000}}", "beyond all bounds"),
        ("{coordinates: [x], functions: {U: [x]}, L: x'^2/2 - U(x)}", "unspecified"),
        ("{coordinates: [x], parameters: [k, m], L: m*x'^2/2 - k*x^2}", "'k' and 'm' have no values"),
    ],
)  # fmt: skip
def test_refused_with_a_reason(text, word):
    with pytest.raises(Refusal, match=word):
        simulated(text, 1)


def test_the_radial_fall_stops_in_the_centre():
    """pi/(2 sqrt(2)) = 1.110720734540."""
    result = simulated("{coordinates: [r], L: r'^2/2 + 1/r, initial: {r: 1}}", 2, samples=21)
    assert not result.certificate.reached
    assert result.events[0].t == pytest.approx(math.pi / math.sqrt(8), abs=1e-12)
    assert 1.11 < result.certificate.holds_until < math.pi / math.sqrt(8)
    assert "without bound" in result.refusal


def test_an_explosion_is_told():
    result = simulated("{coordinates: [x], L: x'^2/2 + exp(x), initial: {x: 1}}", 10)
    exact = math.sqrt(2 / math.e) * math.pi / 2
    assert result.events[0].t == pytest.approx(exact, abs=1e-9)
    assert not result.certificate.reached


def test_the_kink_of_abs_is_located():
    """Period 4 sqrt(2 x0)."""
    text = "{coordinates: [x], L: x'^2/2 - abs(x), initial: {x: 1}}"
    result = simulated(text, 4 * math.sqrt(2) * 5)
    assert last(result, "x") == pytest.approx(1, abs=1e-9)
    assert result.steps < 400


def test_coulomb_friction_slides_and_sticks():
    """Each half-swing loses 2 mu; it sticks when |x| <= mu."""
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, forces: {x: -sign(x')/10}, initial: {x: 1}}"
    assert last(simulated(text, math.pi), "x") == pytest.approx(-0.8, abs=1e-9)
    result = simulated(text, 40)
    assert result.events[0].t == pytest.approx(5 * math.pi, abs=1e-8)
    assert [event.what for event in result.events] == ["sticks"]
    assert last(result, "x") == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("width", [0.1, 0.01])
def test_a_narrow_impulse_from_rest_is_found(width):
    text = f"{{coordinates: [x], L: x'^2/2, forces: {{x: exp(-((t - 5.123)/{width})^2)}}}}"
    result = simulated(text, 10, 1e-6)
    assert last(result, "x'") == pytest.approx(width * math.sqrt(math.pi), abs=1e-6)


def test_zero_gravity_gives_more_charges():
    text = (
        "{coordinates: [x, y], parameters: {g: 0}, L: (x'^2+y'^2)/2 - g*y, initial: {x': 1, y': 2}}"
    )
    result = simulated(text, 100)
    assert result.rows[-1][1:] == pytest.approx((100, 200, 1, 2))
    assert result.certificate.charges["energy"] <= 1e-12


@pytest.mark.parametrize("ratio", ["1e-12", "1e4"])
def test_a_mass_ratio(ratio):
    """The double pendulum against its 40-digit motion."""
    text = """
coordinates: [a, b]
parameters: {m: 1}
L: (1 + m)*a'^2/2 + m*b'^2/2 + m*a'*b'*cos(a - b) + (1 + m)*cos(a) + m*cos(b)
initial: {a: 1, b: 2}
"""
    fine = simulated(text, 1, 1e-15, settings=(f"m={ratio}",), digits=40)
    usual = simulated(text, 1, 1e-10, settings=(f"m={ratio}",))
    assert usual.rows[-1] == pytest.approx(fine.rows[-1], abs=1e-10)
    assert fine.method == "taylor"
