"""Constants worked out, each product with one decimal number in front."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lagcli.evaluation import value_of
from lagcli.expression import Negative, Number
from lagcli.formatters.grammar import to_grammar
from lagcli.notation.decimals import GivenDecimals, with_decimals
from lagcli.notation.given_formulas import decimals_of
from lagcli.pipeline import read
from lagcli.reader import parse_text


@pytest.mark.parametrize(
    ("written", "decimal"),
    [
        ("981/200*cos(x)", "4.905*cos(x)"),
        ("x/4", "0.25*x"),
        ("-(2*x)/(3*y)", "-0.666666666666667*x/y"),
        ("x/(y/2)", "2*x/y"),
        ("1/2 + x + 1/4", "0.75 + x"),
        ("x + 1 - 1", "x"),
        ("sqrt(2)*x^2", "1.4142135623731*x^2"),
        ("sin(pi/6)*x", "0.5*x"),
        ("U(x/2)", "U(0.5*x)"),
        ("(x + 1/2)^(1/2)", "(x + 0.5)^0.5"),
        ("log(-1)*x", "log(-1)*x"),
    ],
)
def test_with_decimals(written, decimal):
    assert to_grammar(with_decimals(parse_text(written))) == decimal


@pytest.mark.long
@given(st.fractions(max_denominator=10**6).filter(lambda x: x >= 0))
def test_a_decimal_is_near_and_reads_back(value):
    node = with_decimals(Number(value))
    assert isinstance(node, Number)
    assert abs(node.value - value) <= abs(value) / 10**14
    digits = to_grammar(node)
    assert value_of(parse_text(digits)) == node.value


def test_signs_are_nodes():
    assert with_decimals(Negative(Number(Fraction(1, 2)))) == Negative(Number(Fraction(1, 2)))


@pytest.mark.parametrize(
    ("formula", "value", "written"),
    [
        ("981*sin(x)/500", "9.81", "1.962*sin(x)"),
        ("m*v^2/2 - 981*m*x/100", "9.81", "m*v^2/2 - 9.81*m*x"),
        ("-981*x/700", "9.81", "-9.81*x/7"),
        ("(100*a + 981*b)/(100*c)", "9.81", "(a + 9.81*b)/c"),
        ("x/4", "0.25", "0.25*x"),
        ("x^(3/2)", "9.81", "x^(3/2)"),
        ("(100*a + 981*b)/(981*c)", "9.81", "(a + 9.81*b)/(9.81*c)"),
        ("sqrt((1829 - sqrt(1535381))/(26*m))/5", "9.81", "sqrt(0.907530894026184/m)"),
        ("14831493750*x/1319003000", "9.81", "11.2444730982416*x"),
        ("(1 + sqrt(33))*x/8", "9.81", "(1 + sqrt(33))*x/8"),
        ("x/3 + sqrt(981*l/100)", "9.81", "x/3 + sqrt(9.81*l)"),
    ],
)
def test_what_was_given_with_a_decimal_point_is_answered_so(formula, value, written):
    write = GivenDecimals([Fraction(value)])
    assert to_grammar(write(parse_text(formula))) == written


def test_without_decimals_nothing_changes():
    assert not GivenDecimals([])
    problem = read("t.yaml", b"coordinates: [x]\nparameters: [g]\nT: 0.5*x'^2\nV: g*x/4\n").problem
    assert decimals_of(problem, ["g=2", "k=1/3", "m = 2.50"]) == [Fraction(1, 2), Fraction(5, 2)]
