"""Events, contacts and switching functions in proved motions, against closed forms."""

from __future__ import annotations

import json
from fractions import Fraction

import mpmath
import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.interface.motion import request_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.rigorous import prove
from tests.numerics.test_rigorous import contains, proof


def test_twenty_bounces_are_counted_and_timed():
    """t_k = sqrt(2 h/g) (1 + 2 (e + ... + e^k)); the speed falls by e each time."""
    ball = lagcli.loads(
        "{coordinates: [y], T: y'^2/2, V: 9.81*y, contacts: {floor: {gap: y >= 0, "
        "restitution: 0.9}}, initial: {y: 1}}"
    )
    found = proof(ball, 7.5, samples=4)
    assert found.reached
    assert len(found.events) == 20
    with mpmath.workdps(40):
        g, e = mpmath.mpf(981) / 100, mpmath.mpf(9) / 10
        fall = mpmath.sqrt(2 / g)
        times = [fall * (1 + 2 * sum(e**j for j in range(1, k + 1))) for k in range(20)]
        for event, exact in zip(found.events, times, strict=True):
            assert (event.name, event.what) == ("floor", "impact")
            assert contains(event.t, exact)
        t = mpmath.mpf(7.5)
        since, speed = t - times[-1], g * fall * e**20
        assert contains(found.rows[-1][1], speed * since - g * since**2 / 2)
        assert contains(found.rows[-1][2], speed - g * since)
    assert all(float(x.rad()) < 1e-15 for x in found.rows[-1][1:])


def test_a_corner_of_the_potential_is_crossed():
    """x'' = -sign(x) from x = 1: parabolas, and 0 at odd multiples of sqrt 2."""
    problem = lagcli.loads("{coordinates: [x], T: x'^2/2, V: abs(x), initial: {x: 1}}")
    found = proof(problem, 10.0, samples=2)
    with mpmath.workdps(40):
        after = 10 - 7 * mpmath.sqrt(2)  # it rises through 0 with the speed sqrt 2
        assert contains(found.rows[-1][1], mpmath.sqrt(2) * after - after**2 / 2)
        assert contains(found.rows[-1][2], mpmath.sqrt(2) - after)


def test_a_force_that_switches_with_the_time_does_so_exactly():
    """x'' = sign(t - 1/3): x = -t^2/2 until then."""
    problem = lagcli.loads(
        "{coordinates: [x], T: x'^2/2, forces: {x: sign(t - 1/3)}, initial: {x: 0}}"
    )
    row = proof(problem, 1.0, samples=2).rows[-1]
    exact = Fraction(-1, 18) - Fraction(1, 3) * Fraction(2, 3) + Fraction(2, 3) ** 2 / 2
    with mpmath.workdps(40):
        assert contains(row[1], mpmath.mpf(exact.numerator) / exact.denominator)


def test_friction_that_is_passed_with_speed_and_friction_that_holds():
    """x'' = -x - sign(x')/10 from 3: half a period takes pi and 1/5 of the amplitude; from 1.05 it
    stops at 0.05 after five halves of a period, and stays.
    """
    text = "{coordinates: [x], T: x'^2/2, V: x^2/2, forces: {x: -sign(x')/10}, initial: {x: %s}}"
    row = proof(lagcli.loads(text % 3), 6.0, samples=2).rows[-1]
    stopped = proof(lagcli.loads(text % 1.05), 20.0, samples=21)
    assert stopped.reached
    [event] = stopped.events
    assert (event.name, event.what) == ("x'", "sticks")
    with mpmath.workdps(40):
        amplitude = mpmath.mpf(27) / 10  # from -2.8, about -1/10
        assert contains(row[1], -mpmath.mpf(1) / 10 - amplitude * mpmath.cos(6 - mpmath.pi))
        assert contains(event.t, 5 * mpmath.pi)
        assert contains(stopped.rows[-1][1], -mpmath.mpf(5) / 100)
        assert contains(stopped.rows[-1][2], 0)


