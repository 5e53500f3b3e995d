"""W with W' = sqrt(P), where P is of first or second degree in the coordinate.

    a + b x:             W = 2 P^(3/2)/(3 b)
    A - k u^2, k > 0:    W = u sqrt(P)/2 + A/(2 sqrt(k)) atan(sqrt(k) u/sqrt(P))
    A + k u^2, k > 0:    W = u sqrt(P)/2 + A/(2 sqrt(k)) log(sqrt(k) u + sqrt(P))

with u = x + b/(2 c) for P = a + b x + c x^2: uniform field, oscillator, and its inversion.
"""

from __future__ import annotations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign


def closed_form(derivative: Expr, x: Symbol) -> Expr | None:
    """W by its derivative, which is put back; None where it stays an integral."""
    parts = [_part(part, x) for part in sympy.Add.make_args(derivative)]
    if any(part is None for part in parts):
        return None
    whole = sympy.Add(*(part for part in parts if part is not None))
    return whole if is_zero(whole.diff(x) - derivative) is True else None


def _part(part: Expr, x: Symbol) -> Expr | None:
    factor, root = part.as_independent(x, as_Add=False)
    if not (root.is_Pow and root.exp == S.Half):
        return antiderivative(part, x)
    polynomial = root.base.as_poly(x)
    if polynomial is None or polynomial.degree() not in (1, 2):
        return None
    *second, b, a = polynomial.all_coeffs()
    if not second:
        return factor * 2 * root**3 / (3 * b)
    [c] = second
    known = sign(c)
    if known not in (1, -1) or not free_of(c, [x]):
        return None
    k, u, A = sympy.sqrt(known * c), x + b / (2 * c), simplify(a - b**2 / (4 * c))
    angle = sympy.log(k * u + root) if known == 1 else sympy.atan(k * u / root)
    return factor * (u * root / 2 + A / (2 * k) * angle)
