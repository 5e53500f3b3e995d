"""Chains, linkages and their Hamiltonians in closed form with abbreviations.

What is printed is evaluated name by name and compared with the linear system of Lagrange's
equations, solved in numbers.
"""

from __future__ import annotations

import random
from functools import cache

import pytest

from lagcli.expression import Name, walk
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.values import Floats, Program
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.pipeline import Request, derive, read, state

SECTIONS = ("accelerations", "multipliers", "hamiltonian")


def chain(n, *, cart=False):
    """n links of general masses and lengths, their masses at the ends (Landau and Lifshitz, § 5)."""
    links = range(1, n + 1)
    lines = ["coordinates: [" + ", ".join(["X"] * cart + [f"theta{k}" for k in links]) + "]"]
    names = ["M"] * cart + [f"{letter}{k}" for letter in "ml" for k in links] + ["g"]
    lines.append("parameters: {" + ", ".join(f"{name}: {{assume: positive}}" for name in names))
    lines[-1] += "}\npoints:"
    if cart:
        lines.append("  cart: {position: [X], mass: M}")
    heights = []
    for k in links:
        x = " + ".join(["X"] * cart + [f"l{j}*sin(theta{j})" for j in range(1, k + 1)])
        y = " + ".join(f"l{j}*cos(theta{j})" for j in range(1, k + 1))
        lines.append(f"  b{k}: {{position: [{x}, -({y})], mass: m{k}}}")
        heights.append(f"m{k}*g*({y})")
    return "\n".join(["title: chain", *lines, f"V: -({' + '.join(heights)})\n"])


SPACE = """
title: Double pendulum in space
coordinates: [theta1, phi1, theta2, phi2]
parameters: {m1: {assume: positive}, m2: {assume: positive}, l1: {assume: positive}, l2: {assume: positive}, g: }
definitions: {z1: l1*cos(theta1)}
points:
  p1: {position: [l1*sin(theta1)*cos(phi1), l1*sin(theta1)*sin(phi1), -z1], mass: m1}
  p2: {position: [l1*sin(theta1)*cos(phi1) + l2*sin(theta2)*cos(phi2), l1*sin(theta1)*sin(phi1) + l2*sin(theta2)*sin(phi2), -z1 - l2*cos(theta2)], mass: m2}
V: -m1*g*z1 - m2*g*(z1 + l2*cos(theta2))
"""
FOUR_BARS = """
title: Four-bar linkage
coordinates: [alpha, beta, gamma]
parameters: [m1, m2, m3, a, b, c, d, g]
T: m1*a^2*alpha'^2/6 + m3*c^2*gamma'^2/6 + m2*(a^2*alpha'^2 + a*b*alpha'*beta'*cos(alpha - beta) + b^2*beta'^2/3)/2
V: m1*g*a*sin(alpha)/2 + m2*g*(a*sin(alpha) + b*sin(beta)/2) + m3*g*c*sin(gamma)/2
constraints:
  horizontal: a*cos(alpha) + b*cos(beta) = d + c*cos(gamma)
  vertical: a*sin(alpha) + b*sin(beta) = c*sin(gamma)
"""
MOVING_PIVOT = """
title: Cartesian double pendulum on a moving pivot
coordinates: [x0, x1, y1, x2, y2]
parameters: [M, m1, m2, l1, l2, g]
T: M*x0'^2/2 + m1*(x1'^2 + y1'^2)/2 + m2*(x2'^2 + y2'^2)/2
V: m1*g*y1 + m2*g*y2
constraints:
  rod1: (x1 - x0)^2 + y1^2 = l1^2
  rod2: (x2 - x1)^2 + (y2 - y1)^2 = l2^2
"""
# a length u1, an angle y and a mass a2 keep their names
LETTERS = chain(4).replace("l1", "u1").replace("m2", "a2").replace("m4", "k1")
SYSTEMS = {
    "4 links": LETTERS,
    **{f"{n} links": chain(n) for n in (5, 6)},
    **{f"{n} links on a cart": chain(n, cart=True) for n in (4, 5, 6)},
    "double pendulum in space": SPACE,
}


@cache
def answers(text, *, expand=False):
    problem = read("test.yaml", text.encode()).problem
    return problem, state(derive(problem), Request(sections=SECTIONS, expand=expand))


