"""All critical points of trigonometric polynomials, |f| and sign f; random members.

What is found is compared with Newton's method from many starts, which shares nothing with it.
"""

from __future__ import annotations

import math
import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.equilibria import RestPoints
from lagcli.statements.answers import EquilibriaSection

from .derived import derive


def _found(V: str):
    d = derive(f"coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: \"{V}\"")
    rest = RestPoints(d.dynamics)
    points = [tuple(float(p.values[q]) for q in d.system.q) for p in rest.points or ()]
    return points, rest.complete


def _turned(u: float) -> float:
    return (u + math.pi - 1e-6) % (2 * math.pi) - math.pi + 1e-6


def _by_newton(V: str, source: random.Random) -> list[tuple[float, float]]:
    """Critical points on the torus, by differences of V."""
    f = eval(f"lambda x, y: {V.replace('^', '**')}", {"sin": math.sin, "cos": math.cos})
    h = 1e-4

    def slopes(x, y):
        return (f(x + h, y) - f(x - h, y)) / (2 * h), (f(x, y + h) - f(x, y - h)) / (2 * h)

    found: list[tuple[float, float]] = []
    for _ in range(150):
        x, y = source.uniform(-math.pi, math.pi), source.uniform(-math.pi, math.pi)
        for _ in range(40):
            a, b = slopes(x, y)
            (ax, bx), (ay, by) = (
                [(p - m) / (2 * h) for p, m in zip(slopes(*up), slopes(*down), strict=True)]
                for up, down in (((x + h, y), (x - h, y)), ((x, y + h), (x, y - h)))
            )
            determinant = ax * by - ay * bx
            if abs(determinant) < 1e-2:
                break
            x, y = x - (a * by - b * ay) / determinant, y - (ax * b - bx * a) / determinant
        if abs(determinant) > 1e-2 and max(map(abs, slopes(x, y))) < 1e-6:
            point = _turned(x), _turned(y)
            if all(math.dist(point, other) > 1e-2 for other in found):
                found.append(point)
    return found


WAVES = ("cos(x)", "cos(y)", "sin(x)", "sin(y)", "cos(x + y)", "cos(x - y)", "sin(x + y)",
         "cos(2*x)", "cos(x)*cos(y)", "sin(x)*sin(y)")  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("seed", range(12))
def test_all_critical_points_of_a_trigonometric_polynomial(seed):
    source = random.Random(seed)
    waves = source.sample(WAVES, 3)
    V = " + ".join(f"{source.choice((1, 2, 3))}*{wave}" for wave in waves)
    points, complete = _found(V)
    if complete:
        turned = [(_turned(x), _turned(y)) for x, y in points]
        for point in _by_newton(V, source):
            assert any(math.dist(point, other) < 1e-3 for other in turned), (V, point, turned)


def test_both_minima_of_three_cosines():
    points, complete = _found("cos(x) + cos(y) + cos(x + y)")
    assert complete
    third = 2 * math.pi / 3
    for sign in (1, -1):
        assert any(math.dist((sign * third,) * 2, point) < 1e-12 for point in points)


@pytest.mark.parametrize(
    ("V", "expected"),
    [
        ("x*abs(x)", {0}),
        ("abs(x)", {0}),
        ("x^2*sign(x)", {0}),
        ("abs(x^2 - 1)", {0, 1, -1}),
        ("(x - 2)*abs(x - 2)", {2}),
        ("abs(x)^3 - 3*x", {1}),
        ("x^2 - 2*abs(x)", {0, 1, -1}),
        ("x^2 - 2*x*sign(x - 3)", {-1}),
    ],
)
def test_moduli_and_signs(V, expected):
    points, complete = _found(f"{V} + y^2")
    assert complete
    assert {round(x, 9) for x, _ in points} == expected


def test_others_are_announced():
    """x sin x has infinitely many; what is listed is not all, and the answers say so."""
    from lagcli.mechanics.statements import Statements

    d = derive("coordinates: [x]\nT: x'^2/2\nV: x*sin(x)")
    answers = Statements(d).answers(["equilibria"])
    assert any("not listed" in warning for warning in answers.warnings)


@pytest.mark.parametrize("seed", range(8))
def test_a_minimum_at_a_kink_is_not_denied(seed):
    """a |x - b| + c x + k y²: the convex V has its minimum at the kink where |c| < a."""
    source = random.Random(seed)
    a = source.randint(1, 5)
    c = source.choice([c for c in range(-7, 8) if abs(c) != a])
    b, k = source.randint(-2, 2), source.randint(1, 3)
    points, complete = _found(f"{a}*abs(x - {b}) + {c}*x + {k}*y^2")
    if abs(c) > a:
        assert (points, complete) == ([], True)
    else:
        assert points or not complete


def test_what_the_others_solve_is_quoted():
    from lagcli.mechanics.statements import Statements

    d = derive("coordinates: [x]\nT: x'^2/2\nV: x*sin(x)")
    section = Statements(d).answers(["equilibria"]).sections["equilibria"]
    assert isinstance(section, EquilibriaSection)
    assert [to_grammar(each) for each in section.open] == ["x*cos(x) + sin(x)"]
