"""The matrix form from the structure, against textbooks, SymPy's route and differences.

References: the planar chain's mass matrix M_ij = sum_{k >= max(i, j)} m_k l_i l_j cos(q_i - q_j)
(Goldstein, Poole, Safko, 3rd ed., exercise 1.22 for n = 2; any n by adding the links' velocities).
"""

import json
import math
import random
import subprocess
import sys
from fractions import Fraction

import pytest
import sympy

from lagcli.algebra.numeric import Evaluator
from lagcli.formatters.built_in.json import to_object
from lagcli.formatters.grammar import to_grammar
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.values import Floats, Program
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.extent import large_form
from lagcli.mechanics.large_statements import LargeStatements
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.pipeline import Request, derive, state
from lagcli.reader import parse_text, read_problem

from .chains import STYLES, cartesian, chain, closed

TOP = """
coordinates: [phi, theta, psi]
parameters: [I1, I3, m, g, h]
T: I1*(theta'^2 + phi'^2*sin(theta)^2)/2 + I3*(psi' + phi'*cos(theta))^2/2
V: m*g*h*cos(theta)
"""
#: everything at once: moving point, mass that changes, friction of a definition, both forces
MIXED = """
coordinates: [x, a, b]
parameters: [m, l, k, w]
functions: {U: [r]}
definitions:
  X: x + l*sin(a)*cos(w*t)
  Y: l*cos(a)*b^2
  v2: X'^2 + Y'^2
points:
  P: {position: [X, Y, x*b], mass: m, force: [k*Y, -x', t]}
T: m*(1 + b^2)*v2/2 + k*x'*b'*sin(a) + exp(b)*b'^4/4
V: U(X) + k*Y*x^2 + diff(sin(a)*Y, a)
dissipation: k*(X'^2 + b'^2)/2
forces: {b: -k*b}
constraints:
  c1: X*Y = b
  c2: x'*sin(b) + a'*t = b'*x
"""


def problem(text):
    return read_problem("test.yaml", text.encode()).checked()


def point(text, seed=1):
    given = problem(text)
    source = random.Random(seed)
    values = {"t": 0.4}
    for quantity in (*given.parameters, *given.coordinates):
        values[quantity.name] = source.uniform(0.4, 1.4)
    for q in given.coordinates:
        values[q.name + "'"] = source.uniform(-1, 1)
    return values


def numbers(form, nodes, values):
    return Program(list(nodes), Floats(), form.functions)(values)


def by_algebra(text, values):
    """The same entries by SymPy, from the Lagrangian written out."""
    dynamics = Derivation(problem(text)).dynamics
    system, lagrange = dynamics.system, dynamics.lagrange
    momenta = [system.L.diff(v) for v in system.qdot]
    still = dict.fromkeys(system.qddot, 0)
    mass = [p.diff(v) for p in momenta for v in system.qdot]
    forcing = [
        applied + system.L.diff(q) - system.total_derivative(p).xreplace(still)
        for applied, q, p in zip(system.applied_forces, system.q, momenta, strict=True)
    ]
    rows = [x for e in dynamics.constraints.equations for x in e.row]
    bias = [e.bias for e in dynamics.constraints.equations]
    assert lagrange.system is system
    found = Evaluator([*mass, *forcing, *rows, *bias])
    named = {s: values[s.name] for s in (system.t, *system.q, *system.qdot, *system.parameters)}
    return [float(x) for x in found(named)]


@pytest.mark.parametrize("combine", [True, False])
@pytest.mark.parametrize(
    "text",
    [
        *(chain(n, style) for style in STYLES for n in (3, 4)),
        *(closed(4, style) for style in ("points", "definitions")),
        cartesian(3),
        TOP,
        MIXED,
    ],
)
def test_entries_are_those_of_the_expanded_lagrangian(text, combine):
    form = MatrixForm(problem(text), combine_angles=combine)
    values = point(text)
    assert numbers(form, form.entries, values) == pytest.approx(
        by_algebra(text, values), rel=1e-11, abs=1e-11
    )


