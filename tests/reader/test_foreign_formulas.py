"""Formulas in other notations: translated right, or not at all.

SymPy's printers for other languages write the formulas of the library; what is translated back
has the same values.
"""

from __future__ import annotations

import random
import re

import pytest
import sympy as sp

from lagcli.expression import Call, Name, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.library import entries
from lagcli.reader import parse_text, read_problem
from lagcli.reader.foreign.cases import without_cases
from lagcli.reader.foreign.translation import translated
from lagcli.reader.foreign.words import UnclearText, Vocabulary

WRITERS = {
    "LaTeX": sp.latex,
    "Mathematica": sp.mathematica_code,
    "MATLAB": sp.octave_code,
    "Maple": sp.maple_code,
    "C": sp.ccode,
    "Fortran": lambda formula: sp.fcode(formula, source_format="free", standard=95),
    "Python": sp.pycode,
    "Julia": sp.julia_code,
}
FUNCTIONS = "sin cos tan cot sqrt exp log abs sinh cosh tanh asin acos atan atan2 sign pi".split()


def plain(formula):
    """The formula with xdot for x', as SymPy reads it."""
    text = re.sub(r"(\w+)'", r"\1dot", to_grammar(formula)).replace("^", "**")
    names = set(re.findall(r"[^\W\d]\w*", text)) - {*FUNCTIONS}
    return sp.sympify(text, locals={name: sp.Symbol(name) for name in names})


def formulas():
    for entry in list(entries())[::12]:
        problem = read_problem(entry.name, entry.path.read_bytes()).problem
        for formula in (problem.kinetic, problem.potential, problem.lagrangian):
            calls = [n for n in walk(formula) if isinstance(n, Call)] if formula else []
            if formula is not None and not any(n.function in problem.functions for n in calls):
                yield problem, formula


@pytest.mark.first_quick
@pytest.mark.parametrize("language", WRITERS)
def test_what_sympy_prints_for_another_language_is_translated_back(language):
    draw, right, unclear = random.Random(language), 0, 0
    for problem, formula in formulas():
        given = plain(formula)
        coordinates = tuple(each.name for each in problem.coordinates)
        others = {node.name for node in walk(formula) if isinstance(node, Name)} | {"t", "pi"}
        names = Vocabulary(coordinates, frozenset(others - {*coordinates}))
        written = given
        if language == "LaTeX":
            dots = {x: sp.Symbol(rf"\dot{{{sp.latex(sp.Symbol(x))}}}") for x in coordinates}
            written = given.subs({f"{x}dot": dot for x, dot in dots.items()})
        text = WRITERS[language](written).replace("&\n", "")
        try:
            back = plain(parse_text(translated(text, names)))
        except UnclearText:
            unclear += 1
            continue
        values = {name: draw.uniform(0.2, 0.9) for name in given.free_symbols}
        assert back.free_symbols <= given.free_symbols, text
        assert complex(back.subs(values)) == pytest.approx(complex(given.subs(values))), text
        right += 1
    assert right > 20
    assert unclear <= 1


NAMES = Vocabulary(("x", "theta"), frozenset({"m", "k", "g", "l", "a", "t", "pi", "ħ"}))


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (r"\frac12 m \dot x^2 + \tfrac{1}{2} k x^2", "1/2*m*x'^2 + 1/2*k*x^2"),
        (r"-m g l \cos\theta", "-m*g*l*cos(theta)"),
        (r"m\left(\frac{dx}{dt}\right)^2", "m*x'^2"),
        ("½ m ẋ² − k·|x|", "(1/2)*m*x'^2 - k*abs(x)"),
        ("m/2 (x'[t]^2 + l^2 Sin[theta[t]]^2)", "m/2*(x'^2 + l^2*sin(theta)^2)"),
        ("m sin²θ", "m*sin(theta)^2"),
        ("k*x.diff(t)**2 + np.sqrt(a)", "k*x'^2 + sqrt(a)"),
        ("1/2mx'^2", "1/2*m*x'^2"),
        ("a^2/2m", "a^2/(2*m)"),
        ("k(1 - e^(-a x))^2", "k*(1 - exp(-a*x))^2"),
        ("m*(dx/dt)^2 + m*d²x/dt²", "m*x'^2 + m*x''"),
        ("9,81 x", "9.81*x"),
        ("k*sin(30°)", "k*sin(30*pi/180)"),
        ("x == l", "x = l"),
        ("½mlẋθ̇cosθ", "(1/2)*m*l*x'*theta'*cos(theta)"),
        (r"k\sqrt[3]{x}", "k*x^(1/3)"),
        ("m l²/2 (θ̇² + 1)", "m*l^2/2*(theta'^2 + 1)"),
        ("self.m*self.dx**2", "m*x'^2"),
        ("a cos lt", "a*cos(l*t)"),
        ("m＊x'ˆ2", "m*x'^2"),
        ("m*Derivative[1][x][t]^2", "m*x'^2"),
        ("mu_k x'", "mu_k*x'"),
        ("1/2 m*'x^2 + F_n x", "1/2*m*x'^2 + F_n*x"),
        ("(k*x).simplify()", "(k*x)"),
        ("1/2 m x'2", "1/2*m*x'^2"),
        ("m*x'_1^2", "m*x_1'^2"),
        (r"\dot{x}_1^2 + \dot x_{1}^2", "x_1'^2 + x_1'^2"),
        ("k ln|x/l| + 2|x - l|", "k*log(abs(x/l)) + 2*abs(x - l)"),
        (r"\hbar x", "ħ*x"),
        ("RADIANS(30)*PI()/2 + DEGREES(x)", "30*pi/180*pi/2 + x*180/pi"),
        ("LOG10(x)", "log(x)/log(10)"),
        ("ArcTan[x, l] + atan2(x, l)", "atan2(l, x) + atan2(x, l)"),
    ],
)
def test_a_formula_is_read_as_its_author_reads_it(text, meant):
    assert translated(text, NAMES) == meant


