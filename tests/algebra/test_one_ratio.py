"""Inequalities in one ratio, against numbers at random values of the parameters."""

from __future__ import annotations

from random import Random

import pytest
import sympy
from sympy import sqrt

from lagcli.algebra.one_ratio import in_one_ratio

a, b, c = sympy.symbols("a b c", positive=True)


def quadratic(rng: Random) -> sympy.Expr:
    return sum((rng.randint(-4, 4) * term for term in (a**2, a * b * c, b**2 * c**2)), sympy.S.Zero)


def member(rng: Random) -> sympy.Expr:
    """P + Q root, of degree two in a and b c."""
    root = sqrt(rng.randint(1, 5) * a**2 + rng.randint(1, 5) * b**2 * c**2)
    linear = rng.randint(-3, 3) * a + rng.randint(-3, 3) * b * c
    return quadratic(rng) + (linear * root if rng.random() < 0.6 else 0)


@pytest.mark.first_quick
@pytest.mark.parametrize("seed", range(6))
def test_the_bounds_hold_just_where_the_inequalities_do(seed):
    rng = Random(seed)
    decided = 0
    while decided < 3:
        expressions = [member(rng) for _ in range(rng.choice([1, 1, 2]))]
        given = [rng.choice([2 * a - 3 * b * c, b * c - a, 5 * b * c - a])][: rng.randint(0, 1)]
        found = in_one_ratio(expressions, given)
        if found is None:
            continue
        decided += 1
        known, asked, told = (
            sympy.lambdify([a, b, c], each) for each in (given, expressions, found)
        )
        for _ in range(100):
            numbers = [10 ** rng.uniform(-1.2, 1.2) for _ in range(3)]
            if min([1, *known(*numbers)]) > 0 and min(map(abs, asked(*numbers))) > 1e-9:
                assert (min([1, *told(*numbers)]) > 0) == (min(asked(*numbers)) > 0)


@pytest.mark.parametrize(
    ("expressions", "given", "bounds"),
    [
        # a rod on the rim of a bowl (Lamb, Statics, section 23): 2 l rods in a bowl of radius b
        ([8 * b - a - sqrt(a**2 + 32 * b**2)], [], [2 * b - a]),
        ([8 * b + sqrt(a**2 + 32 * b**2) - a], [], []),
        ([16 * b**2 - a * (a + sqrt(a**2 + 32 * b**2))], [2 * b - a], []),
        # Ziegler's column (Bolotin, Nonconservative Problems, section 2): P l < (7/2 - sqrt 2) c
        (
            [4 * a**2 * b**2 + 41 * c**2 - 28 * a * b * c, 7 * c - 2 * a * b],
            [],
            [(7 - 2 * sqrt(2)) * c - 2 * a * b],
        ),
    ],
)
def test_bounds_of_textbooks(expressions, given, bounds):
    found = in_one_ratio(expressions, given)
    assert found is not None
    assert list(map(sympy.expand, found)) == list(map(sympy.expand, bounds))


@pytest.mark.parametrize(
    "expressions",
    [[a - b, b - a], [(a - b) ** 2], [a - b, b - c], [a**5 - a * b**4 - b**5], [a - 1]],
)
def test_what_is_left_open(expressions):
    assert in_one_ratio(expressions) is None
