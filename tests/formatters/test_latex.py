"""The LaTeX says what the formula says, fits the page, and runs nothing from the file."""

from __future__ import annotations

import cmath
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import lagcli
from lagcli.document import Equations, Row
from lagcli.expression import Call, Diff, Name, Negative, PartialCall, Power, Quotient, Rate
from lagcli.formatters.built_in.latex import render
from lagcli.formatters.latex_display import LatexDisplay, Set, lines_of
from lagcli.formatters.latex_environments import Environments
from lagcli.formatters.latex_math import WIDEST, LatexPrinter
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.latex_text import latex_text
from lagcli.formatters.latex_width import TEXT_WIDTH
from lagcli.formatters.layout import break_lines
from lagcli.formatters.options import LatexOptions, Options
from lagcli.reader.expressions import parse_text
from lagcli.statements.answers import Answers, LagrangianSection

from .examples import (
    HOOP,
    HOSTILE,
    TWO,
    M,
    R,
    alpha,
    g,
    long_sum,
    number,
    plus,
    sin,
    square,
    theta,
    times,
    x,
)
from .latex_reader import read_latex
from .strategies import expressions, value
from .test_grammar import ONE_OF_EACH

needs_latex = [
    pytest.mark.latex,
    pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is missing"),
]


def latex(node, **names):
    return LatexPrinter(LatexNames(**names)).show(node).text


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (Name("theta_1", 1), r"\dot{\theta}_{1}"),
        (Name("lambda_rolling"), r"\lambda_{\text{rolling}}"),
        (Name("omega_max"), r"\omega_{\mathrm{max}}"),
        (Name("phase", 2), r"\ddot{\mathit{phase}}"),
        (Name("x", 3), "x'''"),
        (Name("phi"), r"\phi"),
        (Name("varphi"), r"\varphi"),
        (Name("φ"), r"\varphi"),
        (plus(times(M, Name("x", 2)), Negative(sin(alpha))), r"M \ddot{x} - \sin \alpha"),
        (times(M, theta), r"M \theta"),
        (times(M, Name("phase")), r"M \, \mathit{phase}"),
        (times(sin(alpha), x), r"\sin(\alpha) x"),
        (times(sin(alpha), sin(theta)), r"\sin \alpha \sin \theta"),
        (square(sin(theta)), r"\sin^{2} \theta"),
        (times(square(sin(theta)), x), r"\sin^{2}(\theta) x"),
        (Power(sin(theta), Negative(TWO)), r"\bigl(\sin \theta\bigr)^{-2}"),
        (times(M, plus(g, R)), r"M \, (g + R)"),
        (times(TWO, number(1, 2)), r"2 \cdot \frac{1}{2}"),
        (square(Negative(x)), r"(-x)^{2}"),
        (Negative(Negative(x)), r"-(-x)"),
        (square(Quotient(x, g)), r"\biggl(\frac{x}{g}\biggr)^{2}"),
        (Power(x, number(1, 2)), "x^{1/2}"),
        (Call("U", (Name("r"),), 1), "U'(r)"),
        (PartialCall("Phi", (1, 2), (x, g)), r"\partial_{1} \partial_{2} \Phi(x, g)"),
        (Diff(square(x), g), r"\frac{\partial}{\partial g} \, (x^{2})"),
        (Diff(x, g), r"\frac{\partial x}{\partial g}"),
        (Rate(Diff(x, g)), r"\frac{d}{dt} \, \frac{\partial x}{\partial g}"),
        (Call("abs", (x,)), r"\lvert x \rvert "),
    ],
)  # fmt: skip
def test_formulas_look_as_in_a_book(node, text):
    assert latex(node).replace(r"\bigl", "").replace(r"\bigr", "") == text.replace(
        r"\bigl", ""
    ).replace(r"\bigr", "")


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("m*(1 - x'^2/c^2)/2", r"\frac{m \, (1 - \dot{x}^{2}/c^{2})}{2}"),
        ("M/(1 + x/2)", r"\frac{M}{1 + x/2}"),
        ("M/(1 + (x/2)*sin(y))", r"\frac{M}{1 + \frac{x}{2} \sin y}"),
        ("M/(1 + (x/g)^2)", r"\frac{M}{1 + (x/g)^{2}}"),
        ("log(x/(M*g))", r"\ln\bigl(x/(M g)\bigr)"),
        ("sin(x)/2 + 1", r"\frac{\sin x}{2} + 1"),
        # a tall fraction within a numerator stands beside the fraction
        (
            "(x^2 + (y - M*g*x^2/(2*R))^2/x^2)/(2*M)",
            r"\frac{1}{2 M} \, \biggl(x^{2} + \frac{\bigl(y - M g x^{2}/(2 R)\bigr)^{2}}{x^{2}}\biggr)",
        ),
        (
            "M*sqrt((g^2*M^2*x + 4*R*y^2)/(x*y*R))/R",
            r"\frac{M}{R} \sqrt{\frac{g^{2} M^{2} x + 4 R y^{2}}{x y R}}",
        ),
        ("sqrt(x)*g", r"\sqrt{x} \, g"),
        ("cos(sin(x)/2)", r"\cos(\sin(x)/2)"),
        ("M*exp(-x/2)", r"M \mathrm{e}^{-x/2}"),
        ("exp(x)^2", r"(\mathrm{e}^{x})^{2}"),
        ("Rc*xc'", r"R_{c} \dot{x}_{c}"),
        ("th + L_xy", r"\mathit{th} + L_{\mathrm{xy}}"),
    ],
)
def test_small_fractions_powers_of_e_and_letters_with_an_index(text, shown):
    assert latex(parse_text(text)) == shown