@pytest.mark.parametrize(
    "text",
    ["a/l x", "cos a x", "sin x^2", "sin x/2", "e^2x", "1,000*x", "U(x)", "x(t - 1)", "k*(x", "x y)",
     "a(t)", "x^2^2", "k*x if x > 0 else 0", "m*g*x [J]", "x' 2"],
)  # fmt: skip
def test_what_may_mean_two_things_is_not_translated(text):
    with pytest.raises(UnclearText):
        translated(text, NAMES)


def test_another_capital_is_another_name():
    assert translated("M m", NAMES) == "M*m"


def test_a_letter_for_the_velocity_beside_its_coordinate_is_not_translated():
    one = Vocabulary(("theta",), frozenset({"m", "t", "pi"}))
    assert translated("m ω²", one) == "m*theta'^2"
    with pytest.raises(UnclearText):
        translated("m ω² θ²", one)


@pytest.mark.parametrize(
    "line",
    [
        "coordinates: [x, y",
        "parameters: {m: 1, k: 2",
        "parameters: {m: 1 k: 2}",
        "T: @(x) x'^2",
        "T: lambda x: x'^2",
        "T: *x'^2",
        "T: - x'^2",
        "T: {1/2}*x'^2",
        "title: A: b",
        "coordinates: {x[t], y[t]}",
    ],
)
def test_a_line_that_yaml_does_not_read_is_proposed_as_the_reader_accepts_it(line):
    good = {"coordinates": "coordinates: [x, y]", "T": "T: x'^2 + y'^2"}
    lines = [line, *(each for key, each in good.items() if not line.startswith(key))]
    [only] = read_problem("p.yaml", "\n".join([*lines, ""]).encode()).diagnostics
    assert only.hint.startswith("write ")
    changed = [only.hint.removeprefix("write "), *lines[1:]]
    assert read_problem("p.yaml", "\n".join([*changed, ""]).encode()).problem is not None


SUMS = [
    "sum({}, i=1..{})", "sum({}, i, 1, {})", "Sum({}, (i, 1, {}))", "sum({}, i = 1:{})",
    "sum({}, i from 1 to {})", "sum({})", "Σ_i {}", "∑_{{i}} {}",
    r"\sum_{{i=1}}^{{{1}}} {0}", r"\sum_i {}",
]  # fmt: skip


@pytest.mark.parametrize("seed", range(20))
def test_a_sum_over_an_index_has_the_value_of_its_terms(seed):
    draw = random.Random(seed)
    count, mark = draw.randrange(2, 5), draw.choice(["_{}", "{}"])
    x = [f"x{mark.format(k)}" for k in range(1, count + 1)]
    masses = [f"m{mark.format(k)}" for k in range(1, count + 1)]
    names = Vocabulary(tuple(x), frozenset([*masses, "k", "t", "pi"]))
    term, one = draw.choice([
        ("m_i*x_i'^2/2", lambda k: f"{masses[k]}*{x[k]}'^2/2"),
        ("(x_i - k*m_i)^2", lambda k: f"({x[k]} - k*{masses[k]})^2"),
        ("i*k*x[i]", lambda k: f"{k + 1}*k*{x[k]}"),
        ("k*m_{i}*x_{i}^2", lambda k: f"k*{masses[k]}*{x[k]}^2"),
    ])  # fmt: skip
    form = draw.choice([each for each in SUMS if "from" not in each])
    found = translated("k - " + form.format(term, count) + " + k*pi", names)
    terms = " + ".join(map(one, range(count)))
    assert sp.expand(plain(parse_text(found)) - plain(parse_text(f"k - ({terms}) + k*pi"))) == 0


@pytest.mark.parametrize("text", ["Σ_i k*y_i", "sum(x_i, i=1..n)", "Σ_i k", "sum(k*x_i, i=1..50)"])
def test_a_sum_without_a_range_or_an_index_is_unclear(text):
    names = Vocabulary(("x_1", "x_2"), frozenset({"k", "n"}))
    with pytest.raises(UnclearText):
        translated(text, names)


