"""Motions whose exact solution is known."""

import mpmath
import pytest

from .running import column, last, simulated

OSCILLATOR = """
coordinates: [x]
parameters: {k: 4}
L: x'^2/2 - k*x^2/2
initial: {x: 1, x': 0.5}
"""
PENDULUM = "{coordinates: [th], L: th'^2/2 + cos(th), initial: {th: 2}}"
KEPLER = """
coordinates: [x, y]
parameters: {e: 0.6}
L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)
initial: {x: 1 - e, y: 0, x': 0, y': sqrt((1 + e)/(1 - e))}
"""


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9, 1e-12])
def test_the_oscillator(accuracy):
    result = simulated(OSCILLATOR, 30, accuracy, samples=31)
    for t, x in zip(column(result, "t"), column(result, "x"), strict=True):
        exact = mpmath.cos(2 * mpmath.mpf(t)) + mpmath.sin(2 * mpmath.mpf(t)) / 4
        assert abs(x - exact) <= accuracy * 1.04


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9, 1e-12])
def test_the_pendulum_by_elliptic_functions(accuracy):
    """sin(th/2) = k sn(K(k) - t, k), k = sin(th0/2): Landau, Lifshitz, section 11, problem 1."""
    result = simulated(PENDULUM, 20, accuracy, samples=41)
    with mpmath.workdps(25):
        k = mpmath.sin(1)
        for t, th in zip(column(result, "t"), column(result, "th"), strict=True):
            sn = mpmath.ellipfun("sn", mpmath.ellipk(k**2) - mpmath.mpf(t), m=k**2)
            assert abs(th - 2 * mpmath.asin(k * sn)) <= accuracy * 2


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("e", ["0.1", "0.6", "0.9"])
def test_kepler_by_his_equation(accuracy, e):
    """x = cos(E) - e with E - e sin(E) = t."""
    result = simulated(KEPLER, 40, accuracy, samples=21, settings=(f"e={e}",))
    assert result.certificate.reached
    e = mpmath.mpf(e)
    scale = max(1, *map(abs, column(result, "y'")))
    for t, x, vy in zip(*(column(result, name) for name in ("t", "x", "y'")), strict=True):
        t = mpmath.mpf(t)
        start = t + e * mpmath.sin(t)
        E = mpmath.findroot(
            lambda E, t=t: E - e * mpmath.sin(E) - t, (start - 1, start + 1), solver="anderson"
        )
        assert abs(x - (mpmath.cos(E) - e)) <= accuracy * 1.9
        exact = mpmath.sqrt(1 - e**2) * mpmath.cos(E) / (1 - e * mpmath.cos(E))
        assert abs(vy - exact) <= accuracy * scale


def test_fall_with_multipliers_and_forces():
    """A mass held on x = 0: N = m g cos(alpha)."""
    result = simulated(
        "{coordinates: [x, y], L: (x'^2+y'^2)/2 + 3*x + 4*y, constraints: {floor: x = 0},"
        " initial: {x: 0, y: 0}}",
        2,
        show="y,y',y'',lambda_floor,floor.x,floor.y,p_y,energy",
    )
    expected = [2.0, 8, 8, 4, -3, -3, 0, 8, 0]
    assert list(result.rows[-1]) == pytest.approx(expected, abs=1e-9)


def test_a_driven_constraint():
    """The support y = sin(t) carries m (g + y'')."""
    result = simulated(
        "{coordinates: [x, y], L: (x'^2+y'^2)/2 - 10*y, constraints: {lift: y = sin(t)},"
        " initial: {x: 0, x': 1}}",
        3,
        show="x,y,y',lambda_lift",
        samples=7,
    )
    for t, x, y, rate, force in result.rows:
        exact = [t, mpmath.sin(t), mpmath.cos(t), 10 - mpmath.sin(t)]
        assert [x, y, rate, force] == pytest.approx([float(a) for a in exact], abs=1e-9)


def test_a_nonholonomic_blade():
    """Chaplygin's blade on the plane runs in a circle of radius v/omega."""
    result = simulated(
        "{coordinates: [x, y, phi], L: (x'^2+y'^2+phi'^2)/2,"
        " constraints: {blade: x'*sin(phi) = y'*cos(phi)}, initial: {x': 2, phi': 0.5}}",
        10,
        samples=11,
    )
    assert result.certificate.constraints["blade"][0] is None
    assert result.certificate.constraints["blade"][1] <= 1e-12
    for t, x, y in zip(*(column(result, name) for name in "txy"), strict=True):
        assert x == pytest.approx(float(4 * mpmath.sin(t / 2)), abs=1e-8)
        assert y == pytest.approx(float(4 - 4 * mpmath.cos(t / 2)), abs=1e-8)


def test_a_definition_and_its_rate_as_columns():
    result = simulated(
        "{coordinates: [x], definitions: {s: x^2 + t}, L: x'^2/2, initial: {x: 1, x': 2}}",
        3,
        show="s, s', s'', atan2(x', x)",
    )
    assert result.rows[-1][1:] == pytest.approx((52, 29, 8, float(mpmath.atan2(2, 7))))
    assert last(result, "t") == 3


def test_what_stays_at_0_at_any_accuracy():
    """1e-34 of a scale of 1e-300 is less than the least double."""
    result = simulated("{coordinates: [x], L: x'^2/2}", 1, 1e-32, method="taylor")
    assert result.certificate.reached
    assert last(result, "x") == 0
