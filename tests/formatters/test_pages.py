"""Markdown and HTML: the same mathematics, and nothing of the file acts on the page."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings

from lagcli.formatters import html, markdown
from lagcli.formatters.mathml import MathmlPrinter, mathml_name
from lagcli.formatters.options import Options

from .examples import HOOP, HOSTILE, g, plus, sin, square, times, x
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


@settings(max_examples=200, deadline=None)
@given(expressions)
def test_mathml_is_well_formed_and_every_slot_is_filled(node):
    tree = ET.fromstring(f"<math>{MathmlPrinter().show(node)}</math>")
    slots = {"msup": 2, "msub": 2, "mfrac": 2, "mover": 2}
    for element in tree.iter():
        if element.tag in slots:
            assert len(element) == slots[element.tag]


def test_no_kind_of_node_is_forgotten():
    for node in ONE_OF_EACH.values():
        assert MathmlPrinter().show(node)


def test_mathml_brackets():
    shown = MathmlPrinter().show(times(x, plus(x, g)))
    assert "<mo>(</mo><mrow><mi>x</mi><mo>+</mo><mi>g</mi></mrow><mo>)</mo>" in shown
    assert MathmlPrinter().show(square(sin(x))).startswith("<mrow><msup><mi>sin</mi>")


def test_mathml_names():
    assert mathml_name("theta_1", 1) == (
        "<msub><mover accent='true'><mi>θ</mi><mo>˙</mo></mover><mrow><mn>1</mn></mrow></msub>"
    )
