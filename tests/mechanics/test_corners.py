"""Rest of one coordinate at a corner of V: the verdict against V on both sides of it."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from random import Random

import pytest

from lagcli import loads
from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import Expression
from lagcli.pipeline import Request, derive, state

NEAR = Fraction(1, 10**6)


def drawn(rng: Random) -> tuple[str, Callable[[Fraction], Fraction]]:
    """A potential with a corner, as text and as a function of exact numbers."""
    a, b = rng.choice([0, 1, 2]), rng.choice([-2, -1, 1, 3])
    return rng.choice(
        [
            (f"{b}*abs({a} - abs(x))", lambda x: b * abs(a - abs(x))),
            (f"{b}*(x - {a})*abs(x - {a})", lambda x: b * (x - a) * abs(x - a)),
            (f"{b}*abs(x^2 - {a})", lambda x: b * abs(x**2 - a)),
            (f"abs(x)^3 + {b}*abs(x)^2", lambda x: abs(x) ** 3 + b * x**2),
            (f"{b}*abs(x)*(x - {a})^2", lambda x: b * abs(x) * (x - a) ** 2),
            (f"x^4 + {b}*x^2*abs(x)", lambda x: x**4 + b * x**2 * abs(x)),
            (f"abs(x^2 + {b}*abs(x))", lambda x: abs(x**2 + b * abs(x))),
        ]
    )


def number(node: Expression) -> Fraction:
    return Fraction(evaluated(node, {}, FUNCTIONS)).limit_denominator(10**9)


@pytest.mark.parametrize("seed", range(16))
def test_a_corner_is_judged_by_both_sides(seed: int) -> None:
    text, V = drawn(Random(f"corner {seed}"))
    problem = loads(f"coordinates: [x]\nT: (1 + x^2)*x'^2\nV: {text}\n")
    answers = state(derive(problem), Request(sections=("equilibria",)))
    section = answers.sections["equilibria"]
    assert section.equilibria
    for each in section.equilibria:
        place = number(each.at["x"])
        rises = [V(place + step) - V(place) for step in (NEAR, -NEAR)]
        if 0 not in rises:
            assert each.verdict.stable is (min(rises) > 0), (text, place)


@pytest.mark.parametrize(
    ("potential", "edge"),
    [
        ("sqrt(x^2 + y^2)", True),
        ("sqrt(2*(x - y)^2 + y^2) + y/10", True),
        ("acos(cos(x)) + y^2", True),
        ("(sqrt(x^2 + y^2) - 1)^2", False),
        ("-1/sqrt(1 + x^2) + y^2", False),
    ],
)
def test_no_rest_is_denied_where_V_has_no_derivative(potential: str, *, edge: bool) -> None:
    problem = loads(f"coordinates: [x, y]\nT: x'^2 + y'^2\nV: {potential}\n")
    section = state(derive(problem), Request(sections=("equilibria",))).sections["equilibria"]
    assert (section.equilibria is None or not section.complete) is edge


@pytest.mark.parametrize(
    ("potential", "name"),
    [
        ("abs(sin(x))", "modes"),
        ("x^2*asin(sin(x))", "equilibria"),
        ("abs(x - 1)", "steady_motions"),
        ("(x^2 + y^2)^(3/2) - x^2 - y^2", "steady_motions"),
    ],
)
def test_a_corner_breaks_no_section(potential: str, name: str) -> None:
    polar = "x'^2 + x^2*y'^2" if name == "steady_motions" else "x'^2 + y'^2"
    problem = loads(f"coordinates: [x, y]\nT: {polar}\nV: {potential}\n")
    answers = state(derive(problem), Request(sections=(name,)))
    assert name in answers.sections
    assert "bug of lagcli" not in str(answers.warnings)
