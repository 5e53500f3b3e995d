"""The sign of a quadratic form that no square of one letter outweighs term by term."""

from __future__ import annotations

from random import Random

import pytest
import sympy

from lagcli.algebra.signs import sign

REAL = sympy.symbols("a b c", real=True)
POSITIVE = sympy.symbols("m k", positive=True)


def form(rng: Random) -> sympy.Expr:
    """A linear form in all letters with small coefficients."""
    return sum(rng.choice([-3, -2, -1, 1, 2, 3]) * s for s in (*REAL, *POSITIVE))


@pytest.mark.parametrize("number", range(12))
def test_squares_plus_something_positive_are_positive(number: int) -> None:
    rng = Random(number)
    squares = sum(form(rng) ** 2 for _ in range(rng.choice([1, 2, 3])))
    whole = sympy.expand(squares + rng.choice([1, *POSITIVE, POSITIVE[0] * POSITIVE[1]]))
    assert sign(whole) == 1
    assert sign(-whole) == -1


@pytest.mark.parametrize("number", range(40))
def test_no_sign_is_said_of_what_has_both(number: int) -> None:
    rng = Random(f"both {number}")
    whole = sympy.expand(form(rng) ** 2 + rng.choice([-1, 1]) * form(rng) * form(rng))
    at = sympy.lambdify((*REAL, *POSITIVE), whole, "math")
    values = (
        at(*(rng.uniform(-2, 2) for _ in REAL), *(rng.uniform(0.01, 2) for _ in POSITIVE))
        for _ in range(500)
    )
    found = {1 if value > 0 else -1 for value in values}
    assert sign(whole) in ({None} if {1, -1} <= found else {None, *found})


def test_the_splitting_of_two_coupled_oscillators_is_positive() -> None:
    m1, m2, k1, k2, k3 = sympy.symbols("m1 m2 k1 k2 k3", positive=True)
    half = m1 * (k2 + k3) - m2 * (k1 + k2)
    assert sign(sympy.expand(half**2 + 4 * m1 * m2 * k2**2)) == 1