def test_a_momentum_carries_its_coordinate():
    assert latex(Name("p_theta_1"), coordinates=("theta_1",)) == r"p_{\theta_{1}}"
    assert latex(Name("p_theta"), coordinates=("theta",)) == r"p_{\theta}"


def test_a_symbol_of_the_file_is_used_as_it_is():
    names = {"symbols": {"q": r"\vec{q}^{*}", "w": r"\omega_{0}"}}
    assert latex(square(Name("q")), **names) == r"{\vec{q}^{*}}^{2}"
    assert latex(Name("w", 1), **names) == r"{\dot{\omega}_{0}}"


@pytest.mark.long
@settings(max_examples=300, deadline=None)
@given(expressions)
def test_what_is_printed_means_the_same(node):
    try:
        expected = value(node)
        read = value(read_latex(latex(node)))
    except (ZeroDivisionError, OverflowError):
        assume(False)
    assume(cmath.isfinite(expected) and 1e-100 < abs(expected) < 1e100)
    assert cmath.isclose(read, expected, rel_tol=1e-6)


@pytest.mark.long
@settings(max_examples=100, deadline=None)
@given(st.lists(expressions, min_size=4, max_size=8))
def test_what_is_broken_over_lines_means_the_same(terms):
    node = Quotient(times(*terms), plus(*terms))
    (display,) = LatexDisplay(LatexPrinter()).equations(Equations((Row(x, node),)))
    lines = lines_of(display)
    whole = " ".join(lines).removeprefix("x &= ")
    try:
        expected = value(node)
        read = value(read_latex(whole))
    except (ZeroDivisionError, OverflowError):
        assume(False)
    assume(cmath.isfinite(expected) and 1e-100 < abs(expected) < 1e100)
    assert cmath.isclose(read, expected, rel_tol=1e-4)


def test_no_kind_of_node_is_forgotten():
    for node in ONE_OF_EACH.values():
        assert latex(node)


def test_nothing_unbreakable_is_too_wide():
    wide = Quotient(Call("sqrt", (long_sum,)), Power(x, Quotient(long_sum, long_sum)))
    pieces = LatexPrinter().show(times(wide, wide)).pieces
    assert max(piece.width for piece in pieces) <= WIDEST + 10


def test_what_fits_into_a_fraction_stands_before_a_long_bracket():
    """3 r ( ... ) / (l M) is 3 r / (l M) times the bracket, not 1 / (l M) times all of it."""
    wide = rf"\bigl({latex(long_sum)}\bigr)"
    ratio = r"\frac{3 R}{g M}"
    assert latex(Quotient(times(number(3), R, long_sum), times(g, M))) == rf"{ratio} \, {wide}"
    behind = Quotient(times(number(3), R, long_sum, x), times(g, M))
    assert latex(behind) == rf"{ratio} \, {wide} x"
    first = Quotient(times(long_sum, R), times(g, M))
    assert latex(first) == rf"\frac{{1}}{{g M}} \, {wide} R"


@pytest.mark.parametrize(
    "text", ["\\input{x}", "$x$", "a_b^c", "50% #1 & ~", "é Ÿ ñ θ ж 中", '--`<>|"']
)
def test_text_cannot_be_a_command(text):
    shown = latex_text(text)
    assert shown.isascii()
    assert not re.search(r"(?<!\\)[&#%_]", shown)
    assert r"\input" not in shown


def test_the_fragment_has_no_preamble_and_the_document_has():
    assert "documentclass" not in render([HOOP], Options())
    whole = render([HOOP], Options(standalone=True))
    assert whole.startswith(r"\documentclass{article}")
    assert re.findall(r"\\usepackage\{(.*?)\}", whole) == ["amsmath"]


def compiled(text, folder):
    (folder / "page.tex").write_text(text, encoding="ascii")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    done = subprocess.run(
        [*command, "page.tex"], cwd=folder, capture_output=True, timeout=100, check=False
    )
    log = (folder / "page.log").read_text(encoding="latin-1")
    assert done.returncode == 0, log[-3000:]
    overfull = [float(points) for points in re.findall(r"Overfull \\hbox \(([0-9.]+)pt", log)]
    assert max(overfull, default=0) < 10, log[-3000:]


