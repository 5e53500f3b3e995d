"""sqrt(f²) is |f|, whatever f is: random formulas with roots of squares, moduli and signs.

What is simplified, and the tree that is printed, have the value of the formula where both f > 0
and f < 0.
"""

import random

import pytest
import sympy
from sympy import Abs, Expr, Rational, cos, sin, sqrt

from lagcli.algebra import shape, simplify
from lagcli.algebra.build import Builder

x, y, k = sympy.symbols("x y k", real=True)
a = sympy.Symbol("a", positive=True)
NAMES = {s.name: s for s in (x, y, a, k)}
ANGLES = (x, y, x + y, x - y, 2 * x, 2 * x + y, x / 2, x - a, k * x)


def _base(source: random.Random) -> Expr:
    angle = source.choice(ANGLES)
    return source.choice([x, y, k, x + y, x - k, sin(angle), cos(angle), k * cos(angle), x * y])


def _square(source: random.Random) -> Expr:
    angle, base, other = source.choice(ANGLES), _base(source), _base(source)
    return source.choice(
        [
            1 - cos(angle) ** 2,
            1 - sin(angle) ** 2,
            a**2 * (1 - cos(angle) ** 2),
            base**2,
            base**4,
            (base + other) ** 2,
            sympy.expand((x + y) ** 2),
            1 - 2 * sin(angle) * cos(angle),
            sympy.cosh(x) ** 2 - 1,
        ]
    )


def _factor(source: random.Random) -> Expr:
    square, base, angle = _square(source), _base(source), source.choice(ANGLES)
    return source.choice(
        [
            sqrt(square),
            1 / sqrt(square),
            square ** Rational(3, 2),
            square ** Rational(1, 4),
            Abs(base),
            base / Abs(base),
            sympy.sign(base),
            base,
            sympy.acos(cos(angle)).diff(x),
            sympy.asin(sin(angle)).diff(x),
        ]
    )


def _value(formula: Expr, point: dict[Expr, float]) -> float | None:
    value = complex(formula.subs(point).evalf(20))
    real = value == value and abs(value) < 1e8 and abs(value.imag) < 1e-12
    return value.real if real else None


@pytest.mark.long
@pytest.mark.parametrize("seed", range(40))
def test_the_value_is_kept_on_either_side(seed):
    source = random.Random(seed)
    formula = _factor(source) * _factor(source)
    if source.random() < 0.3:
        formula += _factor(source)
    printed = Builder(NAMES, {}, lambda e: e)(shape(formula, ["a", "k", "x", "y"]))
    compared = 0
    for _ in range(12):
        point = {s: source.uniform(-4, 4) for s in (x, y, k)} | {a: source.uniform(0.2, 2)}
        before = _value(formula, point)
        if before is not None:
            compared += 1
            for after in (simplify(formula), printed):
                value = _value(after, point)
                assert value is not None, (formula, after, point)
                assert abs(value - before) < 1e-8 * (1 + abs(before)), (formula, after, point)
    assert compared


@pytest.mark.parametrize("factor", [sqrt(2), sqrt(6) / 4, 3, a, k * sqrt(5)])
@pytest.mark.parametrize("power", [Rational(n, 2) for n in (-5, -3, -1, 1, 3)])
def test_an_odd_power_of_a_root_is_its_power(factor, power):
    """x^(-3/2) is sqrt(x)^(-3) for every complex x, and sqrt(x^3)/x^3 its negative for x < 0."""
    formula = factor * x**power
    for value in (-2, -0.3, 0.7, 3):
        point = {x: value, k: 1.3, a: 0.6}
        assert complex((simplify(formula) - formula).subs(point)) == pytest.approx(0, abs=1e-12)
