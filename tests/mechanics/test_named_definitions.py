"""Definitions of a file that its answers keep by name, and those that they cannot keep."""

from __future__ import annotations

import random

import pytest

from lagcli.document import Equations
from lagcli.expression import Expression, Name, walk
from lagcli.formatters import Options
from lagcli.formatters.grammar import to_grammar
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.values import Floats, Program
from lagcli.mechanics.named_definitions import NamedConstants, with_named_constants
from lagcli.pipeline import Request, derive, explain, read, render, state
from lagcli.reader import parse_text

# Goldstein, 3rd ed., sections 3.1 and 3.7: two bodies by their reduced mass
TWO_BODIES = """
coordinates: {r: {assume: positive}, phi: }
parameters: {m1: {assume: positive}, m2: {assume: positive}, G: {assume: positive}}
definitions: {mu: m1*m2/(m1 + m2), k: G*m1*m2}
T: mu*(r'^2 + r^2*phi'^2)/2
V: -k/r
"""
# Szebehely, Theory of Orbits, section 1.5
THREE_BODIES = """
coordinates: [x, y]
parameters: {mu: {assume: positive}}
definitions:
  r1: sqrt((x + mu)^2 + y^2)
  r2: sqrt((x - 1 + mu)^2 + y^2)
T: ((x' - y)^2 + (y' + x)^2)/2
V: -(1 - mu)/r1 - mu/r2
"""
# the same with its centre of mass: Landau and Lifshitz, Mechanics, 3rd ed., section 13
WITH_CENTRE = """
coordinates: {X: , Y: , r: {assume: positive}, phi: }
parameters: {m1: {assume: positive}, m2: {assume: positive}, k: {assume: positive}, b: }
definitions: {mu: m1*m2/(m1 + m2)}
T: (m1 + m2)*(X'^2 + Y'^2)/2 + mu*(r'^2 + r^2*phi'^2)/2
V: k*(r - b)^2/2
"""
# a charge beside a magnetic dipole: Stoermer
DIPOLE = """
coordinates: {rho: {assume: positive}, phi: , z: }
parameters: {m: {assume: positive}, e: {assume: positive}, mu: {assume: positive}}
definitions: {r: sqrt(rho^2 + z^2)}
L: m*(rho'^2 + rho^2*phi'^2 + z'^2)/2 + e*mu*rho^2*phi'/r^3
"""


def problem_of(text):
    found = read("file.yaml", ("title: t\n" + text).encode())
    assert found.problem is not None, found.diagnostics
    return found.problem


def answers_of(text, *sections, named=True):
    request = Request(sections=sections, named=named)
    return state(derive(problem_of(text), named=named), request)


def text_of(answers):
    return render([answers], "text", Options())


def test_a_reduced_mass_keeps_its_name():
    text = text_of(answers_of(TWO_BODIES, "lagrangian", "accelerations", "hamiltonian"))
    assert "μ = m₁ m₂/(m₁ + m₂)" in text
    assert "L = μ (ṙ² + r² φ̇²)/2 + k/r" in text
    assert "r̈ = r φ̇² − k/(μ r²)" in text
    assert "H = (p_r² + p_φ²/r²)/(2 μ) − k/r" in text
    assert "parameters m₁, m₂, G;" in text


@pytest.mark.long
def test_distances_keep_their_names():
    text = text_of(answers_of(THREE_BODIES, "lagrangian", "accelerations"))
    assert "+ (1 − μ)/r₁ + μ/r₂" in text
    assert "ẍ = 2 ẏ + x − μ (x − 1 + μ)/r₂³ − (1 − μ) (x + μ)/r₁³" in text
    assert text.count("√") == 2  # the definitions themselves


def test_a_reduced_mass_keeps_its_name_beside_the_masses():
    text = text_of(answers_of(WITH_CENTRE, "equations", "hamiltonian", "steady_motions"))
    assert "μ r̈ − μ r φ̇² + k (r − b) = 0" in text
    assert "(m₁ + m₂) Ẍ " in text
    assert "+ p_r²/(2 μ) + p_φ²/(2 μ r²)" in text
    assert "φ̇   = √(k (r − b)/(μ r))" in text
    assert "parameters m₁, m₂, k, b;" in text


@pytest.mark.parametrize("definition", ["m*n/(m + n)", "1/(1/m + 1/n)", "m^2*n/(m + 2*n)"])
@pytest.mark.parametrize("physics", ["T: mu*x'^2/2\nV: (m + n)*y*x", "T: m*x'^2/2\nV: y*x/mu^2",
                                     "T: n*x'^2/2\nV: -mu*cos(x/mu)/2 + m*y"])  # fmt: skip
