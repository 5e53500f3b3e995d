"""Signs for all values that the assumptions allow, where nothing that is divided by is 0."""

from __future__ import annotations

import math
from collections.abc import Sequence

import sympy
from sympy import Expr, Integer, S

from lagcli.algebra.entry import Field
from lagcli.algebra.factors import factors_of
from lagcli.algebra.polynomial_roots import coefficients
from lagcli.algebra.ring import factorization
from lagcli.algebra.signs import between_angles, sign, sign_beside_zero, sign_of_circle
from lagcli.algebra.simplification import simplify

_MOST_TERMS = 6


def deciding(expression: Expr, positive: Sequence[Expr] = ()) -> Expr:
    """A polynomial that is positive just where the expression is.

    Factors of known sign are left out, and squares that are divided by, which are not 0.
    """
    odd: list[Expr] = []
    radicands: list[Expr] = []
    direction = 1
    nonzero: dict[Expr, None] = {}
    for factor, power in with_sines(expression):
        even = power % 2 == 0
        known = 1 if even and factor**2 in positive else None
        known = sign(factor**2 if even else factor, positive) if known is None else known
        if known is None and power < 0:
            known = _beside_zero(factor)
        if known is not None:
            direction *= known if power % 2 else 1
        elif factor.is_Pow and (
            factor.base.is_nonnegative or (factor.exp.is_Rational and not factor.exp.is_Integer)
        ):
            radicands += [] if sign(factor.base, positive) == 1 else [factor.base]
        elif isinstance(factor, sympy.Abs):
            nonzero[factor.args[0]] = None
        elif even:
            nonzero |= {_without_logarithms(factor): None} if power > 0 else {}
        else:
            odd.append(factor.args[0] if factor.func is sympy.sign else _without_logarithms(factor))
    for factor in tuple(odd):  # 1 + cos(x) beside sin(x), which is not 0 either
        known = sign_of_circle(factor)
        turned = factor.as_independent(sympy.cos, sympy.sin)[1]
        beside = sympy.sin if isinstance(turned, sympy.cos) else sympy.cos
        if known is not None and {beside(*turned.args)} & {*odd, *nonzero}:
            odd.remove(factor)
            direction *= known
    others = [x for x in nonzero if x not in odd]
    plain = [e for e in radicands if not _exceeds_a_square(e, (*odd, *others))]
    roots = [e for e in (deciding(x, positive) for x in plain) if e not in {x**2 for x in others}]
    return direction * sympy.Mul(*odd, *roots, *(x**2 for x in others))


def _without_logarithms(factor: Expr) -> Expr:
    """a - b of ln a - ln b, x - 1 of ln x: what has the same sign where they are real."""
    above, below = S.One, S.One
    numbers = set()
    for term in sympy.Add.make_args(factor):
        number, log = term.as_coeff_Mul()
        if not isinstance(log, sympy.log):
            return factor
        numbers.add(abs(number))
        above, below = (above * log.args[0], below) if number > 0 else (above, below * log.args[0])
    return simplify(above - below) if len(numbers) == 1 else factor


def vanishing_part(expression: Expr) -> Expr:
    """What is 0 just where the expression is: sin θ of m g l sin θ, without factors of one sign."""
    whole = simplify(expression)
    factors = sympy.Mul.make_args(whole)
    open_ = [factor for factor in factors if not (sign(_base(factor)) or factor.is_nonzero)]
    return sympy.Mul(*map(_without_letters, open_)) if open_ else whole


def _base(factor: Expr) -> Expr:
    """x² + y² of (x² + y²)^(-3/2), which is positive, but has no value at 0; else the factor."""
    below = isinstance(factor, sympy.Pow) and factor.exp.is_number and factor.exp.is_negative
    return factor.base if below else factor


def _without_letters(factor: Expr) -> Expr:
    """sin θ/b³ + m g cos θ of a sin θ/b³ + m g a cos θ, where a is not 0."""
    if not factor.is_Add:
        return factor
    number, rest = factor.primitive()
    factor = rest if number.is_Integer else factor
    terms = [term.as_powers_dict() for term in sympy.Add.make_args(factor)]
    common = {
        letter: min(term.get(letter, S.Zero) for term in terms)
        for letter in factor.free_symbols
        if letter.is_nonzero and all(term.get(letter, S.Zero).is_Integer for term in terms)
    }
    outside = sympy.Mul(*(letter**power for letter, power in common.items() if power > 0))
    return sympy.Add(*(term / outside for term in sympy.Add.make_args(factor)))


def _exceeds_a_square(radicand: Expr, nonzero: Sequence[Expr]) -> bool:
    """Whether it is at least c x² with c > 0 and x not 0: g² + a² + 2 g a sin b ≥ a² cos² b."""
    terms = sympy.Add.make_args(sympy.expand(radicand))
    multiples = {term.as_independent(sympy.sin, sympy.cos)[0] for term in terms[:_MOST_TERMS]}
    return any(
        weak_sign(simplify(radicand - c * x**2)) == 1
        for c in (S.One, *multiples)
        for x in nonzero
        if sign(c) == 1
    )


