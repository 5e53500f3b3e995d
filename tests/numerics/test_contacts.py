"""Contacts that are left and strike again, against textbook results and closed forms."""

import math
from random import Random

import pytest

from lagcli.numerics.equations.refusal import Refusal

from .running import column, last, simulated

BALL = """
coordinates: [x, y]
parameters: {e: 1/2, g: 10}
T: (x'^2 + y'^2)/2
V: g*y
contacts: {floor: {gap: y >= 0, restitution: e, multiplier: N}}
initial: {y: 5, x': 1}
"""


def happened(result):
    return [(event.name, event.what) for event in result.events]


def times(result):
    return [event.t for event in result.events]


def test_a_ball_bounces_and_comes_to_rest_at_3_seconds():
    """t_n = 1 + 2 (e + e^2 + … + e^n), and 1 + 2 e/(1 - e) = 3 at last; then N = m g."""
    result = simulated(BALL, 6, show="x,y,y',N,energy", samples=7)
    assert result.certificate.reached
    *bounces, rest = result.events
    assert [event.what for event in bounces] == ["impact"] * len(bounces)
    expected = [1 + 2 * sum(0.5**k for k in range(1, n + 1)) for n in range(len(bounces))]
    assert times(result)[:-1] == pytest.approx(expected, abs=1e-9)
    assert rest.what == "comes to rest"
    assert rest.t == pytest.approx(3, abs=1e-9)
    # half of the energy at the first impact is 50 (1 - e^2)
    assert bounces[0].energy_lost == pytest.approx(37.5, abs=1e-9)
    assert sum(event.energy_lost for event in result.events) == pytest.approx(50, abs=1e-9)
    assert column(result, "N")[:3] == [0, 0, 0]
    assert column(result, "N")[4:] == pytest.approx([10, 10, 10], abs=1e-9)
    assert last(result, "x") == pytest.approx(6, abs=1e-9)
    assert column(result, "y")[2:] == pytest.approx([0] * 5, abs=1e-9)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-12])
def test_bounces_at_every_accuracy(accuracy):
    """Between impacts y = v (t - t_n) - g (t - t_n)^2/2 with v = 10 e^n."""
    result = simulated(BALL, 2.9, accuracy, show="y,y'", samples=30)
    assert result.certificate.reached
    for t, y, speed in result.rows:
        n, begin = 0, -1.0
        while begin + 2 * 0.5**n <= t + 1e-13:
            begin += 2 * 0.5**n
            n += 1
        flown, start = t - begin, 10 * 0.5**n
        assert y == pytest.approx(start * flown - 5 * flown**2, abs=5 * accuracy)
        if min(flown, 2 * 0.5**n - flown) > 1e-9:
            assert speed == pytest.approx(start - 10 * flown, abs=10 * accuracy)


def test_an_elastic_ball_keeps_its_energy():
    result = simulated(BALL, 20, show="energy", samples=21, settings=("e=1",))
    assert column(result, "energy") == pytest.approx([50.5] * 21, rel=1e-11)
    assert times(result) == pytest.approx([1 + 2 * k for k in range(10)], abs=1e-9)


def test_without_a_restitution_the_run_stops_where_it_closes():
    text = BALL.replace(", restitution: e", "")
    result = simulated(text, 6, show="y,y'")
    assert happened(result) == [("floor", "contact closes")]
    assert times(result) == pytest.approx([1], abs=1e-9)
    assert result.rows[-1] == pytest.approx((1, 0, -10), abs=1e-9)


@pytest.mark.parametrize("e", ["0", "0.3", "1"])
def test_the_end_of_a_falling_rod_strikes(e):
    """w = 6 (1 + e) v cos(th) / (l (1 + 3 cos(th)^2)): Newton's law at the end, impulse at it.

    Meriam, Kraige, *Engineering Mechanics: Dynamics*, 5th ed., section 6/8 has the laws.
    """
    text = """
coordinates: [y, th]
parameters: {e: %s}
T: y'^2/2 + th'^2/24
V: y
contacts: {end: {gap: y - sin(th)/2 >= 0, restitution: e}}
initial: {y: 1/2 + sin(1/2)/2, th: 1/2}
"""
    result = simulated(text % e, 1.0001, show="y',th'")
    after = result.events[0].after
    speed, cosine = 1.0, math.cos(0.5)
    ratio = (1 + float(e)) * speed / (1 + 3 * cosine**2)
    assert result.events[0].t == pytest.approx(1, abs=1e-9)
    assert after["th'"] == pytest.approx(-6 * cosine * ratio, abs=1e-9)
    assert after["y'"] == pytest.approx(-speed + ratio, abs=1e-9)
    lost = (1 - float(e) ** 2) * speed**2 / 2 / (1 + 3 * cosine**2)
    assert result.events[0].energy_lost == pytest.approx(lost, abs=1e-9)