def values(problem, found, at):
    """The printed formulas at a state, one abbreviation after another."""
    names = tuple(q.name for q in problem.coordinates)
    known = dict(at)

    def value(tree):
        graph = Graph()
        node = GraphReader(graph, names, problem.definitions)(tree)
        return Program([node], Floats())(known)[0]

    for name, tree in found.where.items():
        known[name] = value(tree)
    accelerations = found.sections["accelerations"].accelerations
    return [value(accelerations[q]) for q in names], value(
        found.sections["hamiltonian"].hamiltonian
    )


def solved(form, at):
    """q'' of M q'' = forcing, and H = q' M q'/2 + V at p = M q', by elimination in doubles."""
    n = len(form.q)
    flat = Program([*(e for row in form.mass_matrix for e in row), *form.forcing], Floats())(at)
    rows = [[*flat[i * n : (i + 1) * n], flat[n * n + i]] for i in range(n)]
    matrix = [row[:n] for row in rows]
    for i in range(n):
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(n):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i], strict=True)]
    return [row[n] for row in rows], matrix


def only_earlier_abbreviations(problem, found):
    """Each uses those before it and names of the file, of which it takes none."""
    given = {q.name for q in (*problem.coordinates, *problem.parameters)} | {*problem.definitions}
    momenta = {f"p_{q.name}" for q in problem.coordinates}
    known: set[str] = set()
    for label, tree in found.where.items():
        used = {part.name for part in walk(tree) if isinstance(part, Name)}
        assert used <= given | known | momenta
        known.add(label)
    assert not known & given


@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_motion_and_the_hamiltonian_have_a_closed_form(name):
    problem, found = answers(SYSTEMS[name])
    assert found.complete
    assert found.where
    only_earlier_abbreviations(problem, found)
    source = random.Random(name)
    form = MatrixForm(problem)
    at = {p.name: source.uniform(0.5, 1.5) for p in problem.parameters}
    at |= {
        f"{q.name}{prime}": source.uniform(-1, 1)
        for q in problem.coordinates
        for prime in ("", "'")
    }
    expected, matrix = solved(form, at)
    velocities = [at[f"{q.name}'"] for q in problem.coordinates]
    momenta = [sum(m * v for m, v in zip(row, velocities, strict=True)) for row in matrix]
    at |= {f"p_{q.name}": p for q, p in zip(problem.coordinates, momenta, strict=True)}
    accelerations, hamiltonian = values(problem, found, at)
    assert accelerations == pytest.approx(expected, rel=1e-6)
    kinetic = sum(p * v for p, v in zip(momenta, velocities, strict=True)) / 2
    graph_potential = Program([form.potential], Floats())(at)[0]
    assert hamiltonian == pytest.approx(kinetic + graph_potential, rel=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("text", [FOUR_BARS, MOVING_PIVOT])
def test_linkages_have_their_accelerations_and_multipliers(text):
    problem, found = answers(text)
    assert found.complete
    assert set(found.sections["accelerations"].accelerations) == {
        q.name for q in problem.coordinates
    }
    assert all(m.value is not None for m in found.sections["multipliers"].multipliers.values())


@pytest.mark.long
def test_a_letter_of_the_file_is_not_taken():
    _, found = answers(LETTERS)
    assert found.complete
    assert not {"u1", "a2", "k1"} & set(found.where)


@pytest.mark.long
def test_expand_writes_the_abbreviations_out():
    problem, short = answers(LETTERS)
    _, long = answers(LETTERS, expand=True)
    assert not long.where
    at = {p.name: 1.25 for p in problem.parameters}
    source = random.Random("expand")
    for q in problem.coordinates:
        at |= {n: source.uniform(-1, 1) for n in (q.name, f"{q.name}'", f"p_{q.name}")}
    for one, other in zip(values(problem, short, at), values(problem, long, at), strict=True):
        assert one == pytest.approx(other, rel=1e-9)


def test_more_than_a_page_stays_in_matrix_form():
    problem = read("test.yaml", chain(9).encode()).problem
    found = state(derive(problem), Request(sections=("accelerations",)))
    assert found.sections["accelerations"].accelerations is None
    assert "matrix_form" in " ".join(found.warnings)
