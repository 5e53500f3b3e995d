"""What is carried over from Markdown, LaTeX, Python and other tongues: one mistake, one hint."""

from __future__ import annotations

import random

import pytest

from lagcli.reader import read_problem
from tests.reader.test_habits import messages, text

UNREAD = "this line is none of the file"


@pytest.mark.parametrize("seed", range(12))
def test_a_number_whose_exponent_is_not_one_is_named_so(seed):
    draw = random.Random(seed)
    number = draw.choice(["2.0", "1", "6.67", ".5", "30."])
    digits = draw.randrange(1, 30)
    letter = draw.choice("eE")
    [without] = messages(text(V=f"{number}{letter}*x"))
    assert f"as in {number}e-3; a product is {number}*{letter}" in without
    for written in (f"{number} {letter}-{digits}", f"{number}d-{digits}", f"{number}e - {digits}"):
        [apart] = messages(text(parameters=f"{{m: 1, k: {written}}}"))
        assert f"write {number}e-{digits}; a product is" in apart
    [times] = messages(text(parameters=f"{{m: 1, k: {number} x 10^-{digits}}}"))
    assert times.endswith(f"write {number}e-{digits}")


@pytest.mark.parametrize("going_on", ["- k*x", "+ k*x", "k*x", "= 1", "*k"])
@pytest.mark.parametrize("comment", ["# spring", "# a: b", "#"])
def test_a_comment_within_a_value_is_named_where_it_stands(going_on, comment):
    behind = text(V=f"k*x^2/2   {comment}\n  {going_on}")
    between = text(V=f"k*x^2/2\n  {comment}\n  {going_on}")
    for written in (behind, between):
        assert messages(written) == [
            "a comment ends the value that goes on below it; put it on a line above the key"
        ]


HINTS = [
    (text(V="**k*x^2/2**"), "leave out '**': write k*x^2/2"),
    (text(V="*k*x^2/2*"), "leave out '*': write k*x^2/2"),
    (text(V="`k*x^2/2`"), "leave out '`': write k*x^2/2"),
    (text(V=None, **{"**V**": "k*x"}), "leave out '**': write V:"),
    (text(V=None, **{"$V$": "k*x"}), "the key is V"),
    ("* coordinates: [x]\n* T: x'^2\n", "leave out '*': write coordinates:"),
    ("| coordinates | x |\n|---|---|\n", "without a table"),
    (text(source="[Goldstein](http://example.org)"), "put the whole text in quotes"),
    ('"""A pendulum"""\n' + text(), "a comment begins with '#'"),
    ("import sympy\n" + text(), "leave it out"),
    (text(V="{m*g}*x"), "write V: (m*g)*x"),
    (text(V="&= k*x \\\\"), "leave out '&' and '='"),
    (text(V="\\arctan{x}"), "write atan"),
    (text(V="-\\partial U/\\partial x"), "write diff(expression, name)"),
    (text(V="k*\\mathrm{cos}(x)"), "write k*cos(x)"),
    (text(T="m*x.diff(t)**2/2"), "write m*x'^2/2"),
    (text(T="m*x(t).diff(t)**2/2"), "write m*x'^2/2"),
    (text(forces="{x: m*x.diff(t, t)}"), "comma ends the value"),
    (text(forces="\n  x: -m.diff(x)"), "write -diff(m, x)"),
    (text(T="sp.Rational(1, 2)*m*x'^2"), "write 1/2"),
    (text(T="Rational(1, 2)*m*x'^2"), "write 1/2"),
    (text(V="np.arctan2(x, k)"), "write atan2"),
    (text(V="k*norm(x, k)"), "write k*sqrt(x^2 + k^2)"),
    (text(V="cosd(x)"), "write cos(x*pi/180)"),
    (text(V="max(x, k, 0)"), "compare two at a time"),
    (text(V="-grad(U)"), "found from V"),
    (text(T="sum(m*x_i'^2, i=1..2)"), "write each term"),
    (text(T="sum(m*x_i'^2 for i in range(2))"), "write each term"),
    (text(V="x > 0 ? k*x : 0"), "(1 + sign(x))/2"),
    (text(V="k*\u200bx"), "leave it out"),
    (text(V="k\u2009\u202ax"), "leave it out"),
    (text().replace("T: ", "T:\u00a0"), "type a usual blank"),
    (text(T="m*(x)'^2/2"), "write m*x'^2/2"),
    (text(T="m*x^2'/2"), "write m*x'^2/2"),
    (text(parameters="{m: 1'000}"), "write 1000"),
    (text(parameters="{m: {value: 1,5, unit: kg}, k: 1}"), "a decimal point is written '.'"),
    (text(parameters="\n  m: [1, kg]\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="\n  m: 1 [kg]\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="\n  m: 1 (kg)\n  k: 2"), "write {value: 1, unit: kg}"),
    (text(parameters="{m: 1, k: {value: 2, unit: kg s-2}}"), "write kg/s^2"),
    (text(parameters="symbols('m k')"), "write [m, k]"),
    (text(coordinates="[x = dynamicsymbols('x')]"), "write x"),
    (text(coordinates="[x[1], x[2]]"), "write coordinates: [x_1, x_2]"),
    (text(coordinates="[θ]", T="m*θ'^2", V="cosθ*theta"), "write cos(θ)"),
    (text(constraints="{a: x → 1}"), "write x = 1"),
    (text(constraints="{a: 0 < x < 1}"), "write contacts: {lower: x >= 0, upper: x <= 1}"),
    (text(forces="(-k*x)"), "write {x: "),
    (text(expect="{equations: m*x'' = -k*x}"), "write [m*x'' = -k*x]"),
    (text(D="m*x'^2"), "the key is dissipation"),
    (text(simulation="{t: 10}"), "the key is until"),
    (text(coordinates=None, Koordinaten="[x]"), "the key is coordinates"),
    (text(parameters=None, T="x'^2", V="x", paramètres="{m: 1}"), "the key is parameters"),
    (text(coordinates=None, coordnates="[x]"), "did you mean 'coordinates'"),
]