def test_two_masses_exchange_their_speeds():
    """v1+ = (m1 v1 + m2 v2 - m2 e (v1 - v2))/(m1 + m2) and the other way round."""
    text = """
coordinates: [x1, x2]
parameters: {m1: 1, m2: 3, e: 0.8}
T: (m1*x1'^2 + m2*x2'^2)/2
contacts: {touch: {gap: x1 <= x2, restitution: e}}
initial: {x1: 0, x2: 1, x1': 2, x2': -1}
"""
    result = simulated(text, 2, show="x1',x2'")
    assert result.events[0].t == pytest.approx(1 / 3, abs=1e-9)
    mean, e = (1 * 2 - 3) / 4, 0.8
    assert result.rows[-1][1:] == pytest.approx((mean - e * 3 * 3 / 4, mean + e * 3 / 4), abs=1e-9)


def test_a_sphere_is_left_and_the_flight_is_free():
    """From the top at speed v: cos(th) = (2 + v^2)/3, then a parabola."""
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: y
constraints:
  surface: {equation: x^2 + y^2 = 1, multiplier: N, holds_while: N >= 0, on_loss: release}
initial: {x: 0, y: 1, x': 1/2}
"""
    result = simulated(text, 3, show="x,y,x',y',N")
    assert happened(result) == [("surface", "contact lost")]
    begin, c = result.events[0].t, 2.25 / 3
    s, v = math.sqrt(1 - c * c), math.sqrt(c)
    t = 3 - begin
    expected = (s + v * c * t, c - v * s * t - t * t / 2, v * c, -v * s - t, 0)
    assert result.rows[-1][1:] == pytest.approx(expected, abs=1e-9)


def test_a_string_goes_slack_and_is_taut_again():
    """It goes slack at the angle a above the horizontal and is taut at the angle 3 a below.

    With v0^2 = 4 g l: sin(a) = 2/3; the flight takes 4 sin(a) cos(a) sqrt(l sin(a)/g)... of
    the parabola through the circle, which it meets once more.
    """
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: y
constraints:
  string: {equation: x^2 + y^2 = 1, holds_while: lambda_string <= 0, on_loss: release, restitution: 0}
initial: {x: 0, y: -1, x': 2}
"""
    result = simulated(text, 6, show="x,y,x',y'")
    assert happened(result) == [("string", "contact lost"), ("string", "impact")]
    slack, taut = result.events
    s, c = 2 / 3, math.sqrt(5) / 3
    v = math.sqrt(s)  # at the slack point
    flight = 4 * v * c
    assert taut.t - slack.t == pytest.approx(flight, abs=1e-9)
    x, y = c - v * s * flight, s + v * c * flight - flight**2 / 2
    assert x * x + y * y == pytest.approx(1, abs=1e-12)  # the closed form itself
    assert (taut.before["x"], taut.before["y"]) == pytest.approx((x, y), abs=1e-9)
    # only the speed along the circle is left
    u, w = -v * s, v * c - flight
    along = -u * y + w * x
    assert taut.after["x'"] == pytest.approx(-along * y, abs=1e-9)
    assert taut.after["y'"] == pytest.approx(along * x, abs=1e-9)
    assert taut.energy_lost == pytest.approx((u * x + w * y) ** 2 / 2, abs=1e-9)


def test_a_contact_with_an_accelerated_floor():
    """A ball rests on a floor y = A sin(w t) as long as A w^2 sin(w t) < g."""
    text = """
coordinates: [y]
parameters: {A: 1, w: 2, g: 2}
T: y'^2/2
V: g*y
contacts: {floor: {gap: y >= A*sin(w*t), restitution: 0}}
initial: {y: 0, y': A*w}
"""
    result = simulated(text, 0.5, show="y,lambda_floor")
    assert result.events[0].what == "contact lost"
    assert result.events[0].t == pytest.approx(math.asin(0.5) / 2, abs=1e-9)


def test_two_walls_at_the_same_time():
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
contacts: {a: {gap: x >= 0, restitution: 1}, b: {gap: y >= 0, restitution: 1/2}}
initial: {x: 1, y: 1, x': -1, y': -1}
"""
    result = simulated(text, 3)
    assert sorted(happened(result)) == [("a", "impact"), ("b", "impact")]
    assert result.rows[-1][1:] == pytest.approx((2, 1, 1, 0.5), abs=1e-9)


@pytest.mark.long
def test_a_rod_falls_flat_and_rests_on_both_ends():
    text = """
coordinates: [y, th]
T: y'^2/2 + th'^2/24
V: y
contacts:
  a: {gap: y + sin(th)/2 >= 0, restitution: 1/2}
  b: {gap: y - sin(th)/2 >= 0, restitution: 1/2}
initial: {y: 1}
"""
    result = simulated(text, 8, show="y,lambda_a,lambda_b")
    assert [what for _, what in happened(result)[-2:]] == ["comes to rest"] * 2
    assert times(result)[-1] == pytest.approx(3 * math.sqrt(2), abs=1e-9)
    assert result.rows[-1][1:] == pytest.approx((0, 0.5, 0.5), abs=1e-9)


def test_an_impact_at_the_very_beginning():
    result = simulated(BALL.replace("y: 5, x': 1", "y: 0, y': -10"), 1.25, show="y,y'")
    assert result.events[0].t == 0
    assert result.rows[-1] == pytest.approx((1.25, 0.3125, 0), abs=1e-9)


def test_at_rest_on_the_floor_from_the_beginning():
    result = simulated(BALL.replace("y: 5, x': 1", "y: 0"), 1, show="y,N")
    assert result.events == ()
    assert result.rows[-1][1:] == (0, 10)


def test_an_impact_at_a_sample_is_compared_on_its_side():
    """The sample t = 1 is the impact: its position is known, and the answer holds."""
    result = simulated(BALL, 2, show="y", samples=3)
    assert result.certificate.reached
    assert column(result, "y") == pytest.approx([5, 0, 0], abs=1e-9)


@pytest.mark.parametrize("accuracy", [1e-2, 1e-3])
def test_a_row_soon_after_an_impact_is_after_it_at_a_coarse_accuracy_too(accuracy):
    """The impact is at t = 1 with 10 m/s, of which half is left."""
    result = simulated(BALL, 1.0005, accuracy, "y,y'")
    assert result.certificate.reached
    assert result.rows[-1][1:] == pytest.approx((5 * 0.0005, 5), abs=1e-2)
    assert result.rows[-1][1] > 0


def test_a_grazing_gap_is_refused():
    """x = sin(t) touches the wall at 1: whether it strikes is within the error."""
    text = """
coordinates: [x]
L: x'^2/2 - x^2/2
contacts: {wall: {gap: x <= 1, restitution: 1}}
initial: {x': 1}
"""
    result = simulated(text, 10, 1e-9, samples=11)
    assert not result.certificate.reached
    assert "grazes 'wall'" in result.refusal
    assert 1 <= result.certificate.holds_until <= math.pi / 2


@pytest.mark.first_quick
@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("depth", [3e-9, 2e-10, 4e-11])
def test_a_strike_that_is_almost_a_graze_is_told_from_one(accuracy, depth):
    """A ray passes a disc at the distance 1 - depth from its centre: it is reflected."""
    y = 1 - depth
    text = f"""
coordinates: [x, y]
T: (x'^2 + y'^2)/2
contacts: {{disc: {{gap: x^2 + y^2 >= 1, restitution: 1}}}}
initial: {{x: -3, y: {y!r}, x': 1}}
"""
    result = simulated(text, 7, accuracy, "x,y", samples=8)
    assert result.certificate.reached
    c = math.sqrt((1 - y) * (1 + y))
    x, after = -c, 4 + c
    exact = x + (1 - 2 * c**2) * after, y + 2 * c * y * after
    assert result.rows[-1][1:] == pytest.approx(exact, abs=1e-10)


@pytest.mark.parametrize(("clearance", "accuracy"), [(1e-12, 1e-9), (1e-12, 1e-12), (-1e-11, 1e-6)])
def test_a_ball_that_almost_touches_the_floor_is_told_from_one_that_does(clearance, accuracy):
    """Thrown down under a force upwards: y = c + (t - 2)^2/2, or reflected a little earlier."""
    text = f"""
coordinates: [y]
parameters: {{c: {clearance!r}}}
T: y'^2/2
V: -y
contacts: {{floor: {{gap: y >= 0, restitution: 1}}}}
initial: {{y: 2 + c, y': -2}}
"""
    result = simulated(text, 4, accuracy)
    assert result.certificate.reached
    speed = math.sqrt(2 * max(-clearance, 0.0))
    after = 2 + speed
    exact = max(clearance, 0.0) + speed * after + after**2 / 2, speed + after
    assert result.rows[-1][1:] == pytest.approx(exact, abs=1e-10 if speed else 1e-14)


@pytest.mark.parametrize(("accuracy", "room"), [(1e-6, 1e-7), (1e-4, 1e-9)])
def test_two_bumps_that_are_almost_grazed_are_passed(accuracy, room):
    """Of the runs at the next finer accuracy one touches the first bump, the other does not."""
    text = f"""
coordinates: [x, y]
T: (x'^2 + y'^2)/2
contacts: {{floor: {{gap: y + cos(x) + 1 + {room!r} >= 0, restitution: 1/2}}}}
initial: {{x: 0, y: 0, x': 1}}
"""
    result = simulated(text, 12, accuracy, "x,y", samples=3)
    assert result.certificate.reached
    assert result.rows[-1] == pytest.approx((12, 12, 0))
    assert result.events == ()


def test_a_force_that_comes_to_its_limit_is_kept_with_a_warning():
    """v0^2 = 5 g l: the tension vanishes at the top and nowhere else."""
    text = """
coordinates: [x, y]
parameters: {v: sqrt(5)}
T: (x'^2 + y'^2)/2
V: y
constraints: {string: {equation: x^2 + y^2 = 1, holds_while: lambda_string <= 0}}
initial: {x: 0, y: -1, x': v}
"""
    result = simulated(text, 4, 1e-9)
    assert [event.what for event in result.events] == ["touches"]
    assert result.certificate.reached
    assert "string comes to its limit" in result.warnings[0]


@pytest.mark.parametrize(
    ("start", "word"),
    [("y: -1", "wrong side of the contact 'floor'"), ("y: 1", "between 0 and 1")],
)
def test_mistakes_of_a_contact(start, word):
    text = BALL.replace("y: 5, x': 1", start)
    with pytest.raises(Refusal, match=word):
        simulated(text, 10, settings=("e=2",))


# -- friction ------------------------------------------------------------------------------------


def test_a_block_slides_up_an_incline_and_stays():
    """It stops after v/(g (sin(a) + mu cos(a))), since mu > tan(a)."""
    text = """
coordinates: [x]
parameters: {mu: 0.3, a: 0.2}
T: x'^2/2
forces: {x: sin(a) - mu*cos(a)*sign(x')}
initial: {x': -1}
"""
    result = simulated(text, 10, show="x,x',x''")
    slowing = math.sin(0.2) + 0.3 * math.cos(0.2)
    assert happened(result) == [("x'", "sticks")]
    assert result.events[0].t == pytest.approx(1 / slowing, abs=1e-9)
    assert result.rows[-1][1:] == pytest.approx((-0.5 / slowing, 0, 0), abs=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_what_sticks_ends_the_steps_of_every_method(seed):
    """Blocks pushed up an incline; abs and sign have no series, so `taylor` is dop853 as well."""
    random = Random(seed)
    a, v = random.uniform(0.01, 1), random.uniform(0.1, 10)
    mu = math.tan(a) * random.uniform(1.01, 4)
    text = f"""
coordinates: [x]
T: x'^2/2
forces: {{x: -sin({a}) - {mu}*cos({a})*sign(x')}}
initial: {{x': {v}}}
"""
    slowing = math.sin(a) + mu * math.cos(a)
    until = 3 * v / slowing
    for options in ({"method": "dop853"}, {"method": "taylor", "digits": 30}, {}):
        result = simulated(text, until, 1e-12, **options)
        assert happened(result) == [("x'", "sticks")]
        assert result.events[0].t == pytest.approx(v / slowing, abs=1e-11 * until)
        assert result.rows[-1][1] == pytest.approx(v * v / slowing / 2, rel=1e-11)
        assert result.steps < 5_000


@pytest.mark.parametrize(
    "law",
    [
        "-mu*x'/abs(x')",
        "-mu*x'*abs(x')^(-1)",
        "-mu*abs(x')/x'",
        "-mu*x'/sqrt(x'^2)",
        "-2*mu*x'/speed",
        "-mu*x'^3/abs(x')^3",
        "-mu*(x' - 0)/abs(-x')",
        "-mu*tanh(x'/abs(x'))/tanh(1)",
    ],
)
def test_a_direction_is_a_sign_however_it_is_written(law):
    """It stops after v/mu on v^2/(2 mu), and stays there."""
    text = f"""
coordinates: [x]
parameters: {{mu: 0.3}}
definitions: {{speed: abs(2*x')}}
T: x'^2/2
forces: {{x: "{law}"}}
initial: {{x': 2}}
"""
    result = simulated(text, 10, show="x,x'")
    assert happened(result) == [("x'", "sticks")]
    assert result.events[0].t == pytest.approx(2 / 0.3, abs=1e-9)
    assert result.rows[-1][1:] == pytest.approx((2 / 0.3, 0), abs=1e-9)


def test_a_block_on_a_belt_sticks_until_the_spring_pulls():
    """It moves with the belt up to x = mu/k and slips there."""
    text = """
coordinates: [x]
parameters: {mu: 0.5, v: 0.3}
T: x'^2/2
V: x^2/2
forces: {x: -mu*sign(x' - v)}
initial: {x': v}
"""
    result = simulated(text, 2, show="x,x'")
    assert [what for _, what in happened(result)] == ["sticks", "slips"]
    assert result.events[1].t == pytest.approx(0.5 / 0.3, abs=1e-9)
    t = 2 - 0.5 / 0.3
    assert result.rows[-1][1:] == pytest.approx(
        (0.5 + 0.3 * math.sin(t), 0.3 * math.cos(t)), abs=1e-9
    )


def test_two_blocks_stick_together():
    """A force below the friction moves both with F/(m1 + m2)."""
    text = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
forces: {x: 1/2 - sign(x' - y'), y: sign(x' - y')}
"""
    result = simulated(text, 2)
    assert result.rows[-1][1:3] == pytest.approx((0.5, 0.5), abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_no_row_lies_behind_a_strike_that_is_within_the_error(seed):
    """y = 2 t - t^2 comes by less than the accuracy above a ceiling, at 1 - sqrt(1 - height)."""
    depth = 10 ** Random(seed).uniform(-8.5, -6.3)
    text = (
        "{coordinates: [y], T: y'^2/2, V: 2*y, initial: {y: 0, y': 2}, "
        f"contacts: {{ceiling: {{gap: 1 - {depth!r} - y >= 0, restitution: 1}}}}}}"
    )
    result = simulated(text, 2, 1e-6, samples=41)
    strike = 1 - math.sqrt(depth)
    for t, y, v in result.rows:
        back = max(0.0, t - strike)
        assert abs(y - (2 * t - t * t - 4 * math.sqrt(depth) * back)) <= 2e-6
        assert abs(v - (2 - 2 * t - 4 * math.sqrt(depth) * (back > 0))) <= 4e-6


@pytest.mark.long
def test_two_grazes_in_turn_are_bounded():
    """The second disc is met at 3.7e-5 from its edge: errors grow 40000 times by both."""
    from mpmath import mpf, sqrt, workdps

    x2, y2, start, speed = "6.0022491906073", "0.027808361289384", "0.9999973236052108", "1.622"
    text = f"""
coordinates: [x, y]
T: (x'^2 + y'^2)/2
contacts:
  disc: {{gap: x^2 + y^2 - 1 >= 0, restitution: 1}}
  other: {{gap: (x - {x2})^2 + (y - {y2})^2 - 1 >= 0, restitution: 1}}
initial: {{x: -3, y: {start}, x': {speed}}}
"""
    until = 8.5
    result = simulated(text, until, 1e-9, "x,y", samples=2)
    assert result.certificate.reached
    with workdps(40):
        place, velocity, left = (mpf(-3), mpf(start)), (mpf(speed), mpf(0)), mpf(until)
        for centre in ((mpf(0), mpf(0)), (mpf(x2), mpf(y2))):
            u, v = place[0] - centre[0], place[1] - centre[1]
            square = velocity[0] ** 2 + velocity[1] ** 2
            half = u * velocity[0] + v * velocity[1]
            time = (-half - sqrt(half**2 - square * (u**2 + v**2 - 1))) / square
            place = tuple(x + time * w for x, w in zip(place, velocity, strict=True))
            normal = tuple(x - c for x, c in zip(place, centre, strict=True))
            along = 2 * sum(n * w for n, w in zip(normal, velocity, strict=True))
            velocity = tuple(w - along * n for n, w in zip(normal, velocity, strict=True))
            left -= time
        exact = [x + left * w for x, w in zip(place, velocity, strict=True)]
    certificate = result.certificate
    for name, x, y, scale in zip(
        "xy", result.rows[-1][1:], exact, certificate.scales[1:], strict=True
    ):
        assert abs(x - y) <= certificate.global_error[name] * scale + 1e-15
