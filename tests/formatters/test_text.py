"""The text formatter: readable, within the width, harmless to a terminal."""

from __future__ import annotations

from dataclasses import replace

import pytest

from lagcli.expression import Call, Name, Negative, Sum
from lagcli.formatters.built_in.text import render
from lagcli.formatters.display_width import display_width
from lagcli.formatters.layout import break_lines, joined
from lagcli.formatters.options import Options
from lagcli.formatters.unicode import UnicodePrinter, unicode_name
from lagcli.reader.expressions import parse_text
from lagcli.statements.answers import LagrangianSection

from .examples import (
    HOOP,
    HOSTILE,
    TWO,
    M,
    R,
    g,
    kinetic_x,
    minus_half,
    number,
    plus,
    sin,
    square,
    times,
    x,
)


def shown(node):
    return joined(UnicodePrinter().show(node))


@pytest.mark.parametrize(
    ("name", "primes", "text"),
    [
        ("x", 1, "ẋ"),
        ("theta", 2, "θ̈"),
        ("theta_1", 1, "θ̇₁"),
        ("theta_1", 0, "θ₁"),
        ("x1", 0, "x₁"),
        ("lambda_rolling", 0, "λ_rolling"),
        ("p_theta_1", 0, "p_θ₁"),
        ("phase", 2, "phase″"),
        ("x", 3, "x‴"),
        ("_x", 0, "_x"),
    ],
)
def test_names_are_read_as_on_paper(name, primes, text):
    assert unicode_name(name, primes) == text


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (kinetic_x, "M ẋ²/2"),
        (minus_half, "−M g sin(α)/2"),
        (times(number(1, 2), M, square(x)), "½ M x²"),
        (times(number(1, 3), M), "(1/3) M"),
        (times(TWO, number(3), x), "2·3 x"),
        (square(sin(x)), "sin²(x)"),
        (times(M, plus(g, R)), "M (g + R)"),
        (square(square(x)), "(x²)²"),
        (times(TWO, Call("sqrt", (number(5),)), x), "2 √5 x"),
        (square(Call("sqrt", (number(5),))), "(√5)²"),
        (Call("sqrt", (number(1, 2),)), "√(1/2)"),
        (times(TWO, Call("sqrt", (x,))), "2 √x"),
    ],
)
def test_formulas_are_read_without_doubt(node, text):
    assert shown(node) == text


def test_bars_are_those_of_one_modulus():
    inside = Call("abs", (Sum((Name("x"), Negative(Name("a")))),))
    assert shown(inside) == "|x − a|"
    assert shown(Call("abs", (Sum((inside, Name("b"))),))) == "abs(|x − a| + b)"


@pytest.mark.long
@pytest.mark.parametrize("width", [30, 40, 60, 80, 200])
@pytest.mark.parametrize("unicode", [True, False])
def test_no_line_is_wider_than_asked(width, unicode):
    for line in render([HOOP, HOSTILE], Options(width=width, unicode=unicode)).splitlines():
        assert display_width(line) <= width, line


@pytest.mark.parametrize("width", [1, 7, 15])
def test_any_width_is_survived(width):
    assert render([HOOP, HOSTILE], Options(width=width))


def test_ascii_is_ascii():
    assert render([HOOP, HOSTILE], Options(unicode=False)).isascii()


def test_nothing_reaches_the_terminal_that_it_would_act_upon():
    printed = render([HOSTILE], Options())
    assert "\x1b" not in printed
    assert "\u202e" not in printed


def test_wide_characters_take_two_columns():
    assert [display_width(text) for text in ("ẋ", "θ̈", "中文", "ab")] == [1, 1, 4, 2]


def test_every_section_is_there():
    printed = render([HOOP], Options())
    for words in (
        "L = M ẋ²/2 + M R² θ̇²/2 − M g (l − x) sin(α)",
        "verified exactly",
        "at random states to 50 digits",
        "Q̇  = M R g sin(α)/2",
        "50 digits, because of",
        "(rolling: holonomic)",
        "θ = arccos(4/7)",
    ):
        assert words in printed


def test_a_name_is_never_broken():
    names = [Name("a" * 50 + str(i)) for i in range(3)]
    answers = replace(HOOP, sections={"lagrangian": LagrangianSection(lagrangian=plus(*names))})
    printed = render([answers], Options(width=60, unicode=False))
    assert all(name.name in printed for name in names)


def test_functions_in_functions_and_long_numbers_fit():
    deep = x
    for _ in range(60):
        deep = sin(plus(deep, g))
    for node in (deep, sin(sin(sin(sin(sin(sin(sin(deep))))))), number(7**300)):
        answers = replace(HOOP, sections={"lagrangian": LagrangianSection(lagrangian=node)})
        for line in render([answers], Options(width=40)).splitlines():
            assert display_width(line) <= 40


#: Of the double pendulum: two brackets over a denominator, a Hamiltonian.
RATE = (
    "(m2*l2*p1*cos(x - y) - (m1 + m2)*l1*p2)*(l1*p2*cos(x - y) - l2*p1)*sin(x - y)"
    "/(l1^2*l2^2*(m1 + m2*sin(x - y)^2)^2) - m2*g*l2*sin(y)"
)
HAMILTONIAN = (
    "(m2*l2^2*p1^2 - 2*m2*l1*l2*p1*p2*cos(x - y) + (m1 + m2)*l1^2*p2^2)"
    "/(2*m2*l1^2*l2^2*(m1 + m2*sin(x - y)^2)) - (m1 + m2)*g*l1*cos(x)"
)


@pytest.mark.parametrize("formula", [RATE, HAMILTONIAN])
@pytest.mark.parametrize("width", [64, 74])
def test_a_line_breaks_outside_of_brackets_that_fit_into_it(formula, width):
    lines = break_lines(UnicodePrinter().show(parse_text(formula)), width, width)
    assert len(lines) > 1
    assert all(line.text.count("(") == line.text.count(")") for line in lines)
