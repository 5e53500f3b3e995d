"""W with W' = sqrt(N(x)), where a substitution u(x) makes it R(u) sqrt(Q(u)) du, Q quadratic.

Kepler's radial part is sqrt(Q)/r; the oscillator's, with u = r^2, sqrt(Q)/(2 u); that of Morse's
potential has u = exp(-a x); an angular momentum has u = cos(theta) and sqrt(Q)/(1 - u^2).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import sympy
from sympy import Abs, Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.algebra.factors import factors_of, square_part
from lagcli.algebra.positivity import deciding, weak_sign
from lagcli.mechanics.reduction.known_signs import KnownSigns
from lagcli.mechanics.reduction.root_integrals import ROOT, Integrals, Part, root_of
from lagcli.mechanics.reduction.substitutions import IntegralSubstitution, substitutions
from lagcli.record import record


@record
class ElementaryAction:
    """W, a formula of x and `ROOT` = sqrt(`radicand`); where each of `positive` is > 0."""

    terms: tuple[Expr, ...]
    radicand: Expr
    positive: tuple[Expr, ...] = ()


def closed_forms(
    derivative: Expr, x: Symbol, positive: Sequence[Expr] = ()
) -> tuple[ElementaryAction, ...]:
    """W by its derivative, case by case, each proved; none where it stays an integral.

    Parameters
    ----------
    positive
        Expressions that are known to be positive.
    """
    plain: list[Expr] = []
    roots: list[tuple[Expr, Expr]] = []
    for part in sympy.Add.make_args(derivative):
        factor, root = part.as_independent(x, as_Add=False)
        if root.is_Pow and root.exp == S.Half:
            roots.append((factor, root.base))
            continue
        integral = antiderivative(part, x)
        if integral is None:
            return ()
        plain.append(integral)
    if not roots:
        return (ElementaryAction(tuple(plain), S.One),)
    if len(roots) > 1:
        return ()
    [(factor, radicand)] = roots
    for u in substitutions(radicand, x):
        found = _by_substitution(radicand, u, positive)
        if found:
            return tuple(
                ElementaryAction(
                    (*(factor * term for term in each.terms), *plain), each.radicand, each.positive
                )
                for each in found
            )
    return ()


def _by_substitution(
    radicand: Expr, sub: IntegralSubstitution, positive: Sequence[Expr]
) -> tuple[ElementaryAction, ...]:
    """The integral of sqrt(radicand) dx in the variable of a substitution."""
    u = sub.variable
    split = _split(sub.radicand / sub.slope_squared, u)
    if split is None:
        return ()
    Q, R = split
    # sqrt(radicand) = |R du/dx| sqrt(Q)
    turn = simplify((R * sub.slope).xreplace({u: sub.value}))
    direction = weak_sign(turn, positive)
    beside: tuple[Expr, ...] = ()
    if direction is None:
        rest = deciding(turn, positive)
        direction = -1 if rest.could_extract_minus_sign() else 1
        beside = (direction * rest,)
    parts = _parts(R, Q, u)
    if parts is None:
        return ()
    known = KnownSigns(radicand, positive)
    poles = {p for _, _, p in parts}
    if len(poles) == 1 and all(kind != "pair" for _, kind, _ in parts):
        integrated = _in_general(Q, parts, poles.pop(), known)
    else:
        integrals = Integrals(Q, known)
        open_ = next((e for e in integrals.deciding(parts) if integrals.sign(e) is None), None)
        if open_ is not None:
            return tuple(
                each for s in (-1, 1) for each in _with_sign(s * open_, radicand, sub, positive)
            )
        terms = integrals.of(parts)
        integrated = [(terms, ())] if _verified(terms, Q, R) else []
    scale, inside = S.One, Q.as_expr().xreplace({u: sub.value})
    if free_of(turn, [sub.x]) and not beside:
        scale, inside = direction / turn, radicand
    return tuple(
        ElementaryAction(
            tuple(
                (direction * _with_moduli(_without_constants(term, u), where)).xreplace(
                    {u: sub.value, ROOT: scale * ROOT}
                )
                for term in terms
            ),
            inside,
            (*where, *beside),
        )
        for terms, where in integrated
    )


def _verified(terms: Sequence[Expr], Q: sympy.Poly, R: Expr) -> bool:
    root = sympy.sqrt(Q.as_expr())
    W = sympy.Add(*terms).xreplace({ROOT: root})
    return is_zero(W.diff(Q.gen) - R * root) is True


def _in_general(
    Q: sympy.Poly, parts: Sequence[Part], p: Expr, known: KnownSigns
) -> list[tuple[tuple[Expr, ...], tuple[Expr, ...]]]:
    """The terms, and what must be positive, from the integrals with A, B, c as symbols."""
    u = Q.gen
    a, b, c = (Q.coeff_monomial(u**n) for n in range(3))
    pole = any(kind.startswith("1/v") for _, kind, _ in parts)
    ends = [simplify(a + b * p + c * p**2), c]
    signs = [(0,) if e == 0 else (s,) if (s := known.sign(e)) else (-1, 1) for e in ends]
    if not pole:
        signs[0] = (1,)
    middle = simplify(b + 2 * c * p)
    within = Symbol("#v", real=True)
    B, k, length = (sympy.Dummy(n, **assume) for n, assume in _SYMBOLS)
    if middle == 0:
        B = S.Zero
    moved = [(factor, kind, S.Zero) for factor, kind, _ in parts]
    found: list[tuple[tuple[Expr, ...], tuple[Expr, ...]]] = []
    for first, last in product(*signs):
        A = first * length**2 if pole else sympy.Dummy("A", real=True)
        general = sympy.Poly(A + B * within + last * k**2 * within**2, within)
        terms = Integrals(general, known).of(moved)
        rational = sympy.Add(*(f * _REST[kind](within) for f, kind, _ in moved))
        if not _verified(terms, general, rational):
            return []
        put_in = {within: u - p, B: middle, k: root_of(last * c)}
        put_in[length if pole else A] = root_of(first * ends[0]) if pole else ends[0]
        where = tuple(
            deciding(s * e)
            for s, e, choices in zip((first, last), ends, signs, strict=True)
            if len(choices) > 1
        )
        done = tuple(_arranged(term, put_in) for term in terms)
        if done in [each for each, _ in found]:  # the sign that is open does not matter
            return [(done, ())]
        found.append((done, where))
    return found


_SYMBOLS = (("B", {"real": True}), ("k", {"positive": True}), ("l", {"positive": True}))
_REST: dict[str, Callable[[Symbol], Expr]] = {
    "1": lambda _: S.One,
    "u": lambda v: v,
    "1/v^1": lambda v: 1 / v,
    "1/v^2": lambda v: v**-2,
}


def _arranged(term: Expr, put_in: dict[Expr, Expr]) -> Expr:
    """A term with the coefficients put in, each part of it in its shortest form."""
    factors = []
    for factor in sympy.Mul.make_args(term):
        if isinstance(factor, sympy.atan | sympy.log):
            inside = simplify(factor.args[0].xreplace(put_in))
            factors.append(factor.func(inside))
        else:
            factors.append(factor.xreplace(put_in))
    rest = [f for f in factors if not isinstance(f, sympy.atan | sympy.log) and not f.has(ROOT)]
    return sympy.Mul(simplify(sympy.Mul(*rest)), *(f for f in factors if f not in rest))


def _with_sign(
    expression: Expr, radicand: Expr, sub: IntegralSubstitution, positive: Sequence[Expr]
) -> tuple[ElementaryAction, ...]:
    """The forms where the expression is positive: it takes the place of one of its symbols."""
    size = sympy.Dummy(positive=True)
    free = sorted(
        expression.free_symbols - {sub.variable}, key=lambda s: (bool(s.is_positive), str(s))
    )
    for each in free:
        slope = expression.diff(each)
        if not free_of(slope, [each]):
            continue
        put_in = {each: (size - expression.xreplace({each: S.Zero})) / slope}
        within = IntegralSubstitution(
            sub.x,
            sub.variable,
            sub.value,
            sub.slope,
            sub.slope_squared,
            sub.radicand.xreplace(put_in),
        )
        known = [simplify(e.xreplace(put_in)) for e in positive]
        back = {size: expression}
        return tuple(
            ElementaryAction(
                tuple(term.xreplace(back) for term in form.terms),
                sympy.expand(form.radicand.xreplace(back)),
                (deciding(expression), *(e.xreplace(back) for e in form.positive)),
            )
            for form in _by_substitution(simplify(radicand.xreplace(put_in)), within, known)
        )
    return ()


def _split(squared: Expr, u: Symbol) -> tuple[sympy.Poly, Expr] | None:
    """(Q, R) with squared = R² Q and Q of first or second degree in u."""
    Q, R = S.One, S.One
    for factor, power in factors_of(squared):
        if factor.is_Integer:
            whole, rest = square_part(factor)
            Q, R = Q * rest**power, R * whole**power
            continue
        if power % 2:
            Q *= factor
            power -= 1
        R *= factor ** (power // 2)
    polynomial = sympy.expand(Q).as_poly(u)
    if polynomial is None or polynomial.degree() not in (1, 2):
        return None
    return polynomial, R


def _parts(R: Expr, Q: sympy.Poly, u: Symbol) -> list[Part] | None:
    """R in partial fractions whose integrals with sqrt(Q) are known."""
    even = Q.coeff_monomial(u) == 0
    found: list[Part] = []
    whole = sympy.apart(sympy.together(R), u)
    if even and is_zero(R - R.xreplace({u: -u})) is True:
        square = Symbol("#square", positive=True)
        whole = sympy.apart(sympy.together(R.subs(u, sympy.sqrt(square))), square)
        whole = whole.xreplace({square: u**2})
    for term in sympy.Add.make_args(whole):
        factor, rest = term.as_independent(u, as_Add=False)
        above, below = rest.as_numer_denom()
        pole = below.as_poly(u)
        if free_of(below, [u]):
            power = rest.as_poly(u)
            if power is None or not power.is_monomial or power.degree() > 1:
                return None
            found.append((factor * power.LC(), "u" if power.degree() else "1", S.Zero))
        elif pole is None or not free_of(above, [u]):
            return None
        elif even and pole.degree() == 2 and pole.coeff_monomial(u) == 0:
            c, _, a = pole.all_coeffs()
            found.append((factor * above / c, "pair", simplify(-a / c)))
        else:
            linear = _linear(below, u)
            if linear is None:
                return None
            scale, p, power = linear
            found.append((factor * above / scale, f"1/v^{power}", p))
    return found


def _linear(below: Expr, u: Symbol) -> tuple[Expr, Expr, int] | None:
    """(scale, p, n) with below = scale (u - p)^n, n = 1 or 2."""
    base, exponent = below.as_base_exp()
    polynomial = base.as_poly(u)
    if polynomial is None or polynomial.degree() != 1 or exponent not in (1, 2):
        return None
    c, a = polynomial.all_coeffs()
    return c**exponent, simplify(-a / c), int(exponent)


def _without_constants(term: Expr, u: Symbol) -> Expr:
    """ln(u + sqrt(Q)) for ln(F u + F sqrt(Q)), which differs by a constant."""

    def variable(e: Expr) -> Expr:
        whole = sympy.factor_terms(e.args[0])
        return sympy.log(whole.as_independent(u, ROOT, as_Add=False)[1])

    return term.replace(lambda e: isinstance(e, sympy.log), variable)


def _with_moduli(term: Expr, positive: Sequence[Expr]) -> Expr:
    """log|x| where x may be negative."""
    put_in = {
        e.free_symbols.pop(): e.coeff(*e.free_symbols) * sympy.Dummy(positive=True)
        for e in positive
        if e in (*e.free_symbols, *(-s for s in e.free_symbols))
    }
    return term.replace(
        lambda e: isinstance(e, sympy.log) and not e.args[0].xreplace(put_in).is_positive,
        lambda e: sympy.log(Abs(e.args[0])),
    )
