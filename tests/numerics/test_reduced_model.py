"""The cut model moves as the whole one does, and says what it left out."""

import json
import math
import subprocess
import sys

import pytest

TWO = """
title: a pendulum, and a mass on a moving line that knows nothing of it
coordinates: [theta, x, y]
parameters: {g: {value: 9.81}, l: {value: 1}, k: {value: 4}, a: {value: 0.5}}
T: l^2*theta'^2/2 + (x'^2 + y'^2)/2
V: -g*l*cos(theta) + k*x^2/2
constraints:
  line: x - a*y = 1 + t
initial: {theta: 1, y: 0.5, y': 0}
"""


def simulated(path, *options, status=0):
    run = subprocess.run(
        [sys.executable, "-m", "lagcli", "simulate", str(path), "-f", "json", *options],
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == status, run.stderr
    return json.loads(run.stdout) if status == 0 else run.stderr


@pytest.fixture
def two(tmp_path):
    path = tmp_path / "two.yaml"
    path.write_text(TWO)
    return path


@pytest.mark.long
@pytest.mark.parametrize(
    ("problem", "eliminated"),
    [
        ("hoop", {"x": "R*theta"}),
        ("pendulums/pendulum-with-rod", {"r": "l"}),
        ("pulleys/atwood-with-heavy-pulley", {"x": "R*theta", "y": "l - R*theta"}),
        ("contact/bead-in-groove-first-kind", {"y": "a*x^2"}),
    ],
)
def test_the_same_motion_by_fewer_coordinates(problem, eliminated):
    options = [f"problems/{problem}.yaml", "--until", "3", "--samples", "7"]
    cut, whole = simulated(*options), simulated(*options, "--whole-model")
    assert whole["model"] == {}
    assert cut["model"]["eliminated"] == eliminated
    assert set(cut["model"]["reason"]) >= set(eliminated)
    assert set(cut["certificate"]["charges"]) == set(whole["certificate"]["charges"])
    for ours, theirs in zip(cut["rows"], whole["rows"], strict=True):
        assert ours == pytest.approx(theirs, rel=1e-8, abs=1e-8)


@pytest.mark.long
def test_what_no_column_depends_on_is_left_out(two):
    found = simulated(two, "--until", "2", "--samples", "3", "--show", "theta")
    assert set(found["model"]["dropped"]) == {"y"}
    found = simulated(two, "--until", "2", "--samples", "3", "--show", "x,x',y''")
    assert found["model"]["dropped"] == ["theta"]
    # (1 + 1/a^2) x'' = -k x with x(0) = 1 + a y(0), x'(0) = 1: the line moves evenly
    omega, x0 = math.sqrt(4 / (1 + 1 / 0.25)), 1.25
    for t, x, v, a in found["rows"]:
        exact = x0 * math.cos(omega * t) + math.sin(omega * t) / omega
        slope = math.cos(omega * t) - omega * x0 * math.sin(omega * t)
        assert (x, v, a) == pytest.approx((exact, slope, -(omega**2) * exact / 0.5), rel=1e-8)


@pytest.mark.long
def test_a_multiplier_keeps_its_constraint(two):
    found = simulated(two, "--until", "1", "--samples", "3", "--show", "x,lambda_line")
    assert found["model"] == {} or "x" not in found["model"]["eliminated"]
    for _, x, force in found["rows"]:
        # x'' = -k x + lambda and y'' = -a lambda with x'' = a y''
        assert force == pytest.approx(4 * x / (1 + 0.25), rel=1e-8)


@pytest.mark.long
def test_a_state_off_the_constraint_is_refused_all_the_same(two):
    two.write_text(TWO.replace("y: 0.5,", "y: 0.5, x: 3,"))
    assert "line" in simulated(two, "--until", "1", status=2)


@pytest.mark.long
def test_many_digits_begin_at_the_exact_state(two):
    found = simulated(
        two,
        "--until",
        "1",
        "--samples",
        "2",
        "--show",
        "x",
        "--method",
        "taylor",
        "--accuracy",
        "1e-15",
    )
    omega = math.sqrt(0.8)
    assert found["model"]["eliminated"]
    exact = 1.25 * math.cos(omega) + math.sin(omega) / omega
    assert found["rows"][-1][1] == pytest.approx(exact, rel=4e-15)