@pytest.mark.parametrize(("written", "hint"), HINTS)
def test_what_is_meant_is_named_first(written, hint):
    first = messages(written)[0]
    assert hint in first


@pytest.mark.parametrize("shape", ["(x, 0)", "(x, atan2(x, k))", "((x), 0)"])
def test_a_list_in_parentheses_is_one_mistake(shape):
    inner = f"[{shape[1:-1]}]"
    for points in (f"{{P: {{mass: m, position: {shape}}}}}",
                   f"\n  P:\n    mass: m\n    position: {shape}"):  # fmt: skip
        [only] = messages(text(points=points))
        assert inner in only.replace('"', "")


def test_a_name_that_is_misspelled_alike_is_told_once():
    written = text(coordinates="[θ]", T="m*theta'^2", V="theta + theta^2", initial="{θ: 1}")
    assert messages(written) == ["unknown name 'theta' in T; did you mean 'θ'? also in line 4"]


@pytest.mark.parametrize("mark", ["//", ";", "%", "<!--", "--", "/*", '"""'])
@pytest.mark.parametrize("above", [0, 1, 3])
def test_a_comment_of_another_language_is_named(mark, above):
    lines = text().splitlines(keepends=True)
    written = "".join([*lines[:above], f"{mark} a spring\n", *lines[above:]])
    assert messages(written) == ["this line is none of the file; a comment begins with '#'"]


@pytest.mark.parametrize(
    ("formula", "plain"),
    [
        (r"\sqrt{k/m}", "sqrt(k/m)"),
        (r"\sqrt{\frac{k}{m}}", "sqrt(k/m)"),
        (r"\frac{1}{2} \sqrt{\frac{k}{m}}", "1/2*sqrt(k/m)"),
    ],
)
def test_latex_in_brackets_is_read_as_one_text(formula, plain):
    lines = f"expect:\n  equations: [m*x'' + k*x = 0]\n  modes: [{formula}]\n"
    [found] = read_problem("p", (text(V="k*x^2/2") + lines).encode()).diagnostics
    assert found.hint == f"write {plain}"
    assert found.span.line == (text(V="k*x^2/2") + lines).count("\n")
    twice = lines.replace("m*x''", r"m \ddot{x}").replace("[m ", "\n    - m ").replace(" 0]", " 0")
    [both] = read_problem("p", (text(V="k*x^2/2") + twice).encode()).diagnostics
    assert f"m*x'' + k*x = 0; in line {found.span.line + 1} write {plain}" in both.hint


