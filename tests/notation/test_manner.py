"""Formulas in the manner of their file, with the values they had."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lagcli import loads, solve
from lagcli.expression import Call, Name, Negative, Number, Power, Product, Quotient, Sum
from lagcli.formatters.grammar import to_grammar
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.values import Floats, Program
from lagcli.notation.manner import Manner
from lagcli.pipeline import Request, derive, read, state
from lagcli.reader.expressions import parse_text
from lagcli.rewriting import expressions_in
from tests.read import LIBRARY, library

FILE = """
coordinates: {r: {assume: positive}, theta: , phi: }
parameters: {m: {assume: positive}, g: , R: {assume: positive}, a: {assume: positive}}
T: m*(R - a)^2*theta'^2/2 + m*r'^2/2
V: -m*g*(R - a)*cos(theta) + m*g*cos(theta - phi)
"""


def manner():
    return Manner(read("file.yaml", FILE.encode()).problem)


@pytest.mark.parametrize(
    ("formula", "written"),
    [
        # differences as the file has them, in products, squares, functions and sums
        ("g/(a - R)", "-g/(R - a)"),
        ("(a - R)^2*m", "m*(R - a)^2"),
        ("m + a*sin(phi - theta)^2", "m + a*sin(theta - phi)^2"),
        ("g/(m + sin(phi - theta)^4)", "g/(m + sin(theta - phi)^4)"),
        ("m*(a - R)*(r - m)", "m*(m - r)*(R - a)"),
        ("g + m*(a - R)", "g - m*(R - a)"),
        ("cos(phi - theta)", "cos(theta - phi)"),
        ("m*sin(phi - theta)", "-m*sin(theta - phi)"),
        (
            "m*cos(3*(phi - theta)) + g*sin(3*(phi - theta))",
            "m*cos(3*(theta - phi)) - g*sin(3*(theta - phi))",
        ),
        ("g*sin(theta/2 - phi/2)", "g*sin((theta - phi)/2)"),
        # numbers out of brackets, what is above and below, a difference of squares
        ("6*(4*g*r - 2*m*phi)/(2*a)", "6*(2*g*r - m*phi)/a"),
        ("m*(r + sin(phi))^2*g/(r + sin(phi))", "m*g*(r + sin(phi))"),
        ("g*(a + m)*(m - a)", "g*(m^2 - a^2)"),
        ("g*abs(m)*r", "g*abs(m)*r"),
        # a denominator that is positive where the coordinates are 0
        ("g/((m^2 - R^2)*theta^2 - a^4)", "-g/(a^4 + (R^2 - m^2)*theta^2)"),
        # what is added to its own multiple by a square
        ("g + m + m*sin(theta)^2", "g + m*(1 + sin(theta)^2)"),
        ("g*r - m*a - m*a*cos(phi)^2", "g*r - m*a*(1 + cos(phi)^2)"),
        # a number first
        ("m*g*(cos(theta) - 1)", "-m*g*(1 - cos(theta))"),
        ("-g*(cos(theta) - 3)/r", "g*(3 - cos(theta))/r"),
        ("g*(-2*r - m)", "-g*(2*r + m)"),
        # no fractional power of a letter, the cotangent, the inverse of a root
        ("g*r^(3/2)", "g*r*sqrt(r)"),
        ("-2*r*g/tan(theta)", "-2*g*r*cot(theta)"),
        ("g/tan(theta)^2", "g*cot(theta)^2"),
        ("m*sqrt(1/(g + r))", "m/sqrt(g + r)"),
        # positive letters below a root of a sum over something go under it, others do not
        ("sqrt((m*g + a)/m)/r", "sqrt((m*g + a)/(m*r^2))"),
        ("-a*sqrt((m*g + a)/m)/r", "-a*sqrt((m*g + a)/m)/r"),
        ("sqrt((m*g + a)/(2*m*r))/(3*r)", "sqrt((m*g + a)/(2*m*r^3))/3"),
        ("sqrt((m*g + a)/m)/(g*r)", "sqrt((m*g + a)/m)/(g*r)"),
        ("sqrt((m*g + a)/m)/g", "sqrt((m*g + a)/m)/g"),
        ("sqrt((m*g + a)/m)/r'", "sqrt((m*g + a)/m)/r'"),
        ("sqrt(g*R/m)/r", "sqrt(g*R/m)/r"),
        # the square of a letter of either sign stands before the root
        ("sqrt(m*R/g^2)", "sqrt(m*R)/abs(g)"),
        ("2*sqrt(R*phi^2/m)", "2*abs(phi)*sqrt(R/m)"),
        ("sqrt((R - a)^3*a/phi^2)", "sqrt((R - a)^3*a)/abs(phi)"),
        ("sqrt(phi^2)", "sqrt(phi^2)"),
        # no tangent comes from taking out the square of a cosine
        ("(r*tan(theta) + a)*cos(theta)^2", "(r*sin(theta) + a*cos(theta))*cos(theta)"),
        ("(r*tan(theta) + a)*cos(theta)^3", "(r*sin(theta) + a*cos(theta))*cos(theta)^2"),
        ("(r*tan(theta) + a)*cos(phi)", "(r*tan(theta) + a)*cos(phi)"),
        # a period keeps its series apart
        ("2*pi*sqrt(r/g)*(1 + a^2/16)", "2*pi*sqrt(r/g)*(1 + a^2/16)"),
        # a positive term first
        ("-m*(R - a) + g*r", "g*r - m*(R - a)"),
        # one fraction for those in a bracket, but (w^2 cos - g/R) sin stays
        ("(2/m + 1/R)*g", "(m + 2*R)*g/(m*R)"),
        ("(g*theta - phi/m)/r", "(m*g*theta - phi)/(m*r)"),
        ("(g^2*cos(theta) - g/R)*sin(theta)", "(g^2*cos(theta) - g/R)*sin(theta)"),
        ("acos(a/R - r/m)", "acos((m*a - R*r)/(m*R))"),
        ("acos(1 - a/R)", "acos(1 - a/R)"),
        # a letter before a bracket with the same letter
        ("m*(2*r' + m*theta) + g", "2*m*r' + m^2*theta + g"),
    ],
)
def test_a_formula_is_written_as_its_file_writes(formula, written):
    assert to_grammar(manner()(parse_text(formula))) == written


@pytest.mark.long
@given(
    st.lists(st.sampled_from(["m", "R", "a", "r", "r^2", "3", "(1/2)", "g"]), max_size=4),
    st.lists(st.sampled_from(["m", "R^2", "a", "r", "2", "g", "r'"]), max_size=3),
)
def test_letters_put_under_a_root_keep_the_value(inside, outside):
    formula = f"sqrt((m*R + a*r)/({'*'.join(['1', *inside])}))/({'*'.join(['1', *outside])})"
    values = {name: 0.7 + 0.2 * k for k, name in enumerate(("r", "r'", "m", "g", "R", "a"))}
    graph = Graph()
    read_node = GraphReader(graph, ("r", "theta", "phi"), {})
    nodes = [read_node(tree) for tree in (parse_text(formula), manner()(parse_text(formula)))]
    before, after = Program(nodes, Floats())(values)
    assert after == pytest.approx(before, rel=1e-12)


def test_rows_of_one_answer_have_one_denominator():
    write = manner()
    first = to_grammar(write(parse_text("g/(m*r - g*a)")))
    second = to_grammar(write(parse_text("theta'/(g*a - m*r)")))
    assert (first, second) == ("g/(m*r - g*a)", "-theta'/(m*r - g*a)")


def test_a_bracket_that_stood_the_other_way_round_leaves_no_minus_in_a_root():
    """(c² − v²)^(1/2) after an acceleration with v² − c²."""
    write = manner()
    assert to_grammar(write(parse_text("g*(r'^2 - a^2)/R"))) == "g*(r'^2 - a^2)/R"
    root = write(parse_text("sqrt((a^2 - r'^2)*(g^2 + m*r))"))
    assert to_grammar(root) == "sqrt((g^2 + m*r)*(a^2 - r'^2))"


NAMES = st.sampled_from([Name("r"), Name("theta"), Name("m"), Name("R"), Name("a"), Name("r", 1)])
LEAVES = NAMES | st.integers(1, 4).map(lambda k: parse_text(str(k)))


def _deeper(parts):
    signed = parts | parts.map(Negative)
    return st.one_of(
        st.lists(signed, min_size=2, max_size=3).map(lambda x: Sum(tuple(x))),
        st.lists(parts, min_size=2, max_size=3).map(lambda x: Product(tuple(x))),
        st.tuples(parts, parts).map(lambda x: Quotient(*x)),
        st.tuples(parts, st.sampled_from("1 2 3 1/2 3/2 5/2".split())).map(
            lambda x: Power(x[0], parse_text(x[1]))
        ),
        st.tuples(st.sampled_from("sin cos tan abs sqrt".split()), parts).map(
            lambda x: Call(x[0], (x[1],))
        ),
    )


@pytest.mark.long
@given(st.recursive(LEAVES, _deeper, max_leaves=12))
def test_the_value_stays(formula):
    graph = Graph()
    read_node = GraphReader(graph, ("r", "theta", "phi"), {})
    source = random.Random(1)
    try:
        nodes = [read_node(formula), read_node(manner()(formula))]
        program = Program(nodes, Floats())
        names = ("r", "theta", "m", "R", "a", "r'")
        before, after = program({name: source.uniform(0.5, 1.5) for name in names})
    except (ArithmeticError, ValueError):
        return
    assert after == pytest.approx(before, rel=1e-6, abs=1e-9)


def test_numbers_are_not_taken_for_letters():
    assert to_grammar(manner()(Number(parse_text("3").value))) == "3"


@pytest.mark.parametrize("potential", ["0", "0*x", "k*x"])
def test_no_energy_ends_with_nothing(potential):
    text = f"{{coordinates: [x, y], parameters: [m, I, k], V: {potential}, T: m*x'^2/2 + I*y'^2/2}}"
    answer = solve(loads(text), ["energy"])
    assert "0" not in str(answer).partition("Conserved")[0]


def test_rows_that_differ_by_a_coordinate_have_their_factors_in_one_order():
    near = "((a - b)^2 + (c - d)^2)"
    parameters = "{k: , a: , b: , c: , d: }"
    text = f"{{coordinates: [x, y], parameters: {parameters}, T: x'^2/2 + y'^2/2, V: 0}}"
    write = Manner(read("file.yaml", text.encode()).problem)
    rows = [f"k*{near}*({first})" for first in ("a - b", "c - d")]
    assert [to_grammar(write(parse_text(row))) for row in rows] == [
        f"k*({first})*{near}" for first in ("a - b", "c - d")
    ]


@pytest.mark.parametrize(
    ("kinetic", "hamiltonian"),
    [
        ("(m + M/3)*x'^2/2", "p_x^2/(2*(m + M/3))"),
        ("m*(b^2/3 + r^2*x^2)*x'^2/2", "p_x^2/(2*m*(b^2/3 + r^2*x^2))"),
        ("(M + M + m/3)*x'^2/2", "3*p_x^2/(2*(6*M + m))"),
    ],
)
def test_numbers_beside_a_sum_of_the_file_cancel(kinetic, hamiltonian):
    text = (
        "title: t\ncoordinates: [x]\nparameters: {m: {assume: positive}, M: {assume: positive}, "
        f'b: {{assume: positive}}, r: {{assume: positive}}}}\nT: "{kinetic}"\nV: 0\n'
    )
    found = state(derive(read("t.yaml", text.encode()).problem), Request(sections=("hamiltonian",)))
    assert to_grammar(found.sections["hamiltonian"].hamiltonian) == hamiltonian


@pytest.mark.long
@pytest.mark.parametrize("section", ["hamiltonian", "hamilton_jacobi"])
def test_a_potential_keeps_the_terms_of_the_file(section):
    text = (
        "title: t\ncoordinates: {r: {assume: positive}, phi: {}}\n"
        "parameters: {m: {assume: positive}, k: {assume: positive}, beta: {}}\n"
        "T: m*(r'^2 + r^2*phi'^2)/2\nV: -k/r + beta/r^2\n"
    )
    found = state(derive(read("t.yaml", text.encode()).problem), Request(sections=(section,)))
    assert to_grammar(found.sections[section].hamiltonian).endswith("/(2*m) - k/r + beta/r^2")


@pytest.mark.parametrize(
    ("name", "section", "other"),
    [
        ("pulleys/atwood-with-heavy-pulley", "hamilton_jacobi", "reduction"),
        ("pendulums/pendulum-on-sliding-support-multiplier", "multipliers", "accelerations"),
        ("pendulums/pendulum-on-sliding-support-multiplier", "forces", "accelerations"),
    ],
)
def test_a_section_alone_is_that_in_company(name: str, section: str, other: str) -> None:
    """The sign of a denominator is that of the section, whatever was written before."""
    problem = library()[LIBRARY / f"{name}.yaml"]
    alone, company = (
        state(derive(problem), Request(sections=names)).sections[section]
        for names in ((section,), (section, other))
    )
    assert alone == company


@pytest.mark.parametrize(
    ("text", "section", "rows"),
    [
        (  # Chow: an Atwood machine whose pulley hangs from a spring
            """