def test_a_fraction_of_constants_keeps_its_name_with_its_value(definition, physics):
    """With the reciprocal and the square, and 3 m n/(m + n) at random points."""
    text = f"""
coordinates: [x]
parameters: {{m: {{assume: positive}}, n: {{assume: positive}}, y: {{assume: positive}}}}
definitions: {{mu: {definition}}}
{physics}
"""
    problem, chance = problem_of(text), random.Random(7)
    one, other = (
        answers_of(text, "lagrangian", named=named).sections["lagrangian"].lagrangian
        for named in (True, False)
    )
    assert "mu" in {part.name for part in walk(one) if isinstance(part, Name)}
    values = {name: chance.uniform(0.2, 0.9) for name in ("x", "x'", "m", "n", "y")}
    assert value(problem, one, values) == pytest.approx(value(problem, other, values))


def test_a_number_that_only_known_answers_use_is_written_out():
    """Of masses the name is kept: they are what the problem is about."""
    text = """
coordinates: [x]
parameters: {m: {assume: positive}, M: {assume: positive}, k: {assume: positive}}
definitions: {mu: m*M/(m + M), w: k*(m + M)/(m*M)}
T: m*M*x'^2/(2*(m + M))
V: k*x^2/2
expect: {modes: [sqrt(w)]}
"""
    told = text_of(answers_of(text, "lagrangian", "modes"))
    assert "L = μ ẋ²/2" in told
    assert "ω   = √(k/μ)" in told


def test_a_sum_of_constants_keeps_its_name():
    told = text_of(answers_of(WITH_CENTRE.replace("{mu:", "{M: m1 + m2, mu:"), "hamiltonian"))
    assert "H = (p_X² + p_Y²)/(2 M) + p_r²/(2 μ)" in told
    assert "M = m₁ + m₂" in told


REDUCED = """
coordinates: [x, y]
parameters: {m: {assume: SIGN}, n: {assume: positive}, k: {assume: positive}}
definitions: {mu: m*n/(m + n)}
T: mu*(x'^2 + y'^2)/2
V: k*x^2/2
"""


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        ("m*n*k/sqrt((m + n)*(3*(m + n)*x^2 + m*n*k*y^4))", "mu*k/sqrt(3*x^2 + mu*k*y^4)"),
        ("sqrt((m + n)*((m + n)*x - 2*m*n*k))/(m + n)", "sqrt(x - 2*mu*k)"),
        ("sqrt((m + n)^2*x - m*n*(m + n)*y + 3*m^2*n^2)/(m + n)", "sqrt(x - mu*y + 3*mu^2)"),
        # not of one degree, an odd power before it, and nothing with mu
        ("sqrt((m + n)*((m + n)*x + k))", None),
        ("sqrt((m + n)*x + m*n*k)", None),
        ("sqrt((m + n)*((m + n)*x + (m + n)*k))", None),
    ],
)
def test_a_sum_under_a_root_has_the_fraction_where_its_divisor_comes_out(formula, shown):
    problem, tree, chance = (
        problem_of(REDUCED.replace("SIGN", "positive")),
        parse_text(formula),
        random.Random(11),
    )
    written = NamedConstants(problem)(tree)
    for _ in range(3):
        values = {name: chance.uniform(0.2, 0.4) for name in ("m", "n", "k", "y")} | {"x": 2.0}
        assert value(problem, written, values) == pytest.approx(value(problem, tree, values))
    assert to_grammar(written) == (formula if shown is None else shown)


def test_a_divisor_of_unknown_sign_stays_under_the_root():
    formula = "sqrt((m + n)*((m + n)*x - 2*m*n*k))"
    for assume, shown in ("real", formula), ("positive", "(m + n)*sqrt(x - 2*mu*k)"):
        names = NamedConstants(problem_of(REDUCED.replace("SIGN", assume)))
        assert to_grammar(names(parse_text(formula))) == shown


