"""Roots of equations with hyperbolic functions, logarithms and odd powers, against a scan in numbers."""

from __future__ import annotations

import random

import mpmath
import pytest
import sympy

from lagcli.algebra import simplify
from lagcli.algebra.equations import solve_for
from lagcli.algebra.numeric import Evaluator
from lagcli.algebra.place import at
from lagcli.algebra.systems import solve_system

x = sympy.Symbol("x", real=True)
a = sympy.Symbol("a", positive=True)
b = sympy.Symbol("b", real=True)


def number(source: random.Random) -> sympy.Rational:
    return sympy.Rational(source.choice([-5, -3, -2, -1, 1, 2, 3, 5]), source.choice([1, 1, 2, 3]))


def equation(source: random.Random) -> sympy.Expr:
    p, q, r = (number(source) for _ in range(3))
    u = source.choice([x, x - a, 2 * x, x**3 + 1])
    return source.choice(
        [
            p * sympy.cosh(x) + q * sympy.sinh(x),
            p * sympy.cosh(x) + q * sympy.sinh(x) + r,
            p * sympy.cosh(2 * x) + q * sympy.sinh(x) + r,
            p * sympy.sinh(2 * x) + b * sympy.cosh(x),
            sympy.cosh(x) * (p * sympy.sinh(x) ** 2 + q * sympy.sinh(x) + r),
            p * sympy.asinh(u) + q,
            p * sympy.log(u**2 + 1) + q,
            p * sympy.log(a + x**2) * sympy.exp(x) + b * sympy.exp(x),
            p * sympy.atan(u) + q,
            a * x**3 + b,
            p * sympy.sinh(x) ** 5 - b,
        ]
    )


def scanned(f: sympy.Expr, values: dict) -> list[float]:
    """Roots between -9 and 9 at which f changes its sign."""
    plan = sympy.lambdify(x, f.subs(values), "mpmath")
    grid = [mpmath.mpf(k) / 16 + mpmath.mpf("0.0123") for k in range(-144, 144)]
    signs = [plan(s) > 0 for s in grid]
    pairs = zip(grid, grid[1:], signs, signs[1:], strict=False)
    return [
        float(mpmath.findroot(plan, (s, t), solver="anderson")) for s, t, u, v in pairs if u != v
    ]


@pytest.mark.parametrize("seed", range(40))
def test_the_roots_are_those_of_a_scan(seed):
    source = random.Random(seed)
    f = equation(source)
    values = {a: sympy.Rational(13, 10), b: sympy.Rational(source.choice([-17, 17]), 11)}
    solved = solve_system([f], [x])
    assert solved.complete
    found = []
    for each in solved.solutions:
        if all(e.subs(values) > 0 for e in each.positive):
            [root] = Evaluator([each.values[x]], 30)({s: mpmath.mpf(v) for s, v in values.items()})
            found.append(float(root))
            assert abs(mpmath.mpf(f.subs(values).subs(x, sympy.Float(str(root), 30)))) < 1e-12
    assert sorted(r for r in found if abs(r) < 9) == pytest.approx(sorted(scanned(f, values)))


def test_a_root_of_open_sign_is_tried_with_both_signs():
    """x = y = -(b/a)^(1/3), not y = -(|b|/a)^(1/3)."""
    y = sympy.Symbol("y", real=True)
    [found] = solve_system([a * x * y**2 + b, a * x**2 * y + b], [x, y]).solutions
    values = {a: sympy.Rational(13, 11), b: sympy.Rational(-3, 7)}
    assert abs((found.values[x] - found.values[y]).subs(values).evalf(30)) < 1e-20


def test_turns_are_not_counted_without_end():
    assert not solve_system([sympy.sin(299792458 * x)], [x]).complete


@pytest.mark.parametrize("function", [sympy.sinh, sympy.cosh, sympy.exp, sympy.tanh])
@pytest.mark.parametrize("inverse", [sympy.asinh, sympy.atanh])
def test_a_function_of_a_multiple_of_an_inverse_one(function, inverse):
    """cosh(asinh(b)) is written by SymPy as a root: its argument is not that of a cosh."""
    for formula in (function(2 * inverse(b)) / 2, b * function(3 * inverse(b)) + 1):
        for shown in (simplify(formula), at(formula.subs(b, x), {x: b})):
            difference = (shown - formula).subs(b, sympy.Rational(-3, 7)).evalf(30)
            assert abs(difference) < 1e-20


@pytest.mark.parametrize("seed", range(6))
def test_a_power_beside_a_polynomial_has_no_root_of_its_own(seed):
    source = random.Random(seed)
    roots = source.sample([-3, -1, 0, 2, 5], source.randint(1, 2))
    power = a ** (source.choice([1, 2]) * x + source.choice([-2, 0, 1]))
    found = solve_for(sympy.expand(power * sympy.prod(x - root for root in roots)), x)
    assert set(found.values) == set(roots)