def test_what_a_belt_carries_slips_where_its_spring_pulls_as_much_as_friction_holds():
    """x = v t until mu m g = k x, then d + v/w sin(w (t - d/v))."""
    belt = lagcli.load("block-on-belt")
    found = proof(belt, 1.0, samples=2)
    assert [(e.name, e.what) for e in found.events] == [("x'", "sticks"), ("x'", "slips")]
    with mpmath.workdps(40):
        slips = mpmath.mpf(4) / 10 * mpmath.mpf(981) / 100 / 25 / (mpmath.mpf(1) / 2)
        assert contains(found.events[1].t, slips)
        exact = slips / 2 + mpmath.sin(5 * (1 - slips)) / 10
        assert contains(found.rows[-1][1], exact)


def test_two_bodies_that_rub_move_together_in_the_end():
    """x'' = -f, y'' = f/2 from speeds 1 and 0: together at 1/(3 f/2), with two thirds less."""
    text = (
        "{coordinates: [x, y], T: x'^2/2 + y'^2, forces: {x: -0.3*sign(x' - y'), "
        "y: -0.3*sign(y' - x')}, initial: {x': 1}}"
    )
    found = proof(lagcli.loads(text), 5.0, samples=2)
    assert [(e.name, e.what) for e in found.events] == [("x', y'", "sticks")]
    with mpmath.workdps(40):
        assert contains(found.events[0].t, mpmath.mpf(20) / 9)
        assert all(contains(x, mpmath.mpf(1) / 3) for x in found.rows[-1][3:5])


@pytest.mark.parametrize(
    ("e", "height"), [("0.31", "1"), pytest.param("1/2", "0.37", marks=pytest.mark.long)]
)
def test_impacts_that_accumulate_on_a_slope_end_and_the_ball_slides(e, height):
    """Of slope 3/4, g = 10: the normal falls with 8, and along the slope it slides with 6."""
    ball = lagcli.loads(
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: 10*y, initial: {y: HEIGHT}, contacts: "
        "{slope: {gap: 4*y - 3*x >= 0, restitution: E}}}".replace("E}", f"{e}}}").replace(
            "HEIGHT", height
        )
    )
    found = proof(ball, 3.0, samples=4, show=["x", "y", "x'", "lambda_slope"])
    assert found.reached, found.refusal
    assert [event.what for event in found.events][-2:] == ["impact", "comes to rest"]
    with mpmath.workdps(40):
        ratio, h = (
            mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in (e, height)
        )
        rest = mpmath.sqrt(h / 5) * (1 + ratio) / (1 - ratio)
        assert contains(found.events[-1].t, rest)
        assert rest < 3
        along = 3 * h / 5 - 3 * mpmath.mpf(9)
        x, y, speed, force = found.rows[-1][1:]
        assert contains(x, 4 * along / 5)
        assert contains(y, 3 * along / 5)
        assert contains(speed, -mpmath.mpf(4) * 18 / 5)
        assert contains(force, mpmath.mpf(8) / 5)  # beside the gradient, of length 5


@pytest.mark.long
def test_impacts_that_accumulate_while_another_contact_holds_end_the_proof():
    ball = lagcli.loads(
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: 10*y + x, initial: {y: 1}, contacts: "
        "{wall: {gap: x >= 0, restitution: 0}, floor: {gap: y >= 0, restitution: 0.4}}}"
    )
    found = proof(ball, 4.0, samples=41)
    rest = (0.2**0.5) * 1.4 / 0.6
    assert not found.reached
    assert 0.8 * rest < found.holds_until < rest
    assert "where impacts accumulate: what follows them is not enclosed" in found.refusal


@pytest.mark.parametrize(
    ("name", "until"), [("ball-leaves-sphere-with-speed", 1.5), ("pendulum-on-string", 3.0)]
)
def test_a_motion_ends_where_its_contact_is_lost(name, until):
    problem = lagcli.load(name)
    found = proof(problem, until, samples=3)
    motion = lagcli.simulate(problem, until, samples=3)
    assert found.reached
    [event], [other] = found.events, motion.events
    assert event.what == other.what == "contact lost"
    assert float(event.t) == pytest.approx(other.t, rel=1e-12)
    assert float(event.t.rad()) < 1e-18