@pytest.mark.parametrize("style", STYLES)
def test_the_mass_matrix_of_a_chain_reads_as_in_the_textbook(style):
    n = 7
    section = state(derive(problem(chain(n, style))), Request(sections=("matrix_form",)))
    matrix = to_object(section)["matrix_form"]
    form = MatrixForm(problem(chain(n, style)))
    values = point(chain(n, style))
    shared = {}
    for name, formula in matrix["shared"].items():
        shared[name] = value_of(form, formula, values | shared)
    for i in range(n):
        for j in range(n):
            got = value_of(form, matrix["mass_matrix"][i][j], values | shared)
            links = sum(values[f"m{k + 1}"] for k in range(max(i, j), n))
            expected = links * values[f"l{i + 1}"] * values[f"l{j + 1}"]
            expected *= math.cos(values[f"q{i + 1}"] - values[f"q{j + 1}"])
            assert got == pytest.approx(expected, rel=1e-12)
    assert "cos(q1 - q2)" in matrix["mass_matrix"][0][1]
    assert "cos" not in matrix["mass_matrix"][0][0]  # cos^2 + sin^2 = 1


def value_of(form, formula, values):
    """A formula that has been printed, read again."""
    reader = GraphReader(form.graph, (), {})
    return Program([reader(parse_text(formula))], Floats())(values)[0]


def test_shared_names_come_in_order_of_use_and_avoid_those_of_the_file():
    text = chain(8, "definitions").replace("g]", "g, s7]").replace("l1*sin", "s7*l1*sin")
    matrix = to_object(state(derive(problem(text)), Request(sections=("matrix_form",))))[
        "matrix_form"
    ]
    names = list(matrix["shared"])
    assert names == [f"shared{k}" for k in range(1, len(names) + 1)]
    seen = set()
    for name, formula in matrix["shared"].items():
        used = {str(s) for s in sympy.sympify(formula.replace("'", "_p")).free_symbols}
        assert {u for u in used if u.startswith("shared")} <= seen
        seen.add(name)


@pytest.mark.parametrize("text", [closed(8, "definitions"), cartesian(4), MIXED])
def test_constraint_rows_are_the_slopes_of_the_constraints(text):
    form = MatrixForm(problem(text))
    values = point(text)
    names = [q.name for q in form.q]
    for row in form.constraints:
        variables = names if row.holonomic else [name + "'" for name in names]
        slopes = [central(form, row.f, values, name) for name in variables]
        assert numbers(form, row.row, values) == pytest.approx(slopes, abs=1e-7)
        # d/dt of a . q' + b along q' with q'' = 0
        h = 1e-5
        moved = [
            sum(a * values[name + "'"] for a, name in zip(entries, names, strict=True)) + drift
            for step in (h, -h)
            for later in [values | {n: values[n] + step * values[n + "'"] for n in names}]
            for *entries, drift in [
                numbers(form, [*row.row, row.drift], later | {"t": values["t"] + step})
            ]
        ]
        expected = (moved[0] - moved[1]) / (2 * h)
        assert numbers(form, [row.bias], values) == pytest.approx([expected], abs=1e-7)


def central(form, node, values, name, h=1e-5):
    """A central difference."""
    ahead, behind = (
        numbers(form, [node], values | {name: values[name] + step})[0] for step in (h, -h)
    )
    return (ahead - behind) / (2 * h)


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        (closed(8, "points"), 6),
        (cartesian(10), 10),
        (cartesian(10).replace("  rod1:", "  again: 3*(x1^2 + y1^2) = 3*l1^2\n  rod1:"), 10),
        (chain(8, "points"), 8),
    ],
)
def test_degrees_of_freedom(text, degrees):
    assert MatrixForm(problem(text)).degrees_of_freedom == degrees


def test_a_small_system_is_not_large_and_a_chain_of_eight_is():
    assert large_form(problem(TOP)) is None
    assert large_form(problem(chain(4, "points"))) is None
    assert large_form(problem(chain(8, "points"))) is not None


@pytest.mark.long
def test_contradictory_constraints_are_left_to_the_algebra_which_names_them():
    text = cartesian(14).replace("  rod1:", "  other: x1^2 + y1^2 = 2*l1^2\n  rod1:")
    assert large_form(problem(text)) is None