class TestPdflatex:
    pytestmark = needs_latex

    def test_every_section_compiles_and_fits(self, tmp_path):
        compiled(render([HOOP, HOSTILE], Options(standalone=True)), tmp_path)

    def test_a_fragment_compiles_where_it_is_input(self, tmp_path):
        (tmp_path / "part.tex").write_text(render([HOOP], Options()), encoding="ascii")
        compiled(
            "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n"
            "\\input{part}\n\\end{document}\n",
            tmp_path,
        )

    def test_hostile_formulas_compile_and_fit(self, tmp_path):
        deep = x
        for _ in range(25):
            deep = (
                Quotient(plus(deep, g), square(plus(theta, Negative(deep))))
                if _ < 6
                else sin(plus(deep, times(M, Name("длина", 2))))
            )
        formulas = [
            Quotient(long_sum, long_sum),
            Power(long_sum, long_sum),
            Call("sqrt", (Quotient(Call("sqrt", (long_sum,)), square(long_sum)),)),
            Power(Call("sqrt", (long_sum,)), Quotient(TWO, number(3))),
            Call("abs", (times(long_sum, Call("atan2", (long_sum, x))),)),
            Diff(long_sum, Name("theta_1", 1)),
            number(7**2000, 3),
            times(*(sin(Name(f"omega_{i}")) for i in range(60))),
            Power(Power(Name("x_1", 3), TWO), number(1, 2)),
            square(Name("q")),
            deep,
        ]
        answers = [
            Answers(
                title="%$#",
                coordinates=("x",),
                parameters=("é", "ab_ç", "_", "q"),
                degrees_of_freedom=1,
                symbols={"q": r"\mathbb{Q}'"},
                sections={"lagrangian": LagrangianSection(lagrangian=formula)},
            )
            for formula in formulas
        ]
        compiled(render(answers, Options(standalone=True)), tmp_path)


def test_no_page_break_divides_an_equation_that_is_not_very_long():
    environments = Environments(LatexOptions())
    lines = ["L &= x", *("& + x",) * 3]
    text = "\n".join(environments.set([Set(x, lines), Set(g, ["g &= x"])]))
    assert text.count(r" \\*") == 3
    assert "& + x \\\\\ng &= x" in text
    long = "\n".join(environments.set([Set(x, ["L &= x", *("& + x",) * 80])]))
    assert r"\\*" not in long


def test_left_sides_are_broken_too():
    rows = (Row(x, g), Row(long_sum, x))
    first, second = map(lines_of, LatexDisplay(LatexPrinter()).equations(Equations(rows)))
    assert first == ["x &= g"]
    assert all(line.startswith("&") for line in second)


def test_every_character_that_the_program_or_the_library_uses_has_a_notation():
    """A missing one came out as its code point in brackets: every string of the package."""
    package = Path(lagcli.__file__).parent
    texts = [path.read_text(encoding="utf-8") for path in package.rglob("*.py")]
    texts += [
        path.read_text(encoding="utf-8") for path in (package.parent / "problems").rglob("*.yaml")
    ]
    characters = sorted({c for text in texts for c in text if ord(c) > 127})
    assert "≤" in characters
    for character in characters:
        shown = latex_text(character)
        assert shown.isascii()
        assert "[U+" not in shown


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("g ≤ R ω²", r"g $\le$ R $\omega$$^{\text{2}}$"),
        ("½ m", "1/2 m"),
        ("x₁ ≥ 0", r"x$_{\text{1}}$ $\ge$ 0"),
        ("漢", "(cjk unified ideograph-6f22)"),
    ],
)
def test_signs_and_letters_without_a_type(text, expected):
    assert latex_text(text) == expected


def test_a_line_breaks_between_a_fraction_and_a_bracket_rather_than_inside_it():
    """The rate of a momentum of the double pendulum."""
    node = parse_text(
        "((m1 + m2)*l1*p2 - m2*l2*p1*cos(x - y))*(l2*p1 - l1*p2*cos(x - y))*sin(x - y)"
        "/(l1^2*l2^2*(m1 + m2*sin(x - y)^2)^2) - m2*g*l2*sin(y)"
    )
    lines = break_lines(LatexPrinter().show(node).pieces, TEXT_WIDTH, TEXT_WIDTH)
    assert len(lines) > 1
    assert all(line.text.count(r"\bigl") == line.text.count(r"\bigr") for line in lines)


@pytest.mark.parametrize("terms", [1, 2, 3])
def test_a_fraction_that_a_line_can_hold_is_one(terms: int) -> None:
    """Also where it is wider than a fraction within a bracket may be; beside other terms too."""
    fraction = "g*(a*sin(u) - b*sin(w))/((M + a + b)*(M + b) - (M*cos(u) + M*cos(w))^2)"
    node = parse_text(" - ".join([fraction, *("x", "y")[: terms - 1]]))
    (display,) = LatexDisplay(LatexPrinter()).equations(Equations((Row(x, node),)))
    whole = "".join(lines_of(display))
    assert LatexPrinter().show(node).text.count("^{-1}") == 1
    assert "^{-1}" not in whole
    assert r"\frac{g \, (a \sin u - b \sin w)}" in whole
    within = LatexPrinter().line(parse_text(f"k*(x + {fraction})^2"), TEXT_WIDTH)
    assert "^{-1}" in within.text