def with_sines(expression: Expr) -> list[tuple[Expr, int]]:
    """The factors, cos² - 1 among them as -sin², which has one sign."""
    powers = dict(factors_of(expression))
    for factor in list(powers):
        less = factor - 2
        if isinstance(factor - 1, sympy.cos) and powers.get(less) == powers[factor]:
            power = powers.pop(less)
            del powers[factor]
            sine = sympy.sin((factor - 1).args[0])
            powers[sine] = powers.get(sine, 0) + 2 * power
            powers[S.NegativeOne] = powers.get(S.NegativeOne, 0) + power
    return list(powers.items())


def is_positive(expression: Expr, positive: Sequence[Expr] = ()) -> bool:
    """Whether it is positive wherever it is finite: what it is divided by is not 0."""
    return sign(expression, positive) == 1 or _by_factors(expression, positive) == 1


def weak_sign(expression: Expr, positive: Sequence[Expr] = ()) -> int | None:
    """1 or -1 where the expression has no other sign, though it may be 0; else None."""
    return _by_factors(expression, positive, zeros=True)


@between_angles
def _by_factors(
    expression: Expr, positive: Sequence[Expr] = (), *, zeros: bool = False
) -> int | None:
    """The sign where no divisor is 0, nor the expression itself, which `zeros` allows."""
    result = 1
    for factor, power in factors_of(expression):
        beside_zero = zeros or power < 0
        if power % 2 == 0 and beside_zero:
            continue
        known = sign(factor**power, positive)
        known = _beside_zero(factor) if beside_zero and not known else known
        if known is None:
            return None
        result *= known
    return result


def without_moduli(expression: Expr, positive: Sequence[Expr]) -> Expr:
    """The expression with x or -x for |x| where x has one sign beside 0, and its sign put in."""
    put_in = {
        modulus: known * modulus.args[0]
        for modulus in expression.atoms(sympy.Abs)
        if (known := weak_sign(modulus.args[0], positive)) is not None
    }
    put_in |= {
        jump: Integer(known)
        for jump in expression.atoms(sympy.sign)
        if (known := sign_of(jump.args[0], positive)) is not None
    }
    return simplify(expression.xreplace(put_in)) if put_in else expression


def _beside_zero(factor: Expr) -> int | None:
    """The sign of what has only one beside 0: roots, moduli, acos, cos - 1 and cos + 1."""
    even_root = factor.is_Pow and factor.exp.is_Rational and factor.exp.q % 2 == 0
    if isinstance(factor, (sympy.Abs, sympy.acos)) or even_root:
        return 1
    return sign_of_circle(factor) or sign_beside_zero(factor)


def sign_of(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1, -1 or 0 where it has one sign for all values; else None."""
    known = sign(expression, positive)
    for other in (_on_the_circle, _in_roots):
        known = other(expression, positive) if known is None else known
    return known


def _in_roots(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """The sign with u² for each positive letter c whose root occurs: c - d² = (u - d)(u + d)."""
    indices: dict[Expr, list[int]] = {}
    for power in {p for e in (expression, *positive) for p in e.atoms(sympy.Pow)}:
        if power.base.is_Symbol and power.base.is_positive and power.exp.is_Rational:
            indices.setdefault(power.base, []).append(int(power.exp.q))
    put_in = {
        letter: sympy.Dummy(letter.name, positive=True) ** math.lcm(*found)
        for letter, found in indices.items()
        if max(found) > 1
    }
    if not put_in:
        return None
    return sign(simplify(expression.xreplace(put_in)), [p.xreplace(put_in) for p in positive])


def _on_the_circle(expression: Expr, positive: Sequence[Expr]) -> int | None:
    """1 for a + b cos(x) with a > 0 and squares at cos = 1 and cos = -1, over a positive."""
    field = Field([expression])
    element = field(expression)
    below = sign(1 / field.to_sympy(field.polynomial(element.denominator)), positive)
    if below is None:
        return None
    poly = element.numerator * below
    for g in field.ring.used(poly):
        if field.generators[g].kind != "cos" or field.ring.degree(poly, g) != 1:
            continue
        if g + 1 in field.ring.used(poly):
            continue
        a, b = coefficients(field, poly, g)
        ends = [(a + b).numerator, (a - b).numerator]
        if sign(field.to_sympy(a), positive) == 1 and all(map(_is_a_square, ends)):
            return 1
    return None


def _is_a_square(poly: object) -> bool:
    content, factors = factorization(poly)
    return int(content) > 0 and all(exponent % 2 == 0 for _, exponent in factors)
