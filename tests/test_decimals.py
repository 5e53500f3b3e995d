"""Constants worked out, each product with one decimal number in front."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lagcli.decimals import value_of, with_decimals
from lagcli.expression import Negative, Number
from lagcli.formatters.grammar import to_grammar
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


@given(st.fractions(max_denominator=10**6).filter(lambda x: x >= 0))
def test_a_decimal_is_near_and_reads_back(value):
    node = with_decimals(Number(value))
    assert isinstance(node, Number)
    assert abs(node.value - value) <= abs(value) / 10**14
    digits = to_grammar(node)
    assert value_of(parse_text(digits)) == node.value


def test_signs_are_nodes():
    assert with_decimals(Negative(Number(Fraction(1, 2)))) == Negative(Number(Fraction(1, 2)))
