"""Functions of time for linear equations x'' + p(t) x' + q(t) x = f whose coefficients change.

With mu = exp of the integral of p, x = y/sqrt(mu) and y'' + I y = 0, I = q - p'/2 - p^2/4.  Where
I is constant or c/t^2 the solutions Y are elementary.  A translation then is Y/sqrt(mu), and the
stretching of time a product of two Y (Lane-Emden of index 1, Euler's equation, growing masses).

References
----------
Kamke, *Differentialgleichungen*, vol. I, part A, section 25.1 (normal form).
Leach, J. Math. Phys. 18 (1977) 1608 (symmetries of the time-dependent oscillator).
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of

_MOST_OPERATIONS = 200


def of_changing_coefficients(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> tuple[list[Expr], list[Expr]]:
    """Functions for translations, and for the other generators; none where p and q are constant."""
    translations: list[Expr] = []
    others: list[Expr] = []
    time, t = t, sympy.Dummy("t", positive=True)  # for t < 0 the functions differ by a sign
    for acceleration, x, rate in zip(accelerations, q, v, strict=True):
        found = _of_equation(acceleration.xreplace({time: t}), x, rate, {*q, *v}, t)
        if found is None:
            continue
        root, Y, p = found
        translations += [simplify(y / root) for y in Y]
        for stretch in _products(Y):
            others += [stretch, simplify(stretch.diff(t)), simplify(p * stretch)]
    return _distinct(translations, t, time), _distinct(others, t, time)


def _products(Y: Sequence[Expr]) -> list[Expr]:
    """Of two Y; 1, sin and cos of twice the argument for sine and cosine."""
    if Y[0].func is sympy.sin:
        double = 2 * Y[0].args[0]
        return [sympy.S.One, sympy.sin(double), sympy.cos(double)]
    return [sympy.expand(a * b) for i, a in enumerate(Y) for b in Y[: i + 1]]


def _of_equation(
    acceleration: Expr, x: Symbol, rate: Symbol, moving: set[Symbol], t: Symbol
) -> tuple[Expr, list[Expr], Expr] | None:
    """sqrt(mu), the two Y and p."""
    if sympy.count_ops(acceleration) > _MOST_OPERATIONS:
        return None
    p, own = -acceleration.diff(rate), -acceleration.diff(x)
    if free_of(p, [t]) and free_of(own, [t]):
        return None
    p, own = simplify(p), simplify(own)
    if not (p.free_symbols | own.free_symbols).isdisjoint(moving):
        return None
    integral = antiderivative(p, t)
    Y = _elementary(simplify(own - p.diff(t) / 2 - p**2 / 4), t)
    if integral is None or not Y:
        return None
    root = simplify(sympy.exp(sympy.expand(integral / 2)))
    return (root, Y, p) if all(map(_is_plain, (root, *Y))) else None


def _elementary(I: Expr, t: Symbol) -> list[Expr]:  # noqa: E741
    """Two solutions of y'' + I y = 0."""
    if I == 0:
        return [sympy.S.One, t]
    if free_of(I, [t]):
        if I.is_negative:
            return [sympy.exp(sympy.sqrt(-I) * t), sympy.exp(-sympy.sqrt(-I) * t)]
        return [sympy.sin(sympy.sqrt(I) * t), sympy.cos(sympy.sqrt(I) * t)]
    inverse = sympy.expand(simplify(1 / I))  # (t + b)^2/c
    if not inverse.is_polynomial(t) or sympy.degree(inverse, t) != 2:
        return []
    square, linear, _ = sympy.Poly(inverse, t).all_coeffs()
    shifted = t + simplify(linear / (2 * square))
    s = sympy.sqrt(sympy.Rational(1, 4) - 1 / square)
    if not s.is_Rational or s == 0 or simplify(square * shifted**2 - inverse) != 0:
        return []
    return [shifted ** (sympy.S.Half + s), shifted ** (sympy.S.Half - s)]


def _is_plain(function: Expr) -> bool:
    """Whether all its powers are rational numbers, as they are needed for values modulo a prime."""
    return not function.has(sympy.log) and all(
        p.exp.is_Rational or p.base == sympy.E for p in function.atoms(sympy.Pow)
    )


def _distinct(functions: Sequence[Expr], t: Symbol, time: Symbol) -> list[Expr]:
    """Terms without constant factors, each once, in the time of the problem."""
    terms = (
        term.as_independent(t, as_Add=False)[1].xreplace({t: time})
        for f in functions for term in sympy.Add.make_args(sympy.expand(f))
    )  # fmt: skip
    return [f for f in dict.fromkeys(terms) if f != 0]
