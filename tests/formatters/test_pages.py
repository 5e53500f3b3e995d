"""Markdown and HTML: the same mathematics, and nothing of the file acts on the page."""

from __future__ import annotations

import re
from importlib import import_module
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings

from lagcli.document import Document, Equations, Paragraph, Row
from lagcli.expression import Call, Name, Negative, Power, Quotient
from lagcli.formatters.built_in import html, markdown
from lagcli.formatters.mathml import MathmlPrinter, mathml_name
from lagcli.formatters.options import Options
from lagcli.reader.expressions import parse_text
from lagcli.record import replace
from lagcli.statements.answers import (
    EquilibriaSection,
    Equilibrium,
    LagrangianSection,
    Multiplier,
    MultipliersSection,
)
from lagcli.statements.motions import Verdict

from .examples import HOOP, HOSTILE, g, long_sum, number, plus, sin, square, times, x
from .strategies import expressions
from .test_grammar import ONE_OF_EACH

MARKDOWN = markdown.render([HOOP, HOSTILE], Options())
HTML = html.render([HOOP, HOSTILE], Options())


def test_markdown_displays_the_same_latex():
    assert MARKDOWN.startswith("# Hoop rolling without slipping down an incline\n\n")
    assert r"L &= \frac{M \dot{x}^{2}}{2} + \frac{M R^{2} \dot{\theta}^{2}}{2}" in MARKDOWN
    assert MARKDOWN.count("$$") % 2 == 0


def test_no_line_of_a_display_starts_a_list_or_a_heading():
    for display in MARKDOWN.split("$$")[1::2]:
        for line in display.strip().splitlines():
            assert not re.match(r"\s*([-+*#>=]|\d+[.)]|$)", line), line


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("<script>", "&lt;script&gt;"),
        ("[a](b) *c* _d_ `e`", r"\[a\](b) \*c\* \_d\_ \`e\`"),
        ("$x$ & @you", "&#36;x&#36; &amp; &#64;you"),
        ("# one\n# two", r"\# one \# two"),
        (":smile: a: b", "&#58;smile: a: b"),
        ("\x1b[0m", r"\\u\{1b\}\[0m"),
    ],
)
def test_markdown_escapes(text, shown):
    assert markdown.escaped(text) == shown


def test_html_is_well_formed_and_runs_nothing():
    page = html.render([HOOP, HOSTILE], Options(standalone=True))
    body = page[page.index("<body>") : page.index("</body>") + 7]
    tree = ET.fromstring(body)
    names = {element.tag for element in tree.iter()}
    assert "math" in names
    assert not names & {"script", "b", "img", "a"}
    assert "<title>" in page
    assert "&lt;b&gt;" in page


def test_a_fragment_is_no_page():
    assert HTML.startswith("<article>")
    assert "<html" not in HTML


@pytest.mark.long
@settings(max_examples=200, deadline=None)
@given(expressions)
def test_mathml_is_well_formed_and_every_slot_is_filled(node):
    tree = ET.fromstring(f"<math>{MathmlPrinter().show(node)}</math>")
    slots = {"msup": 2, "msub": 2, "msubsup": 3, "mfrac": 2, "mover": 2}
    for element in tree.iter():
        if element.tag in slots:
            assert len(element) == slots[element.tag]


def test_no_kind_of_node_is_forgotten():
    for node in ONE_OF_EACH.values():
        assert MathmlPrinter().show(node)


def test_mathml_brackets():
    shown = MathmlPrinter().show(times(x, plus(x, g)))
    inner = "<mrow><mi>x</mi><mo>+</mo><mi>g</mi></mrow>"
    assert f"<mo stretchy='false'>(</mo>{inner}<mo stretchy='false'>)</mo>" in shown
    high = MathmlPrinter().show(times(x, plus(x, Quotient(g, x))))
    assert "<mo>(</mo>" in high
    assert MathmlPrinter().show(square(sin(x))).startswith("<mrow><msup><mi>sin</mi>")


def test_an_index_and_a_power_stand_above_each_other():
    shown = MathmlPrinter().show(square(Name("theta_1")))
    assert shown == "<msubsup><mi>θ</mi><mrow><mn>1</mn></mrow><mn>2</mn></msubsup>"
    half = MathmlPrinter().show(Power(x, Negative(Quotient(number(3), number(2)))))
    assert "<mfrac>" not in half


