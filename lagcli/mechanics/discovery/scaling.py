"""A solution with a factor that makes it readable: no fractions, no common parameters."""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from functools import reduce

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.entry import Field
from lagcli.algebra.field import over_common_denominator
from lagcli.algebra.ring import Monomial, Poly


def scaled(values: Sequence[Expr], constants: AbstractSet[Symbol]) -> tuple[Expr, ...]:
    """The values without denominators and common factors of constants, the last one positive.

    By continuity the rest is a solution even where such a factor vanishes.
    """
    terms = [term for v in values for term in sympy.Add.make_args(sympy.expand(v))]
    common = _common(terms, constants)
    result = _without_content([sympy.expand(v / common) for v in values], constants)
    leading = next((v for v in reversed(result) if v != 0), sympy.S.One)
    first = sympy.Add.make_args(leading)[0]
    sign = -1 if first.could_extract_minus_sign() and leading.could_extract_minus_sign() else 1
    return tuple(sign * v for v in result)


def _without_content(values: Sequence[Expr], constants: AbstractSet[Symbol]) -> tuple[Expr, ...]:
    """The values simplified, over what divides all their coefficients."""
    content = content_of(values, constants)
    return tuple(simplify(v if content.is_Number else v / content) for v in values)


def content_of(values: Sequence[Expr], constants: AbstractSet[Symbol]) -> Expr:
    """What divides all coefficients of the values over a common denominator."""
    field = Field(values)
    tops = over_common_denominator(field, [field(v) for v in values])
    return field.polynomial_to_sympy(_content(field, tops, constants))


def _content(field: Field, tops: Sequence[Poly], constants: AbstractSet[Symbol]) -> Poly:
    """The gcd of the coefficients, which are polynomials in the constants."""
    ring = field.ring
    fixed = {i for i, g in enumerate(field.generators) if g.expression.free_symbols <= constants}
    coefficients: dict[tuple[int, Monomial], list[tuple[Monomial, int]]] = {}
    for k, top in enumerate(tops):
        for monomial, number in ring.terms(top):
            rest = tuple(pair for pair in monomial if pair[0] not in fixed)
            inside = tuple(pair for pair in monomial if pair[0] in fixed)
            coefficients.setdefault((k, rest), []).append((inside, number))
    polys = (ring.lift(ring.build(part)) for part in coefficients.values())
    return reduce(lambda a, b: a.gcd(b), polys)


def _common(terms: Sequence[Expr], constants: AbstractSet[Symbol]) -> Expr:
    """gcd of numbers, of powers of constants and of inverse roots of their sums, over all terms."""
    number: Expr | None = None
    powers: dict[Expr, Expr] | None = None
    for term in terms:
        if term == 0:
            continue
        coefficient, rest = term.as_coeff_Mul()
        if not coefficient.is_Rational:
            coefficient, rest = sympy.S.One, term
        number = abs(coefficient) if number is None else sympy.gcd(number, coefficient)
        own = {
            base: exponent
            for base, exponent in (f.as_base_exp() for f in sympy.Mul.make_args(rest))
            if base.free_symbols
            and base.free_symbols <= constants
            and (exponent.is_Integer or (exponent.is_Rational and base.is_Add and exponent < 0))
        }
        if powers is None:
            powers = own
        else:
            powers = {
                base: min(powers.get(base, sympy.S.Zero), own.get(base, sympy.S.Zero))
                for base in {*powers, *own}
            }
    factor = number or sympy.S.One
    for base, exponent in (powers or {}).items():
        factor *= base**exponent
    return factor


def bare_terms(expression: Expr, q: Sequence[Symbol]) -> list[Expr]:
    """The terms of an expression, each once without its factors that no coordinate is in."""
    terms = sympy.Add.make_args(sympy.expand(expression))
    parts = (term.as_independent(*q, as_Add=False)[1] for term in terms if term != 0)
    return list(dict.fromkeys(parts))


def bare_sums(fraction: Expr, q: Sequence[Symbol]) -> list[Expr]:
    """The sums of its terms with the same constants, each once without these and its number."""
    top, bottom = sympy.fraction(fraction)
    sums: dict[Expr, list[Expr]] = {}
    for term in sympy.Add.make_args(sympy.expand(top)):
        number, rest = term.as_coeff_Mul()
        constants, part = rest.as_independent(*q, as_Add=False)
        sums.setdefault(constants, []).append(number * part)
    primitive = [sympy.Add(*parts).primitive()[1] for parts in sums.values()]
    over = bottom.as_independent(*q, as_Add=False)[1]
    made = (-x / over if x.could_extract_minus_sign() else x / over for x in primitive if x != 0)
    return list(dict.fromkeys(made))
