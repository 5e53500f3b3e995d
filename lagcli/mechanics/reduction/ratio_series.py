"""T/T0 as a series in the amplitude, by series of the potential and of the mass.

About a minimum q0 let U = U0 + u z^2/2 with z(x) a series in x = q - q0.  With
z = Z sin s the period is the integral of sqrt(M/u) dx/dz over s from 0 to 2 pi, so

    sqrt(M/M0) dx/dz = sum f_k z^k,     T = 2 pi sqrt(M0/u) (1 + f_2 Z^2/2 + 3 f_4 Z^4/8 + …),

where R is not quadratic in q', dt/dq is that of a mass M(q, E) = 2 (E - U) (dt/dq)^2, and f_k
has powers of E - U0 = u Z^2/2,

and the amplitude a, half the distance between the turning points, is the odd part of
x(z) at Z.

Reference
---------
Landau, Lifshitz, *Mechanics*, 3rd ed., sections 11 (problem 1 for the pendulum) and 28.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Rational, S, Symbol

#: T/T0 is given to this order in the amplitude.
ORDER = 4

Series = list[Expr]


def ratio_series(
    alpha: Sequence[Expr], beta: Sequence[Sequence[Expr]], n: int = ORDER
) -> list[Expr]:
    """The coefficients of a, a^2, …, a^n in T/T0, from those of U in x and of M in Z^2 and x."""
    letters: dict[Expr, Expr] = {}
    alpha = [_letter(c, letters) for c in alpha[: n + 1]]
    beta = [[_letter(c, letters) for c in row] for row in beta]
    root_U = _power(alpha, Rational(1, 2))
    z = [S.Zero, *root_U]  # z = x sqrt(1 + α_1 x + …), known to x^(n+1)
    x = _inverse(z)
    # in powers of Z with z = Z σ, σ = sin s
    sine = sympy.Dummy()
    mass = [S.Zero] * (n + 1)
    for j, row in enumerate(beta):
        for k, c in enumerate(_composed(row, x, n)[: max(n + 1 - 2 * j, 0)]):
            mass[k + 2 * j] += c * sine**k
    slope = [(k + 1) * x[k + 1] * sine**k for k in range(n + 1)]
    T = [_mean(c, sine) for c in _product(_power(mass, Rational(1, 2)), slope, n)]
    odd = [c if k % 2 else S.Zero for k, c in enumerate(x)]
    values = {letter: c for c, letter in letters.items()}
    return [c.xreplace(values) for c in _composed(T, _inverse(odd), n)[1:]]


def _letter(coefficient: Expr, letters: dict[Expr, Expr]) -> Expr:
    """A letter for a coefficient, whose powers would grow if they were multiplied out."""
    return coefficient if coefficient.is_Atom else letters.setdefault(coefficient, sympy.Dummy())


def _mean(expression: Expr, sine: Symbol) -> Expr:
    """Its mean over s, that of sin(s)^(2 k) being binomial(2 k, k)/4^k."""
    terms = sympy.Poly(expression, sine).terms()
    return sympy.Add(*(c * sympy.binomial(k, k // 2) / 2**k for (k,), c in terms if k % 2 == 0))


def _product(a: Series, b: Series, n: int) -> Series:
    return [
        sympy.Add(*(a[i] * b[k - i] for i in range(k + 1) if i < len(a) and k - i < len(b)))
        for k in range(n + 1)
    ]


def _power(a: Series, exponent: Rational) -> Series:
    """(1 + a_1 x + …)^exponent by Euler's recurrence."""
    result: Series = [S.One]
    for k in range(1, len(a)):
        terms = ((exponent * i - (k - i)) * a[i] * result[k - i] for i in range(1, k + 1))
        result.append(sympy.expand(sympy.Add(*terms) / k))
    return result


def _composed(outer: Sequence[Expr], inner: Series, n: int) -> Series:
    """outer(inner(x)) for an inner series without constant term."""
    result = [S.Zero] * (n + 1)
    power: Series = [S.One] + [S.Zero] * n
    for k in range(min(len(outer), n + 1)):
        result = [r + outer[k] * p for r, p in zip(result, power, strict=True)]
        power = _product(power, inner, n)
    return [sympy.expand(r) for r in result]


def _inverse(a: Series) -> Series:
    """The x(z) of z = x + a_2 x^2 + …, to the same order."""
    n = len(a) - 1
    x: Series = [S.Zero, S.One] + [S.Zero] * (n - 1)
    for k in range(2, n + 1):
        x[k] = S.Zero
        x[k] = -_composed(a, x, k)[k]
    return [sympy.expand(c) for c in x]
