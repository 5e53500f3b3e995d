"""Whether two files mean the same physics, on random members of each kind of change."""

from __future__ import annotations

import random

import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.studies.check.difference import differences

PARTS = {
    "coordinates": "[x, y]",
    "parameters": "{m: {assume: positive}, k: {assume: positive}, a: {assume: positive}}",
    "L": "m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2",
    "constraints": "{wire: y = a*x^2}",
}


def problem(**changed):
    parts = {key: value for key, value in (PARTS | changed).items() if value is not None}
    return lagcli.loads("".join(f"{key}: {value}\n" for key, value in parts.items()))


GAUGES = ["x'*y + x*y'", "2*x*x'", "cos(x)*x'", "3*t^2", "y' + x*y'*0", "exp(y)*y'"]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(12))
def test_a_total_derivative_and_another_shape_change_nothing(seed):
    draw = random.Random(seed)
    gauge = draw.choice(GAUGES)
    factor = draw.choice(["1", "-2", "k", "m*a"])
    shape = draw.choice([
        "m*x'^2/2 + m*y'^2/2 - k*x^2/2 - y^2*k/2",
        "(m*(x'^2 + y'^2) - k*(x^2 + y^2))/2",
        "m*((x' + y')^2 + (x' - y')^2)/4 - k*((x + y)^2 + (x - y)^2)/4",
    ])  # fmt: skip
    free = draw.random() < 0.5
    constraints = None if free else PARTS["constraints"]
    old = problem(constraints=constraints)
    assert (
        differences(old, problem(L=f"{shape} + ({factor})*({gauge})", constraints=constraints))
        == []
    )


CHANGES = [
    ({"L": "m*(x'^2 + y'^2)/2 + k*(x^2 + y^2)/2"}, "accelerations.x"),
    ({"L": "m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)"}, "accelerations.x"),
    ({"L": "m*(x'^2 + 2*y'^2)/2 - k*(x^2 + y^2)/2"}, "accelerations.x"),
    ({"constraints": "{wire: y = 2*a*x^2}"}, "constraints.wire"),
    ({"constraints": "{rail: y = a*x^2}"}, "constraints.rail"),
    ({"constraints": "{wire: 2*y = 2*a*x^2}"}, "multipliers.wire"),
    ({"forces": "{x: k*a}"}, "accelerations.x"),
    ({"dissipation": "k*x'^2"}, "accelerations.x"),
    ({"coordinates": "[x, y, z]", "L": PARTS["L"] + " + m*z'^2/2"}, "coordinates.z"),
    ({"parameters": "{m: 1, k: {assume: positive}, a: {assume: positive}}"}, "parameters.m"),
    ({"initial": "{x: 1}"}, "initial.x"),
]


@pytest.mark.long
@pytest.mark.parametrize(("changed", "subject"), CHANGES)
def test_what_changes_the_physics_is_named(changed, subject):
    found = differences(problem(), problem(**changed))
    assert subject in [one.subject for one in found]
    assert all(one.verdict == "differs" for one in found)


def test_the_command_says_it_with_its_exit_status(tmp_path, capsysbinary):
    for name, sign in (("old", "-"), ("new", "+")):
        text = f"coordinates: [x]\nL: x'^2/2 {sign} x^2/2\n"
        (tmp_path / f"{name}.yaml").write_text(text)
    old, new = (str(tmp_path / f"{name}.yaml") for name in ("old", "new"))
    assert run(["diff", old, old]) == 0
    assert capsysbinary.readouterr().out == b"the same physics\n"
    assert run(["diff", old, new]) == 1
    shown = capsysbinary.readouterr().out.decode()
    assert shown == "differs: accelerations.x\n  - -x\n  + x\n"
    assert run(["diff", old, str(tmp_path / "none.yaml")]) == 2


def test_values_are_shown_as_they_are_written():
    old, new = (
        lagcli.loads(f"coordinates: [x]\nparameters: {{g: {g}}}\nL: x'^2/2 - g*x\n")
        for g in ("9.81", "98/10 + pi")
    )
    [found] = differences(old, new)
    assert (found.old, found.new) == ("9.81", "98/10 + pi")


def test_shards_are_a_partition(tmp_path, capsysbinary):
    for k in range(5):
        (tmp_path / f"{k}.yaml").write_text("coordinates: [x]\nL: x'^2/2\n")
    seen = []
    for part in ("1/2", "2/2"):
        assert run(["check", str(tmp_path), "--shard", part]) == 0
        lines = capsysbinary.readouterr().out.decode().splitlines()[:-1]
        seen += [line.split()[1] for line in lines]
    assert sorted(seen) == sorted(str(tmp_path / f"{k}.yaml") for k in range(5))
    for wrong in ("0/2", "3/2", "x", "1/"):
        assert run(["check", str(tmp_path), "--shard", wrong]) == 2
        assert b"such as 1/4" in capsysbinary.readouterr().err


@pytest.mark.long
@pytest.mark.parametrize("name", ["hoop", "kepler", "chaplygin-sleigh", "double-atwood"])
def test_a_file_is_the_same_as_itself(name):
    assert differences(lagcli.load(name), lagcli.load(name)) == []