def test_latex_in_brackets_that_is_right_in_quotes():
    wrong = text(coordinates=r"{x: {symbol: \xi_{1}}}")
    [found] = messages(wrong)
    assert "quotes" in found
    quoted = found.partition("write ")[2]
    assert messages(wrong.replace(r"\xi_{1}", quoted)) == []


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        ("[problem]\ncoordinates = x\n", "a key is written without brackets"),
        ("<problem>x</problem>\n", "without tags"),
        (text(V="k\\,x"), "write k*x"),
        (text(forces="{x: m*\\max{x, 1}}"), "put the formula in quotes"),
        (text(T="m*x'[t]^2/2"), "write m*x'^2/2"),
        (text(T="m*der(x)^2/2"), "write m*x'^2/2"),
        (text(V="std::pow(x, 2)"), "write x^2"),
        (text(constraints='{a: "Eq(x, 1)"}'), "write x = 1"),
        (text(parameters="\n  m: 1\n  k: N/m"), "write {unit: N/m}"),
        (text(coordinates="{x: {unit: º}}"), "did you mean 'deg'"),
        (text(V="m*g*„x“"), "leave them out"),
        (text(expect="{eom: [m*x'' = -k*x]}"), "the key is equations"),
    ],
)
def test_other_programs_and_other_marks(written, hint):
    found = messages(written)  # the second is what the first hides
    assert len(found) <= 2
    assert any(hint in each for each in found)


@pytest.mark.parametrize("seed", range(10))
def test_a_range_for_until_is_told_its_end(seed):
    draw = random.Random(seed)
    end = draw.choice(["10", "2.5", "1e3", "200"])
    between = draw.choice(["..", "...", ":", " to ", ", ", " - ", "–", ":0.1:"])
    opened, closed = draw.choice([("", ""), ("(", ")"), ('"[', ']"')])
    written = f"{opened}0{between}{end}{closed}"
    [only] = messages(text(simulation=f"\n  until: {written}"))
    assert only.endswith(f"a motion begins at t = 0: write {end}")


