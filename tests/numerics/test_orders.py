"""The orders of the implicit and symplectic methods, and what they are for."""

import math

import pytest

from lagcli.numerics.certified.methods import METHODS
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.jacobian import jacobian
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.integrators.collocation import gauss, radau
from lagcli.numerics.integrators.gauss8 import Gauss8
from lagcli.numerics.integrators.implicit import Stages
from lagcli.numerics.integrators.yoshida8 import Yoshida8, separates

from .running import ROOT, last, problem_of, simulated

# A circle: x = cos t, y = sin t
KEPLER = """
coordinates: [x, y]
L: (x'^2 + y'^2)/2 + (x^2 + y^2)^(-1/2)
initial: {x: 1, y: 0, x': 0, y': 1}
"""
CHAIN = (ROOT / "problems/chains/triple-pendulum.yaml").read_text()
#: x'' + c x' + k x = 0, of which the fast part dies in a time 1/c
DAMPED = """
coordinates: [x]
parameters: {c: 1e6, k: 1e6}
T: x'^2/2
V: k*x^2/2
dissipation: c*x'^2/2
initial: {x: 1}
"""


def motion_of(text):
    return Motion(EquationsOfMotion(problem_of(text)), {}, Doubles())


def error(change, steps, until=2.0):
    q, v, h = [1.0, 0.0], [0.0, 1.0], until / steps
    for k in range(steps):
        by = change(k * h, h, q, v)
        q, v = (
            [x + d for x, d in zip(q, by[:2], strict=False)],
            [x + d for x, d in zip(v, by[2:], strict=False)],
        )
    return math.dist(
        (*q, *v), (math.cos(until), math.sin(until), -math.sin(until), math.cos(until))
    )


def collocation(method):
    stages = Stages(motion_of(KEPLER), method)

    def change(t, h, q, v):
        stages.linearize(t, q, v)
        guess = [list(stages.motion.accelerations(t, *q, *v))] * method.size
        return stages.changes(h, v, stages.solve(t, h, q, v, guess, [1.0] * 4, 1e-16))

    return change


METHODS_OF_ONE_STEP = {
    "radau 3": (lambda: collocation(radau(2)), 3, 20),
    "radau5": (lambda: collocation(radau(3)), 5, 10),
    "gauss 4": (lambda: collocation(gauss(2)), 4, 10),
    "gauss8": (lambda: Gauss8(None, Stages(motion_of(KEPLER), gauss(4)), []).change, 8, 4),
    "yoshida8": (lambda: Yoshida8(motion_of(KEPLER), None, []).change, 8, 16),
}


@pytest.mark.parametrize("name", METHODS_OF_ONE_STEP)
def test_the_order_is_the_one_that_is_said(name):
    make, order, steps = METHODS_OF_ONE_STEP[name]
    coarse, fine = error(make(), steps), error(make(), 2 * steps)
    assert math.log2(coarse / fine) == pytest.approx(order, abs=0.35)
    if name in METHODS:
        assert METHODS[name].order == order


def test_the_coefficients_are_the_book_s():
    """Hairer, Wanner II, table IV.5.6, Radau IIA of order 5; table IV.5.2, Gauss of order 4."""
    root, method = math.sqrt(6), radau(3)
    assert method.nodes == pytest.approx([(4 - root) / 10, (4 + root) / 10, 1], abs=1e-16)
    assert method.a[0] == pytest.approx(
        [(88 - 7 * root) / 360, (296 - 169 * root) / 1800, (-2 + 3 * root) / 225], abs=1e-16
    )
    assert method.weights == pytest.approx([(16 - root) / 36, (16 + root) / 36, 1 / 9], abs=1e-16)
    assert gauss(2).a[0] == pytest.approx([1 / 4, 1 / 4 - math.sqrt(3) / 6], abs=1e-16)


def test_the_jacobian_is_the_slope():
    problem = problem_of(CHAIN)
    equations = EquationsOfMotion(problem)
    symbols = {
        equations.graph.symbol(p.name): 1.0 + 0.1 * k for k, p in enumerate(problem.parameters)
    }
    motion = Motion(equations, symbols, Doubles())
    state = [0.3, 0.4, -0.7, 1.1, 0.5, -0.2, 0.8][: 1 + 2 * motion.n]
    by_q, by_v = jacobian(motion)(*state)
    for j in range(2 * motion.n):
        step = 1e-6
        above, below = (
            motion.accelerations(*state[: j + 1], state[j + 1] + s, *state[j + 2 :])
            for s in (step, -step)
        )
        for i, (a, b) in enumerate(zip(above, below, strict=False)):
            exact = (by_q if j < motion.n else by_v)[i][j % motion.n]
            assert (a - b) / (2 * step) == pytest.approx(exact, rel=1e-6, abs=1e-7)


