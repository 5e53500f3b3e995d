"""Digits lost, condition numbers: against mpmath, and against closed forms."""

import math

import mpmath
import pytest

from lagcli.diagnostics import Source
from lagcli.pipeline import read
from lagcli.reader.expressions import read_expression
from lagcli.reader.positions import Excerpt
from lagcli.studies.extremes.case import CaseFormula
from lagcli.studies.extremes.condition import mass_condition
from lagcli.studies.extremes.digits import DIGITS, losses
from lagcli.studies.extremes.formulas import printed_formulas
from lagcli.studies.extremes.scene import ExtremeScene, with_all_values


def problem(text):
    found = read("case.yaml", text.encode())
    assert found.problem is not None, found.diagnostics
    return found.problem


def tree(text):
    return read_expression(Excerpt.whole(Source("formula", text)))


def loss(text, **values):
    formula = CaseFormula(group="charges", name="Q", printed=tree(text))
    [found] = losses([formula], values)
    return found.printed


def by_mpmath(found, exact):
    with mpmath.workdps(60):
        relative = abs((mpmath.mpf(found) - exact) / exact)
        return max(0.0, float(mpmath.log10(relative * mpmath.mpf(2) ** 53)))


@pytest.mark.parametrize("x", [1e-3, 1e-5, 1e-7])
def test_one_minus_cosine(x):
    with mpmath.workdps(60):
        exact = 1 - mpmath.cos(mpmath.mpf(x))
    found = loss("1 - cos(x)", x=x)
    assert found == pytest.approx(by_mpmath(1 - math.cos(x), exact), abs=1e-9)
    assert found > -2 * math.log10(x) - 2


@pytest.mark.parametrize(
    ("text", "values", "python", "exact"),
    [
        ("(a + b) - a", {"a": 1e12, "b": 0.1}, lambda a, b: (a + b) - a, lambda a, b: a - a + b),
        (
            "sqrt(a + b) - sqrt(a)",
            {"a": 1.0, "b": 1e-9},
            lambda a, b: math.sqrt(a + b) - math.sqrt(a),
            lambda a, b: b / (mpmath.sqrt(a + b) + mpmath.sqrt(a)),
        ),
        (
            "a^2 - b^2",
            {"a": 1.0000001, "b": 1.0},
            lambda a, b: a**2 - b**2,
            lambda a, b: (a - b) * (a + b),
        ),
    ],
)
def test_differences(text, values, python, exact):
    with mpmath.workdps(60):
        known = exact(*(mpmath.mpf(x) for x in values.values()))
    assert loss(text, **values) == pytest.approx(
        by_mpmath(python(*values.values()), known), abs=1e-9
    )


def test_nothing_is_lost_where_nothing_cancels():
    assert loss("a*b/c", a=3.0, b=0.1, c=7.0) < 0.5


def test_everything_is_lost():
    """1 - cos(1e-9) is 0 in doubles; exp(1000) is no double, its logarithm is 1000."""
    assert loss("1 - cos(x)", x=1e-9) == pytest.approx(53 * math.log10(2))
    assert loss("log(exp(x))", x=1000.0) == DIGITS


def test_where_there_is_no_value():
    assert loss("1/x", x=0.0) is None
    assert loss("sqrt(x)", x=-1.0) is None


def test_an_exact_zero():
    assert loss("x - x*cos(y)", x=1.0, y=0.0) == 0


DOUBLE = """
coordinates: [a, b]
parameters: {m: %s}
L: (1 + m)*a'^2/2 + m*b'^2/2 + m*a'*b'*cos(a - b) + (1 + m)*cos(a) + m*cos(b)
initial: {a: 1, b: %s}
"""


@pytest.mark.parametrize("m", ["1", "1e12", "1e-12"])
@pytest.mark.parametrize("b", ["2", "1 + 1e-9"])
def test_the_condition_of_a_double_pendulum(m, b):
    """Scaled, M is [[1, r], [r, 1]] with r^2 = m cos(a - b)^2/(1 + m): (1 + r)/(1 - r)."""
    scene = ExtremeScene(problem(DOUBLE % (m, b)))
    with mpmath.workdps(50):
        mass, (x, y) = mpmath.mpf(scene.value("m")), map(mpmath.mpf, scene.q)
        r = abs(mpmath.cos(x - y)) * mpmath.sqrt(mass / (1 + mass))
        exact = float((1 + r) / (1 - r))
    assert mass_condition(scene) == pytest.approx(exact, rel=1e-9)


def test_a_mass_matrix_without_rank():
    scene = ExtremeScene(problem(DOUBLE % ("0", "2")))
    assert mass_condition(scene) == math.inf


def test_the_formulas_are_those_that_solve_prints():
    """Of a pendulum: -g sin(th)/l, and the energy whose 1 - cos is rewritten."""
    text = """
coordinates: [th]
parameters: [m, g, l]
T: m*l^2*th'^2/2
V: m*g*l*(1 - cos(th))
"""
    known, missing = with_all_values(problem(text))
    assert list(missing) == ["m", "g", "l"]
    found = {formula.name: formula for formula in printed_formulas(known)}
    assert list(found) == ["th''", "energy"]
    assert found["th''"].rewritten is None
    values = {"m": 2.0, "g": 9.81, "l": 0.7, "th": 1e-9, "th'": 0.0}
    acceleration, energy = losses(list(found.values()), values)
    assert acceleration.printed < 1
    assert energy.printed == DIGITS
    assert energy.rewritten < 1
