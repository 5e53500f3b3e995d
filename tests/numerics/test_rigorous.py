"""Proved motions: the exact one lies in the enclosure, against closed forms and certified runs."""

from __future__ import annotations

import json
from pathlib import Path

import mpmath
import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.interface.motion import request_of
from lagcli.numerics.rigorous import prove
from tests.oracle.interval_taylor import pendulum


def proof(problem, until, accuracy=1e-9, samples=5, show=()):
    return prove(
        problem, request_of(problem, until=until, accuracy=accuracy, samples=samples, show=show)
    )


def contains(ball, value):
    """Whether a value known to 30 digits lies in a ball."""
    middle, radius = mpmath.mpf(ball.mid().str(40, radius=False)), mpmath.mpf(float(ball.rad()))
    return abs(middle - value) <= radius * (1 + mpmath.mpf(10) ** -10) + mpmath.mpf(10) ** -25


def test_a_pendulum_lies_in_its_enclosure_by_jacobis_functions():
    """theta = 2 asin(k sn(K - w t, k)) from rest at 2 asin k (Whittaker, section 44)."""
    pendulum = lagcli.loads(
        "{coordinates: [theta], T: theta'^2/2, V: -9*cos(theta), initial: {theta: 2}}"
    )
    found = proof(pendulum, 4.0, 1e-12)
    assert found.reached
    with mpmath.workdps(40):
        k = mpmath.sin(1)
        quarter = mpmath.ellipk(k**2)
        for row in found.rows:
            t = mpmath.mpf(float(row[0].mid()))
            exact = 2 * mpmath.asin(k * mpmath.ellipfun("sn", quarter - 3 * t, m=k**2))
            assert contains(row[1], exact)
            assert float(row[1].rad()) < 1e-12


def test_the_radius_of_a_pendulum_is_a_part_of_a_rounding_after_many_turns():
    """What steps leave out is far below 2^-kept, and so are all their rounds together."""
    found = proof(lagcli.load("plane-pendulum"), 20.0, 1e-12, samples=2)
    assert all(float(x.rad()) < 0.01 * 2.0**-found.kept for x in found.rows[-1][1:])


@pytest.mark.long
def test_the_radius_of_a_pendulum_is_below_that_of_a_textbook_method_in_as_many_bits():
    """Nor do the two enclosures exclude each other."""
    found = proof(lagcli.load("plane-pendulum"), 20.0, 1e-12, samples=2)
    other, _ = pendulum("1", "9.81", 20, found.bits)
    for ours, theirs in zip(found.rows[-1][1:], other, strict=True):
        assert ours.overlaps(theirs)
        assert ours.rad() < theirs.rad()


@pytest.mark.parametrize("k", ["3", "1/7", "0.1"])
def test_oscillations_with_and_without_a_drive_lie_in_theirs(k):
    """x'' = -k x + t, x(0) = 1: x = t/k + cos(w t) - sin(w t)/(k w)."""
    problem = lagcli.loads(f"{{coordinates: [x], L: x'^2/2 - {k}*x^2/2 + t*x, initial: {{x: 1}}}}")
    with mpmath.workdps(40):
        number = mpmath.mpf(1) / 7 if k == "1/7" else mpmath.mpf(k)
        w = mpmath.sqrt(number)
        for row in proof(problem, 3.0).rows:
            t = mpmath.mpf(float(row[0].mid()))
            exact = t / number + mpmath.cos(w * t) - mpmath.sin(w * t) / (number * w)
            assert contains(row[1], exact)


def test_damping_and_a_column_lie_in_theirs():
    """x'' = -2 x', x'(0) = 1: x = (1 - exp(-2 t))/2; the column is x'' itself."""
    problem = lagcli.loads("{coordinates: [x], T: x'^2/2, dissipation: x'^2, initial: {x': 1}}")
    with mpmath.workdps(40):
        for row in proof(problem, 2.0, show=["x", "x''"]).rows:
            t = mpmath.mpf(float(row[0].mid()))
            assert contains(row[1], (1 - mpmath.exp(-2 * t)) / 2)
            assert contains(row[2], -2 * mpmath.exp(-2 * t))


@pytest.mark.long
def test_kepler_comes_back_to_its_beginning():
    """After one period 2 pi a^(3/2) the state is the first one; a = 1 from x = 1/2."""
    problem = lagcli.loads(
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: -1/sqrt(x^2 + y^2), "
        "initial: {x: 1/2, y': sqrt(3)}}"
    )
    until = float(2 * mpmath.pi)
    row = proof(problem, until, samples=2).rows[-1]
    for ball, begin in zip(row[1:], (0.5, 0, 0, mpmath.sqrt(3)), strict=True):
        assert abs(float(ball.mid()) - begin) < 1e-14 + float(ball.rad())


@pytest.mark.long
def test_a_stiff_mechanism_with_three_loops_is_proved():
    """Andrews' squeezer, whose inertias of 1e-6 make the derivatives of its accelerations large."""
    problem = lagcli.load(Path(__file__).parents[1] / "benchmarks" / "andrews-squeezer.yaml")
    motion = lagcli.simulate(problem, 0.005, samples=2, accuracy=1e-10)
    found = proof(problem, 0.005, samples=2)
    assert found.reached
    for name, x, ball in zip(motion.columns, motion.rows[-1], found.rows[-1], strict=True):
        assert abs(float(ball.mid()) - x) <= 1e-9 * max(abs(value) for value in motion[name])


