"""Mistakes in the expectations of `algebra`, each with its place."""

from __future__ import annotations

import pytest

from lagcli.reader import read_problem

HEAD = "coordinates: [x]\nparameters: [k]\nL: x'^2/2 - k*x^2/2\nexpect: {algebra: "


@pytest.mark.parametrize(
    ("expect", "message", "column"),
    [
        ("{dimensions: 1}", "unknown key 'dimensions' in 'algebra'", 20),
        ("{independent: two}", "'independent' is a whole number, 0 or more", 33),
        ("{integrable: maybe}", "'integrable' has no value 'maybe'", 32),
        ("{special: k = 0}", "'special' must be a list, not a text", 29),
        ("{special: [{charges: 5}]}", "a special value needs 'where', such as where: n = -1", 30),
        ("{special: [{where: k = 0, charges: -1}]}", "'charges' is a whole number, 0 or more", 54),
        ("{special: [{where: k = x}]}", "the coordinate x cannot stand in the special value", 42),
        ("{special: [{where: j = 0}]}", "unknown name 'j' in the special value", 38),
    ],
)
def test_each_mistake_is_named_where_it_stands(expect, message, column):
    [found] = read_problem("test.yaml", (HEAD + expect + "}\n").encode()).diagnostics
    assert found.message == message
    assert (found.span.line, found.span.column) == (4, column)


def test_all_keys_are_read():
    text = (
        "{dimension: 5, name: sch(1), independent: 2, in_involution: 1, integrable: yes, "
        "special: [{where: k = 0, charges: 5, discovered: {momentum: x'}}]}}\n"
    )
    algebra = read_problem("test.yaml", (HEAD + text).encode()).checked().expect.algebra
    assert algebra is not None
    assert (algebra.dimension, algebra.independent, algebra.in_involution) == (5, 2, 1)
    assert algebra.name == "sch(1)"
    assert algebra.integrable is True
    [special] = algebra.special
    assert special.charges == 5
    assert set(special.discovered) == {"momentum"}
