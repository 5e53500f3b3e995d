"""Variables u(x) in which a formula is rational, with (du/dx)^2 rational in u.

u = x;  u = x^2;  u = exp(k x);  u = cos, sin, tan, sinh, tanh of k x + a
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import reduce

import sympy
from sympy import Expr, S, Symbol
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from lagcli.algebra.build import free_of
from lagcli.record import record

_SINE, _COSINE = Symbol("#sin", positive=True), Symbol("#cos", positive=True)


@record
class IntegralSubstitution:
    """`value` = u(x), `slope` = du/dx by x, its square and the radicand by u."""

    x: Symbol
    variable: Symbol
    value: Expr
    slope: Expr
    slope_squared: Expr
    radicand: Expr


def substitutions(radicand: Expr, x: Symbol) -> Iterator[IntegralSubstitution]:
    """The substitutions by which a radicand becomes a rational function, the simple ones first."""
    functions = [f for f in radicand.atoms(sympy.Function) if not free_of(f, [x])]
    if not functions:
        yield from _powers(radicand, x)
    elif all(isinstance(f, sympy.exp) for f in functions):
        yield from _exponential(radicand, x, functions)
    elif all(isinstance(f, TrigonometricFunction) for f in functions):
        yield from _circular(radicand, x, functions, _CIRCULAR)
    elif all(isinstance(f, HyperbolicFunction) for f in functions):
        yield from _circular(radicand, x, functions, _HYPERBOLIC)


def _rational(expression: Expr, u: Symbol) -> bool:
    return bool(expression.is_rational_function(u))


def _powers(radicand: Expr, x: Symbol) -> Iterator[IntegralSubstitution]:
    if not _rational(radicand, x):
        return
    yield IntegralSubstitution(x, x, x, S.One, S.One, radicand)
    u = Symbol("#u", positive=True)
    squared = radicand.subs(x, sympy.sqrt(u))
    if _rational(squared, u):
        yield IntegralSubstitution(x, u, x**2, 2 * x, 4 * u, squared)


def _exponential(
    radicand: Expr, x: Symbol, functions: list[Expr]
) -> Iterator[IntegralSubstitution]:
    rates = [f.args[0].diff(x) for f in functions]
    ratios = [sympy.cancel(rate / rates[0]) for rate in rates]
    if not all(r.is_Rational for r in ratios):
        return
    k = rates[0] * reduce(sympy.gcd, ratios)
    if not free_of(k, [x]):
        return
    u = Symbol("#u", positive=True)
    put_in = {
        f: sympy.exp(sympy.expand(f.args[0] - rate * x)) * u ** sympy.cancel(rate / k)
        for f, rate in zip(functions, rates, strict=True)
    }
    there = radicand.xreplace(put_in)
    if free_of(there, [x]) and _rational(there, u):
        value = sympy.exp(k * x)
        yield IntegralSubstitution(x, u, value, k * value, k**2 * u**2, there)


_Rule = tuple[Callable[[Expr], Expr], Callable[[Expr], Expr], Expr, Expr, Expr, Expr]


def _table() -> tuple[tuple[_Rule, ...], tuple[_Rule, ...]]:
    """By function of the angle: it, its derivative, that squared by u, sine, cosine by u."""
    u = Symbol("#u", real=True)
    one, plus = sympy.sqrt(1 - u**2), sympy.sqrt(1 + u**2)
    circular: tuple[_Rule, ...] = (
        (sympy.cos, lambda a: -sympy.sin(a), 1 - u**2, one, u, u),
        (sympy.sin, sympy.cos, 1 - u**2, u, one, u),
        (sympy.tan, lambda a: 1 / sympy.cos(a) ** 2, (1 + u**2) ** 2, u / plus, 1 / plus, u),
    )
    hyperbolic: tuple[_Rule, ...] = (
        (sympy.sinh, sympy.cosh, 1 + u**2, u, plus, u),
        (sympy.cosh, sympy.sinh, u**2 - 1, sympy.sqrt(u**2 - 1), u, u),
        (sympy.tanh, lambda a: 1 / sympy.cosh(a) ** 2, (1 - u**2) ** 2, u / one, 1 / one, u),
    )
    return circular, hyperbolic


_CIRCULAR, _HYPERBOLIC = _table()


def _circular(
    radicand: Expr, x: Symbol, functions: list[Expr], rules: tuple[_Rule, ...]
) -> Iterator[IntegralSubstitution]:
    [angle, *others] = {f.args[0] for f in functions}
    k = angle.diff(x)
    if others or not free_of(k, [x]):
        return
    plain = radicand.replace(
        lambda e: e in functions, lambda e: _by_sine_and_cosine(type(e).__name__)
    )
    for value, derivative, squared, sine, cosine, u in rules:
        there = plain.subs({_SINE: sine, _COSINE: cosine}, simultaneous=True)
        if free_of(there, [x]) and _rational(there, u):
            yield IntegralSubstitution(
                x, u, value(angle), k * derivative(angle), k**2 * squared, there
            )


def _by_sine_and_cosine(name: str) -> Expr:
    s, c = _SINE, _COSINE
    return {"sin": s, "cos": c, "tan": s / c, "cot": c / s, "sec": 1 / c, "csc": 1 / s}[
        name.removesuffix("h")
    ]
