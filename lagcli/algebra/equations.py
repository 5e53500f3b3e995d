"""Equations in one unknown, solved exactly: polynomials, and polynomials in sin and cos.

A polynomial is factored; factors of degree one and two, and powers x^k = a, are solved by
radicals.  What has only numbers in it is solved by numbers where radicals do not serve.
Roots may be complex for some values of the parameters: the caller tells which are real.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd

import mpmath
import sympy
from sympy import Dummy, Expr, Rational, S, Symbol

from lagcli.algebra.build import free_of
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.opening import common_multiple, phases, without_phases
from lagcli.algebra.ring import Poly, factorization
from lagcli.algebra.roots import substitute_square
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import shape, simplify
from lagcli.expression import Expression, signed

_DECIMALS = 15
_MAX_DEGREE = 24
_INVERSES = {
    sympy.log: sympy.exp,
    sympy.asinh: sympy.sinh,
    sympy.asin: sympy.sin,
    sympy.atan: sympy.tan,
}


@dataclass(frozen=True, slots=True)
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
        if n > _MAX_DEGREE:
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
        return _between_two_powers(field.polynomial_to_sympy(poly), unknown)
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
        open_roots = _logarithms if first.kind == "exp" else _hyperbolic
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
    if exponent.is_nonzero is not True:
        return None
    if exponent.could_extract_minus_sign():
        constant, exponent = 1 / constant, -exponent
    value = (1 / constant) ** (1 / exponent)
    return solve_for(base - value, unknown) if side == 1 else Roots((), angle=False)


def _over_all_turns(angles: Sequence[Expr], n: int) -> tuple[Expr, ...]:
    """The x in (-pi, pi] at which n x is one of the angles up to whole turns."""
    found: list[Expr] = []
    for angle in angles:
        negative = angle.could_extract_minus_sign() or angle == 0
        first = -((n - negative) // 2)
        found += [(angle + 2 * k * sympy.pi) / n for k in range(first, first + n)]
    return tuple(dict.fromkeys(found))


def coefficients(field: Field, poly: Poly, generator: int) -> list[Element]:
    """The coefficients by powers of a generator, constant term first."""
    parts = field.ring.coefficients(poly, generator)
    degree = max(parts, default=0)
    return [field.polynomial(parts.get(k, field.ring.zero)) for k in range(degree + 1)]


def polynomial_roots(field: Field, poly: Poly, generator: int) -> list[Expr] | None:
    """The roots in one generator, without repetition; None where no closed form was found.

    Roots that are surely not real are left out.
    """
    roots: list[Expr] = []
    for found, _, _ in factor_roots(field, poly, generator):
        if found is None:
            return None
        roots += found
    return [root for root in dict.fromkeys(roots) if root.is_real is not False]


def factor_roots(
    field: Field, poly: Poly, generator: int
) -> list[tuple[list[Expr] | None, int, int]]:
    """By irreducible factor: roots (None without closed form), multiplicity, degree."""
    factors = factors_by_coefficients(field, poly, generator)
    return [(_roots(field, parts), many, len(parts) - 1) for parts, many in factors]


def factors_by_coefficients(
    field: Field, poly: Poly, generator: int
) -> list[tuple[list[Element], int]]:
    """Those with the generator: the coefficients a_0, a_1, … and the multiplicity of each."""
    _, factors = factorization(field.ring.lift(poly))
    factors.sort(key=lambda pair: (pair[0].total_degree(), str(pair[0])))
    parted = ((coefficients(field, factor, generator), many) for factor, many in factors)
    return [(parts, many) for parts, many in parted if len(parts) > 1]


def _roots(field: Field, a: Sequence[Element]) -> list[Expr] | None:
    """The roots of a_0 + a_1 x + … of an irreducible polynomial."""
    degree = len(a) - 1
    step = gcd(*(k for k in range(1, degree + 1) if not a[k].is_zero()))
    if step > 1:
        powers = _roots(field, a[::step])
        return None if powers is None else _radicals(powers, step)
    if degree == 1:
        return [field.to_sympy(-a[0] / a[1])]
    if degree == 2:
        # x = (-b ± sqrt(b² - 4 a c)) / (2 a)
        root = sympy.sqrt(simplify(field.to_sympy(a[1] ** 2 - field.rational(4) * a[2] * a[0])))
        # of |b| and -|b| together the modulus is of no use
        moduli = (x.args[0] if isinstance(x, sympy.Abs) else x for x in sympy.Mul.make_args(root))
        root = sympy.Mul(*moduli)
        middle, below = field.to_sympy(-a[1]), field.to_sympy(field.rational(2) * a[2])
        return [simplify((middle - root) / below), simplify((middle + root) / below)]
    return _scaled_roots(field, a)


def _scaled_roots(field: Field, a: Sequence[Element]) -> list[Expr] | None:
    """With x = r y, r = a_(n-1)/a_n, the coefficients may become numbers."""
    n = len(a) - 1
    scale = field.rational(1) if a[n - 1].is_zero() else _without_number(a[n - 1] / a[n])
    numbers = [(a[k] / (a[n] * scale ** (n - k))).rational() for k in range(n)]
    if any(number is None for number in numbers):
        return None
    unit = scale.rational()
    exact = [Rational(b.numerator, b.denominator) for b in numbers if b is not None]
    if n == 3:
        return [simplify(field.to_sympy(scale)) * y for y in _cubic_roots(*exact)]
    if unit is None or n > _MAX_DEGREE:
        return None
    poly = sympy.Poly([1, *reversed(exact)], Dummy())
    return [decimal(Rational(unit) * root.evalf(_DECIMALS + 10)) for root in poly.real_roots()]


def _without_number(element: Element) -> Element:
    """The element over the ratio of its leading coefficients."""
    above = int(element.numerator.leading_coefficient())
    below = int(element.denominator.leading_coefficient())
    return element * element.field.rational(Fraction(below, above))


def _cubic_roots(a0: Rational, a1: Rational, a2: Rational) -> list[Expr]:
    """The real roots of y³ + a_2 y² + a_1 y + a_0 (Viète, Cardano), y = z - a_2/3."""
    p, q = a1 - a2**2 / 3, 2 * a2**3 / 27 - a2 * a1 / 3 + a0
    discriminant = -4 * p**3 - 27 * q**2
    if discriminant >= 0:
        # z = 2 sqrt(-p/3) cos(acos(3 q/(2 p) sqrt(-3/p))/3 - 2 pi k/3)
        angle = sympy.acos(3 * q / (2 * p) * sympy.sqrt(-3 / p))
        return [
            2 * sympy.sqrt(-p / 3) * sympy.cos((angle - 2 * sympy.pi * k) / 3) - a2 / 3
            for k in range(3)
        ]
    root = sympy.sqrt(q**2 / 4 + p**3 / 27)
    return [sympy.real_root(-q / 2 + root, 3) + sympy.real_root(-q / 2 - root, 3) - a2 / 3]


def _radicals(powers: Sequence[Expr], k: int) -> list[Expr] | None:
    """The real x with x^k one of the given values; None: an odd root of an angle's open sign."""
    roots: list[Expr] = []
    for value in map(simplify, powers):
        if value.is_zero:
            roots.append(S.Zero)
        elif k % 2 == 0:
            if value.is_negative:
                continue
            root = simplify(sympy.Pow(value, Rational(1, k)))
            roots += [-root, root]
        elif value.is_nonnegative:
            roots.append(sympy.Pow(value, Rational(1, k)))
        elif value.is_nonpositive:
            roots.append(-sympy.Pow(-value, Rational(1, k)))
        elif value.is_rational_function():
            roots.append(sympy.sign(value) * sympy.Pow(sympy.Abs(value), Rational(1, k)))
        else:
            return None
    return roots


