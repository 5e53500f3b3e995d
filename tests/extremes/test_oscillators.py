"""Oscillators at resonance, at critical damping, without a linear term, in any units."""

import mpmath
import pytest
from mpmath import mp, mpf


def test_at_resonance(simulate):
    """x'' + x = cos(t): t sin(t)/2."""
    text = "{coordinates: [x], L: x'^2/2 - x^2/2 + x*cos(t), initial: {x: 0}}"
    run = simulate(text, 1000)
    assert run.status == 0
    assert run.last["x"] == pytest.approx(float(500 * mp.sin(1000)), rel=1e-9)


def test_beside_resonance_by_1e_minus_9(simulate):
    """(cos(w t) - cos(t))/(1 - w^2), w = 1 + 1e-9, which a double cannot subtract."""
    text = "{coordinates: [x], parameters: {w: 1 + 1e-9}, L: x'^2/2 - x^2/2 + x*cos(w*t), initial: {x: 0}}"
    run = simulate(text, 100)
    with mp.workdps(40):
        w = 1 + mpf("1e-9")
        exact = (mp.cos(100 * w) - mp.cos(100)) / (1 - w**2)
    assert run.last["x"] == pytest.approx(float(exact), abs=1e-7)


DAMPED = "{coordinates: [x], parameters: {b: %s}, L: x'^2/2 - x^2/2, dissipation: b*x'^2, initial: {x: 1}}"


@pytest.mark.parametrize("b", ["1", "1 + 1e-12", "1 - 1e-12"])
def test_at_critical_damping(simulate, b):
    """(1 + t) exp(-t), and next to it the same to 1e-10."""
    run = simulate(DAMPED % b, 20, show="x*exp(t)")
    assert run.status == 0
    assert run.last["x*exp(t)"] == pytest.approx(21, abs=1e-7)


def test_overdamped_by_1e4(simulate):
    """The slow root -b + sqrt(b^2 - 1) = -1/(b + sqrt(b^2 - 1))."""
    run = simulate(DAMPED % "1e4", 2)
    with mp.workdps(30):
        s = mp.sqrt(mpf(10) ** 8 - 1)
        slow, fast = -1 / (10**4 + s), -(10**4 + s)
        exact = (slow * mp.exp(2 * fast) - fast * mp.exp(2 * slow)) / (slow - fast)
    assert run.status == 0
    assert run.last["x"] == pytest.approx(float(exact), abs=1e-9)


QUARTIC = "{coordinates: [x], L: x'^2/2 - x^4/4, initial: {x: %s, x': %s}}"


def test_the_cubic_force_from_the_middle(simulate):
    """x'^2/2 + x^4/4 = 1/2 with x(0) = 0: the inverse of int dx/sqrt(1 - x^4/2)."""
    run = simulate(QUARTIC % (0, 1), 1)
    exact = mpmath.findroot(
        lambda x: mpmath.quad(lambda y: 1 / mp.sqrt(1 - y**4 / 2), [0, x]) - 1,
        (0.9, 1),
        solver="anderson",
    )
    assert float(exact) == pytest.approx(0.95199877, abs=1e-8)
    assert run.last["x"] == pytest.approx(float(exact), abs=1e-9)


def test_the_quartic_oscillator_of_amplitude_1e_minus_6(simulate):
    """Gamma(1/4)^2/sqrt(pi)/amplitude = 7.416298709/amplitude."""
    run = simulate(QUARTIC % ("1e-6", 0), "1e7", "--stop-when", "x'")
    exact = mp.gamma(0.25) ** 2 / mp.sqrt(mp.pi)
    assert float(exact) == pytest.approx(7.416298709, abs=1e-9)
    assert 2 * run.events[0]["t"] == pytest.approx(float(exact) * 1e6, rel=1e-9)


@pytest.mark.parametrize("unit", ["1e-12", "1", "1e12"])
def test_the_same_in_any_unit_of_length(simulate, unit):
    """The pendulum, sin(x/2u) = k sn(K - t, k)."""
    text = f"{{coordinates: [x], parameters: {{u: {unit}}}, L: x'^2/2 - u^2*(1 - cos(x/u)), initial: {{x: 1.5*u}}}}"
    run = simulate(text, 20, show="x/u")
    k = mp.sin(mpf("0.75"))
    exact = 2 * mp.asin(k * mpmath.ellipfun("sn", mpmath.ellipk(k**2) - 20, m=k**2))
    assert run.status == 0
    assert run.last["x/u"] == pytest.approx(float(exact), abs=1e-9)


@pytest.mark.parametrize("unit", ["1e-12", "1e12"])
def test_the_same_in_any_unit_of_time(simulate, unit):
    text = (
        f"{{coordinates: [x], parameters: {{w: {unit}}}, L: x'^2/2 - w^2*x^2/2, initial: {{x: 1}}}}"
    )
    run = simulate(text, f"20/{unit}", show="x,x'/w")
    assert run.status == 0
    assert run.last["x"] == pytest.approx(float(mp.cos(20)), abs=1e-9)
    assert run.last["x'/w"] == pytest.approx(-float(mp.sin(20)), abs=1e-9)


def test_a_potential_with_an_edge(simulate):
    """V = abs(x): 4 sqrt(2 x0) is the period, the edge is met 40 times."""
    text = "{coordinates: [x], L: x'^2/2 - abs(x), initial: {x: 1}}"
    run = simulate(text, "80*sqrt(2)")
    assert run.status == 0
    assert run.last["x"] == pytest.approx(1, abs=1e-9)


@pytest.mark.parametrize("width", ["0.1", "0.001", "0.0001"])
def test_a_narrow_impulse_is_found(simulate, width):
    """x' = width sqrt(pi) after it, however narrow."""
    text = f"{{coordinates: [x], L: x'^2/2, forces: {{x: exp(-((t - 5.123)/{width})^2)}}}}"
    run = simulate(text, 10, accuracy=1e-6)
    assert run.status == 0
    assert run.last["x'"] == pytest.approx(float(width) * float(mp.sqrt(mp.pi)), abs=1e-6)


def test_free_fall_against_a_weak_drag(simulate):
    """v = tanh(sqrt(k) t)/sqrt(k) with k = 1e-12: the drag is lost beside the weight."""
    text = "{coordinates: [y], parameters: {k: 1e-12}, L: y'^2/2 + y, forces: {y: -k*y'*abs(y')}, initial: {y: 0}}"
    run = simulate(text, 1000, accuracy=1e-10)
    root = mpf("1e-6")
    assert run.status == 0
    assert run.last["y'"] == pytest.approx(float(mp.tanh(1000 * root) / root), rel=1e-10)
