"""Antiderivatives of rational functions whose coefficients have parameters."""

import random

import pytest
import sympy
from sympy import Add, Expr

from lagcli.algebra.antiderivative import antiderivative

x = sympy.Symbol("x", real=True)
PARAMETERS = sympy.symbols("a b k", real=True)


def _polynomial(source: random.Random, degree: int) -> Expr:
    letters = (1, *PARAMETERS)
    return Add(*(source.randint(-3, 3) * source.choice(letters) * x**i for i in range(degree + 1)))


@pytest.mark.parametrize("seed", range(8))
def test_of_the_derivative_of_a_rational_function_it_is_that_function(seed: int):
    source = random.Random(seed)
    below = (5 + source.choice(PARAMETERS) ** 2) * x**2 + _polynomial(source, 1)
    R = _polynomial(source, 3) / below ** source.randint(1, 2)
    form = source.choice((sympy.expand, sympy.together, sympy.cancel))
    found = antiderivative(form(R.diff(x)), x)
    assert found is not None
    assert found.is_rational_function(x)
    numbers = {p: sympy.Rational(source.randint(1, 40), 11) for p in PARAMETERS}
    constant = (found - R).xreplace(numbers)
    assert len({constant.xreplace({x: sympy.Rational(k, 7)}) for k in (2, 3, 5, 12)}) == 1


def test_beside_a_rational_function_there_may_be_an_arctangent_or_logarithms():
    R = x / (x**2 + 1)
    for rest in (sympy.atan(x), sympy.log(x + 2) - 3 * sympy.log(x + 5)):
        found = antiderivative(sympy.cancel((R + rest).diff(x)), x)
        assert found is not None
        assert sympy.simplify((found - R - rest).diff(x)) == 0
        assert type(found.atoms(sympy.Function).pop()) in (sympy.atan, sympy.log)


@pytest.mark.parametrize("seed", range(8))
def test_powers_times_waves_of_the_logarithm_have_one(seed: int):
    """By u = log(t): of exp((n + 1) u) u^j cos(b u), with n a parameter or a number."""
    draw = random.Random(seed)
    t, s, b = sympy.Symbol("t", real=True), *sympy.symbols("s b", positive=True)
    power = draw.choice([s, s / 2, sympy.Rational(draw.randint(-5, 5), 2), -s - 1])
    wave = draw.choice([sympy.cos, sympy.sin])(draw.choice([b, 2, b / 2]) * sympy.log(t))
    f = t**power * sympy.log(t) ** draw.randint(0, 2) * wave
    F = antiderivative(f, t)
    assert F is not None
    at = {t: sympy.Rational(13, 7), s: sympy.Rational(5, 3), b: sympy.Rational(8, 5)}
    assert abs((F.diff(t) - f).xreplace(at).evalf(30)) < 1e-20


@pytest.mark.parametrize("degree", range(3))
def test_a_wave_that_grows_has_one(degree: int):
    t, a, b = sympy.Symbol("t", real=True), *sympy.symbols("a b", positive=True)
    f = t**degree * sympy.exp(-a * t) * sympy.sin(b * t)
    F = antiderivative(f, t)
    assert F is not None
    at = {t: sympy.Rational(13, 7), a: sympy.Rational(5, 3), b: sympy.Rational(8, 5)}
    assert abs((F.diff(t) - f).xreplace(at).evalf(30)) < 1e-20