def decimal(value: Expr) -> Expr:
    """A number as the exact decimal fraction of its first 15 significant digits."""
    with mpmath.workdps(_DECIMALS + 5):
        number = mpmath.mpf(str(value))
        return Rational(mpmath.nstr(number, _DECIMALS, min_fixed=-9, max_fixed=_DECIMALS))


def is_decimal(value: Expr) -> bool:
    """Whether a root is one that `decimal` rounded."""
    return bool(value.is_Rational and len(str(value.q)) > _DECIMALS // 2)


def written(value: Expr, order: Sequence[str]) -> Expression:
    """The readable shape of a root; one that was rounded is written with a decimal point."""
    if not is_decimal(value) or 10**400 % int(value.q):
        return shape(value, order)
    return signed(Fraction(int(value.p), int(value.q)), decimal=True)


def rounded(value: Expr) -> Expr:
    """A function of a decimal as a decimal, anything else unchanged."""
    if value.is_number and any(map(is_decimal, value.atoms(Rational))):
        return decimal(value.evalf(_DECIMALS + 10))
    return value


def angle_roots(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """The angles in (-pi, pi] at which a polynomial in its cosine and sine vanishes.

    Parameters
    ----------
    cosine
        The generator of the cosine; that of the sine follows it.
    """
    ring = field.ring
    roots: list[Expr] = []
    _, factors = factorization(ring.lift(poly))
    for factor, _ in sorted(factors, key=lambda pair: (pair[0].total_degree(), str(pair[0]))):
        used = ring.used(factor)
        if cosine not in used and cosine + 1 not in used:
            continue
        found = _angles(field, ring.lift(factor), cosine)
        if found is None:
            return None
        roots += found
    return [root for root in dict.fromkeys(roots) if root.is_real is not False]


def _angles(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    ring, sine = field.ring, cosine + 1
    if ring.degree(poly, sine) == 0:
        values = polynomial_roots(field, poly, cosine)
        return None if values is None else [a for c in values for a in _with_cosine(c)]
    swapped = _without_cosine(field, poly, cosine)
    if swapped is not None:
        values = polynomial_roots(field, swapped, sine)
        return None if values is None else [a for s in values for a in _with_sine(s)]
    if (ratio := _ratio(field, poly, cosine)) is not None:  # a cos + b sin = 0: tan = -a/b
        return _with_tangent(field.to_sympy(-ratio))
    return _by_half_angle(field, poly, cosine)


def _without_cosine(field: Field, poly: Poly, cosine: int, side: int = -1) -> Poly | None:
    """The polynomial in the sine alone: cos² = 1 - sin², cosh² = 1 + sinh²; None: it is not one."""
    ring = field.ring
    if any(power % 2 for power in ring.coefficients(poly, cosine)):
        return None
    return substitute_square(field, poly, cosine, ring.one + side * ring.generator(cosine + 1) ** 2)


def _logarithms(field: Field, poly: Poly, exponential: int) -> list[Expr] | None:
    """The x at which a polynomial in exp(x) vanishes."""
    values = polynomial_roots(field, poly, exponential)
    return (
        None if values is None else [sympy.log(v) for v in values if v != 0 and not _below_zero(v)]
    )


def _hyperbolic(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """The x at which a polynomial in cosh(x) and sinh(x) vanishes."""
    ring = field.ring
    roots: list[Expr] = []
    for factor, _ in factorization(ring.lift(poly))[1]:
        used = {cosine, cosine + 1} & set(ring.used(factor))
        if not used:
            continue
        whole = ring.lift(factor)
        alone = _without_cosine(field, whole, cosine, 1) if len(used) > 1 else whole
        if alone is None:
            values = _by_exponential(field, whole, cosine)
        elif cosine in ring.used(alone):
            values = polynomial_roots(field, alone, cosine)
            apart = (v for v in values or () if not _below_zero(v - 1 if v.is_number else v))
            values = values and [side * sympy.acosh(v) for v in apart for side in (-1, 1)]
        else:
            values = polynomial_roots(field, alone, cosine + 1)
            values = values and [sympy.asinh(v) for v in values]
        if values is None:
            return None
        roots += values
    return list(dict.fromkeys(roots))


def _below_zero(value: Expr) -> bool:
    """Whether it is not positive wherever it is real: a square root with a minus, say."""
    if value.is_number:
        return bool(value.evalf() < 0)
    return value.is_nonpositive or all(
        f.is_nonnegative or (f.is_Pow and f.exp == S.Half) for f in sympy.Mul.make_args(-value)
    )


def _with_cosine(value: Expr) -> list[Expr]:
    if value == 1:
        return [S.Zero]
    if value == -1:
        return [sympy.pi]
    if value.is_number and abs(value.evalf()) > 1:
        return []
    return [-sympy.acos(value), sympy.acos(value)]


def _with_sine(value: Expr) -> list[Expr]:
    if value.is_zero:
        return [S.Zero, sympy.pi]
    if abs(value) == 1:
        return [sympy.asin(value)]
    if value.is_number and abs(value.evalf()) > 1:
        return []
    angle = sympy.asin(sympy.factor_terms(value))  # asin(-v) is -asin(v)
    return [angle, -sympy.pi - angle if value.is_negative else sympy.pi - angle]


def _with_tangent(value: Expr) -> list[Expr]:
    angle = sympy.atan(sympy.factor_terms(value))
    return [angle, angle - sympy.pi if value.is_positive else angle + sympy.pi]


def _by_exponential(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """Of a cosh x + b sinh x = 0: tanh x = -a/b; else by exp(x) = cosh x + sinh x."""
    ratio = _ratio(field, poly, cosine)
    if ratio is not None:
        return [sympy.atanh(sympy.factor_terms(field.to_sympy(-ratio)))]
    E = field(Dummy("#E", positive=True))
    half = field.rational(Fraction(1, 2))
    images = {cosine: half * (E + E**-1), cosine + 1: half * (E - E**-1)}
    return _logarithms(
        field, _put_in(field, poly, images).numerator, field.ring.used(E.numerator)[0]
    )


def _ratio(field: Field, poly: Poly, cosine: int) -> Element | None:
    """a/b of a polynomial a cos + b sin, else None."""
    free, *along = coefficients(field, poly, cosine + 1)
    if len(along) != 1:
        return None
    ratio = free / (along[0] * field.generator(cosine))
    used = {*field.ring.used(ratio.numerator), *field.ring.used(ratio.denominator)}
    return None if {cosine, cosine + 1} & used else ratio


def _by_half_angle(field: Field, poly: Poly, cosine: int) -> list[Expr] | None:
    """With t = tan(angle/2): cos = (1 - t²)/(1 + t²), sin = 2 t/(1 + t²)."""
    ring, sine = field.ring, cosine + 1
    t = field(Dummy("#t", real=True))
    number = ring.used(t.numerator)[0]
    one = field.rational(1)
    images = {
        cosine: (one - t * t) / (one + t * t),
        sine: (t + t) / (one + t * t),
    }
    values = polynomial_roots(field, _put_in(field, poly, images).numerator, number)
    if values is None:
        return None
    angles = [2 * sympy.atan(value) for value in values]
    at_pi = ring.compose(poly, {cosine: ring.constant(-1), sine: ring.zero})
    return [sympy.pi, *angles] if at_pi == 0 else angles


def _put_in(field: Field, poly: Poly, images: Mapping[int, Element]) -> Element:
    """A polynomial with values for some generators."""
    ring, total = field.ring, field.rational(0)
    for monomial, coefficient in ring.terms(poly):
        rest = tuple(pair for pair in monomial if pair[0] not in images)
        term = field.polynomial(ring.build([(rest, coefficient)]))
        for generator, exponent in monomial:
            if generator in images:
                term = term * images[generator] ** exponent
        total = total + term
    return total
