"""Sums of fractions that the file has: ellipsoids and their like."""

from __future__ import annotations

import random

import pytest

from lagcli.expression import Expression, Name, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.values import Floats, Program
from lagcli.notation.ordering import Ordering
from lagcli.notation.reciprocals import GivenFractions
from lagcli.pipeline import Request, derive, read, state
from lagcli.reader import parse_text

ORDER = Ordering(("m", "a", "b", "c", "t", "x", "y", "z"))


def value(tree: Expression, values: dict[str, float]) -> float:
    (number,) = Program([GraphReader(Graph(), (), {})(tree)], Floats())(values)
    return number


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        ("x/(b^2*x^2 + a^2*y^2)", None),
        ("a^4*b^4*m*x/(b^4*x^2 + a^4*y^2)", "m*x/(x^2/a^4 + y^2/b^4)"),
        ("b^4*m*x/(b^4*x^2 + a^4*y^2)", "b^4*m*x/(b^4*x^2 + a^4*y^2)"),
        ("a^2*c^2*y/(b^4*c^4*x^2 + a^4*(c^4*y^2 + b^4*z^2))", None),
        ("m*(b*x + a*y)/(a*b)", "m*(x/a + y/b)"),
        ("x/(a*b + y)", None),  # not a sum of that kind
        ("x*(a^2 - b^2)/m", None),
    ],
)
def test_what_is_shorter_with_fractions_has_them(formula, shown):
    tree = parse_text(formula)
    written = GivenFractions([parse_text("x^2/a^2 + y^2/b^2 + z^2/c^2 - 1")], ORDER)(tree)
    chance = random.Random(3)
    values = {n.name: chance.uniform(0.5, 2) for n in walk(tree) if isinstance(n, Name)}
    assert value(written, values) == pytest.approx(value(tree, values))
    if shown is not None:
        assert to_grammar(written) == shown


@pytest.mark.parametrize("power", [2, 4])
def test_the_ellipsoid_of_jacobi_prefers_no_axis(power):
    """Geodesics: Arnold, Mathematical Methods of Classical Mechanics, section 47.D."""

    def multiplier(axes: str, coordinates: str) -> str:
        surface = " + ".join(
            f"{q}^{power}/{a}^{power}" for q, a in zip(coordinates, axes, strict=True)
        )
        text = (
            "title: t\ncoordinates: [x, y, z]\nparameters: {m: {assume: positive}, "
            "a: {assume: positive}, b: {assume: positive}, c: {assume: positive}}\n"
            f"T: m*(x'^2 + y'^2 + z'^2)/2\nconstraints: {{s: {surface} = 1}}\n"
        )
        problem = read("t.yaml", text.encode()).problem
        found = state(derive(problem), Request(sections=("multipliers",))).sections["multipliers"]
        (found_,) = found.multipliers.values()
        return to_grammar(found_.value)

    if power == 2:
        shown = "-m*(x'^2/a^2 + y'^2/b^2 + z'^2/c^2)/(2*(x^2/a^4 + y^2/b^4 + z^2/c^4))"
        assert multiplier("abc", "xyz") == shown
    one, other = multiplier("abc", "xyz"), multiplier("bac", "xyz")
    turned = one.translate(str.maketrans("ab", "ba"))
    assert sorted(turned.replace("(", " ").replace(")", " ").split()) == sorted(
        other.replace("(", " ").replace(")", " ").split()
    )


def test_a_file_without_such_sums_is_left_alone():
    tree = parse_text("x/(b^2*x^2 + a^2*y^2)")
    assert GivenFractions([parse_text("m*x^2/a + m*y")], ORDER)(tree) is tree
