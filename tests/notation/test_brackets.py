"""Brackets with momenta, and sums of a file within longer ones; each keeps its value."""

from __future__ import annotations

import math
import random

import pytest

from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.formatters.grammar import to_grammar
from lagcli.notation.manner import Manner
from lagcli.pipeline import read
from lagcli.reader.expressions import parse_text

FILE = """
coordinates: {r: {assume: positive}, x: , y: , phi: }
parameters: {m: {assume: positive}, q: , B: , c: {assume: positive}, w: , l: {assume: positive}}
T: m*(r'^2 + x'^2 + y'^2)/2 + m*r^2*(phi' + w)^2/2 + m*(l^2 + r^2 - 2*l*r*cos(phi))*x'^2
V: q*(sqrt(x^2 + y^2) - l)^2/2 + B*(x - y)^2
"""
WRITTEN = [
    # H of a charge and its canonical equations, Goldstein 8.1 and Landau and Lifshitz, Fields, 16
    ("(2*p_x + q*B*y)/(2*m)", "(p_x + q*B*y/2)/m"),
    ("-q*B*(q*B*x - 2*p_y)/(4*m)", "q*B*(p_y - q*B*x/2)/(2*m)"),
    ("(2*p_x + q*B*y)/m", "(2*p_x + q*B*y)/m"),
    (
        "c*sqrt((2*p_x + q*B*y)^2 + (q*B*x - 2*p_y)^2 + 4*m^2*c^2)/2",
        "c*sqrt((p_x + q*B*y/2)^2 + (p_y - q*B*x/2)^2 + m^2*c^2)",
    ),
    (
        "c*r*p_r/sqrt(r^2*(p_r^2 + m^2*c^2) + p_phi^2)",
        "c*p_r/sqrt(p_r^2 + p_phi^2/r^2 + m^2*c^2)",
    ),
    ("sqrt(x^2*p_r^2 + p_phi^2)/x", "sqrt(x^2*p_r^2 + p_phi^2)/x"),  # x may be negative
    ("(p_r*cos(phi) - p_phi)*m", "-m*(p_phi - p_r*cos(phi))"),
    # sums of the file: a rotating frame, a spring, the law of cosines
    ("m*r*phi'^2 + 2*m*r*w*phi' + m*r*w^2 - B", "m*r*(phi' + w)^2 - B"),
    (
        "q*x - q*l*x/sqrt(x^2 + y^2)",
        "q*x*(1 - l/sqrt(x^2 + y^2))",
    ),
    (
        "m*l^2 + m*r*(r - 2*l*cos(phi)) + q",
        "m*(l^2 + r^2 - 2*l*r*cos(phi)) + q",
    ),
    ("m*r*r'^2 + m*r*x'^2", "m*r*r'^2 + m*r*x'^2"),  # term by term in the rates
    # one sign of a bracket and its square; the constants by their values
    ("m*(r - m)/(l^2 + (m - r)^2)", "m*(r - m)/(l^2 + (r - m)^2)"),
    ("r*(sqrt(33) - 1)", "(sqrt(33) - 1)*r"),
    ("abs(q)*abs(B)/m", "abs(q*B)/m"),
]


def manner() -> Manner:
    return Manner(read("file.yaml", FILE.encode()).problem)


def value(node, seed):
    source = random.Random(seed)
    values = {
        name: source.uniform(0.3, 2) * (1 if name in "rmcl" else source.choice([-1, 1]))
        for name in KNOWN
    }
    return evaluated(node, values | {"pi": math.pi}, FUNCTIONS)


KNOWN = ["r", "x", "y", "phi", "m", "q", "B", "c", "w", "l", "p_r", "p_x", "p_y", "p_phi",
         "r'", "x'", "y'", "phi'"]  # fmt: skip


@pytest.mark.parametrize(("formula", "written"), WRITTEN)
def test_brackets_are_those_of_a_book(formula: str, written: str) -> None:
    assert to_grammar(manner()(parse_text(formula))) == written


def members(seed: int) -> str:
    """A random product or sum of the kinds above."""
    source = random.Random(seed)
    letters = ["m", "q", "B", "c", "l", "w", "r", "x", "y"]

    def product(count: int) -> str:
        return "*".join(source.choice(letters) for _ in range(count))

    def bracket() -> str:
        n, p = source.choice([1, 2, 3, 4]), source.choice(["p_x", "p_y", "p_phi"])
        term = f"{source.choice([1, 2, 4, 6])}*{product(2)}"
        return source.choice([f"({n}*{p} + {term})", f"({term} - {n}*{p})"])

    root = f"sqrt({bracket()}^2 + r^2*(p_r^2 + {source.choice([1, 4, 9])}*m^2*c^2) + 4*p_phi^2)"
    number = source.choice([1, 2, 4, 8])
    a, b = source.choice([("phi'", "w"), ("sqrt(x^2 + y^2)", "-1*l"), ("x", "-1*y")])
    k = product(2)
    expanded = source.choice([f"{k}*{a} + {k}*{b}", f"{k}*{a}^2 + 2*{k}*{a}*{b} + {k}*{b}^2"])
    kinds = [
        f"{product(1)}*{bracket()}^{source.choice([1, 2, 3])}/({number}*m)",
        f"{product(2)}*{bracket()}/({number}*r^{source.choice([1, 2, 3])}*{root})",
        f"{source.choice(['', '-'])}{product(2)}*{root}/({number}*r)",
        f"{product(2)} - {expanded}".replace("- ", "+ -1*(", 1) + ")",
        f"({expanded} + {product(3)})*{bracket()}/{number}",
    ]
    return source.choice(kinds)


@pytest.mark.parametrize("seed", range(60))
def test_the_value_stays(seed: int) -> None:
    before = parse_text(members(seed))
    after = manner()(before)
    for state in range(3):
        one, other = value(before, state), value(after, state)
        assert math.isclose(one, other, rel_tol=1e-9, abs_tol=1e-9), to_grammar(after)
