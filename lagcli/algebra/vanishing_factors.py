"""The factors of equations that can vanish, and which equations say nothing new."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.entry import Field
from lagcli.algebra.factors import factors_of
from lagcli.algebra.numeric import vanishes_at_random
from lagcli.algebra.ring import factorization
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import is_zero

_HIGHEST_POWER = 4  # k of f^(k + 1/2): forces of two centres have 3/2
_ZERO = 1e-25  # of 40 digits: those of a number that is not 0 do not cancel so far


def vanishing_factors(equation: Expr, unknowns: Sequence[Symbol]) -> list[Expr] | None:
    """The factors that can vanish: None for 0 = 0, empty for a contradiction."""
    equation = _of_exponents(_without_signs(equation), unknowns)
    field = Field([equation], closed=True)
    try:
        element = field(equation)
    except ZeroDivisionError:
        return []
    if element.is_zero():
        return None
    if free_of(equation, unknowns) and vanishes_at_random(equation):
        return None
    factors, below = (
        [field.polynomial_to_sympy(f) for f, _ in factorization(field.ring.lift(part))[1]]
        for part in (element.numerator, element.denominator)
    )
    # sqrt(k)/k is nowhere 0
    factors = [
        _with_equal_bases(f)
        for f in factors
        if not (f.is_Pow and f.exp.is_number and _divides(f.base, below))
    ]
    if field.doubtful and any(is_zero(f) is None and abs(f.evalf(40)) < _ZERO for f in factors
                              if not f.free_symbols):  # fmt: skip
        return None
    open_ = [f for f in factors if not free_of(f, unknowns) and sign(f) not in (1, -1)]
    # sin(y - 2 x) is not multiplied out: its roots are y = 2 x + n pi
    whole = len(open_) == 1 and not field.ring.used(element.denominator)
    return [equation] if whole and _is_one_wave(equation, unknowns) else open_


def _of_exponents(equation: Expr, unknowns: Sequence[Symbol]) -> Expr:
    """u - v - ln(-b/a) for a exp(u) + b exp(v) with constants a and b of opposite signs."""
    terms = sympy.Add.make_args(sympy.expand(equation, power_exp=False))
    if len(terms) != 2:
        return equation
    parts = []
    for term in terms:
        exponentials = [f for f in sympy.Mul.make_args(term) if f.func is sympy.exp]
        size = term / sympy.Mul(*exponentials)
        if not free_of(size, unknowns) or sign(size) not in (1, -1):
            return equation
        parts.append((size, sympy.Add(*(f.args[0] for f in exponentials))))
    (a, u), (b, v) = parts
    if sign(a) == sign(b) or free_of(u - v, unknowns):
        return equation
    return u - v - sympy.log(-b / a)


def _is_one_wave(equation: Expr, unknowns: Sequence[Symbol]) -> bool:
    """Whether the unknowns occur in one sine or cosine of several of them alone."""
    waves = [f for f in equation.atoms(sympy.sin, sympy.cos) if not free_of(f, unknowns)]
    if len(waves) != 1:
        return False
    return free_of(equation.xreplace({waves[0]: sympy.Dummy()}), unknowns)


def divisors(product: Expr) -> set[Expr]:
    """What a product is divided by, in powers."""
    powers = (factor.as_base_exp() for factor in sympy.Mul.make_args(product))
    return {base for base, exponent in powers if exponent.is_negative}


def in_sines(value: Expr) -> Expr:
    """The value with tan and cot as quotients of sin and cos."""
    ratios = {sympy.tan: (sympy.sin, sympy.cos), sympy.cot: (sympy.cos, sympy.sin)}
    return value.xreplace(
        {
            f: ratios[type(f)][0](f.args[0]) / ratios[type(f)][1](f.args[0])
            for f in value.atoms(*ratios)
        }
    )


def can_vanish(expression: Expr) -> bool:
    """Whether it is not known to have a sign, and not known to be other than 0."""
    return sign(expression) not in (1, -1) and sign(expression**2) != 1


def may_vanish(expression: Expr) -> list[Expr]:
    """The factors with symbols that are not known to be other than 0."""
    factors = (f for f, power in factors_of(expression) if power > 0 and f.free_symbols)
    return [f for f in factors if can_vanish(f)]


def squares_divided_by(values: Iterable[Expr]) -> list[Expr]:
    """The squares of all that anything in the values is divided by: positive where they are."""
    powers = {power for value in values for power in in_sines(value).atoms(sympy.Pow)}
    below = {power.base for power in powers if power.exp.is_negative and power.base.free_symbols}
    return [d**2 for d in sorted(below, key=sympy.default_sort_key)]


def _divides(product: Expr, factors: Sequence[Expr]) -> bool:
    """Whether all its factors are among these, up to their signs."""
    own = (factor for factor, _ in factors_of(product) if not factor.is_number)
    return all(factor in factors or -factor in factors for factor in own)


def _without_signs(equation: Expr) -> Expr:
    """v/u^k of v sgn(u)/u^k, which has no value where u = 0."""
    below = divisors(equation)
    signs = (u for u in sympy.Mul.make_args(equation) if isinstance(u, sympy.sign))
    void = [u for u in signs if {u.args[0], -u.args[0]} & below]
    return equation.xreplace(dict.fromkeys(void, sympy.S.One)) if void else equation


def _with_equal_bases(factor: Expr) -> Expr:
    """f - g of f^p - g^p, p = ±(k + 1/2), which vanishes where f = g alone: both are positive."""
    roots = [p for p in factor.atoms(sympy.Pow) if p.exp == sympy.S.Half]
    if len(roots) != 2 or not factor.is_Add:
        return factor
    first, second = (sympy.collect(factor, roots, evaluate=False).get(p, 0) for p in roots)
    if sympy.expand(factor - first * roots[0] - second * roots[1]) != 0:
        return factor
    bases = [p.base for p in roots]
    equal = any(
        sympy.expand(first * g**k + second * f**k) == 0
        for k in range(_HIGHEST_POWER)
        for f, g in (bases, bases[::-1])
    )
    return sympy.expand(bases[0] - bases[1]) if equal else factor


def without_repeats(left: list[list[Expr]]) -> list[list[Expr]]:
    """The equations without those that another one, which has one factor, makes 0."""
    kept: list[list[Expr]] = []
    for place, factors in enumerate(left):
        others = [*kept, *left[place + 1 :]] if len(factors) > 1 else kept
        alone = [other[0] for other in others if len(other) == 1]
        if not any(same(f, g) for f in factors for g in alone):
            kept.append(factors)
    return kept


def same(first: Expr, second: Expr) -> bool:
    """Whether two equations are one, up to the sign."""
    if first in (second, -second):
        return True
    if first.free_symbols != second.free_symbols:
        return False
    return bool(sympy.expand(first + second) == 0)
