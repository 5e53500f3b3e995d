"""`reaches` and `always` decided by enclosures, against closed forms."""

from __future__ import annotations

import json
from random import Random

import mpmath
import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.statements.questions import Proved
from lagcli.studies.proved_answer import proved_answer

BRAKED = """
coordinates: [x]
parameters: {{c: {{value: {c}}}, w: {{value: {w}}}}}
T: x'^2/2
forces: {{x: -c*x'}}
initial: {{x': w}}
simulation: {{until: 5}}
find:
  there: {{reaches: "x = {place}", for: w}}
  far: {{reaches: x = w/c, for: w}}
  fast: {{always: "x' >= {speed}", for: w}}
  slow: {{always: x' <= w + 1/1000, for: w}}
"""


def answers(text):
    problem = lagcli.loads(text)
    return {q.name: proved_answer(problem, q) for q in problem.find}


def in_last_place(shown, exact):
    """Whether the digits shown are those of a number, but for one unit of the last."""
    places = len(shown.partition(".")[2])
    return abs(mpmath.mpf(shown) - exact) <= mpmath.mpf(10) ** -places


@pytest.mark.parametrize("seed", range(3))
def test_braked_motion_reaches_and_keeps_what_its_exponential_says(seed):
    """x' = w exp(-c t), x = (w - x')/c."""
    draw = Random(seed)
    c, w = (f"{draw.uniform(0.3, 1.5):.3f}" for _ in range(2))
    place, speed = f"{float(w) / float(c) / 3:.3f}", f"{float(w) / 2:.3f}"
    found = answers(BRAKED.format(c=c, w=w, place=place, speed=speed))
    with mpmath.workdps(40):
        C, W, X, V = map(mpmath.mpf, (c, w, place, speed))
        assert found["there"].holds
        assert in_last_place(found["there"].at, -mpmath.log(1 - C * X / W) / C)
        assert not found["fast"].holds
        assert in_last_place(found["fast"].at, mpmath.log(W / V) / C)
    assert (found["far"].holds, found["far"].until, found["far"].at) == (False, 5.0, "")
    assert (found["slow"].holds, found["slow"].until) == (True, 5.0)


def test_what_is_only_touched_or_begins_at_the_limit_is_not_decided():
    """x = sin(t) touches 1."""
    text = (
        "{coordinates: [x], parameters: {w: {value: 1}}, T: x'^2/2, V: x^2/2, initial: {x': w}, "
        "simulation: {until: 4}, find: {top: {reaches: x = 1, for: w}, "
        "beyond: {reaches: x = 1.001, for: w}, limit: {always: x' <= 1, for: w}, "
        "false: {always: x' >= 2, for: w}}}"
    )
    found = answers(text)
    assert isinstance(found["top"], str)
    assert isinstance(found["limit"], str)
    assert isinstance(found["beyond"], Proved)
    assert not found["beyond"].holds
    assert "at the beginning" in found["false"].sentence


def test_a_velocity_that_an_impact_turns_is_below_a_limit_until_then(tmp_path, capsysbinary):
    """From 1 m, e = 4/5: x' rises to 0.8 sqrt(2 g); falling faster than 3 m/s from t = 3/g on."""
    file = tmp_path / "ball.yaml"
    file.write_text(
        "{coordinates: [y], parameters: {h: {value: 1}}, T: y'^2/2, V: 10*y, initial: {y: h}, "
        "contacts: {floor: {gap: y >= 0, restitution: 0.8}}, simulation: {until: 1}, "
        "find: {up: {always: y' <= 3.6, for: h}, down: {always: y' >= -3, for: h}}}"
    )
    run(["solve", str(file), "--show", "find", "--format", "json"])
    found = json.loads(capsysbinary.readouterr().out)["find"]
    assert found["up"]["ranges"] is None
    assert found["up"]["proved"]["holds"]
    assert not found["down"]["proved"]["holds"]
    assert in_last_place(found["down"]["proved"]["at"], mpmath.mpf(3) / 10)
