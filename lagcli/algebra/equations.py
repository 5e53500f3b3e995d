"""Equations in one unknown, solved exactly: polynomials, and polynomials in sin and cos.

Roots may be complex for some values of the parameters: the caller tells which are real.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol
from sympy.simplify.fu import TR8

from lagcli.algebra.build import free_of
from lagcli.algebra.circular_roots import angle_roots, hyperbolic_roots, logarithms
from lagcli.algebra.decimals import rounded
from lagcli.algebra.entry import Field
from lagcli.algebra.opening import common_multiple, phases, without_phases
from lagcli.algebra.polynomial_roots import MAX_DEGREE, polynomial_roots
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.signs import sign
from lagcli.record import record

_INVERSES = {
    sympy.log: sympy.exp,
    sympy.asinh: sympy.sinh,
    sympy.asin: sympy.sin,
    sympy.atan: sympy.tan,
}


@record
class Roots:
    """The roots of an equation; those of an angle lie in (-pi, pi]."""

    values: tuple[Expr, ...]
    angle: bool


def solve_for(expression: Expr, unknown: Symbol) -> Roots | None:
    """All roots of expression = 0 that may be real; None where no closed form was found.

    The unknown occurs as a polynomial variable, or inside sines and cosines of integer multiples
    of it, or of one constant multiple of it, or inside hyperbolic ones or exponentials of integer
    multiples of a (unknown - b), or inside one logarithm, asinh, asin or atan.
    """
    for x, phase in phases([expression], [unknown]).items():
        plain = solve_for(without_phases(expression, {x: phase}), x)
        return plain and Roots(tuple(rounded(root + phase) for root in plain.values), plain.angle)
    if (n := common_multiple(expression, unknown)) > 1:
        if n > MAX_DEGREE:
            return None  # 299792458 turns
        plain = solve_for(without_phases(expression.xreplace({unknown: unknown / n}), {}), unknown)
        return plain and Roots(_over_all_turns(plain.values, n), plain.angle)
    field = Field([expression], closed=True)
    try:
        poly = field(expression).numerator
    except ZeroDivisionError:
        return None
    used = [
        g for g in field.ring.used(poly)
        if unknown in field.generators[g].expression.free_symbols
    ]  # fmt: skip
    if not used:
        return Roots((), angle=False)
    first = field.generators[used[0]]
    if any(field.generators[g].kind == "power" for g in used):
        return _with_powers(field, poly, unknown)
    if used == [field.number_of(unknown)]:
        found = polynomial_roots(field, poly, used[0])
        return None if found is None else Roots(tuple(found), angle=False)
    if len(used) == 1 and first.expression.func in _INVERSES:
        return _under_inverse(first.expression, polynomial_roots(field, poly, used[0]), unknown)
    if first.kind not in ("cos", "sin", "cosh", "sinh", "exp") or first.argument is None:
        return None
    cosine = first.partner if first.kind in ("sin", "sinh") else used[0]
    if not set(used) <= ({cosine} if first.kind == "exp" else {cosine, cosine + 1}):
        return None
    offset = first.argument.subs(unknown, 0)
    factor = sympy.expand(first.argument - offset) / unknown
    if unknown in factor.free_symbols:
        return None
    if first.kind not in ("cos", "sin"):
        open_roots = logarithms if first.kind == "exp" else hyperbolic_roots
        values = open_roots(field, poly, cosine)
        return (
            None
            if values is None
            else Roots(tuple(sympy.expand((rounded(v) - offset) / factor) for v in values), False)
        )
    if offset != 0:
        return None
    angles = angle_roots(field, poly, cosine)
    if angles is None:
        angles = _in_sums(expression.xreplace({unknown: unknown / factor}), unknown)
    if angles is None:
        return None
    angles = [rounded(angle) for angle in angles]
    if factor == 1:
        return Roots(tuple(angles), angle=True)
    if factor.is_Rational and factor.p == 1 and not any(a.free_symbols for a in angles):
        # sin and cos of theta/n: theta lies in (-pi, pi] where theta/n is in (-pi/n, pi/n]
        return Roots(
            tuple(a / factor for a in angles if -sympy.pi < a / factor <= sympy.pi), angle=True
        )
    return Roots(tuple(a / factor for a in angles), angle=False)


def _under_inverse(node: Expr, values: list[Expr] | None, unknown: Symbol) -> Roots | None:
    """Of ln(u) = v: u = exp(v); of asin and atan only where v is a number, whose range is known."""
    found: list[Expr] = []
    for v in values or ():
        if isinstance(node, (sympy.asin, sympy.atan)):
            if not v.is_number:
                return None
            if abs(v.evalf()) >= sympy.pi.evalf() / 2:  # asin(u) = pi/2 has u at its edge
                continue
        inner = solve_for(node.args[0] - _INVERSES[node.func](v), unknown)
        if inner is None:
            return None
        found += inner.values
    return None if values is None else Roots(tuple(dict.fromkeys(found)), angle=False)


def _with_powers(field: Field, poly: Poly, unknown: Symbol) -> Roots | None:
    """With open exponents: of each factor; a power alone where its base is 0, if it may be."""
    parts: list[Roots | None] = []
    for factor, _ in factorization(field.ring.lift(poly))[1]:
        used = [field.generators[g] for g in field.ring.used(factor)]
        within = [g for g in used if unknown in g.expression.free_symbols]
        powers = [g for g in within if g.kind == "power"]
        plain = field.polynomial_to_sympy(factor)
        if powers and len(factor) > 1:
            parts.append(_between_two_powers(plain, unknown))
        elif powers:
            parts += (_of_a_power(g.expression, unknown) for g in powers)
        elif within and not powers:
            parts.append(solve_for(plain, unknown))
    found = [part for part in parts if part is not None]
    if len(found) < len(parts):
        return None
    roots = [root for part in found for root in part.values]
    return Roots(tuple(dict.fromkeys(roots)), angle=any(part.angle for part in found))


def _of_a_power(power: Expr, unknown: Symbol) -> Roots | None:
    """Where u^n with an open exponent is 0: at u = 0 if n > 0, nowhere if n < 0 or u > 0."""
    base, exponent = power.as_base_exp()
    least = {n: 1 + sympy.Dummy(integer=True, nonnegative=True) for n in exponent.free_symbols
             if n.is_integer and n.is_positive}  # fmt: skip
    exponent = sympy.expand(exponent.xreplace(least))
    if sign(base) == 1 or exponent.is_negative:
        return Roots((), angle=False)
    return solve_for(base, unknown) if exponent.is_positive else None


def _between_two_powers(expression: Expr, unknown: Symbol) -> Roots | None:
    """Of A u^m = B u^n with open exponents, where u > 0: u = (B/A)^(1/(m - n))."""
    terms = sympy.Add.make_args(sympy.expand(expression))
    if len(terms) != 2:
        return None
    ratio = sympy.powsimp(-terms[1] / terms[0], force=True)
    constant, power = ratio.as_independent(unknown, as_Add=False)
    side, (base, exponent) = sign(constant), power.as_base_exp()
    if side is None or free_of(base, [unknown]) or not free_of(exponent, [unknown]):
        return None
    if exponent.is_nonzero is not True or exponent.is_integer:
        return None
    if exponent.could_extract_minus_sign():
        constant, exponent = 1 / constant, -exponent
    value = (1 / constant) ** (1 / exponent)
    return solve_for(base - value, unknown) if side == 1 else Roots((), angle=False)


def _in_sums(expression: Expr, unknown: Symbol) -> list[Expr] | None:
    """The angles by sines of multiple angles that have a common one: a - k sin(2 x)/2 = 0."""
    sums = sympy.expand(TR8(sympy.expand(expression)))
    if common_multiple(sums, unknown) == 1:
        return None
    found = solve_for(sums, unknown)
    return None if found is None else list(found.values)


def _over_all_turns(angles: Sequence[Expr], n: int) -> tuple[Expr, ...]:
    """The x in (-pi, pi] at which n x is one of the angles up to whole turns."""
    found: list[Expr] = []
    for angle in angles:
        negative = angle.could_extract_minus_sign() or angle == 0
        first = -((n - negative) // 2)
        found += [(angle + 2 * k * sympy.pi) / n for k in range(first, first + n)]
    return tuple(dict.fromkeys(found))
