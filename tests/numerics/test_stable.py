"""Stable forms: equal as mathematics, and right in doubles where the plain form is not."""

import math

import mpmath
import pytest

from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.stable import Stable, stable_dynamics
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.straight_line import straight_line

from .running import problem_of

EXACT = mpmath.mp.clone()
EXACT.dps = 60
CASES = {
    "1 - cos(x)": lambda x: 1 - EXACT.cos(x),
    "1 + cos(x)": lambda x: 1 + EXACT.cos(x),
    "3*x*cos(x) - 3*x": lambda x: 3 * x * (EXACT.cos(x) - 1),
    "y - y*cos(x) + x^2": lambda x: 2 * (1 - EXACT.cos(x)) + x**2,
    "cosh(x) - 1": lambda x: EXACT.cosh(x) - 1,
    "exp(x) - 1": lambda x: EXACT.exp(x) - 1,
    "sqrt(1 + x^2) - 1": lambda x: EXACT.sqrt(1 + x**2) - 1,
    "1/sqrt(1 - x^2) - 1": lambda x: 1 / EXACT.sqrt(1 - x**2) - 1,
    "y*sqrt(1 + x)/2 - y/2": lambda x: EXACT.sqrt(1 + x) - 1,
    "1 - cos(x)^2": lambda x: EXACT.sin(x) ** 2,
    "y*cosh(x)^2 - y": lambda x: 2 * EXACT.sinh(x) ** 2,
    "3 + y*cos(x)^2 - y - 3*exp(x)": lambda x: 3 - 3 * EXACT.exp(x) - 2 * EXACT.sin(x) ** 2,
    "cos(1 + x) - cos(1)": lambda x: -2 * EXACT.sin(1 + x / 2) * EXACT.sin(x / 2),
    "y*sin(1 + x) - y*sin(1)": lambda x: 4 * EXACT.cos(1 + x / 2) * EXACT.sin(x / 2),
}


def values(formula, *, stable):
    """f(x) for y = 2, in doubles."""
    problem = problem_of(f"{{coordinates: [x, y], T: x'^2/2 + y'^2/2, V: {formula}}}")
    graph = Graph()
    node = GraphReader(graph, ("x", "y"), {})(problem.potential)
    node = Stable(graph)(node) if stable else node
    function = straight_line([graph.symbol("x"), graph.symbol("y")], [node], {}, Doubles())
    return lambda x: function(x, 2.0)[0]


@pytest.mark.parametrize("formula", CASES)
@pytest.mark.parametrize("x", [1e-9, 1e-4, 0.3, -0.7])
def test_the_stable_form_keeps_its_digits(formula, x):
    assert values(formula, stable=True)(x) == pytest.approx(
        float(CASES[formula](EXACT.mpf(x))), rel=2e-15, abs=0
    )


@pytest.mark.parametrize("formula", ["1 - x^2", "y^2*x^2 - y^2", "1 - x^2/(2*y)^2*16"])
@pytest.mark.parametrize("x", [1 - 1e-7, -1 + 1e-6])
def test_a_difference_of_squares_keeps_its_digits(formula, x):
    """Each is c (1 - x^2), next to 0."""
    c = -4 if formula[0] == "y" else 1
    exact = float(c * (1 - EXACT.mpf(x) ** 2))
    assert values(formula, stable=True)(x) == pytest.approx(exact, rel=1e-15, abs=0)
    plain = values("1 - x^2", stable=False)(x)
    assert plain != pytest.approx(float(1 - EXACT.mpf(x) ** 2), rel=1e-11, abs=0)


@pytest.mark.parametrize("formula", ["1 - cos(x)", "1/sqrt(1 - x^2) - 1", "cosh(x) - 1"])
def test_the_plain_form_does_not(formula):
    exact = float(CASES[formula](EXACT.mpf(1e-9)))
    assert math.isclose(values(formula, stable=False)(1e-9), 0.0, abs_tol=0.0)
    assert exact > 4e-19


POLE = """
coordinates: [p, f]
L: (p'^2 + (1 - cos(p)^2)*f'^2)/2 + cos(p)
"""


def accelerations(text, *state):
    equations = EquationsOfMotion(problem_of(text))
    nodes = [*(entry for row in equations.mass for entry in row), *equations.forcing]
    motion = Motion(equations, constants_of(equations, nodes, Doubles()), Doubles())
    return motion.accelerations(0.0, *state)


def test_accelerations_near_a_cancellation_keep_their_digits(monkeypatch):
    """Beside the pole of a sphere: f'' = -2 p' f'/tan(p), to 50 digits; 1 - cos^2 p is 1e-12."""
    state = p, _, p_rate, f_rate = 1e-6, 0.25, 0.5, 0.75
    true = -2 * EXACT.mpf(p_rate) * EXACT.mpf(f_rate) / EXACT.tan(EXACT.mpf(p))
    assert abs(accelerations(POLE, *state)[1] / true - 1) < 1e-15
    monkeypatch.setattr(
        "lagcli.numerics.equations.equations.stable_dynamics", lambda *given: given[1]
    )
    assert abs(accelerations(POLE, *state)[1] / true - 1) > 1e-6


@pytest.mark.parametrize(
    ("formula", "rewritten"),
    [("1 - cos(x)^2", True), ("sin(x) + 1 - cos(x)", False), ("abs(1 - cos(x)^2)", False)],
)
def test_the_dynamics_grow_no_longer_and_kinks_stay(formula, rewritten):
    """sin^2 x is shorter; 2 sin^2(x/2) beside sin x asks for another function."""
    problem = problem_of(f"{{coordinates: [x, y], T: x'^2/2 + y'^2/2, V: {formula}}}")
    graph = Graph()
    node = GraphReader(graph, ("x", "y"), {})(problem.potential)
    assert (stable_dynamics(graph, [node]) != [node]) == rewritten