def test_a_function_does_not_run_into_the_factor_before():
    assert "<mspace width='0.17em'/>" in MathmlPrinter().show(times(g, sin(x)))


def test_markdown_has_only_what_github_takes():
    """GitHub refuses \\operatorname; MathJax shows an escape within \\text as it stands."""
    root = Call("asinh", (Name("x_a_b"),))
    page = replace(
        HOOP,
        sections={
            "lagrangian": LagrangianSection(lagrangian=root),
            "multipliers": MultipliersSection(
                multipliers={"no_slip": Multiplier(symbol="N", value=x, kind="holonomic")}
            ),
        },
    )
    shown = markdown.render([page, HOSTILE], Options())
    assert r"\mathop{\mathrm{arsinh}}" in shown
    assert "operatorname" not in shown
    assert r"\text{(no}\_\text{slip: holonomic)}" in shown
    assert not re.search(r"\\text\{[^}]*\\_", shown)


def test_no_inline_formula_has_an_escape_or_emphasis():
    answers = replace(
        HOOP,
        coordinates=("theta_1", "theta_2"),
        sections={
            "equilibria": EquilibriaSection(
                equilibria=(
                    Equilibrium(
                        at={"x_1": times(g, Name("theta_2", 1))}, verdict=Verdict(stable=True)
                    ),
                )
            ),
        },
    )
    shown = markdown.render([answers], Options())
    for formula in re.findall(r"\$([^$\n]+)\$", shown):
        assert not re.search(r"\\[^A-Za-z]", formula)
        assert "}_{" not in formula


def test_mathml_names():
    assert mathml_name("theta_1", 1) == (
        "<msub><mover accent='true'><mi>θ</mi><mo style='padding-bottom: 0.1em'>˙</mo></mover>"
        "<mrow><mn>1</mn></mrow></msub>"
    )


def test_no_line_of_a_page_ends_before_a_full_stop_or_a_sign():
    parts = ("it equals ", Name("T"), " + ", Name("V"), ", and ", Name("h"), " is ", Name("L"))
    page = html.pages([Document("Page", (Paragraph((*parts, ".")),))], Options())
    kept = re.findall(r'<span style="white-space: nowrap">(.*?)</span>', page)
    assert [re.sub("<[^>]*>", "", text) for text in kept] == ["T + V,", "L."]


def test_a_sign_at_the_start_of_a_row_keeps_its_distance():
    row = Row(x, plus(*long_sum.terms, Negative(g)))
    page = "".join(html.pages([Document("Page", (Equations((row,)),))], Options()).split())
    begun = re.findall(r"<mspacewidth='1em'/><mrow>(<mo[^>]*>[+−]?)", page)
    assert begun
    assert set(begun) <= {"<moform='infix'>+", "<moform='infix'>−"}


def test_keys_are_code():
    page = html.pages([Document("Page", (Paragraph(("no `points` & <b>",)),))], Options())
    assert "<p>no <code>points</code> &amp; &lt;b&gt;</p>" in page


def test_a_wide_fraction_goes_over_several_rows():
    text = "x = (" + " + ".join(f"m*g*sin(x + {k}*y)*cos(y)" for k in range(2, 9)) + ")/(M + m)"
    left, right = map(parse_text, text.split(" = "))
    rows = list(html._row(Row(left, right), MathmlPrinter()))
    assert len(rows) > 1
    whole = "".join(rows)
    assert whole.count("(</mo>") == whole.count(")</mo>")
    assert whole.count("<mfrac>") == 1
    ET.fromstring(f"<mtable>{whole}</mtable>")


@pytest.mark.parametrize("sign", ["=", ">", "<", "≤", "≥", "≠", "+", "−"])
@pytest.mark.parametrize("module", ["latex", "markdown"])
def test_a_relation_in_a_sentence_is_one_formula(sign: str, module: str) -> None:
    """$g > R w^2$, which an author can paste, not $g$ > $R w^2$; words stay words."""
    a, b = Name("a"), Name("b")
    paragraph = Paragraph(("For ", a, f" {sign} ", b, ", and where ", a, " is = ", b, "."))
    document = Document("t", (paragraph,), ("a", "b"))
    page = import_module(f"lagcli.formatters.built_in.{module}").pages([document], Options())
    [line] = [line for line in page.splitlines() if "For" in line]
    assert line.count("$") == 6
    assert "a$" not in line.partition(",")[0]
