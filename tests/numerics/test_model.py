"""What `solve --show model` says is what a run does, and what is without influence has none."""

import json
import random
import subprocess
import sys

import pytest

from lagcli import load, loads
from lagcli.mechanics.derivation import Derivation
from lagcli.numerics.certified.model import model_section
from lagcli.pipeline import Request, state
from tests.solved import solve


def lagcli(*arguments, status=0):
    run = subprocess.run(
        [sys.executable, "-m", "lagcli", *arguments], capture_output=True, text=True, check=False
    )
    assert run.returncode == status, run.stderr
    return run.stdout


def model_of(path):
    return json.loads(lagcli("solve", str(path), "--show", "model", "-f", "json"))["model"]


@pytest.mark.long
@pytest.mark.parametrize(
    "name",
    ["hoop", "pendulums/pendulum-with-rod", "pulleys/atwood-with-heavy-pulley", "central/kepler"],
)
def test_it_is_the_model_of_a_run(name):
    path = f"problems/{name}.yaml"
    run = json.loads(lagcli("simulate", path, "--until", "0.1", "-f", "json"))["model"]
    said = model_of(path)
    if not run:
        assert said["eliminated"] == {}
        return
    assert said["kept"] == run["kept"]
    assert said["eliminated"] == run["eliminated"]


@pytest.mark.long
@pytest.mark.parametrize(
    "name",
    [
        "central/kepler",
        "classics/spherical-pendulum",
        "pendulums/pendulum-on-sliding-support",
        "rigid/heavy-symmetric-top",
        "oscillations/masses-joined-by-damper",
        "discovery/uniform-magnetic-field-space",
        "steady/elastic-conical-pendulum",
    ],
)
def test_ignorable_are_the_cyclic_coordinates_with_a_conserved_momentum(name):
    """Against the algebra's charges, which know nothing of the numbers."""
    problem = load(f"problems/{name}.yaml")
    sections = solve(problem, ["momenta", "charges"]).sections
    broken = {c.name for c in sections["charges"].charges if not c.conserved}
    cyclic = {x for x in sections["momenta"].cyclic if f"p_{x}" not in broken}
    assert set(model_section(problem).ignorable) == cyclic


@pytest.mark.parametrize(
    "acting",
    [
        "constraints: {c: x'*sin(phi) = y'*cos(phi)}",
        "constraints: {c: x' = phi*y'}",
        "constraints: {c: x' = sin(phi)}",
        "forces: {x: -phi}",
        "forces: {y: a*x'*cos(phi)}",
        "dissipation: a*(2 + cos(phi))*x'^2/2",
    ],
)
def test_a_cyclic_coordinate_on_which_forces_or_constraints_depend_is_not_ignorable(acting):
    """Its momentum is conserved, but the motion of x and y depends on its value."""
    problem = loads(f"""
coordinates: [x, y, phi]
parameters: {{a: {{assume: positive}}}}
T: (x'^2 + y'^2 + phi'^2)/2
V: a*x*y
{acting}
""")
    assert model_section(problem).ignorable == ()


@pytest.mark.long
@pytest.mark.parametrize("name", ["hoop", "pulleys/atwood"])
def test_what_is_dropped_has_no_influence(name):
    path = f"problems/{name}.yaml"
    [dropped] = model_of(path)["dropped"]
    rows = [
        json.loads(
            lagcli("simulate", path, "--until", "1", "-f", "json", "--set", f"{dropped}={value}")
        )["rows"]
        for value in ("3", "77")
    ]
    assert rows[0] == rows[1]


def test_a_coefficient_of_restitution_has_influence():
    assert "e" not in model_section(load("problems/impact/two-carts-collide.yaml")).reason


def test_constraints_that_stay_say_why():
    reason = model_section(load("problems/chains/slider-crank.yaml")).reason
    assert "constant coefficient" in reason["height"]
    assert "stroke" in reason["x"]
    reason = model_section(load("problems/contact/mass-sliding-off-sphere.yaml")).reason
    assert "contact" in reason["surface"]
    reason = model_section(load("problems/nonholonomic/rolling-vertical-disk.yaml")).reason
    assert "velocities" in reason["roll_x"]


def test_a_constraint_that_restricts_nothing_more_is_said_to_follow_from_the_others():
    """A sum of the others, with positions or with their rates; none that is independent."""
    source = random.Random("follows")
    for _ in range(4):
        a, b, c = (source.choice([-3, -2, 2, 3]) for _ in range(3))
        rows = [f"x + {a}*u", f"y + {b}*u", f"{c}*(x + {a}*u) - y - {b}*u"]
        if source.random() < 0.5:
            rows[2] = f"{c}*(x' + {a}*u') - y' - {b}*u'"
        rows.append("y*w' - u'")
        lines = [f'  c{k}: "{row} = 0"\n' for k, row in enumerate(rows)]
        file = (
            "coordinates: [x, y, u, w]\nparameters: [m, g]\n"
            "T: m*(x'^2 + y'^2 + u'^2 + w'^2)/2\nV: m*g*x\nconstraints:\n" + "".join(lines)
        )
        reason = model_section(loads(file)).reason
        assert "follows" in reason["c2"], file
        assert "velocities" in reason["c3"], file


def test_what_a_definition_is_made_of_has_the_influence_of_the_definition():
    """Derived with a definition of constants as a parameter, what it holds is not dropped."""
    source = random.Random("definition")
    for _ in range(4):
        name = source.choice(["s", "nu", "K"])
        formula = source.choice(["a*sin(b)", "a*b", "a - b", "a/b^2"])
        place = source.choice(["V: {}*x^2/2", "V: x^4\nforces: {{x: -{}*x'}}"])
        file = (
            f"coordinates: [x]\nparameters: [m, a, b, c]\ndefinitions: {{{name}: {formula}}}\n"
            f"T: m*x'^2/2\n{place.format(name)}\n"
        )
        section = solve(loads(file), ["model"]).sections["model"]
        assert section.dropped == ("c",), file


def test_coordinates_that_move_alone_are_named():
    reason = model_section(load("problems/rigid/rolling-race.yaml")).reason
    assert all("no other coordinate" in reason[f"theta{k}"] for k in (1, 2, 3))


def test_what_cannot_be_run_has_no_model():
    """A ray of light has no Lagrangian."""
    answers = state(
        Derivation(load("problems/hamiltonian/ray-of-light.yaml")), Request(sections=("model",))
    )
    assert "model" not in answers.sections
    assert not answers.complete
    assert any("model" in warning for warning in answers.warnings)