def test_a_range_of_python_ends_before_its_end():
    names = Vocabulary(("x1", "x2", "x3"), frozenset({"k"}))
    found = translated("sum(k*x_i^2 for i in range(1, 3))", names)
    assert found == "(k*x1^2 + k*x2^2)"


def test_neighbours_in_a_sum_have_the_next_index():
    names = Vocabulary(("x1", "x2", "x3"), frozenset({"k"}))
    found = translated("k/2*sum((x_{i+1} - x_i)^2, i=1..2)", names)
    assert found == "k/2*((x2 - x1)^2 + (x3 - x2)^2)"


@pytest.mark.parametrize(
    "text", ["q*A·v", r"q \vec{A}\cdot\vec{v}", "q*dot(A, v)", "q*np.dot(v, A)"]
)
def test_a_product_of_vectors_has_the_components_of_the_file(text):
    names = Vocabulary(("x", "y", "z"), frozenset({"q", "A_x", "A_z"}))
    expected = plain(parse_text("q*(A_x*x' + A_z*z')"))
    assert sp.expand(plain(parse_text(translated(text, names))) - expected) == 0


@pytest.mark.parametrize(
    ("text", "whole"),
    [("m*y + (k*y^2/2 if y < 0)", "m*y + ((k*y^2/2)*(1 - sign(y))/2)"),
     ("m*y + (0 if y > 0 else k*y^2) + 1", "m*y + ((k*y^2)*(1 - sign(y))/2) + 1"),
     ("m*(y + 1) + k*(y - 1)", "m*(y + 1) + k*(y - 1)")],
)  # fmt: skip
def test_cases_inside_of_a_sum_leave_its_other_terms(text, whole):
    assert without_cases(text) == whole


PRODUCTS = [
    ("Cross[{{{0}}}, {{{1}}}][[{2}]]", 1),
    ("Cross[{{{0}}}, {{{1}}}]_{3}", 0),
    ("np.cross([{0}], [{1}])[{2}]", 0),
    ("(({0}) × ({1}))_{3}", 0),
    ("k*cross([{0}], [{1}]).{3} + k - k", 0),
]


@pytest.mark.parametrize(("form", "first"), PRODUCTS)
@pytest.mark.parametrize("axis", range(3))
def test_one_component_of_a_product_of_vectors(form, first, axis):
    one, other = ["x", "2*y", "z - x"], ["p_x", "k*p_y", "p_z"]
    names = Vocabulary(("x", "y", "z"), frozenset({"k"}), momenta=True)
    text = form.format(", ".join(one), ", ".join(other), axis + first, "xyz"[axis])
    found = sp.sympify(translated(text, names))
    right = sp.Matrix(sp.sympify(one)).cross(sp.Matrix(sp.sympify(other)))[axis]
    assert sp.expand(found - right * (sp.Symbol("k") if form[0] == "k" else 1)) == 0


@pytest.mark.parametrize("text", ["cross(r, p)[1]", "cross(r, p)[2]", "(r × p)[2]", "(r x p)[1]"])
def test_an_index_of_a_product_that_may_begin_at_0_or_1_is_unclear(text):
    with pytest.raises(UnclearText):
        translated(text, Vocabulary(("x", "y", "z"), frozenset(), momenta=True))


def test_an_index_that_the_names_have_is_none_of_a_component():
    names = Vocabulary(("x", "y"), frozenset({"k_1", "k_2", "k_x", "k_y"}))
    assert translated("k[1]*x + k[2]*y", names) == "k_1*x + k_2*y"


@pytest.mark.parametrize("argument", ["w*t", "t", "2*pi*t", "w*t + 1"])
def test_a_square_of_the_time_may_be_a_wave(argument):
    """In MATLAB and SciPy, square(w*t) is sign(sin(w*t)): no power is proposed."""
    begin = "coordinates: [x]\nparameters: {m: 1, w: 2}\nT: m*x'^2/2\nforces: {x: "

    def hint(law):
        [found] = read_problem("p.yaml", f"{begin}{law}}}\n".encode()).diagnostics
        return found.hint

    assert hint(f"m*square({argument})").startswith("a square wave is written sign(sin(w*t))")
    assert hint(f"m*signal.square({argument})").startswith("a function has its name alone")
    assert hint("-m*square(x')") == "write -m*x'^2"
    assert hint("-m*sq(w*t)") == "write -m*(w*t)^2"


def test_a_real_part_is_a_cosine():
    begin = "coordinates: [x]\nparameters: {m: 1, F: 1, w: 2}\nT: m*x'^2/2\nforces: {x: "

    def hints(law):
        found = read_problem("p.yaml", f"{begin}{law}}}\n".encode()).diagnostics
        return [each.hint for each in found]

    assert hints("F*Re(exp(i*w*t))") == ["write F*(cos(w*t))"]
    assert not any("cos" in each for each in hints("F*Im(exp(i*w*t))"))
