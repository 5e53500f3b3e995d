"""Corners, jumps and impacts: what is claimed against closed forms, after many of them."""

import math
import random

import mpmath
import pytest

from lagcli.numerics.compiled.engine import engine
from tests.marks import mostly_long
from tests.numerics.running import last, simulated
from tests.numerics.test_narrow import held

FREE = """
coordinates: [x]
T: x'^2/2
{given}
initial: {{x: {x}, x': {v}}}
"""
ACCURACIES = (1e-6, 1e-9, 1e-12)


def given_to(text, x="0", v="0"):
    return FREE.format(given=text, x=x, v=v)


def claims_hold(file, until, place, speed):
    """Whether what is claimed at each accuracy holds, and all of it is claimed."""
    for accuracy in ACCURACIES:
        result = simulated(file, float(until), accuracy)
        assert held(result, "x", place)
        assert held(result, "x'", speed)
        assert result.certificate.reached


@pytest.mark.long
@pytest.mark.parametrize("potential", ["abs(x)", "sqrt(x^2)"])
@pytest.mark.parametrize("seed", range(2))
def test_well_with_a_corner(seed, potential):
    """V = |x| from rest: four parabolas in a period of 4 sqrt(2 x0)."""
    draw = random.Random(seed)
    x0, until = f"{draw.uniform(0.5, 3):.4g}", f"{draw.uniform(100, 400):.5g}"
    mpmath.mp.dps = 25
    x, t = mpmath.mpf(x0), mpmath.mpf(float(until))
    quarter = mpmath.sqrt(2 * x)
    s = t - 4 * quarter * mpmath.floor(t / (4 * quarter))
    turns = int(mpmath.nint(s / (2 * quarter)))  # of the nearest turning point
    u = s - 2 * quarter * turns
    side = (-1) ** turns
    claims_hold(given_to(f"V: {potential}", x0), until, side * (x - u * u / 2), -side * u)


@pytest.mark.parametrize(
    ("force", "first", "period"),
    [
        ("asin(sin(3*t))", mpmath.pi / 6, mpmath.pi / 3),
        ("acos(-cos(2*t + 1))", -mpmath.mpf(1) / 2, mpmath.pi / 2),
        ("atan(tan(2*t + 1))", (mpmath.pi / 2 - 1) / 2, mpmath.pi / 2),
        ("asin(sin(2*t)^3)", mpmath.pi / 4, mpmath.pi / 2),
        ("acos(cos(2*t)^2)", mpmath.mpf(0), mpmath.pi / 2),
    ],
)
def test_waves_of_triangles(force, first, period):
    """An inverse function of its function: x' is the integral of the force, corner by corner."""
    wave = {
        "asin(sin(3*t))": lambda t: mpmath.asin(mpmath.sin(3 * t)),
        "acos(-cos(2*t + 1))": lambda t: mpmath.acos(-mpmath.cos(2 * t + 1)),
        "atan(tan(2*t + 1))": lambda t: mpmath.atan(mpmath.tan(2 * t + 1)),
        "asin(sin(2*t)^3)": lambda t: mpmath.asin(mpmath.sin(2 * t) ** 3),
        "acos(cos(2*t)^2)": lambda t: mpmath.acos(mpmath.cos(2 * t) ** 2),
    }[force]
    until = mpmath.mpf(10)
    corners = [first + k * period for k in range(20)]
    parts = [mpmath.mpf(0), *(t for t in corners if 0 < t < until), until]
    with mpmath.workdps(25):
        speed = mpmath.quad(wave, parts)
        place = mpmath.quad(lambda t: (until - t) * wave(t), parts)
    claims_hold(given_to(f"forces: {{x: {force}}}"), until, place, speed)


