"""Elementary solutions of y'' + I(t) y = 0: each is put back, and known ones are found.

Kovacic, J. Symb. Comp. 2 (1986) 3; Poeschl, Teller, Z. Phys. 83 (1933) 143 (l(l+1)/cosh^2).
"""

import random

import mpmath
import pytest
import sympy

from lagcli.mechanics.discovery.kovacic import elementary_solutions

t = sympy.Symbol("t", real=True)
k, w = sympy.symbols("k w", positive=True)


def defect(y, I, place):  # noqa: E741
    """(y'' + I y)/(|y''| + |I y|) at a place, by 30 digits."""
    names = (y.free_symbols | I.free_symbols) - {t}
    given = {x: sympy.Rational(7 + 2 * i, 5) for i, x in enumerate(sorted(names, key=str))}
    function = sympy.lambdify(t, y.xreplace(given), "mpmath")
    with mpmath.workdps(30):
        second = mpmath.diff(function, place, 2)
        other = sympy.lambdify(t, I.xreplace(given), "mpmath")(place) * function(place)
        assert abs(mpmath.im(function(place))) < 1e-20
        return abs(second + other) / (abs(second) + abs(other))


KNOWN = [
    -6 / t**2,
    k**2 - 12 / t**2,
    -(k**2) - 2 / t**2,
    1 / t**4,
    -2 / t**2 - 3 / t**4,
    -2 / (t**2 - k**2),
    -(k**2) + 2 / sympy.cosh(t) ** 2,
    -(k**2) + 24 / sympy.cosh(2 * t) ** 2,
    -(k**2) - 2 / sympy.sinh(t) ** 2,
    w**2 - 2 / sympy.cos(t) ** 2,
    w**2 - 6 / sympy.sin(t) ** 2,
    sympy.exp(2 * t) - sympy.Rational(1, 4),
    4 * sympy.exp(-2 * k * t) - k**2 / 4,
    -2 / (1 + t**2),
]


@pytest.mark.parametrize("I", KNOWN, ids=str)
def test_two_solutions_are_found_that_fulfil_the_equation(I):  # noqa: E741
    found = elementary_solutions(I, t)
    assert len(found) == 2
    assert all(defect(y, I, mpmath.mpf("0.83")) < 1e-12 for y in found)
    first, second = found
    wronskian = first * second.diff(t) - second * first.diff(t)
    given = {k: sympy.Rational(7, 5), w: sympy.Rational(9, 5)}
    at = [wronskian.xreplace(given).subs(t, sympy.Rational(n, 100)).evalf(20) for n in (83, 97)]
    assert abs(at[0]) > 1e-6
    assert abs(at[0] - at[1]) < 1e-12 * abs(at[0])


@pytest.mark.parametrize("seed", range(12))
def test_a_polynomial_times_an_exponential_is_found_again(seed):
    draw = random.Random(seed)
    P = sympy.Mul(*(t + draw.randint(1, 5) for _ in range(draw.randint(0, 2))))
    growth = [draw.randint(-3, 3) * t, sympy.Rational(draw.randint(-3, 3), 2) * t**2,
              draw.randint(-2, 2) / t]  # fmt: skip
    y = P * t ** draw.randint(-1, 2) * sympy.exp(sympy.Add(*growth))
    I = sympy.factor(sympy.simplify(-y.diff(t, 2) / y))  # noqa: E741
    found = elementary_solutions(I, t)
    assert found
    assert all(defect(f, I, mpmath.mpf("1.21")) < 1e-12 for f in found)


@pytest.mark.parametrize("I", [t, sympy.cos(t), 2 - t**2, sympy.exp(t**2)], ids=str)
def test_where_there_is_none_none_is_found(I):  # noqa: E741
    assert elementary_solutions(I, t) == []
