"""The unique form: what is equal has one form, what is not is told apart."""

from __future__ import annotations

from random import Random

import mpmath
import pytest
import sympy as sp
from mpmath import mpf
from sympy import Expr, Symbol, cos, exp, sin, sqrt

from lagcli.algebra import Field, is_zero
from lagcli.algebra.build import unspecified
from lagcli.algebra.numeric import Evaluator

a, b, t, v = (Symbol(n, real=True) for n in "a b t v".split())
p, q, n = (Symbol(s, positive=True) for s in "p q n".split())

#: The square of the distance from (s, p sin a) with s² = q² - p² sin² a, with s² and cos² gone.
S = sqrt(q**2 - p**2 * sin(a) ** 2)
DISTANCE = b**2 - 2 * b * S + v**2 - 2 * v * p * sin(a) + q**2

IDENTITIES: list[Expr] = [
    sin(a) ** 2 + cos(a) ** 2 - 1,
    sin(3 * a) - 3 * sin(a) + 4 * sin(a) ** 3,
    cos(a - b) - cos(a) * cos(b) - sin(a) * sin(b),
    sp.tan(a / 2) - sin(a) / (1 + cos(a)),
    sp.sec(a) ** 2 - sp.tan(a) ** 2 - 1,
    sin(a + sp.pi / 3) - sin(a) / 2 - sqrt(3) * cos(a) / 2,
    sin(p * t + b) - sin(p * t) * cos(b) - cos(p * t) * sin(b),
    sp.sinh(2 * a) - 2 * sp.sinh(a) * sp.cosh(a),
    exp(a - b) * exp(b) - exp(a),
    exp(2 * a) - exp(a) ** 2,
    p**n / p ** (n - 1) - p,
    sqrt(p) * sqrt(q) - sqrt(p * q),
    sqrt(8) - 2 * sqrt(2),
    sqrt(6) - sqrt(2) * sqrt(3),
    sqrt(p**3) - p * sqrt(p),
    sqrt(1 - v**2 / p**2) - sqrt(p**2 - v**2) / p,
    1 / sqrt(a**2 + b**2) ** 3 - sqrt(a**2 + b**2) / (a**2 + b**2) ** 2,
    sqrt(1 - cos(a) ** 2) - sp.Abs(sin(a)),
    sp.Abs(p * a) - p * sp.Abs(a),
    sp.Abs(a) ** 2 - a**2,
    1 / (sqrt(2) + 1) - sqrt(2) + 1,
    unspecified("U", 1)(a + a) - unspecified("U", 1)(2 * a),
]


@pytest.mark.parametrize("identity", IDENTITIES, ids=str)
def test_identities(identity: Expr) -> None:
    assert is_zero(identity) is True


@pytest.mark.parametrize(
    "expression",
    [a - b, sin(a) - cos(a), sqrt(p) - sqrt(q), exp(a) - exp(b), sin(2 * a) - 2 * sin(a),
     unspecified("U", 1)(a) - unspecified("U", 1, (1,))(a)],
    ids=str,
)  # fmt: skip
def test_certainly_not_zero(expression: Expr) -> None:
    assert is_zero(expression) is False


def evaluate(expression, values):
    return Evaluator([expression], 50)(values)[0]


def test_hidden_dependence_is_not_denied() -> None:
    """sqrt(3 + 2 sqrt(2)) = 1 + sqrt(2): no rule knows, so nothing is claimed."""
    assert is_zero(sqrt(3 + 2 * sqrt(2)) - 1 - sqrt(2)) is not False
    assert is_zero(sp.log(p * q) - sp.log(p) - sp.log(q)) is not False
    assert is_zero(sp.atan(a) + sp.atan(1 / a) - sp.pi / 2) is not False


def test_division_by_a_hidden_zero() -> None:
    assert is_zero(1 / (sin(a) ** 2 + cos(a) ** 2 - 1)) is None


def test_elements_are_numbers_of_a_field() -> None:
    field = Field([sin(a), b])
    s, x = field(sin(a)), field(b)
    assert ((s + x) * (s - x) - s * s + x * x).is_zero()
    assert (s / s).is_one()
    assert field.to_sympy((s * x) ** -1) == 1 / (b * sin(a))


def test_generators_can_be_added_at_any_time() -> None:
    field = Field()
    total = field.rational(0)
    symbols = sp.symbols("s:40", real=True)
    for symbol in symbols:
        total = total + field(symbol) * field(sin(symbol)) ** 2
    for symbol in symbols:
        total = total - field(symbol) + field(symbol) * field(cos(symbol) ** 2)
    assert total.is_zero()


def test_unspecified_functions_have_consistent_derivatives() -> None:
    """dU/dr by a difference quotient at 50 digits."""
    U, slope = unspecified("U", 1)(a), unspecified("U", 1, (1,))(a)
    mixed = unspecified("F", 2, (1, 2))(a, b)
    with mpmath.workdps(50):
        h = mpf(10) ** -16
        quotient = (evaluate(U, {a: 1 + h}) - evaluate(U, {a: 1 - h})) / (2 * h)
        assert abs(quotient - evaluate(slope, {a: 1})) < mpf(10) ** -28
        side = [evaluate(unspecified("F", 2, (1,))(a, b), {a: 1, b: s}) for s in (2 + h, 2 - h)]
        assert abs((side[0] - side[1]) / (2 * h) - evaluate(mixed, {a: 1, b: 2})) < mpf(10) ** -28


def test_an_evaluator_is_reused_at_many_points() -> None:
    plan = Evaluator([a**2 + b, sqrt(a**2 + b)], 30)
    assert [plan({a: mpf(k), b: mpf(0)})[0] for k in range(4)] == [0, 1, 4, 9]


@pytest.mark.parametrize("factor", [b - S, v - p * sin(a), b * S + cos(a) * v, S])
def test_a_factor_that_the_rules_hide_in_the_numerator_is_cancelled(factor: Expr) -> None:
    """s² = q² - p² sin² a in the product leaves no common divisor that polynomials have."""
    quotient = factor * DISTANCE / (3 * DISTANCE)
    field = Field([quotient])
    above, below = field(sp.expand(factor * DISTANCE)), field(3 * DISTANCE)
    assert (above / below).denominator == 3
    assert is_zero(field.to_sympy(above / below) - factor / 3)


def test_what_is_no_multiple_is_not_divided() -> None:
    quotient = (b - S + v * S**2) / DISTANCE
    field = Field([quotient])
    assert not field(quotient).is_polynomial()
    assert is_zero(field.to_sympy(field(quotient)) - quotient)


@pytest.mark.parametrize("seed", range(8))
def test_hyperbolic_functions_are_exponentials_beside_these(seed: int) -> None:
    """cosh(u) - (exp(u) + exp(-u))/2 was said not to vanish."""
    draw = Random(seed)
    x, a = sp.Symbol("x", real=True), sp.Symbol("a", positive=True)
    formula: sp.Expr = sp.Integer(0)
    for _ in range(3):
        u = draw.choice([x, 2 * x, x / 3, sp.sqrt(6) * x / 4, a * x]) + draw.choice([0, a])
        function = draw.choice([sp.cosh, sp.sinh, sp.tanh, sp.coth])
        part = function(u) ** draw.choice([1, 2]) * draw.choice([x, a, 1])
        formula += part - part.rewrite(sp.exp)
    assert is_zero(formula) is True
    assert is_zero(formula + a * sp.exp(x)) is False