@pytest.mark.parametrize(
    ("written", "potential", "corners"),
    [
        ("sqrt(1 - cos({b}*x))", lambda u: mpmath.sqrt(2) * abs(mpmath.sin(u / 2)), 2),
        ("sqrt(3 - 3*cos({b}*x))", lambda u: mpmath.sqrt(6) * abs(mpmath.sin(u / 2)), 2),
        ("sqrt(4 - 4*cos({b}*x)^2)", lambda u: 2 * abs(mpmath.sin(u)), 1),
        ("sqrt(cosh({b}*x) - 1)/200", lambda u: mpmath.sinh(u / 2) / mpmath.sqrt(20000), 9),
    ],
)
def test_a_motion_begins_at_a_corner_of_a_root(written, potential, corners):
    """The time to x is the integral of dx/v, v^2 = 16 - 2 V."""
    b = f"{random.Random(written).uniform(0.5, 1.5):.3g}"
    result = simulated(given_to("V: " + written.format(b=b), v="4"), 3.0, 1e-9)
    assert result.certificate.reached
    with mpmath.workdps(25):
        x, scale = mpmath.mpf(last(result, "x")), mpmath.mpf(b)
        parts = [k * corners * mpmath.pi / scale for k in range(20)]
        parts = [*(place for place in parts if place < x), x]
        time = mpmath.quad(lambda y: 1 / mpmath.sqrt(16 - 2 * potential(scale * y)), parts)
        assert abs(time - 3) < 1e-9


@pytest.mark.parametrize("seed", range(2))
def test_square_wave(seed):
    draw = random.Random(seed)
    rate, until = f"{draw.uniform(1, 3):.4g}", f"{draw.uniform(50, 200):.5g}"
    mpmath.mp.dps = 25
    w, end = mpmath.mpf(rate), mpmath.mpf(float(until))
    x = v = t = mpmath.mpf(0)
    for k in range(int(w * end / mpmath.pi) + 1):
        h = min(end, (k + 1) * mpmath.pi / w) - t
        x, v, t = x + v * h + (-1) ** k * h * h / 2, v + (-1) ** k * h, t + h
    claims_hold(given_to(f'forces: {{x: "sign(sin({rate}*t))"}}'), until, x, v)


def test_two_jumps_that_nearly_coincide():
    """A force of 1e6 for a time of 1e-6: its end is no double."""
    file = given_to('forces: {x: "1e6*(sign(t - 3) - sign(t - 3.000001))/2"}')
    mpmath.mp.dps = 25
    for accuracy in ACCURACIES:
        result = simulated(file, 10, accuracy)
        assert held(result, "x'", 1)
        assert held(result, "x", 7 - mpmath.mpf("5e-7"))


@pytest.mark.parametrize("until", ["1.2", "4.1", "10"])
def test_the_branch_cut_of_a_phase(until):
    """atan2(sin 2 t, cos 2 t)/2 is t less a multiple of pi."""
    file = given_to('forces: {x: "atan2(sin(2*t), cos(2*t))/2"}')
    mpmath.mp.dps = 25
    end, pi = mpmath.mpf(float(until)), mpmath.pi
    x = v = t = mpmath.mpf(0)
    k = 0
    while t < end:
        h = min(end, (k + mpmath.mpf(1) / 2) * pi) - t
        a = t - k * pi
        x, v, t = x + v * h + a * h**2 / 2 + h**3 / 6, v + a * h + h * h / 2, t + h
        k += 1
    claims_hold(file, until, x, v)


BALL = """
coordinates: [x]
T: x'^2/2
V: {g}*x
contacts: {{floor: {{gap: x >= 0, restitution: 1}}}}
initial: {{x: {x}, x': {v}}}
"""
BETWEEN = """
coordinates: [x]
T: x'^2/2
contacts:
  left: {{gap: x >= 0, restitution: 1}}
  right: {{gap: 1 - x >= 0, restitution: 1}}
initial: {{x: {x}, x': {v}}}
"""


@pytest.mark.first_quick
@pytest.mark.parametrize("seed", range(3))
def test_a_ball_that_bounces_many_times(seed):
    draw = random.Random(seed)
    g, x, v, until = (
        f"{draw.uniform(*ends):.4g}" for ends in ((5, 12), (0.3, 2), (-1, 1), (30, 70))
    )
    mpmath.mp.dps = 25
    a, x0, v0, t = map(mpmath.mpf, (g, x, v, float(until)))
    speed = mpmath.sqrt(v0**2 + 2 * a * x0)
    first, flight = (v0 + speed) / a, 2 * speed / a
    s = t - first - flight * mpmath.floor((t - first) / flight)
    claims_hold(BALL.format(g=g, x=x, v=v), until, speed * s - a * s * s / 2, speed - a * s)


