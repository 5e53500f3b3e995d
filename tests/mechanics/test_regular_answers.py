"""A printed answer is regular wherever the motion is: where a coordinate or a cosine vanishes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import mpmath
import pytest
import sympy

from lagcli import load
from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.derivation import Derivation

from .derived import derive

PROBLEMS = Path(__file__).parents[2] / "problems"
QUARTER = sympy.pi / 2

# a state on the constraints at which x' tan(phi), 1/cos(phi) or 1/x1 would have no value
SINGULAR_ONLY_IN_COORDINATES = {
    "nonholonomic/chaplygin-sleigh": {"phi": QUARTER, "x'": 0, "y'": 2, "phi'": 3},
    "nonholonomic/skate-on-incline": {"phi": QUARTER, "x'": 0, "y'": 2, "phi'": 3},
    "rolling/skate-on-incline": {"phi": QUARTER, "x'": 0, "y'": 2, "phi'": 3},
    "pendulums/pendulum-cartesian": {"x": 0, "y": -2, "x'": 3, "y'": 0, "l": 2},
    "chains/cartesian-double-pendulum": {
        "x1": 0, "y1": -2, "x2": 3, "y2": -2, "x1'": 1, "y1'": 0, "x2'": 1, "y2'": 2,
        "l1": 2, "l2": 3,
    },
}  # fmt: skip

# constraints whose multiplier stays finite where y = 0, or where the wedge is flat
WRITTEN = {
    "surface": (
        """{coordinates: [x, y, z], parameters: {m: {assume: positive}, g: {assume: positive}},
        T: m*(x'^2+y'^2+z'^2)/2, V: m*g*z, constraints: {s: "y*x' + x*y' + x*y*z' = 0"}}""",
        {"x": 1, "y": 0, "x'": 3, "y'": 0, "z'": 2},
    ),
    "flat wedge": (
        """{coordinates: [X, x, y], parameters: {M: {assume: positive}, m: {assume: positive},
        g: {assume: positive}, a: }, T: M*X'^2/2 + m*(x'^2+y'^2)/2, V: m*g*y,
        constraints: {plane: y*cos(a) = (x - X)*sin(a)}}""",
        {"a": 0},
    ),
}


@pytest.mark.long
@pytest.mark.parametrize("name", SINGULAR_ONLY_IN_COORDINATES)
def test_the_answer_is_finite_where_the_motion_is_regular(name: str) -> None:
    known = SINGULAR_ONLY_IN_COORDINATES[name]
    assert_finite(Derivation(load(PROBLEMS / f"{name}.yaml")), known)


@pytest.mark.parametrize("name", WRITTEN)
def test_nothing_is_divided_by_what_may_vanish(name: str) -> None:
    text, known = WRITTEN[name]
    assert_finite(derive(text), known)


def assert_finite(derivation: Derivation, known: Mapping[str, object]) -> None:
    dynamics = derivation.dynamics
    motion = dynamics.motion
    assert motion is not None
    equations = dynamics.constraints.equations
    n, m = len(dynamics.system.q), len(equations)
    matrix = [
        [*row, *(-e.row[i] for e in equations)]
        for i, row in enumerate(dynamics.lagrange.mass_matrix)
    ] + [[*e.row, *([sympy.S.Zero] * m)] for e in equations]
    right = [*dynamics.lagrange.forcing, *(-e.bias for e in equations)]
    answers = [*motion.accelerations, *(v for v in motion.multipliers if v is not None)]
    formulas = [*(x for row in matrix for x in row), *right, *answers]
    symbols = sorted({s for f in formulas for s in f.free_symbols}, key=lambda s: s.name)
    values = {s: known.get(s.name, sympy.Rational(7 + k, 5)) for k, s in enumerate(symbols)}
    with mpmath.workdps(50):
        point = {s: mpmath.mpf(str(sympy.N(v, 60))) for s, v in values.items()}
        found = Evaluator(formulas, 50)(point)
        size = n + m
        A = mpmath.matrix([found[i * size : (i + 1) * size] for i in range(size)])
        solution = mpmath.lu_solve(A, mpmath.matrix(found[size * size : size * size + size]))
        for value, expected in zip(found[size * size + size :], solution, strict=True):
            assert mpmath.almosteq(value, expected, 1e-30, 1e-30)