def damped(t, c=1e6, k=1e6):
    root = math.sqrt(c * c / 4 - k)
    slow, fast = -k / (c / 2 + root), -(c / 2 + root)
    return (fast * math.exp(slow * t) - slow * math.exp(fast * t)) / (fast - slow)


@pytest.mark.long
@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9])
def test_what_is_stiff_is_left_to_the_stiff_method(accuracy):
    found = simulated(DAMPED, 10, accuracy)
    assert found.method == "radau5"
    assert found.certificate.reached
    assert abs(last(found, "x") - damped(10)) <= accuracy
    assert found.steps < 2000  # an explicit one needs more than 10 * 1e6 / 6


def test_what_oscillates_is_not_stiff():
    text = "{coordinates: [x], L: x'^2/2 - 1e10*x^2/2, initial: {x: 1}}"
    found = simulated(text, 0.01, 1e-6)
    assert found.method != "radau5"
    assert last(found, "x") == pytest.approx(math.cos(1e3), abs=1e-6)


@pytest.mark.long
def test_no_exact_derivatives_where_nothing_dies_away_quickly(monkeypatch):
    """Those of ten coordinates cost more than the motion; friction of 2 is far from 1e5."""
    from lagcli.numerics.certified import stiffness

    asked = []
    monkeypatch.setattr(
        stiffness, "jacobian", lambda motion: asked.append(motion) or jacobian(motion)
    )
    text = "{{coordinates: [x], L: x'^2/2 - x^2/2, forces: {{x: -{}*x'}}, initial: {{x: 1}}}}"
    assert simulated(text.format(2), 5, 1e-6).method != "radau5"
    assert not asked
    assert simulated(text.format("10^6"), 5, 1e-6).method == "radau5"
    assert len(asked) == 1


@pytest.mark.first_quick
@pytest.mark.parametrize("method", ["radau5", "gauss8", "yoshida8"])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-8])
def test_certified_against_the_exact_motion(method, accuracy):
    found = simulated(KEPLER, 6, accuracy, method=method)
    assert found.method == method
    assert found.certificate.reached
    assert last(found, "x") == pytest.approx(math.cos(6), abs=accuracy)
    assert last(found, "y'") == pytest.approx(math.cos(6), abs=accuracy)


@pytest.mark.long
@pytest.mark.parametrize("method", ["radau5", "gauss8"])
def test_constraints_are_held(method):
    text = (ROOT / "problems/pendulums/pendulum-cartesian.yaml").read_text()
    true = simulated(text, 3, 1e-12, method="taylor")
    found = simulated(text, 3, 1e-6, method=method)
    assert found.method == method
    assert found.rows[-1] == pytest.approx(true.rows[-1], abs=1e-6)
    assert max(found.certificate.constraints["rod"]) <= 1e-13


def test_what_does_not_separate_says_so():
    magnetic = "{coordinates: [x, y], L: x'^2/2 + y'^2/2 + x*y', initial: {x: 1, y: 0}}"
    assert not separates(EquationsOfMotion(problem_of(magnetic)))
    assert separates(EquationsOfMotion(problem_of(KEPLER)))
    found = simulated(magnetic, 1, 1e-6, method="yoshida8")
    assert found.method == "dop853"
    assert "not yoshida8: it does not separate" in found.reason


@pytest.mark.long
def test_a_short_push_is_not_stepped_over():
    """exp(-((t - 5)/0.02)^2): found, or told, and never passed in silence."""
    text = "{coordinates: [x], T: x'^2/2, forces: {x: exp(-((t - 5)/0.02)^2)}}"
    for method in ("radau5", "gauss8", "yoshida8"):
        found = simulated(text, 10, 1e-6, method=method)
        speed = 0.02 * math.sqrt(math.pi)
        if found.certificate.reached:
            assert last(found, "x'") == pytest.approx(speed, abs=1e-6)
        else:
            assert found.refusal