coordinates: [y, x]
T: m1*(y' + x')^2/2 + m2*(y' - x')^2/2
V: k*y^2/2 - m1*g*(y + x) - m2*g*(y - x)
""",
            "equations",
            [
                "(m1 + m2)*y'' + (m1 - m2)*x'' + k*y - (m1 + m2)*g",
                "(m1 - m2)*y'' + (m1 + m2)*x'' - (m1 - m2)*g",
            ],
        ),
        (  # Irodov, problem 1.78: two pulleys
            """
coordinates: [x, y]
T: m1*x'^2/2 + m2*y'^2/2
V: -m1*g*x - m2*g*y
constraints: {string: 2*x + y = k}
""",
            "accelerations",
            ["(m1 - 2*m2)*g/(m1 + 4*m2)", "-2*(m1 - 2*m2)*g/(m1 + 4*m2)"],
        ),
        (  # Neumann's particle on a sphere: three like rows
            """
coordinates: [x, y, z]
T: (x'^2 + y'^2 + z'^2)/2
V: (m1*x^2 + m2*y^2 + g*z^2)/2
constraints: {sphere: x^2 + y^2 + z^2 = 1}
""",
            "accelerations",
            [
                "-x*(x'^2 + y'^2 + z'^2 + (m1 - m2)*y^2 + (m1 - g)*z^2)",
                "-y*(x'^2 + y'^2 + z'^2 + (m2 - m1)*x^2 + (m2 - g)*z^2)",
                "-z*(x'^2 + y'^2 + z'^2 + (g - m1)*x^2 + (g - m2)*y^2)",
            ],
        ),
    ],
)
def test_a_difference_of_constants_stands_one_way_in_a_section(text, section, rows):
    problem = read("t.yaml", f"title: t\nparameters: [m1, m2, k, g]{text}".encode()).problem
    found = state(derive(problem), Request(sections=(section,))).sections[section]
    shown = [to_grammar(each) for each in expressions_in(found)]
    assert [each for each in shown if each in rows] == rows