@pytest.mark.parametrize("seed", range(10))
def test_a_call_in_brackets_is_written_with_parentheses(seed):
    draw = random.Random(seed)
    name = draw.choice(["sin", "cos", "sqrt", "exp", "log"])
    inside = draw.choice(["x", "x[t]", "2*x[t]"])
    [only] = messages(text(V=f"k*{name.capitalize()}[{inside}]"))
    call = f"{name}({inside.replace('[t]', '')})"
    assert only.endswith(f"write k*{call}")


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        (text(Given="a mass on a spring"), "write description: Given: …"),
        (
            text(find="equations of motion"),
            "leave it out: equations, equilibria, frequencies and charges are found",
        ),
        (text(V="k . x^2/2"), "write k*x^2/2"),
        (text(V="k*x^2/2 ..."), "a line that continues the one above begins with blanks"),
        (text(V="(k*x^2/2).subs(k, 2)"), "values stand under 'parameters'"),
        (text(T="m*D[x[t], t]^2/2"), "write m*x'^2/2"),
        (text(initial="{x -> 1}"), "write x: 1"),
        (text(initial="{x' => 1}"), "write x': 1"),
        (text(initial="[1; 0]"), "write {x: 1, x': 0"),
        (text(initial="\n  x: (1, 0)"), "write one value"),
        (text(V="-m*g*\\cos x"), "write -m*g*cos(x)"),
        (text(coordinates='{x: {symbol: "\\vartheta"}}'), "use single quotes"),
        ("model Spring\nparameter Real m = 1;\n", "no program"),
        (text(coordinates="[Real x]"), "write x"),
        (text(coordinates="{x: {fixed: true}}"), "a parameter, no coordinate"),
        (text(coordinates="[‘x’]"), "leave out the quotes: write x"),
        (text(T="m*x′²/2"), "write m*x'^2/2"),
        (text(T=None, **{"1. T": "m*x'^2/2"}), "the key is T"),
        (text(coordinates="\n– x"), "write - x"),
        (text(parameters="{m: {<<: {unit: kg}}, k: 2}"), "write what it stands for"),
        (text(coordinates="\n  - {name: x, unit: m}"), "write x: {unit: m}, without '-'"),
        (text(version="2"), "leave it out"),
        (text(energy="conserved"), "what is conserved is found"),
        (text(**{"degree-of-freedom": "1"}), "write expect: {degrees_of_freedom: 1}"),
        (text(fuerzas="{x: -g*x}"), "the key is forces"),
        (text(constraints="{rod: the length is constant}"), "write left = right"),
        (text(points="{A: {polar: [x, k], mass: m}}"), "[r*cos(phi), r*sin(phi)]"),
        (text(points="{A: {position: {r: x}, mass: m}}"), "[r*cos(phi), r*sin(phi)]"),
        (text(parameters="{m: {assume: True}, k: 2}"), "write one of real, positive"),
        (text(forces="{x: -m*Derivative(x,t,2)}"), 'write "-m*Derivative(x,t,2)"'),
        (text(coordinates="[theta]", T="m*omega^2/2", V="0"), "write m*theta'^2/2"),
        (text(T="m*(x'^2 + y'^2)/2", V="m*y"), "declare it under 'coordinates'"),
    ],
)
def test_paper_mathematica_modelica_and_word(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        (text(coordinates="[Function('x')(t)]"), "write x"),
        (
            text(parameters="\n  m: Symbol('m', positive=True)\n  k: 2"),
            "write m: {assume: positive}",
        ),
        (text(method="LagrangesMethod"), "leave it out"),
        (text(definitions="{f: 'lambda x: k*x'}"), "write k*x"),
        (text(initial="Matrix([1, 0])"), "write {x: 1, x': 0"),
        (text(coordinates="[x, Subscript[x, 1]]"), "write coordinates: [x, x_1]"),
        (text(simulation='{until: "linspace(0, 10, 100)"}'), "write 10"),
        (text(V="k*x^2/2 \\quad"), "write k*x^2/2"),
        (text(annotation="(experiment)"), "leave it out"),
        (text(T=None, **{"• T": "m*x'^2/2"}), "the key is T"),
        (text(parameters="{m: ${MASS}, k: 2}"), "write the value for ${MASS}"),
        (text(parameters="{m: {{ mass }}, k: 2}"), "a map has one pair of braces"),
        (text(simulation="{until: 10, output: out.csv}"), "lagcli simulate p.yaml -o motion.csv"),
        (text(initial="{x: 10 percent}"), "write 10/100"),
        (text(V="k*x^2/2 ∴"), "leave it out"),
    ],
)
def test_sympy_and_placeholders(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        (text(F="{x: -g*x}"), "the key is forces"),
        (text(**{"generalised-forces": "{x: -g*x}"}), "the key is forces"),
        (text(V=None, potentials="k*x^2"), "the key is V"),
        (
            text(coordinates="[theta]", T="m*theta'^2/2", V=None, theta0="30°"),
            "write initial: {theta: 30*pi/180}",
        ),
        (text(initial="{x: 1, at rest}"), "a velocity that is not given is 0"),
        (
            text() + "l = 9.81 m\n",
            "write all as parameters: {m: 1, k: 2, g: 9.81, l: {value: 9.81, unit: m}}",
        ),
        ("coordinates = {x, y}\n", "write coordinates: [x, y]"),
        (text(T="½ m x'²"), "(1/2)*m"),
        (text(symmetries="true"), "leave out the key"),
        (text(find="{omega: frequency}"), "frequencies and charges are found"),
        (text(expect="x'' = -k*x/m"), "write {accelerations: {x: -k*x/m}}"),
        (text(simulation="10 seconds with accuracy 1e-9"), "write {until: 10}"),
    ],
)
def test_words_for_keys_and_values(written, hint):
    [only] = messages(written)
    assert hint in only