def test_a_moving_floor_adds_its_speed():
    """The gap y - t/2 from 1, g = 2, e = 1: 1 - t^2 = t/2 at (sqrt(17) - 1)/4."""
    problem = lagcli.loads(
        "{coordinates: [y], T: y'^2/2, V: 2*y, contacts: {floor: {gap: y - t/2 >= 0, "
        "restitution: 1}}, initial: {y: 1}}"
    )
    found = proof(problem, 1.0, samples=2)
    with mpmath.workdps(40):
        t = (mpmath.sqrt(17) - 1) / 4
        assert contains(found.events[0].t, t)
        assert contains(found.rows[-1][2], 1 + 2 * t - 2 * (1 - t))


def test_an_event_at_the_beginning_and_one_at_the_end():
    """x'' = -sign(x) from 0 with speed 1 is back at 0 at t = 2, 4, ...: with exactly that speed."""
    problem = lagcli.loads("{coordinates: [x], T: x'^2/2, V: abs(x), initial: {x': 1}}")
    row = proof(problem, 8.0, samples=2).rows[-1]
    assert row[1].contains(0)
    assert row[2].contains(1)
    assert float(row[1].rad()) < 1e-15
    row = proof(problem, 8.0, samples=2, show=["x", "x''"]).rows[-1]
    assert row[2] is None  # the force jumps just then
    still = proof(lagcli.loads("{coordinates: [x], T: x'^2/2, V: abs(x)}"), 1.0, samples=2)
    assert not still.reached


def test_the_run_stops_at_a_condition(capsysbinary):
    command = [
        "simulate",
        "plane-pendulum",
        "--until",
        "2",
        "--stop-when",
        "theta",
        "--rigorous",
    ]
    assert run([*command, "-f", "json"]) == 0
    content = json.loads(capsysbinary.readouterr().out)
    [event] = content["events"]
    with mpmath.workdps(30):
        quarter = mpmath.ellipk(mpmath.sin(mpmath.mpf(1) / 2) ** 2) / mpmath.sqrt(
            mpmath.mpf("9.81")
        )
        assert abs(mpmath.mpf(event["enclosure"]["midpoint"]) - quarter) < 1e-18
    assert content["rows"][-1][0] == event["t"]


def test_the_table_lists_what_happened(capsysbinary):
    assert run(["simulate", "bouncing-ball", "--until", "1", "--samples", "2", "--rigorous"]) == 0
    text = capsysbinary.readouterr().out.decode()
    assert "impact at t = 0.63855085681410092842" in text
    assert "order and number of the events" in text


def test_a_sign_that_makes_a_condition_jump_is_not_followed():
    """1.2 - x changes to 0.8 - x at t = 1: neither of their zeros is where the sign changes."""
    problem = lagcli.loads("{coordinates: [x], T: x'^2/2, initial: {x: 0, x': 1}}")
    stop = "1.2 - x - 0.2*(1 + sign(t - 1))"
    with pytest.raises(Refusal, match="jumps with a sign"):
        prove(problem, request_of(problem, until=3, stop_when=stop))
    continuous = prove(problem, request_of(problem, until=3, stop_when="abs(x - 1/2) - 1/10"))
    assert float(continuous.events[0].t) == pytest.approx(0.4, rel=1e-15)


@pytest.mark.parametrize("restitution", ["0", "1/2"])
def test_a_contact_that_is_closed_at_the_beginning_acts_until_its_force_is_lost(restitution):
    """V = y - t^2 y: the force of the floor, 1 - t^2, is lost at t = 1, and y'' = t^2 - 1 from then."""
    ball = lagcli.loads(
        "{coordinates: [y], T: y'^2/2, V: y - t^2*y, contacts: {floor: {gap: y >= 0, "
        f"restitution: {restitution}}}}}, initial: {{y: 0}}}}"
    )
    found = proof(ball, 2.0, samples=2)
    assert found.reached
    assert [(event.name, event.what) for event in found.events] == [("floor", "contact lost")]
    assert contains(found.events[0].t, mpmath.mpf(1))
    with mpmath.workdps(40):  # y' = t^3/3 - t + 2/3
        assert contains(found.rows[-1][2], mpmath.mpf(8) / 3 - 2 + mpmath.mpf(2) / 3)
