"""All equilibria of one coordinate with their stability, against a scan of V' in numbers."""

from __future__ import annotations

import json
import math
import random

import mpmath
import pytest

from lagcli.formatters.built_in.json import to_object
from lagcli.pipeline import Request, derive, read, state
from tests.random_systems.grammar import Undefined
from tests.random_systems.grammar import read as formula

#: Of period 2 π, or with all equilibria between -9 and 9; k and a are positive, b of any sign.
POTENTIALS = [
    "k*sin(x) + b*sin(x)*cos(x)",
    "k*(cos(x)^4 - b*cos(x))",
    "k*log(cosh(x)) - b*x",
    "k*cosh(2*x) + b*sinh(x)",
    "k*cosh(x) - b*cosh(x)^2/3",
    "k*x^4/4 + b*x",
    "k*abs(x - a) + b*x^2",
    "k*sign(x)*x^2 + b*x",
    "k*(x^2 + a)*(log(x^2 + a) - 1)/2 - b*x^2/2",
]


def above(text: str, values: dict) -> bool:
    left, _, right = text.partition(">")
    return formula(left)(values) > formula(right)(values)


def holds(each: dict, name: str, values: dict) -> bool:
    """Whether all inequalities of a condition hold, which may have no value where one fails."""
    texts = each[name] if isinstance(each[name], list) else each[name].split(" and ")
    try:
        return all(above(text, values) for text in texts)
    except Undefined:
        return False


def scanned(V: str, values: dict, end: float) -> dict[float, int]:
    """Where V turns between -end and end, 1 for a minimum."""
    potential, step = formula(V), mpmath.mpf(end) / 400
    grid = [-end + step * (k + mpmath.mpf("0.237")) for k in range(800)]

    def at(x):
        return potential(values | {"x": x})

    found = {}
    for left, middle, right in zip(grid, grid[1:], grid[2:], strict=False):
        side = 1 if at(middle) < min(at(left), at(right)) else -1
        if side == 1 or at(middle) > max(at(left), at(right)):
            for _ in range(60):  # the bracket shrinks about the extremum
                third = (right - left) / 3
                less = side * at(left + third) < side * at(right - third)
                left, right = (left, right - third) if less else (left + third, right)
            found[float(left)] = side
    return found


@pytest.mark.parametrize("V", POTENTIALS)
def test_what_is_listed_is_what_a_scan_finds(V):
    text = (
        "{coordinates: [x], parameters: {k: {assume: positive}, a: {assume: positive}, b: {}},"
        f' T: "x\'^2/2", V: "{V}"}}'
    )
    problem = read("t.yaml", text.encode()).problem
    answers = state(derive(problem), Request(sections=("equilibria", "modes")))
    sheet = json.loads(json.dumps(to_object(answers)))
    assert not [w for w in sheet["warnings"] if "not verified" not in w]
    turns = any(f in V for f in ("sin(x)", "cos(x)"))
    source, end = random.Random(V), math.pi if turns else 9.0
    for b in (-2.3, -0.45, 0.45, 2.3):
        values = {
            "k": mpmath.mpf(source.uniform(0.5, 2)),
            "a": mpmath.mpf("0.7"),
            "b": mpmath.mpf(b),
        }
        listed = {}
        for each in sheet["equilibria"]:
            if "condition" in each and not holds(each, "condition", values):
                continue
            stable = each["stable"]
            if stable is None:
                stable = holds(each, "minimum", values) if "minimum" in each else False
            x = float(formula(each["at"]["x"])(values))
            listed[-x if x == end else x] = 1 if stable else -1
        inside = {x: side for x, side in scanned(V, values, end).items() if abs(x) < end - 0.02}
        wanted = sorted(inside.items())
        got = sorted((x, side) for x, side in listed.items() if abs(x) < end - 0.02)
        assert [side for _, side in got] == [side for _, side in wanted], (b, got, wanted)
        assert [x for x, _ in got] == pytest.approx([x for x, _ in wanted], abs=1e-4)