@pytest.mark.long
@pytest.mark.parametrize(("g", "height"), [("19.617", "0.171"), ("18.542", "0.214")])
def test_between_impacts_two_runs_differ_by_rounding_alone(g, height):
    """From rest: flights are polynomials, which every tolerance gives alike."""
    result = simulated(BALL.format(g=g, x=height, v=0), 15, 1e-14)
    scales, bounds = result.certificate.scales[1:], result.certificate.global_error.values()
    with mpmath.workdps(30):
        a, top = mpmath.mpf(g), mpmath.mpf(height)
        flight = 2 * mpmath.sqrt(2 * top / a)
        for t, *found in result.rows:
            s = (t + flight / 2) % flight - flight / 2
            for x, y, scale, bound in zip(
                found, (top - a * s * s / 2, -a * s), scales, bounds, strict=True
            ):
                assert abs(x - y) <= bound * scale + math.ulp(x) / 2


@pytest.mark.long
@pytest.mark.parametrize("seed", mostly_long(range(2), 0))
def test_a_particle_between_walls(seed):
    draw = random.Random(seed)
    x, v, until = (f"{draw.uniform(*ends):.4g}" for ends in ((0.1, 0.9), (1, 4), (50, 90)))
    mpmath.mp.dps = 25
    way = mpmath.mpf(x) + mpmath.mpf(v) * mpmath.mpf(float(until))
    turns = int(way)
    place = way - turns if turns % 2 == 0 else turns + 1 - way
    claims_hold(BETWEEN.format(x=x, v=v), until, place, (-1) ** turns * mpmath.mpf(v))


@pytest.mark.parametrize("width", ["1e-3", "1e-6", "1e-8"])
def test_a_window_whose_ends_are_no_doubles(width):
    """A force 1/w between t = 3 and 3 + w: the end is where the file writes it."""
    w, end = mpmath.mpf(width), mpmath.mpf(10)
    force = f"(sign(t - 3) - sign(t - 3 - {width}))/(2*{width})"
    claims_hold(given_to(f'forces: {{x: "{force}"}}'), 10, end - 3 - w / 2, mpmath.mpf(1))


def test_a_slab_so_thin_that_its_far_side_is_left_at_once():
    """-1000 between 3 and 3.0001: a step from its near side would turn back by itself."""
    mpmath.mp.dps = 25
    depth = mpmath.mpf("0.0001")
    slower = mpmath.sqrt(1 - 2000 * depth)
    within = (1 - slower) / 1000
    for given in (
        'forces: {x: "-500*(sign(x - 3) - sign(x - 3.0001))"}',
        'V: "500*(abs(x - 3) - abs(x - 3.0001))"',
    ):
        claims_hold(given_to(given, "0", "1"), 10, 3 + depth + slower * (7 - within), slower)


@pytest.mark.parametrize("e", ["1", "0.97", "0.9"])
def test_a_ball_that_loses_a_part_of_its_speed(e):
    mpmath.mp.dps = 25
    g, h, v, t, until = mpmath.mpf("3.7"), mpmath.mpf("1.3"), mpmath.mpf(0), mpmath.mpf(0), 8
    while True:
        flight = (v + mpmath.sqrt(v * v + 2 * g * h)) / g
        if t + flight >= until:
            break
        v, h, t = mpmath.mpf(e) * (g * flight - v), mpmath.mpf(0), t + flight
    s = until - t
    floor = f'{{floor: {{gap: "x >= 0", restitution: {e}}}}}'
    file = given_to(f'V: "3.7*x"\ncontacts: {floor}', "1.3")
    claims_hold(file, until, h + v * s - g * s * s / 2, v - g * s)


