"""Differences that a file has inside powers, exponentials and hyperbolic functions stay whole."""

import pytest
import sympy

from lagcli.algebra import is_zero, shape
from lagcli.algebra.equations import solve_for
from lagcli.formatters.grammar import to_grammar

a, d, k, r, s, x, y = sympy.symbols("a d k r s x y", positive=True)
u = sympy.exp(-a * (x - y - d))


def printed(expression: sympy.Expr) -> str:
    return to_grammar(shape(expression, ("k", "a", "d", "s", "t", "x", "y", "r")))


# Landau, Lifshitz, Quantum Mechanics, 3rd ed., section 23, problem 4 (Morse); sections 23 and 25
@pytest.mark.parametrize(
    ("energy", "expected"),
    [
        (k * (1 - u) ** 2, "2*k*a*(exp(a*(y + d - x)) - 1)*exp(a*(y + d - x))"),
        (k / sympy.sinh(a * (x - y)) ** 2, "2*k*a*cosh(a*(x - y))/sinh(a*(x - y))^3"),
        (k / sympy.cosh(a * (x - y)) ** 2, "2*k*a*sinh(a*(x - y))/cosh(a*(x - y))^3"),
    ],
)
def test_no_exponential_is_torn_apart(energy: sympy.Expr, expected: str) -> None:
    assert printed(-energy.diff(x)) == expected


def test_the_force_of_lennard_jones_is_two_powers() -> None:
    # Goldstein, Poole, Safko, 3rd ed., chapter 3: 4 eps ((s/r)^12 - (s/r)^6)
    force = -(4 * k * ((s / (x - y)) ** 12 - (s / (x - y)) ** 6)).diff(x)
    assert printed(force) == "48*k*s^12/(x - y)^13 + 24*k*s^6/(y - x)^7"
    assert is_zero(force - 48 * k * s**12 / (x - y) ** 13 + 24 * k * s**6 / (x - y) ** 7)


def test_hyperbolic_squares_are_joined() -> None:
    assert printed(1 / (sympy.cosh(a * x) ** 2 - 1)) == "1/sinh(a*x)^2"


def test_equal_exponentials_are_equal_however_they_are_given() -> None:
    assert is_zero(u**2 - sympy.exp(2 * a * y + 2 * a * d) / sympy.exp(a * x) ** 2) is True
    assert is_zero(sympy.exp(a * x) * sympy.exp(-a * y) - sympy.exp(a * (x - y))) is True


def test_an_exponential_of_a_difference_is_solved() -> None:
    roots = solve_for((k * (1 - u) ** 2).diff(x), x)
    assert roots is not None
    assert roots.values == (d + y,)
