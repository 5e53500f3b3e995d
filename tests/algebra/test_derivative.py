"""The derivative by the rules is SymPy's."""

from __future__ import annotations

from random import Random

import pytest
import sympy
from sympy import Expr

from lagcli.algebra import derivative

x, y = sympy.symbols("x y", real=True)
a = sympy.Symbol("a", positive=True)
LEAVES = (x, y, a, sympy.Integer(3), sympy.Rational(2, 5))
PLACE = {x: sympy.Rational(3, 7), y: sympy.Rational(5, 8), a: sympy.Rational(9, 11)}
FUNCTIONS = (sympy.sin, sympy.exp, sympy.log, sympy.atan, lambda u: a**u)


def formula(random: Random, depth: int) -> Expr:
    """A random one of sums, products, powers and functions."""
    if depth == 0:
        return random.choice(LEAVES)
    parts = [formula(random, depth - 1) for _ in range(random.randint(2, 3))]
    made = random.choice([
        lambda: sympy.Add(*parts),
        lambda: sympy.Mul(*parts),
        lambda: (1 + parts[0] ** 2) ** sympy.Rational(random.choice((-3, -1, 1, 3, 4)), 2),
        lambda: random.choice(FUNCTIONS)(parts[0]),
    ])  # fmt: skip
    return made()


@pytest.mark.parametrize("seed", range(20))
def test_the_derivative_has_the_value_of_sympys(seed: int) -> None:
    f = formula(Random(seed), 3)
    for s in (x, y, a):
        given, wanted = (g.evalf(30, PLACE) for g in (derivative(f, s), f.diff(s)))
        assert abs(given - wanted) <= abs(wanted) * sympy.Float("1e-20")