@pytest.mark.long
@pytest.mark.parametrize("name", ["kepler", "double-pendulum-equal", "pendulum-cartesian"])
def test_certified_runs_lie_in_the_enclosures(name):
    """Within the bound of the certificate, which is another route to the same motion."""
    problem = lagcli.load(name)
    motion = lagcli.simulate(problem, 2.0, samples=5, accuracy=1e-9)
    found = proof(problem, 2.0)
    assert found.reached
    for row, balls in zip(motion.rows, found.rows, strict=True):
        for name, x, ball in zip(motion.columns, row, balls, strict=True):
            scale = max(abs(value) for value in motion[name])
            bound = 1e-9 * scale + float(ball.rad())
            assert abs(float(ball.mid()) - x) <= bound


@pytest.mark.long
def test_the_energy_is_enclosed_thinly_all_the_way():
    problem = lagcli.load("double-pendulum-equal")
    rows = proof(problem, 4.0, show=["energy"]).rows
    assert all((row[1] - rows[0][1]).contains(0) for row in rows)
    assert max(float(row[1].rad()) for row in rows) < 1e-9


@pytest.mark.long
def test_a_collision_ends_the_proof_before_it(capsysbinary):
    """The fall takes pi/(2 sqrt 2) = 1.1107."""
    status = run(["simulate", "kepler", "--at", "y'=0", "--until", "2", "--samples", "9",
                  "--rigorous", "-f", "json"])  # fmt: skip
    content = json.loads(capsysbinary.readouterr().out)
    assert status == 1
    assert content["refused"]["at"] == content["certificate"]["holds_until"] == 1.0
    assert content["rows"][-1][0] == 1.0
    assert content["refused"]["reason"].endswith("the motion comes to a singularity")


@pytest.mark.long
def test_a_perihelion_of_a_millionth_is_passed():
    """The semiaxis is 1: after 2 pi the motion is where it began."""
    problem = lagcli.loads(
        "{coordinates: [x, y], L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2), "
        "initial: {x: 2 - 1e-6, y': sqrt(2/(2 - 1e-6) - 1)}}"
    )
    found = prove(problem, request_of(problem, until="2*pi", accuracy=1e-6, samples=2))
    assert found.reached, found.refusal
    for before, after in zip(found.rows[0][1:], found.rows[-1][1:], strict=True):
        assert after.overlaps(before)


def test_rows_where_a_column_is_next_to_0_get_the_bits_that_they_need():
    """At half a period x' = -sin(t) is the distance of the double from pi."""
    oscillator = lagcli.loads("{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}")
    found = proof(oscillator, 3.141592653589793, 1e-12, samples=2)
    assert found.reached
    with mpmath.workdps(40):
        assert contains(found.rows[-1][2], -mpmath.sin(mpmath.mpf("3.141592653589793")))
    assert found.rows[-1][2].rel_accuracy_bits() > 39


def test_json_has_an_enclosure_for_each_number(capsysbinary):
    assert run(["simulate", "plane-pendulum", "--until", "1", "--samples", "3", "--rigorous", "-f",
                "json"]) == 0  # fmt: skip
    content = json.loads(capsysbinary.readouterr().out)
    for row, balls in zip(content["rows"], content["enclosures"], strict=True):
        for x, ball in zip(row, balls, strict=True):
            assert abs(x - float(ball["midpoint"])) <= float(ball["radius"]) + 1e-15 * abs(x)
    assert content["certificate"]["kind"] == "proof"


def test_times_are_those_that_are_written(capsysbinary):
    """x = sin t at one and two tenths of a second, which no double is, and at parts of pi."""
    oscillator = lagcli.loads("{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x': 1}}")
    with mpmath.workdps(40):
        tenths, thirds = proof(oscillator, "0.2", samples=3), proof(oscillator, "pi", samples=4)
        for k, row in enumerate(tenths.rows):
            assert contains(row[1], mpmath.sin(mpmath.mpf(k) / 10))
        for k, row in enumerate(thirds.rows):
            assert contains(row[1], mpmath.sin(k * mpmath.pi / 3))
        assert float(tenths.rows[1][1].rad()) < 1e-21
    arguments = ["simulate", "plane-pendulum", "--until", "0.2", "--samples", "3", "--rigorous"]
    assert run([*arguments, "-f", "json"]) == 0
    rows = json.loads(capsysbinary.readouterr().out)["enclosures"]
    assert all(float(ball["radius"]) < 1e-20 for row in rows for ball in row)


def test_a_row_at_the_time_of_an_impact_has_both_sides():
    """A ball that falls 1/10 with g = 1 strikes after 1/sqrt 5, at a row."""
    text = (
        "{coordinates: [y], T: y'^2/2, V: y, contacts: {floor: {gap: y >= 0, restitution: 1/2}}, "
        "initial: {y: 1/10}}"
    )
    _, _, row, last = proof(lagcli.loads(text), "3/(2*sqrt(5))", samples=4).rows
    assert row[1].contains(0)
    assert row[2] is None
    assert contains(last[1], mpmath.mpf(1) / 40)
    assert last[2].contains(0)


