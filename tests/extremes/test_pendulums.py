"""Pendulums: tiny and largest amplitudes, poles, chaos, ratios of masses, stiff springs."""

import mpmath
import pytest
from mpmath import mp, mpf

from .reference import number, solution

PLANE = "{coordinates: [th], L: th'^2/2 + cos(th), initial: {th: %s}}"


def period(amplitude):
    return 4 * mpmath.ellipk(mp.sin(amplitude / 2) ** 2)


def test_amplitude_1e_minus_8_over_1000(simulate):
    """sin(th/2) = k sn(K - t, k): the error is bounded relative to the amplitude."""
    run = simulate(PLANE % "1e-8", 1000, show="th*1e8", accuracy=1e-10)
    with mp.workdps(40):
        k = mp.sin(mpf("1e-8") / 2)
        sn = mpmath.ellipfun("sn", mpmath.ellipk(k**2) - 1000, m=k**2)
        exact = 2e8 * mp.asin(k * sn)
    assert float(exact) == pytest.approx(0.56237907629070816, rel=1e-15)
    assert run.status == 0
    assert run.last["th*1e8"] == pytest.approx(float(exact), abs=1e-10)


@pytest.mark.long
@pytest.mark.parametrize(
    ("start", "known"), [("pi - 1e-12", 118.84185063), ("3.1415926535887932", None)]
)
def test_period_next_to_the_separatrix(simulate, start, known):
    """A decimal number of the file is that number, not the nearest double."""
    with mp.workdps(50):
        amplitude = mp.pi - mpf("1e-12") if known else mpf(start)
        exact = float(period(amplitude))
    if known:
        assert exact == pytest.approx(known, abs=1e-8)
    run = simulate(PLANE % start, 62, "--stop-when", "th'", "--precision", 50)
    assert run.status == 0
    assert 2 * run.events[0]["t"] == pytest.approx(exact, abs=1e-8)
    assert simulate(PLANE % start, 62, "--method", "taylor64").status == 1
    assert simulate(PLANE % start, 62).status == 0


def test_exactly_on_top_it_stays(simulate):
    run = simulate(PLANE % "pi", 50, "--precision", 60, show="th - pi")
    assert run.status == 0
    assert abs(run.last["th - pi"]) < 1e-9


@pytest.mark.long
def test_on_top_as_a_double_it_falls(simulate):
    """d = pi - th0 grows as d cosh(t): at a right angle where tan(th/4) says so."""
    start = "3.141592653589793115997963468544185161590576171875"
    run = simulate(PLANE % start, 42, "--stop-when", "cos(th)", "--precision", 50)
    with mp.workdps(50):
        k = mp.sin(mpf(start) / 2)
        # sin(th/2) = k sn(K - t, k) and th = pi/2
        exact = mpmath.ellipk(k**2) - mpmath.ellipf(mp.asin(mp.sin(mp.pi / 4) / k), k**2)
    assert run.events[0]["t"] == pytest.approx(float(exact), abs=1e-8)
    assert 36 < exact < 39


def test_from_rest_at_90_degrees_the_energy_is_kept(simulate):
    run = simulate(PLANE % "pi/2", 100, show="energy", samples=101)
    assert run.status == 0
    assert max(abs(row["energy"]) for row in run.rows) < 1e-12


def test_a_chain_from_rest_on_the_level(simulate):
    """Three links released horizontally: no jump where the first rates vanish."""
    text = """
coordinates: [a, b, c]
definitions: {x1: sin(a), y1: cos(a), x2: x1 + sin(b), y2: y1 + cos(b), x3: x2 + sin(c), y3: y2 + cos(c)}
T: (x1'^2 + y1'^2 + x2'^2 + y2'^2 + x3'^2 + y3'^2)/2
V: -y1 - y2 - y3
initial: {a: pi/2, b: pi/2, c: pi/2}
"""
    run = simulate(text, 3, show="energy", samples=31)
    assert run.status == 0
    assert max(abs(row["energy"]) for row in run.rows) < 1e-10


