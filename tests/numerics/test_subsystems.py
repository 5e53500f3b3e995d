"""Subsystems that move without each other take steps of their own where that pays."""

import math

import pytest

from lagcli.numerics.certified.model import model_section
from lagcli.numerics.equations.coupling import coupling, groups
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.pipeline import with_lagrangian
from tests.numerics.running import column, problem_of, simulated

#: A pendulum on its circle and a mass on a quick spring, written in turns.
TWO = """
coordinates: [x, u, y]
parameters: {g: {value: 9.81}, l: {value: 1}, w: {value: 300}}
T: (x'^2 + y'^2)/2 + u'^2/2
V: g*y + w^2*u^2/2
constraints:
  rod: x^2 + y^2 = l^2
initial: {x: 0.6, y: -0.8, x': 0.4, y': 0.3, u: 1}
"""
PENDULUM = """
coordinates: [x, y]
parameters: {g: {value: 9.81}, l: {value: 1}}
T: (x'^2 + y'^2)/2
V: g*y
constraints:
  rod: x^2 + y^2 = l^2
initial: {x: 0.6, y: -0.8, x': 0.4, y': 0.3}
"""
SHOWN = "x,u,y,x',u',y',lambda_rod"


def test_each_moves_as_it_does_by_itself():
    found = simulated(TWO, 40, show=SHOWN, samples=41)
    assert found.method == "taylor64"
    assert "steps of their own (x, y; u)" in found.reason
    assert found.certificate.reached
    alone = simulated(PENDULUM, 40, accuracy=1e-12, samples=41, show="x,y,lambda_rod")
    for name in ("x", "y", "lambda_rod"):
        bound = 1e-9 * max(1, *map(abs, column(alone, name)))
        assert column(found, name) == pytest.approx(column(alone, name), abs=bound, rel=0)
    quick = [(math.cos(300 * t), -300 * math.sin(300 * t)) for t in range(41)]
    assert column(found, "u") == pytest.approx([u for u, _ in quick], abs=1e-9, rel=0)
    assert column(found, "u'") == pytest.approx([v for _, v in quick], abs=300e-9, rel=0)


@pytest.mark.long
def test_the_certificate_holds_against_thirty_digits():
    found = simulated(TWO, 10, accuracy=1e-10, samples=11)
    exact = simulated(TWO, 10, accuracy=1e-20, samples=11, method="taylor128", whole=True)
    assert "steps of their own" in found.reason
    assert exact.certificate.reached
    for name in found.certificate.global_error:
        truth = column(exact, name)
        error = max(abs(a - b) for a, b in zip(column(found, name), truth, strict=True))
        assert error <= 1e-10 * max(1, *map(abs, truth))
    residual, rate = found.certificate.constraints["rod"]
    assert 0 < residual <= 1e-12
    assert 0 < rate <= 1e-12


def test_what_does_not_pay_is_not_done():
    assert "steps of their own" not in simulated(TWO, 1).reason  # too short
    slow = simulated(TWO, 40, settings=("w=3",))  # nothing is much quicker than the rest
    assert "steps of their own" not in slow.reason
    whole = simulated(TWO, 40, whole=True)
    assert "steps of their own" not in whole.reason


def test_the_model_tells_of_it():
    told = model_section(with_lagrangian(problem_of(TWO))).reason
    assert "its own steps" in told["u"]
    coupled = TWO.replace("w^2*u^2/2", "w^2*u^2/2 + x*u")
    assert "steps of its own" not in str(model_section(with_lagrangian(problem_of(coupled))).reason)


def test_a_part_that_ends_ends_the_whole():
    fall = TWO.replace("g*y", "-0.01/x").replace("rod: x^2 + y^2 = l^2", "rod: y = -0.8")
    found = simulated(fall.replace("x': 0.4, y': 0.3", "x': 0"), 40, samples=401, show="x,u")
    assert not found.certificate.reached
    # from rest at 0.6 by 0.01/x^2
    end = math.pi / 2 * math.sqrt(0.6**3 / 0.02)
    assert found.events[-1].name == "singularity"
    assert found.events[-1].t == pytest.approx(end, rel=1e-6)
    assert found.certificate.holds_until == pytest.approx(end, abs=0.2)


@pytest.mark.parametrize(
    ("kinetic", "potential", "constraint", "expected"),
    [
        ("a'^2 + b'^2 + c'^2", "a^2 + b^2 + c^2", "", [[0], [1], [2]]),
        ("a'^2 + b'^2 + c'^2 + a'*c'", "b^2", "", [[0, 2], [1]]),  # by the mass matrix
        ("a'^2*(2 + sin(b)) + c'^2", "b^2", "", [[0, 1], [2]]),  # by what it depends on
        ("a'^2 + b'^2 + c'^2", "a^2 + b*c", "", [[0], [1, 2]]),  # by a force
        ("a'^2 + b'^2 + c'^2", "a^2", "constraints: {k: a - c = 0}", [[0, 2], [1]]),
        ("a'^2 + b'^2 + c'^2", "a*b + b*c", "", [[0, 1, 2]]),
    ],
)
def test_what_is_coupled_moves_together(kinetic, potential, constraint, expected):
    text = f"coordinates: [a, b, c]\nT: {kinetic}\nV: {potential}\n{constraint}\n"
    e = EquationsOfMotion(with_lagrangian(problem_of(text)))
    assert groups(*coupling(e.graph, e.q, e.mass, e.forcing, e.constraints)) == expected