def test_the_table_shows_proved_digits_only(capsysbinary):
    assert run(["simulate", "plane-pendulum", "--until", "1", "--samples", "2", "--rigorous"]) == 0
    last = capsysbinary.readouterr().out.decode().splitlines()[2].split()
    assert mpmath.mpf(last[1]) == pytest.approx(-0.98006699293340488, abs=1e-14)
    assert len(last[1]) >= 14


def test_a_format_without_enclosures_is_a_mistake(capsysbinary, tmp_path):
    out = str(tmp_path / "x.npz")
    assert run(["simulate", "kepler", "--rigorous", "--until", "1", "-o", out]) == 2
    assert b"--rigorous has no format npz" in capsysbinary.readouterr().err


@pytest.mark.parametrize(
    ("constraint", "given", "exact"),
    [
        ("y = 3*x", "y: 1", "1/3"),  # linear: solved for y, unless x follows from it
        ("x^3 + x = y", "y: 2, x': 1", "1"),
        ("cos(x) = x*y", "y: 1", "0.73908513321516064165531208767387340401341175890076"),
    ],
)
def test_what_a_constraint_determines_is_no_double(constraint, given, exact):
    problem = lagcli.loads(
        f"{{coordinates: [x, y], T: (x'^2 + y'^2)/2, constraints: {{c: {constraint}}}, "
        f"initial: {{{given}}}}}"
    )
    row = proof(problem, 1.0, samples=2, show=["x", "y"]).rows[0]
    with mpmath.workdps(50):
        value = mpmath.mpf(1) / 3 if exact == "1/3" else mpmath.mpf(exact)
        assert contains(row[1], value)
        assert float(row[1].rad()) < 1e-20


@pytest.mark.first_quick
@pytest.mark.parametrize(
    ("force", "integral"),
    [
        ("exp(-((t - 3)/1e-3)^2)", lambda: mpmath.sqrt(mpmath.pi) / 1000),
        ("1/cosh((t - 3)/1e-4)^2", lambda: mpmath.mpf(2) / 10000),
        ("exp(-(sin(t)/1e-2)^2)", lambda: mpmath.exp(-5000) * mpmath.besseli(0, 5000) * mpmath.pi),
        ("(t/4)^300", lambda: mpmath.mpf(4) / 301),
        ("1e-6/(1e-12 + (t - 3)^2)", lambda: mpmath.atan(3e6) + mpmath.atan(1e6)),
    ],
)
def test_a_narrow_pulse_is_proved_though_no_coefficient_shows_it(force, integral):
    """x' at the end is the integral of the force; of that of a sine there is half a period more."""
    until = 5.0 if "sin" in force else 4.0
    text = f"{{coordinates: [x], T: x'^2/2, forces: {{x: '{force}'}}, initial: {{x: 0}}}}"
    found = proof(lagcli.loads(text), until, samples=2)
    assert found.reached, found.refusal
    with mpmath.workdps(40):
        turns = mpmath.mpf(3) / 2 if "sin" in force else 1
        assert contains(found.rows[-1][2], integral() * turns)


@pytest.mark.parametrize("w", ["1e-3", "1e-5"])
def test_a_low_wall_is_passed_and_a_high_one_turns_back(w):
    """The speed is that of the beginning; behind x = 5 only where the wall is below 1/2."""
    for height, speed in (("0.3", 1), ("0.7", -1)):
        text = (
            f"{{coordinates: [x], T: x'^2/2, V: '{height}*exp(-((x - 5)/{w})^2)', "
            "initial: {x: 0, x': 1}}"
        )
        found = proof(lagcli.loads(text), 10.0, samples=2)
        assert found.reached, found.refusal
        assert contains(found.rows[-1][2], speed)


@pytest.mark.long
def test_the_cut_of_an_angle_is_passed():
    """atan2(sin t, cos t) is t up to pi, and t - 2 pi from there on."""
    problem = lagcli.loads(
        "{coordinates: [x], T: x'^2/2, forces: {x: 'atan2(sin(t), cos(t))'}, initial: {x: 0}}"
    )
    row = proof(problem, 4.0, samples=2).rows[-1]
    with mpmath.workdps(40):
        assert contains(row[1], mpmath.mpf(64) / 6 - mpmath.pi * (4 - mpmath.pi) ** 2)


def test_a_constraint_that_others_imply_at_the_beginning_only_ends_the_proof():
    """x^2 + y^2 = 1 and x^2 + 2 y^2 = 1 have the same tangent at (1, 0), and go apart."""
    text = (
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: y, "
        "constraints: {circle: x^2 + y^2 = 1, ellipse: x^2 + 2*y^2 = 1}, initial: {x: 1, y: 0}}"
    )
    found = proof(lagcli.loads(text), 1.0)
    assert not found.reached
    assert "do not imply" in found.refusal
