"""Elementary solutions of y'' + I(t) y = 0: a polynomial times exp of an integral.

For y'' = r y with a rational r, y = P exp(integral of theta), where theta is the sum of the parts
of sqrt(r) at its poles c and at infinity, each with a sign, and of alpha_c/(x - c).  The degree of
P is alpha_oo - sum alpha_c, and P'' + 2 theta P' + (theta' + theta^2 - r) P = 0.

Where I is rational in u = exp(c t), sqrt(u) y obeys w'' = -(I/c^2 + 1/4) w/u^2.  With sines and
cosines it is so for t = -i s.

References
----------
Kovacic, J. Symb. Comp. 2 (1986) 3, section 3.1 (the first case).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import nullspace, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.spectrum import frequency_of

_MOST_PLACES = 5  # the choices of signs double with each
_LARGEST_DEGREE = 8
_HALF = sympy.Rational(1, 2)
_WAVES = (sympy.exp, sympy.cosh, sympy.sinh, sympy.tanh, sympy.coth)
_TURNING = (sympy.sin, sympy.cos, sympy.tan, sympy.cot)


@dataclass(frozen=True, slots=True)
class _Solution:
    """y = P E exp(W), with a real envelope E; P and W may be complex."""

    P: Expr
    envelope: Expr
    exponent: Expr

    def real_parts(self) -> list[Expr]:
        """Re y and Im y where they are not 0: both are solutions."""
        A, B = _real_and_imaginary(self.P)
        growth, phase = _real_and_imaginary(self.exponent)
        s, c = sympy.sin(phase), sympy.cos(phase)
        parts = (simplify(self.envelope * y) for y in (A * c - B * s, A * s + B * c))
        return [y * sympy.exp(growth) for y in parts if y != 0]


def _real_and_imaginary(f: Expr) -> tuple[Expr, Expr]:
    """Where roots whose sign is open are real."""
    roots = {p: sympy.Dummy(real=True) for p in f.atoms(sympy.Pow) if p.exp == _HALF}
    back = {name: p for p, name in roots.items()}
    real, imaginary = sympy.expand(f.xreplace(roots)).as_real_imag()
    return real.xreplace(back), imaginary.xreplace(back)


@dataclass(frozen=True, slots=True)
class _Part:
    """One sign at a place: what it adds to theta, alpha, and a factor (E, W) of y."""

    theta: Expr
    alpha: Expr
    factor: tuple[Expr, Expr]


def elementary_solutions(I: Expr, t: Symbol) -> list[Expr]:  # noqa: E741
    """Two independent real solutions of y'' + I y = 0 for t > 0, or one, or none."""
    if I.atoms(*_TURNING):
        s = sympy.Dummy("s", real=True)
        found = [_turned(y, s, t) for y in _in_waves(simplify(-I.subs(t, sympy.I * s)), s)]
    elif I.atoms(*_WAVES):
        found = _in_waves(I, t)
    else:
        found = list(_of_rational(-I, t))
    chosen: list[Expr] = []
    for y in (part for each in found for part in each.real_parts()):
        if all(not free_of(simplify(y / other), [t]) for other in chosen):
            chosen.append(y)
    if len(chosen) == 1:  # the other is y times the integral of 1/y^2
        integral = antiderivative(simplify(1 / chosen[0] ** 2), t)
        chosen += [] if integral is None else [simplify(chosen[0] * integral)]
    return [_where_positive(y, t) for y in chosen[:2]]


def positive(u: Expr, t: Symbol) -> Expr:
    """u or -u, one of which is in question where a mass m - b t is: positive at t = 0 if known."""
    first = u.subs(t, 0)
    return (
        -u if first.is_negative or (not first.is_positive and u.could_extract_minus_sign()) else u
    )


def _where_positive(y: Expr, t: Symbol) -> Expr:
    """With roots and logarithms of what is positive there; a constant factor is left out."""
    y = y.replace(
        lambda e: e.is_Pow and t in e.base.free_symbols and not e.exp.is_Integer,
        lambda e: positive(e.base, t) ** e.exp,
    )
    return y.replace(sympy.log, lambda u: sympy.log(positive(u, t)))


# -- exponentials ---------------------------------------------------------------------------


def _in_waves(I: Expr, t: Symbol) -> list[_Solution]:  # noqa: E741
    """Where I is rational in u = exp(c t)."""
    inside = [f.args[0] for f in I.atoms(*_WAVES)]
    ratios = [simplify(x / inside[0]) for x in inside]
    if not inside or not all(x.is_Rational for x in ratios):
        return []
    unit = inside[0] / sympy.ilcm(1, *(x.q for x in ratios))
    return _by_powers(I, unit, t) or _by_powers(I, unit / 2, t)


def _by_powers(I: Expr, argument: Expr, t: Symbol) -> list[_Solution]:  # noqa: E741
    """Of u = exp of the argument."""
    c, u = argument.diff(t), sympy.Dummy("u", positive=True)
    if t in c.free_symbols or simplify(argument - c * t) != 0:
        return []
    shape = simplify(I.rewrite(sympy.exp).subs(t, sympy.log(u) / c))
    if not shape.is_rational_function(u):
        return []
    found = _of_rational(simplify((shape / c**2 + _HALF**2) / -(u**2)), u)
    return [_of_time(y, u, argument, centred=not I.has(sympy.exp)) for y in found]


def _of_time(w: _Solution, u: Symbol, argument: Expr, *, centred: bool) -> _Solution:
    """w/sqrt(u), with polynomials in u by cosh and sinh about their middle power."""
    exponent = w.exponent.subs({sympy.log(u): argument, u: sympy.exp(argument)}) - argument / 2
    bases: dict[Expr, Expr] = {}
    for base, power in (f.as_base_exp() for f in sympy.Mul.make_args(w.envelope)):
        bases[power] = bases.get(power, sympy.S.One) * base
    envelope = sympy.S.One
    for power, base in bases.items():
        middle, waves = _in_the_middle(base, u, argument, centred=centred)
        exponent += middle * power * argument
        envelope *= waves**power
    middle, P = _in_the_middle(w.P, u, argument, centred=centred)
    return _Solution(P, envelope, exponent + middle * argument)


def _in_the_middle(f: Expr, u: Symbol, argument: Expr, *, centred: bool) -> tuple[Expr, Expr]:
    """A power of u, and what a polynomial is divided by it."""
    terms = sympy.Poly(f, u).terms()
    middle = sympy.Rational(terms[0][0][0] + terms[-1][0][0], 2)
    middle = middle if centred or len(terms) == 1 else sympy.S.Zero
    waves = ((a, (m - middle) * argument) for (m,), a in terms)
    powers = (a * (sympy.cosh(z) + sympy.sinh(z) if centred else sympy.exp(z)) for a, z in waves)
    return middle, sympy.expand(sympy.Add(*powers))


def _turned(y: _Solution, s: Symbol, t: Symbol) -> _Solution:
    """For s = -i t; sinh(s) in the envelope is -i sin(t), whose constant factor is left out."""
    envelope = y.envelope.replace(sympy.sinh, lambda x: sympy.I * sympy.sinh(x))
    P, envelope, exponent = (e.subs(s, -sympy.I * t) for e in (y.P, envelope, y.exponent))
    return _Solution(P, envelope, exponent)


# -- rational functions ---------------------------------------------------------------------


def _of_rational(r: Expr, x: Symbol) -> Iterator[_Solution]:
    """Solutions of y'' = r y."""
    above, below = (e.as_poly(x) for e in sympy.fraction(sympy.cancel(r)))
    if above is None or below is None or above.is_zero:
        return
    factors = [(f.as_expr(), order) for f, order in below.factor_list()[1]]
    places = [_at_pole(r, f, order, x) for f, order in factors]
    places.append(_at_infinity(r, below.degree() - above.degree(), x))
    if len(places) > _MOST_PLACES:
        return
    scale = sympy.Mul(*(f ** max(order, 2) for f, order in factors))
    for parts in product(*places):
        degree = simplify(parts[-1].alpha - sympy.Add(*(p.alpha for p in parts[:-1])))
        if not (degree.is_Integer and 0 <= degree <= _LARGEST_DEGREE):
            continue
        P = _polynomial(r, sympy.Add(*(p.theta for p in parts)), scale, x, int(degree))
        if P is not None:
            envelopes, exponents = zip(*(p.factor for p in parts), strict=True)
            yield _Solution(P, sympy.Mul(*envelopes), sympy.Add(*exponents))


def _polynomial(r: Expr, theta: Expr, scale: Expr, x: Symbol, degree: int) -> Expr | None:
    """P with P'' + 2 theta P' + (theta' + theta^2 - r) P = 0; `scale` clears the denominators."""
    slope = simplify(2 * scale * theta)
    rest = simplify(scale * (theta.diff(x) + theta**2 - r))
    rates = [
        sympy.expand(scale * (x**k).diff(x, 2) + slope * (x**k).diff(x) + rest * x**k).as_poly(x)
        for k in range(degree + 1)
    ]
    if any(rate is None for rate in rates):
        return None
    highest = max(rate.degree() for rate in rates if not rate.is_zero) if any(rates) else 0
    rows = [[simplify(rate.nth(j)) for rate in rates] for j in range(int(highest) + 1)]
    found = nullspace(rows)
    whole = sympy.Add(*(c * x**k for k, c in enumerate(found[0]))) if found else None
    return None if whole is None else sympy.expand(sympy.fraction(sympy.together(whole))[0])


def _at_pole(r: Expr, f: Expr, order: int, x: Symbol) -> list[_Part]:
    """At the root of f, or at both of one of second degree; none where it has no such part."""
    degree = sympy.degree(f, x)
    if order == 1:
        return [_Part(f.diff(x) / f, sympy.S(degree), (f, sympy.S.Zero))]
    if order % 2 or degree > 2 or (degree == 2 and order > 2):
        return []
    place = sympy.roots(f, x)
    c = next(iter(place))
    half = order // 2
    around = _taylor(simplify(sympy.cancel(r * (x - c) ** order)), x, c, half + 1)
    if half == 1:
        if not free_of(simplify(around[0]), place):
            return []
        return [_Part(a * f.diff(x) / f, degree * a, _power(f, a)) for a in _indices(around[0])]
    root, b = _root(around, half - 1, half - 1)
    poles = sympy.Add(*(a * (x - c) ** (k - half) for k, a in enumerate(root)))
    found = []
    for sign in (1, -1):
        alpha = simplify((sign * b / root[0] + half) / 2)
        E, W = _power(x - c, alpha)
        theta = sign * poles + alpha / (x - c)
        found.append(_Part(theta, alpha, (E, W + sign * sympy.integrate(poles, x))))
    return found


def _at_infinity(r: Expr, order: int, x: Symbol) -> list[_Part]:
    """Of r = O(x^-order)."""
    zero, one = sympy.S.Zero, sympy.S.One
    if order > 2:
        return [_Part(zero, alpha, (one, zero)) for alpha in (zero, one)]
    h = sympy.Dummy("h", positive=True)
    half = -order // 2
    around = _taylor(simplify(sympy.cancel(r.subs(x, 1 / h) * h**-order)), h, zero, half + 2)
    if order == 2:
        return [_Part(zero, a, (one, zero)) for a in _indices(around[0])]
    if order % 2:
        return []
    root, b = _root(around, half + 1, half + 1)
    grown = sympy.Add(*(a * x ** (half - k) for k, a in enumerate(root)))
    return [
        _Part(sign * grown, simplify((sign * b / root[0] - half) / 2),
              (one, sign * sympy.integrate(grown, x)))
        for sign in (1, -1)
    ]  # fmt: skip


def _indices(b: Expr) -> list[Expr]:
    """alpha^2 - alpha = b."""
    root = _square_root(simplify(1 + 4 * b))
    return [_HALF] if root == 0 else [simplify((1 + root) / 2), simplify((1 - root) / 2)]


def _square_root(square: Expr) -> Expr:
    return sympy.I * frequency_of(-square) if square.is_negative else frequency_of(square)


def _taylor(f: Expr, x: Symbol, c: Expr, count: int) -> list[Expr]:
    """Its first coefficients at c."""
    found = []
    for k in range(count + 1):
        found.append(simplify(f.subs(x, c) / sympy.factorial(k)))
        f = sympy.cancel(f.diff(x))
    return found


def _root(terms: Sequence[Expr], count: int, place: int) -> tuple[list[Expr], Expr]:
    """The first `count` coefficients of the root of a series, and what is left at a place."""
    found = [_square_root(terms[0])]
    for k in range(1, count):
        found.append(simplify((terms[k] - _convolved(found, k)) / (2 * found[0])))
    return found, simplify(terms[place] - _convolved(found, place))


def _convolved(root: Sequence[Expr], place: int) -> Expr:
    """Of products of two known coefficients."""
    n = len(root)
    return sympy.Add(*(root[i] * root[place - i] for i in range(n) if 0 <= place - i < n))


def _power(f: Expr, alpha: Expr) -> tuple[Expr, Expr]:
    """f^alpha as a real power and an exponent."""
    real, imaginary = _real_and_imaginary(alpha)
    return f**real, sympy.I * imaginary * sympy.log(f) if imaginary != 0 else sympy.S.Zero
