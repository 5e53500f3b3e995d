"""Mirror images and pairs of roots are written once."""

from __future__ import annotations

import random

import numpy as np
import pytest

from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import Expression, Negative, PlusMinus
from lagcli.formatters.grammar import to_grammar
from lagcli.reader import read_problem
from lagcli.reader.expressions import parse_text
from lagcli.rewriting import rebuilt
from lagcli.statements.plus_minus import modes_in_pairs, pairs, single
from tests.solved import solve


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


def reading(node: Expression, upper: bool) -> Expression:
    if isinstance(node, PlusMinus):
        return node.operand if upper != node.minus_above else Negative(node.operand)
    return rebuilt(node, lambda part: reading(part, upper))


@pytest.mark.first_quick
@pytest.mark.parametrize("seed", range(4))
def test_two_frequencies_with_their_shapes_are_one_row(seed):
    """M x'' + K x = 0, against the eigenvalues of random members."""
    draw = random.Random(seed)
    a, b = draw.sample(range(1, 8), 2)
    text = f"""
        coordinates: [x, y]
        parameters: {{m: {{assume: positive}}, M: {{assume: positive}}, k: {{assume: positive}}, c: {{assume: positive}}}}
        T: m*x'^2/2 + {a}*M*y'^2/2
        V: k*x^2/2 + {b}*k*y^2/2 + c*(x - y)^2/2
    """
    problem = read_problem("two.yaml", text.encode()).checked()
    (mode,) = modes_in_pairs(solve(problem, ["modes"]).sections["modes"].modes)
    values = {name: draw.uniform(0.5, 2) for name in ("m", "M", "k", "c")}
    m, M, k, c = values.values()
    squares, shapes = np.linalg.eig([[(k + c) / m, -c / m], [-c / (a * M), (b * k + c) / (a * M)]])
    known = sorted((w**0.5, y / x) for w, (x, y) in zip(squares, shapes.T, strict=True))
    found = sorted(
        tuple(
            evaluated(reading(node, upper), values, FUNCTIONS)
            for node in (mode.frequency, mode.shape["y"])
        )
        for upper in (True, False)
    )
    assert np.allclose(found, known, rtol=1e-9)
