"""Speeds next to that of light, and far below it."""

import pytest
from mpmath import mp, mpf


def test_a_constant_force_for_1e5(simulate):
    """sqrt(1 + t^2) - 1."""
    text = "{coordinates: [x], L: x - sqrt(1 - x'^2), initial: {x: 0}}"
    run = simulate(text, 100000)
    assert run.status == 0
    assert run.last["x"] == pytest.approx(99999.000005, abs=1e-4)


@pytest.mark.long
def test_beginning_at_c_less_1e_minus_12(simulate):
    """x = (sqrt(m^2 + (p + t)^2) - sqrt(m^2 + p^2)), p = v/sqrt(1 - v^2) = 7e5."""
    text = "{coordinates: [x], parameters: {v: 1 - 1e-12}, L: 1e6*x - sqrt(1 - x'^2), initial: {x': v}}"
    run = simulate(text, 10, "--precision", 40, show="x,(1 - x')*1e12", accuracy=1e-10)
    with mp.workdps(50):
        v = 1 - mpf("1e-12")
        p = v / mp.sqrt(1 - v**2)
        q = p + 10**7
        x = (mp.sqrt(1 + q**2) - mp.sqrt(1 + p**2)) / 10**6
        slow = 1 - q / mp.sqrt(1 + q**2)
    assert run.status == 0
    assert run.last["x"] == pytest.approx(float(x), abs=1e-9)
    assert run.last["(1 - x')*1e12"] == pytest.approx(float(slow) * 1e12, abs=1e-10)


@pytest.mark.parametrize(("speed", "word"), [(1, "divided by zero"), ("1 + 1e-12", "real value")])
def test_at_c_and_above_is_refused(simulate, speed, word):
    text = f"{{coordinates: [x], L: x - sqrt(1 - x'^2), initial: {{x': {speed}}}}}"
    run = simulate(text, 1)
    assert run.status == 1
    assert word in run.err


def test_the_kinetic_energy_at_1e_minus_9_c(simulate):
    """gamma - 1 = v^2/2 + 3 v^4/8: 5e-19, of which nothing is left in 1/sqrt(1 - v^2) - 1."""
    text = "{coordinates: [x], L: -sqrt(1 - x'^2), initial: {x': 1e-9}}"
    run = simulate(text, 1, show="1e19*(1/sqrt(1 - x'^2) - 1)")
    assert run.status == 0
    assert run.last["1e19*(1/sqrt(1 - x'^2) - 1)"] == pytest.approx(5, rel=1e-12)
