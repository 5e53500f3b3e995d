"""Roots of quantities of either sign: what is simplified has the same values where it is real."""

from itertools import product

import pytest
import sympy

from lagcli.algebra import simplify

k, m, g, w = sympy.symbols("k m g w", real=True)
p = sympy.Symbol("p", positive=True)
root = sympy.sqrt
FORMULAS = [
    root(k * m) / m,
    root(k * m) / k,
    m / root(k * m),
    root(k / m),
    m * root(k / m),
    m * root(k / m) - root(k * m),
    root(k / m) * root(k * m),
    root(k / m) / root(k * m),
    root(p * k * m) / m,
    root(k * m / p) * m,
    root(k * m * g * w) / (m * g),
    root(k * m**3) / m,
    root(k * (k + m)) / k,
    root(k * (k**2 + m**2)) / k,
    root(m * (k**2 + m**2) / k) * k,
    sympy.cos(root(k * m) * w / m) - sympy.cos(root(k / m) * w),
    sympy.sin(root(k * m) * w / m) - sympy.sin(root(k / m) * w),
]


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_the_sign_stays(formula):
    shaped = simplify(formula)
    compared = 0
    for signs in product((1, -1), repeat=4):
        values = {x: s * v for x, s, v in zip((k, m, g, w), signs, (2, 3, 5, 7), strict=True)}
        values[p] = sympy.Integer(11)
        before = formula.subs(values)
        if before.is_real:
            assert abs(sympy.N(before - shaped.subs(values))) < 1e-12, (values, shaped)
            compared += 1
    assert compared