CARTESIAN = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: y
constraints: {rod: x^2 + y^2 = 1}
initial: {x: sqrt(3)/2, y: -1/2}
"""


@pytest.mark.parametrize(
    "periods", [100, pytest.param(10**4, marks=pytest.mark.long)]
)  # fmt: skip
def test_the_constraint_is_held_over_many_periods(simulate, periods):
    """After n periods it is back at rest; the rod has kept its length."""
    until = mpmath.nstr(periods * period(mp.pi / 3), 17)
    run = simulate(CARTESIAN, until, show="atan2(x, -y)", accuracy=1e-8)
    assert run.status == 0
    assert run.last["atan2(x, -y)"] == pytest.approx(float(mp.pi / 3), abs=1e-8)
    assert max(run.held["constraints"]["rod"].values()) <= 1e-12
    assert run.held["charges"]["energy"]["drift"] <= 1e-8


SPHERICAL = """
coordinates: [th, ph]
L: (th'^2 + sin(th)^2*ph'^2)/2 + cos(th)
initial: {th: 1, ph': %s}
"""


def test_the_spherical_pendulum_through_the_pole(simulate):
    """With ph' = 0 it is the plane pendulum: back at its amplitude after a period."""
    run = simulate(SPHERICAL % 0, mpmath.nstr(period(mpf(1)), 17))
    assert run.status == 0
    assert run.last["th"] == pytest.approx(1, abs=1e-9)
    assert run.last["ph"] == 0


@pytest.mark.parametrize("rate", ["1e-3", "1e-6"])
def test_the_spherical_pendulum_beside_the_pole(simulate, rate):
    """In angles and in Cartesian coordinates; ph turns by half a turn within 1e-6."""
    cartesian = f"""
coordinates: [x, y, z]
T: (x'^2 + y'^2 + z'^2)/2
V: z
constraints: {{rod: x^2 + y^2 + z^2 = 1}}
initial: {{x: sin(1), y: 0, z: -cos(1), x': 0, y': sin(1)*{rate}, z': 0}}
"""
    angles = simulate(SPHERICAL % rate, 5, show="sin(th)*cos(ph),sin(th)*sin(ph),cos(th)")
    points = simulate(cartesian, 5, show="x,y,-z")
    assert angles.status == points.status == 0
    assert list(angles.last.values()) == pytest.approx(list(points.last.values()), abs=2e-9)


DOUBLE = """
coordinates: [a, b]
parameters: {m: %s}
L: (1 + m)*a'^2/2 + m*b'^2/2 + m*a'*b'*cos(a - b) + (1 + m)*cos(a) + m*cos(b)
initial: {a: %s, b: %s}
"""


def double_pendulum(m):
    """The rates of (a, b, a', b') with unit lengths, gravity and first mass, by Cramer's rule."""
    m = number(m)

    def rate(y):
        a, b, u, w = y
        s, c = (a - b).sin_cos()
        f = -m * w * w * s - (1 + m) * a.sin()
        g = u * u * s - b.sin()
        d = 1 + m * s * s
        return [u, w, (f - m * c * g) / d, ((1 + m) * g - c * f) / d]

    return rate


@pytest.mark.parametrize("ratio", ["1e-12", "1e4", "1e12"])
def test_the_double_pendulum_with_a_mass_ratio(simulate, ratio):
    exact = solution(double_pendulum(ratio), [1, 2, 0, 0], 1, 10)
    run = simulate(DOUBLE % (ratio, 1, 2), 1, "--precision", 40, accuracy=1e-11)
    assert run.status == 0
    assert [run.last["a"], run.last["b"]] == pytest.approx(exact[:2], abs=1e-11)


@pytest.mark.long
def test_the_double_pendulum_to_its_horizon(simulate):
    """Doubles say until when they hold, and it is so; with more digits the end is reached."""
    text = DOUBLE % (1, 3, "5/2")
    doubles = simulate(text, 60, "--method", "dop853", accuracy=1e-6, samples=61)
    assert doubles.status == 1
    until = doubles.held["holds_until"]
    assert 5 < until < 60
    exact = solution(double_pendulum(1), [3, "5/2", 0, 0], until, int(16 * until))
    row = next(row for row in doubles.rows if row["t"] == until)
    assert [row["a"], row["b"]] == pytest.approx(exact[:2], rel=2e-6)
    assert f"until t = {until:g}" in doubles.err


@pytest.mark.long
def test_the_double_pendulum_beyond_the_horizon_of_doubles(simulate):
    """`auto` carries the digits that chaos costs."""
    run = simulate(DOUBLE % (1, 3, 3), 60, accuracy=1e-6)
    assert run.status == 0
    exact = solution(double_pendulum(1), [3, 3, 0, 0], 60, 12 * 60)
    assert [run.last["a"], run.last["b"]] == pytest.approx(exact[:2], rel=1e-6)


@pytest.mark.parametrize(("m", "rod"), [(0, 1), (1, 0)])
def test_a_second_bob_without_mass_or_rod_is_refused(simulate, m, rod):
    text = f"""
coordinates: [a, b]
parameters: {{m: {m}, l: {rod}}}
L: (1 + m)*a'^2/2 + m*l^2*b'^2/2 + m*l*a'*b'*cos(a - b) + (1 + m)*cos(a) + m*l*cos(b)
initial: {{a: 1, b: 2}}
"""
    run = simulate(text, 1)
    assert run.status == 1
    assert "mass matrix" in run.err


STRETCH = """
coordinates: [s, th]
parameters: {k: %s}
L: (s'^2 + (1 + s)^2*th'^2)/2 + (1 + s)*cos(th) - k*s^2/2
initial: {s: %s, th: %s}
"""


def test_the_spring_pendulum_of_1e10_swings_up_and_down(simulate):
    """s = 1/k + (s0 - 1/k) cos(sqrt(k) t): a thousand radians."""
    run = simulate(STRETCH % ("1e10", "1e-9", 0), "1/100", show="s*1e10")
    assert run.status == 0
    assert run.last["s*1e10"] == pytest.approx(float(1 + 9 * mp.cos(1000)), abs=1e-8)


def test_a_spring_of_1e16_with_its_stretch_as_variable(simulate):
    run = simulate(STRETCH % ("1e16", "3e-16", 0), "1e-6", show="s*1e16")
    assert run.status == 0
    assert run.last["s*1e16"] == pytest.approx(float(1 + 2 * mp.cos(100)), abs=1e-8)


@pytest.mark.long
def test_a_spring_of_1e16_with_its_length_as_variable(simulate):
    """The stretch of 3e-16 is lost beside a length of 1 in doubles: more digits or a refusal."""
    text = "{coordinates: [r], L: r'^2/2 + r - 1e16*(r - 1)^2/2, initial: {r: 1 + 3e-16}}"
    refused = simulate(text, "1e-6", "--method", "dop853", show="(r - 1)*1e16")
    assert refused.status == 1
    assert "is not reached" in refused.err
    run = simulate(text, "1e-6", "--precision", 50, show="(r - 1)*1e16")
    assert run.status == 0
    assert run.last["(r - 1)*1e16"] == pytest.approx(float(1 + 2 * mp.cos(100)), abs=1e-8)


def test_without_gravity_it_turns_evenly_and_a_charge_is_added(lagcli, simulate):
    text = "{coordinates: [th], parameters: {g: 0}, L: th'^2/2 + g*cos(th), initial: {th': 2}}"
    run = simulate(text, 1000)
    assert run.status == 0
    assert run.last["th"] == pytest.approx(2000, abs=1e-9)
    solved = lagcli("solve", text, "--show", "charges", "--numeric")
    assert solved.status == 0
    assert "momentum p_th" in solved.out


def test_a_bead_at_the_critical_rate_of_rotation(simulate):
    """th'' = -sin(th)(1 - cos(th)): the quadratic terms cancel, the period is 1/amplitude."""
    text = "{coordinates: [th], L: (th'^2 + sin(th)^2)/2 + cos(th), initial: {th: 1e-3}}"
    run = simulate(text, 6000, "--stop-when", "th'", accuracy=1e-8)
    with mp.workdps(40):
        a = mpf("1e-3")
        # with sin(th/2)^2 = p sin(s)^2, p = sin(a/2)^2: t = int ds / sqrt(p (1 + sin^2)(1 - p sin^2))
        p = mp.sin(a / 2) ** 2
        exact = 2 * mpmath.quad(
            lambda s: 1 / mp.sqrt(p * (1 + mp.sin(s) ** 2) * (1 - p * mp.sin(s) ** 2)),
            [0, mp.pi / 2],
        )
    assert run.status == 0
    assert run.events[0]["t"] == pytest.approx(float(exact), rel=1e-8)


def test_the_energy_above_the_rest_is_known_to_its_last_digit(simulate):
    """1 - cos(th) = 2 sin(th/2)^2 is 0 in doubles for th = 1e-9."""
    text = "{coordinates: [th], L: th'^2/2 - 1e20*(1 - cos(th)), initial: {th: 1e-9}}"
    run = simulate(text, "1e-12", show="1e20*(1 - cos(th))", accuracy=1e-6)
    assert run.rows[0]["1e20*(1 - cos(th))"] == pytest.approx(50, rel=1e-14)
