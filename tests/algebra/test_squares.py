"""Signs that are proved by squares, against random values."""

from __future__ import annotations

import random

import pytest
import sympy as sp

from lagcli.algebra.signs import sign, sign_beside_zero

a, b, c = sp.symbols("a b c", positive=True)
u, v, w = sp.symbols("u v w", real=True)
SYMBOLS = (a, b, c, u, v, w)
SHAPES = (a, b, c, u, v, w, a * u, b * v, a * sp.cos(w), u * sp.sin(v), b * sp.cos(u))


def values(expression: sp.Expr, source: random.Random) -> list[float]:
    drawn = [
        {s: source.uniform(0.1, 3) if s.is_positive else source.uniform(-3, 3) for s in SYMBOLS}
        for _ in range(60)
    ]
    return [float(expression.subs(each)) for each in drawn]


def random_sum(source: random.Random, *, of_squares: bool) -> sp.Expr:
    """(p - q)² weighted and a positive rest; or any terms at all."""
    pairs = [source.sample(SHAPES, 2) for _ in range(source.randint(1, 3))]
    numbers = [source.randint(1, 4) for _ in range(6)]
    if of_squares:
        parts = [n * c * (k * p - q) ** 2 for n, k, (p, q) in zip(numbers, numbers[3:], pairs,
                                                                 strict=False)]  # fmt: skip
        return sp.expand(sp.Add(*parts) + numbers[5] * a * b)
    parts = [(-1) ** n * n * p * q for n, (p, q) in zip(numbers, pairs, strict=False)]
    return sp.expand(sp.Add(*parts, *(s**2 for s in source.sample(SHAPES, 3))))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(40))
def test_a_sign_that_is_claimed_is_that_of_random_values(seed: int) -> None:
    source = random.Random(f"squares {seed}")
    expression = random_sum(source, of_squares=bool(seed % 2))
    strict, weak = sign(expression), sign_beside_zero(expression)
    for value in values(expression, source):
        assert strict is None or value * strict > 0
        assert weak is None or value * weak > -1e-9


@pytest.mark.parametrize("n", [1, 2, 5])
def test_a_square_beside_something_positive_is_positive(n: int) -> None:
    assert sign(sp.expand(c * (n * a - b) ** 2 + a)) == 1
    assert sign(sp.expand(a**2 + (n * b) ** 2 - 2 * n * a * b * sp.cos(u)) + c) == 1
    assert sign(-sp.expand((a * u - n * v) ** 2 + (v - w) ** 2 + b)) == -1


def test_a_square_alone_may_vanish() -> None:
    square = sp.expand(c * (a - b) ** 2)
    assert (sign(square), sign_beside_zero(square)) == (None, 1)


@pytest.mark.parametrize("short", [3, 21, 2001])
def test_a_square_that_is_not_paid_for_is_not_claimed(short: int) -> None:
    excess = sp.Rational(2 * short + 1, short)
    assert sign(a**2 + b**2 - excess * a * b) is None
    assert sign_beside_zero(a**2 + b**2 - excess * a * b) is None