def test_an_impact_on_a_floor_that_jumps():
    """The floor 2/(1 + u^2), u = (t - 4)/w, strikes what rests at 1 when u = -1."""
    speed = 2 * mpmath.mpf(1) / mpmath.mpf("1e-3")
    floor = '{floor: {gap: "x - 2/(1 + ((t - 4)/1e-3)^2) >= 0", restitution: 1}}'
    start = mpmath.mpf(4) - mpmath.mpf("1e-3")
    claims_hold(given_to(f"contacts: {floor}", "1"), 10, 1 + speed * (10 - start), speed)


def test_a_root_of_what_passes_0():
    """A force sqrt(|t - 3|): it has a value at t = 3, and no series."""
    mpmath.mp.dps = 25
    three, end = mpmath.mpf(3), mpmath.mpf(8)
    speed = (three**1.5 + (end - 3) ** 1.5) * 2 / 3
    place = 3 * three**1.5 * 2 / 3 - three**2.5 * 4 / 15
    place += (end - 3) * three**1.5 * 2 / 3 + (end - 3) ** 2.5 * 4 / 15
    claims_hold(given_to('forces: {x: "sqrt(abs(t - 3))"}'), 8, place, speed)


def test_a_force_as_the_cube_root_of_the_distance():
    """V = 3/4 |x|^(4/3) from rest at 1: after a whole period it is there again."""
    mpmath.mp.dps = 25
    quarter = mpmath.sqrt(2 / mpmath.mpf(3)) * mpmath.beta(0.75, 0.5) * 3 / 4
    result = simulated(given_to('forces: {x: "-sign(x)*abs(x)^(1/3)"}', "1"), 10, 1e-6)
    assert result.certificate.reached
    swings = 10 / float(quarter)
    assert (-1) ** int((swings + 1) // 2) * last(result, "x") > 0


def test_a_root_that_divides_ends_the_motion():
    result = simulated(given_to('forces: {x: "1/sqrt(abs(t - 3))"}'), 8, 1e-6)
    assert not result.certificate.reached
    assert "t = 3:" in result.refusal


@pytest.mark.parametrize("seed", range(2))
def test_a_force_that_jumps_without_a_sign(seed):
    """x'' = atan(tan(w t)), a saw tooth with the period P = pi/w: x' = w s^2/2, s = t - n P."""
    draw = random.Random(seed)
    rate, until = f"{draw.uniform(0.4, 2):.4g}", draw.uniform(5, 12)
    mpmath.mp.dps = 25
    w, t = mpmath.mpf(rate), mpmath.mpf(until)
    period = mpmath.pi / w
    n = mpmath.nint(t / period)
    s = t - n * period
    result = simulated(given_to(f'forces: {{x: "atan(sin({rate}*t)/cos({rate}*t))"}}'), until, 1e-9)
    assert result.certificate.reached
    assert held(result, "x", n * w * period**3 / 24 + w * s**3 / 6)
    assert held(result, "x'", w * s**2 / 2)


@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_a_force_with_a_vertical_tangent(accuracy):
    """x'' = |t - c|^(1/2): x' = 2/3 (c^(3/2) + (t - c)^(3/2))."""
    result = simulated(given_to('forces: {x: "sqrt(abs(t - 2.7))"}'), 8.0, accuracy)
    mpmath.mp.dps = 25
    c = mpmath.mpf("2.7")
    assert result.certificate.reached
    assert held(result, "x'", 2 * (c**1.5 + (8 - c) ** 1.5) / 3)


@pytest.mark.first_quick
@pytest.mark.parametrize(
    ("force", "method", "what"),
    [
        ("atan(sin({w}*t)/cos({w}*t))", "taylor80", "jumps there"),
        ("asin((sin({w}*t) + sin({w}*t)^3)/2)", "taylor64", "has a corner there"),
        ("tan({w}*t)", "taylor64", "grows without bound"),
        ("sqrt(2 - {w}*t)", "taylor64", "are not defined there"),
        ("-exp(-exp(300*{w}*t))", "taylor64", "is beyond all numbers there"),
    ],
)
@pytest.mark.parametrize("rate", ["0.7", "1.9"])
def test_corners_jumps_and_poles_are_distinguished(force, method, what, rate):
    file = given_to(f'forces: {{x: "{force.format(w=rate)}"}}')
    assert what in simulated(file, 8.0, 1e-9, method=method).refusal


@pytest.mark.first_quick
@pytest.mark.skipif(not engine().quadruple, reason="no numbers of 128 bits")
@pytest.mark.parametrize("force", ["sqrt(1 - cos(t + 1)^2)", "asin(sin(3*t))", "acos(cos(2*t))"])
def test_a_corner_met_by_a_run_of_128_bits(force):
    """It is passed or named; x' is the integral of the force, by Gauss's rule in 300 parts."""
    result = simulated(given_to(f'forces: {{x: "{force}"}}'), 3.0, 1e-9, method="taylor128")
    end = result.rows[-1][0]
    assert (end == 3) if result.certificate.reached else ("corner there" in result.refusal)
    value = mpmath.quad(
        eval(f"lambda t: {force.replace('^', '**')}", dict(vars(mpmath))),
        mpmath.linspace(0, end, 301), maxdegree=3,
    )  # fmt: skip
    assert result.rows[-1][2] == pytest.approx(float(value), abs=1e-6)


@pytest.mark.parametrize("strength", ["1", "1e-6", "1e-11"])
@pytest.mark.parametrize("force", ["{a}/(t - 3)", "{a}/(t - 3)^2", "{a}*tan(t*pi/6)"])
def test_a_pole_is_not_passed_however_weak(force, strength):
    result = simulated(given_to(f'forces: {{x: "{force.format(a=strength)}"}}', "1"), 8.0, 1e-6)
    assert not result.certificate.reached
    assert result.certificate.holds_until < 3


@pytest.mark.first_quick
@pytest.mark.parametrize("seed", range(3))
def test_a_cusp_is_passed_in_any_precision(seed):
    """V = |x|^p from x = 1: four times the quarter B(1/p, 1/2)/(p sqrt(2)) is a period."""
    rng = random.Random(seed)
    below = rng.choice((3, 4, 5, 7))
    above = rng.randint(math.ceil(4 * below / 3), 2 * below - 1)
    a, p = mpmath.mpf(below) / above, f"{above}/{below}"
    period = float(4 * a * mpmath.beta(a, 0.5) / mpmath.sqrt(2))
    result = simulated(
        f"{{coordinates: [x], L: x'^2/2 - abs(x)^({p}), initial: {{x: 1}}}}", period, 1e-14
    )
    assert result.certificate.reached
    assert result.rows[-1][1:] == pytest.approx((1, 0), abs=1e-14)


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7, 1e-10, 1e-12])
def test_a_rounded_constant_that_opens_a_narrow_window(accuracy):
    """cos(t - 1) > 1 - 1e-12 for 2 acos(1 - 1e-12) around 1, 1 + 2 pi and 1 + 4 pi."""
    file = given_to('forces: {x: "1e5*(1 + sign(cos(t - 1) - 1 + 1e-12))"}')
    result = simulated(file, 14, accuracy)
    with mpmath.workdps(30):
        gained = 4e5 * mpmath.acos(1 - mpmath.mpf("1e-12"))
        assert held(result, "x'", 3 * gained)
        assert held(result, "x", gained * sum(13 - 2 * mpmath.pi * k for k in range(3)))
    assert result.certificate.reached


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7, 1e-10, 1e-12])
def test_a_rounded_constant_in_a_small_divisor(accuracy):
    """x'' = a/(b + cos t), b = 1 + 1e-8: a period gives 2 pi a/sqrt(b^2 - 1)."""
    until = 4 * math.pi
    result = simulated(given_to('forces: {x: "1e-4/(1.00000001 + cos(t))"}'), until, accuracy)
    with mpmath.workdps(30):
        a, b = mpmath.mpf("1e-4"), mpmath.mpf("1.00000001")
        late = until - 4 * mpmath.pi
        speed = 4 * mpmath.pi * a / mpmath.sqrt(b * b - 1)
        assert held(result, "x'", speed + late * a / (b + 1))
        assert held(result, "x", (2 * mpmath.pi + late) * speed)
    assert result.certificate.reached
