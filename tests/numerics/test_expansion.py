"""Formulas multiplied out: shorter, and the same numbers."""

from __future__ import annotations

import random

import pytest

from lagcli.graph.expansion import Expansion
from lagcli.graph.nodes import Graph, ancestry
from lagcli.graph.reading import GraphReader
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.straight_line import straight_line

from .running import problem_of

LINK = (
    "{coordinates: [a], parameters: [l, m, g], V: -m*g*l*cos(a), "
    "points: {p: {position: [l*sin(a), -l*cos(a)], mass: m}}}"
)
FORMULAS = [
    "(x + y)*(x - y) - x^2",
    "cos(x)^3*y + sin(x)^2*cos(x)*y",
    "(1 - cos(x)^2)^2/(1 + y^2) + cos(x)^4/(1 + y^2)",
    "x*y*(x*(y*cos(y)^2) + x*y*sin(y)^2)",
    "cos(x)*cos(y)*x - y*sin(x)*cos(y) + x*sin(x)*sin(y) + y*cos(x)*sin(y)",
    "(cos(x)*cos(2*y) - sin(x)*sin(2*y))*sin(x)*cos(x) + 3*sin(y)*cos(2*y) + 3*cos(y)*sin(2*y)",
    "(x + 2*y + cos(x))^3 - sqrt(1 + x^2)*(x - 1/sqrt(1 + x^2))",
]


def test_a_link_made_of_a_point_has_a_constant_inertia_and_no_forces_of_its_turning():
    form = MatrixForm(problem_of(LINK), combine_angles=False)
    shorter, [[inertia]], [force] = Expansion(form.graph), form.mass_matrix, form.forcing
    assert inertia.mask & form.q[0].mask
    assert not shorter(inertia).mask & form.q[0].mask
    assert not shorter(force).mask & form.qdot[0].mask


def test_two_links_made_of_points_are_as_short_as_their_textbook_lagrangian():
    """m a'^2 + m b'^2/2 + m a' b' cos(a - b)"""
    points = "{p: {position: [sin(a), -cos(a)], mass: m}, r: {position: [sin(a) + sin(b), -cos(a) - cos(b)], mass: m}}"
    written = f"{{coordinates: [a, b], parameters: [m], points: {points}}}"
    textbook = "{coordinates: [a, b], parameters: [m], T: m*a'^2 + m*b'^2/2 + m*a'*b'*cos(a - b)}"
    sizes = []
    for text in (written, textbook):
        form = MatrixForm(problem_of(text), combine_angles=False)
        shorter = Expansion(form.graph)
        nodes = [shorter(x) for x in (*form.mass_matrix[0], *form.mass_matrix[1], *form.forcing)]
        sizes.append(len(ancestry(nodes)))
    assert sizes[0] == sizes[1]


@pytest.mark.parametrize("formula", FORMULAS)
def test_the_numbers_are_the_same(formula):
    problem = problem_of(f"{{coordinates: [x, y], T: x'^2/2 + y'^2/2, V: {formula}}}")
    graph = Graph()
    node = GraphReader(graph, ("x", "y"), {})(problem.potential)
    found = Expansion(graph)(node)
    assert len(ancestry([found])) <= len(ancestry([node]))
    values = straight_line([graph.symbol("x"), graph.symbol("y")], [node, found], {}, Doubles())
    draw = random.Random(1)
    for _ in range(20):
        before, after = values(draw.uniform(0.1, 2), draw.uniform(0.1, 2))
        assert after == pytest.approx(before, rel=1e-12, abs=1e-12)
