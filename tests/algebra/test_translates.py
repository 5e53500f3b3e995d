"""The least period of formulas in a length, whatever the order in which their sines are met."""

from __future__ import annotations

from itertools import product
from math import gcd

import pytest
import sympy
from sympy import Symbol, cos, pi, sin, tan

from lagcli.algebra.translates import least_period

x, a = Symbol("x", real=True), Symbol("a", positive=True)
MULTIPLES = list(product((1, 2, 3, 6), repeat=3))
SEVERAL = [cos(j * x / a) + cos(k * x / a) + sin(n * x / a) for j, k, n in MULTIPLES]


@pytest.mark.parametrize(
    ("formula", "period"),
    [
        *zip(SEVERAL, (2 * pi * a / gcd(*each) for each in MULTIPLES), strict=True),
        (tan(x / a), pi * a),
        (sin(x / a) ** 2 * cos(3 * x / a), pi * a * 2),
        (sin(x / a) ** 2 * cos(2 * x / a), pi * a),
        (cos(x), None),
        (cos(x / a) + x, None),
        (cos(x**2 / a), None),
    ],
)
def test_the_least_period(formula: sympy.Expr, period: sympy.Expr | None) -> None:
    found = least_period([formula], x)
    assert (found is None) == (period is None)
    assert found is None or sympy.simplify(found - period) == 0
