"""A root in what is at rest lengthens nothing before the velocities."""

import random

import pytest
import sympy

from lagcli.algebra.terms import terms
from lagcli.expression import operation_count

ORDER = ("a", "b", "k", "t", "theta", "phi", "theta'", "phi'")
RATES = frozenset(ORDER[-2:])
a, b, k, _, x, y, u, v = (sympy.Symbol(name, real=True) for name in ORDER)


@pytest.mark.parametrize("seed", range(4))
def test_a_sum_of_sines_before_velocities_stays_as_short(seed: int) -> None:
    """Kepler's problem on a sphere, about a slanted axis."""
    draw = random.Random(seed)
    m, n = draw.randint(2, 4), draw.randint(2, 4)
    slanted = m * sympy.cos(x) + n * sympy.sin(x) * sympy.cos(y)
    rest = k * sympy.sin(x) * sympy.sin(y) / sympy.sqrt(m**2 + n**2 - slanted**2)
    moving = u * v * (n * sympy.cos(y) / sympy.tan(x) - m) * sympy.sin(y) * sympy.sin(x) ** 2
    together, *apart = (
        operation_count(terms(each, ORDER, RATES)) for each in (moving + rest, moving, rest)
    )
    assert together <= sum(apart) + 1