def test_the_sections_of_a_large_system_agree_with_the_algebra():
    """A chain of four, small enough for both ways."""
    text = chain(4, "definitions")
    large = LargeStatements(MatrixForm(problem(text))).answers(("lagrangian", "momenta", "energy"))
    small = Derivation(problem(text))
    system = small.system
    expected = [system.L, *small.dynamics.lagrange.momenta, small.energy.readable_function]
    shown = to_object(large)
    found = [shown["lagrangian"], *shown["momenta"].values(), shown["energy"]["function"]]
    values = point(text)
    named = {s: values[s.name] for s in (*system.q, *system.qdot, *system.parameters)}
    form = MatrixForm(problem(text))
    assert [value_of(form, formula, values) for formula in found] == pytest.approx(
        [float(x) for x in Evaluator(expected)(named)]
    )
    assert shown["energy"]["conserved"] is True
    assert shown["energy"]["is_total_energy"] is True


def test_the_equations_of_a_large_system_hold():
    """left - right of each equation is M q'' - forcing - A^T lambda."""
    text = closed(8, "definitions")
    form = MatrixForm(problem(text))
    section = LargeStatements(form).answers(("equations",)).sections["equations"]
    values = point(text)
    source = random.Random(3)
    values |= {q.name + "''": source.uniform(-1, 1) for q in form.q}
    values |= {c.multiplier: source.uniform(-1, 1) for c in form.problem.constraints}
    for i, equation in enumerate(section.equations):
        sides = [value_of(form, to_grammar(e), values) for e in (equation.left, equation.right)]
        row = numbers(form, [*form.mass_matrix[i], form.forcing[i]], values)
        inertia = sum(m * values[q.name + "''"] for m, q in zip(row, form.q, strict=False))
        reaction = sum(
            numbers(form, [r.row[i]], values)[0] * values[c.multiplier]
            for r, c in zip(form.constraints, form.problem.constraints, strict=True)
        )
        assert sides[0] - sides[1] == pytest.approx(inertia - row[-1] - reaction)


@pytest.mark.long
def test_usual_sections_of_a_large_system_are_null_where_not_found_and_say_so():
    shown = to_object(state(derive(problem(cartesian(20))), Request()))
    assert shown["accelerations"] is None
    assert any("matrix_form" in warning for warning in shown["warnings"])
    assert shown["degrees_of_freedom"] == 20
    assert shown["energy"]["conserved"] is True
    assert len(shown["equations"]) == 40


@pytest.mark.long
def test_matrix_form_of_a_large_system_needs_no_sympy(tmp_path):
    path = tmp_path / "chain.yaml"
    path.write_text(chain(12, "points"))
    code = (
        "import sys; from lagcli.pipeline import *\n"
        f"found = read('chain.yaml', open({str(path)!r}, 'rb').read())\n"
        "request = Request(sections=('matrix_form',))\n"
        "from lagcli.formatters import Options\n"
        "print(render([state(derive(found.problem), request)], 'json', Options()))\n"
        "assert 'sympy' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["degrees_of_freedom"] == 12


def test_a_sign_moves_out_of_a_difference_within_a_difference():
    """sin(-(b - a)) = sin(a - b), however the minus came there."""
    graph = Graph()
    a, b = graph.symbol("a"), graph.symbol("b")
    turned = graph.scaled(graph.difference(b, a), -1)
    assert graph.call("sin", (turned,)) is graph.call("sin", (graph.difference(a, b),))
    assert graph.call("cos", (turned,)) is graph.call("cos", (graph.difference(b, a),))


def test_products_of_products_keep_every_factor():
    """Random products, one in another: their value is the product of the values.

    A product that is taken apart may bring more of another one that stands beside it.
    """
    choose = random.Random(16)
    for _ in range(60):
        graph = Graph()
        symbols = [graph.symbol(name) for name in "abc"]
        values = {node: 1.0 + choose.random() for node in symbols}
        for _ in range(8):
            pairs = [
                (choose.choice(list(values)), Fraction(choose.choice([-2, -1, 1, 2])))
                for _ in range(choose.randint(1, 4))
            ]
            node = graph.monomial(pairs)
            expected = math.prod(values[base] ** float(power) for base, power in pairs)
            found = straight_line(symbols, [node], {}, Doubles())(*(values[s] for s in symbols))
            assert found[0] == pytest.approx(expected, rel=1e-9)
            values[node] = expected