@pytest.mark.parametrize("seed", range(4))
def test_random_sums_under_a_root_keep_their_values(seed):
    chance = random.Random(seed)
    problem = problem_of(REDUCED.replace("SIGN", "positive"))
    degree, outside = chance.randint(1, 3), chance.randint(0, 3)
    outside += (degree + outside) % 2
    terms = (
        "*".join((str(chance.randint(1, 9)), *["m*n"] * i, *["(m + n)"] * (degree - i), "x"))
        for i in range(degree + 1)
    )
    before = "(m + n)*" * outside
    tree = parse_text(f"x*m*n/sqrt({before}({' + '.join(terms)}))")
    written = NamedConstants(problem)(tree)
    assert "mu" in {part.name for part in walk(written) if isinstance(part, Name)}
    assert "m*n" not in to_grammar(written)
    values = {name: chance.uniform(0.2, 0.9) for name in ("x", "y", "m", "n", "k")}
    assert value(problem, written, values) == pytest.approx(value(problem, tree, values))


def test_even_powers_of_a_distance_have_its_name_too():
    text = text_of(answers_of(DIPOLE, "reduction"))
    assert text.count("ρ² + z²") == 1  # the definition itself
    assert "/(m r⁸)" in text


@pytest.mark.parametrize("text", [TWO_BODIES, THREE_BODIES, WITH_CENTRE, DIPOLE])
def test_the_values_are_those_of_what_is_written_out(text):
    """Both answers at random points, the definitions evaluated by the file's own reader."""
    problem, chance = problem_of(text), random.Random(5)
    pairs = zip(
        *(
            answers_of(text, "accelerations", named=named)
            .sections["accelerations"]
            .accelerations.values()
            for named in (True, False)
        ),
        strict=True,
    )
    for one, other in pairs:
        values = {
            name: chance.uniform(0.2, 0.9)
            for q in problem.coordinates
            for name in (q.name, q.name + "'")
        }
        values |= {p.name: chance.uniform(0.2, 0.9) for p in problem.parameters}
        assert value(problem, one, values) == pytest.approx(value(problem, other, values))


def value(problem, formula: Expression, values):
    names = tuple(q.name for q in problem.coordinates)
    node = GraphReader(Graph(), names, problem.definitions)(formula)
    (number,) = Program([node], Floats())(values)
    return number


@pytest.mark.parametrize(
    ("definitions", "physics"),
    [
        # m occurs beside it: T would be positive only where M > m
        ("{M: m + n}", "T: M*x'^2/2 + m*y'^2/2"),
        # two functions of one parameter
        ("{a: n^2, b: n^3}", "T: a*x'^2/2 + b*y'^2/2"),
        # a position is no constant
        ("{u: m*x}", "T: n*(x'^2 + y'^2)/2\nV: u^2"),
    ],
)
def test_what_is_not_free_is_written_out(definitions, physics):
    problem = problem_of(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, n: {assume: positive}}\n"
        f"definitions: {definitions}\n{physics}\n"
    )
    assert with_named_constants(problem) is problem


def test_the_sign_of_a_definition_is_known():
    named = with_named_constants(problem_of(TWO_BODIES))
    assert {p.name: p.assume for p in named.parameters}["mu"] == "positive"
    assert list(named.named) == ["mu", "k"]


def test_they_are_written_out_where_names_are_not_wanted():
    answers = answers_of(TWO_BODIES, "accelerations", named=False)
    used = {
        part.name
        for formula in answers.sections["accelerations"].accelerations.values()
        for part in walk(formula)
        if isinstance(part, Name)
    }
    assert not used & {"mu", "k"}


@pytest.mark.long
def test_an_explanation_lists_and_keeps_them():
    told = repr(explain(derive(problem_of(THREE_BODIES), named=True), named=True).steps)
    assert "r1" in told
    assert "Fraction(3, 2)" not in told.split("Lagrange's equations")[1]


#: Products, quotients, and sums of masses whose names answers keep, and that L does not use.
MASSES = (
    "m1*m2/(m1 + m2)",
    "4*m1*m2/(m1 + m2)",
    "m1 + m2",
    "m1^2*m2/(m1 + m2)^2",
    "m1*m2/(m1 - m2)",
    "1/(1/m1 + 1/m2)",
)


@pytest.mark.parametrize("formula", MASSES)
def test_an_explanation_does_not_define_a_name_by_itself(formula):
    text = f"""
coordinates: [x, y]
parameters: {{m1: {{assume: positive}}, m2: {{assume: positive}}, g: }}
definitions: {{mu: {formula}}}
T: m1*x'^2/2 + m2*y'^2/2
V: -g*(m1*x + m2*y)
"""
    account = explain(derive(problem_of(text), named=True), named=True)
    blocks = [block for step in account.steps for block in step.blocks]
    rows = [row for block in blocks if isinstance(block, Equations) for row in block.rows]
    assert parse_text(formula) in [row.right for row in rows if row.left == Name("mu")]
    assert not any(row.left == row.right for row in rows)
