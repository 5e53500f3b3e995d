"""Mirror images and pairs of roots are written once."""

from __future__ import annotations

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.reader.expressions import parse_text
from lagcli.statements.plus_minus import pairs, single


@pytest.mark.parametrize(
    ("one", "other", "both"),
    [
        ("-acos(g/a)", "acos(g/a)", "+/-acos(g/a)"),
        ("(a - sqrt(b))/m", "(a + sqrt(b))/m", "(a +/- sqrt(b))/m"),
        ("(sqrt(b) - a)*c", "(a - sqrt(b))*c", "+/-(a - sqrt(b))*c"),
        ("a*sqrt(g - c)", "-a*sqrt(g - c)", "+/-a*sqrt(g - c)"),
    ],
)
def test_two_roots_are_one_row(one, other, both):
    for rows in ((one, other), (other, one)):
        (shown,) = map(to_grammar, single(map(parse_text, rows)))
        assert shown in {both, "+/-(sqrt(b) - a)*c"}


@pytest.mark.parametrize(("one", "other"), [("a", "b"), ("a - b", "a + c"), ("a*b", "-a*c")])
def test_others_stay_two_rows(one, other):
    assert len(single(map(parse_text, (one, other)))) == 2


def test_upper_signs_belong_together():
    states = [
        ({"x": parse_text("-a"), "y": parse_text("b")}, "stable"),
        ({"x": parse_text("a"), "y": parse_text("-b")}, "stable"),
        ({"x": parse_text("-a"), "y": parse_text("-b")}, "unstable"),
        ({"x": parse_text("0")}, "stable"),
    ]
    ((at, _), *others) = pairs(states)
    assert {name: to_grammar(value) for name, value in at.items()} == {"x": "+/-a", "y": "-/+b"}
    assert len(others) == 2
