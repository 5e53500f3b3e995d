"""Functions of time for linear equations x'' + p(t) x' + q(t) x = f whose coefficients change.

Equations x'' = K x/tau^2 + C x'/tau, tau = a t + b, have constant coefficients in log(tau) (Euler),
where the stretching of time is tau times a function with a difference of two exponents.

Two equations of a charge in a field B(t) and a central force are one in axes that turn with -B/2
(Larmor).  Those of a turning saddle are constant in its axes.

Of one other equation, with mu = exp of the integral of p, x = y/sqrt(mu) and y'' + I y = 0,
I = q - p'/2 - p^2/4.  Where I is constant, or K/Q^2 with Q of second degree in t, the solutions Y
are elementary; others are found by Kovacic's algorithm.  A translation then is Y/sqrt(mu), and the
stretching of time a product of two Y (Lane-Emden of index 1, growing masses).

References
----------
Kamke, *Differentialgleichungen*, vol. I, part A, section 25.1 (normal form).
Leach, J. Math. Phys. 18 (1977) 1608 (symmetries of the time-dependent oscillator).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr, Symbol
from sympy.simplify.fu import TR8

from lagcli.algebra import dot, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.kovacic import elementary_solutions, positive
from lagcli.mechanics.discovery.spectrum import Exponent, differences, exponents, frequency_of

_MOST_OPERATIONS = 200  # measured: at most 25
_MOST_MODES = 3


def of_changing_coefficients(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> tuple[list[Expr], list[Expr], list[Expr], bool]:
    """Functions for translations, for the other generators, of a forced motion; whether all are.

    There are none where p and q are constant.
    """
    translations: list[Expr] = []
    others: list[Expr] = []
    forced: list[Expr] = []
    solved = True
    time, t = t, sympy.Dummy("t", positive=True)  # for t < 0 the functions differ by a sign
    moving = {*q, *v}
    given = _by_modes([a.xreplace({time: t}) for a in accelerations], q, v, t)
    tau, found, rows = of_euler(given, q, v, t)
    s = sympy.log(tau)
    translations += [f for each in found for f in each.functions(s)] + ([s] if rows else [])
    between = [f for each in differences(found) for f in each.functions(s)]
    others += [g for f in [*between, *([s, s**2] if rows else [])] for g in (tau * f, f)]
    driven = [f for k in rows for f in _terms(given[k]) if f.free_symbols.isdisjoint(moving)]
    forced += [g for f in driven for g in (tau**2 * f, tau**2 * f * s)]
    turned: set[int] = set()
    for pair in combinations(range(len(q)), 2):
        both, x, rates = ([each[k] for k in pair] for each in (given, q, v))
        if free_of(sympy.Tuple(*both), moving - {*x, *rates}):
            of_axes = _in_turning_axes(both, x, rates, t)
            translations += of_axes
            turned |= {*pair} if of_axes else set()
    turning = _turning_pairs(given, q, v, t)
    seconds = {second for second, _ in turning.values()}
    for k, (acceleration, x, rate) in enumerate(zip(given, q, v, strict=True)):
        if k in turned or k in rows or k in seconds:
            continue
        if k not in turning:
            solved = solved and not _changes_by(acceleration, moving - {x, rate}, moving, t)
        _, field = turning.get(k, (k, sympy.S.Zero))
        angle = antiderivative(field / 2, t)
        solution = _of_equation(acceleration, x, rate, field, moving, t)
        if solution is None:
            continue
        root, Y, p = solution
        solved = solved and len(Y) > 1 and angle is not None
        turns = [sympy.cos(angle), sympy.sin(angle)] if angle else [sympy.S.One]
        translations += [_of_one_wave(simplify(y / root) * turn) for y in Y for turn in turns]
        forced += _forced(acceleration, root, Y, moving, t)
        for stretch in _products(Y):
            others += [stretch, *map(simplify, (stretch.diff(t), p * stretch, field * stretch))]
    translations, others, forced = (
        _distinct(each, t, time) for each in (translations, others, forced)
    )
    return translations, others, forced, solved


def adjoint(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> list[Expr]:
    """u'' of the factors u of integrals u.q' + w.q, where q'' = S q + D q' with S(t), D(t).

    u'' = (S^T - D'^T) u - D^T u'.
    """
    terms, moving = [_terms(each) for each in accelerations], {*q, *v}
    S, D = (
        sympy.Matrix([[sympy.Add(*_factors(each, x, moving)) for x in y] for each in terms])
        for y in (q, v)
    )
    u, rates = sympy.Matrix(list(q)), sympy.Matrix(list(v))
    return [simplify(each) for each in (S - D.diff(t)).T * u - D.T * rates]


def _by_modes(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> Sequence[Expr]:
    """Those of the modes, where x'' = d(t) x' + (f(t) K + g(t)) x + F(t) with a constant K."""
    n, still = len(q), dict.fromkeys((*q, *v), sympy.S.Zero)
    if not 1 < n <= _MOST_MODES or any(x.count_ops() > _MOST_OPERATIONS for x in accelerations):
        return accelerations
    S, D = (sympy.Matrix([[simplify(a.diff(x)) for x in y] for a in accelerations]) for y in (q, v))
    across = [S[i, j] for i in range(n) for j in range(n) if i != j and S[i, j] != 0]
    entries = sympy.Tuple(*S, *D)
    if not across or not free_of(entries, [*q, *v]) or free_of(entries, [t]):
        return accelerations
    f = across[0].as_independent(t, as_Add=False)[1]
    K = ((S - S[0, 0] * sympy.eye(n)) / f).applyfunc(simplify)
    if not free_of(sympy.Tuple(*K), [t]) or any((D - D[0, 0] * sympy.eye(n)).applyfunc(simplify)):
        return accelerations
    modes = [(value, u) for value, _, vectors in K.T.eigenvects() for u in vectors]
    if len(modes) < n or any(value.has(sympy.I) for value, _ in modes):
        return accelerations
    forces = [dot(u, [a.xreplace(still) for a in accelerations]) for _, u in modes]
    return [
        simplify(f * value + S[0, 0]) * x + D[0, 0] * rate + simplify(force)
        for (value, _), x, rate, force in zip(modes, q, v, forces, strict=True)
    ]


def of_euler(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> tuple[Expr, list[Exponent], list[int]]:
    """tau, the exponents in s = log(tau), and which equations have them: x_ss = x_s + tau^2 x''."""
    moving, tau = {*q, *v}, t
    linear: list[Expr] = []
    for acceleration in accelerations:
        terms = _terms(acceleration)
        factors = [sympy.cancel(sympy.Add(*_factors(terms, x, moving))) for x in (*q, *v)]
        changing = [f for f in factors if not free_of(f, [t])]
        below = sympy.denom(changing[0]) if changing else sympy.S.One
        below = sympy.factor_list(below, t)[1] if below.is_polynomial(t) else []
        if len(below) == 1 and sympy.degree(below[0][0], t) == 1 and tau == t:
            tau = positive(below[0][0], t)
        linear.append(dot(factors, [*q, *v]) if changing else sympy.S.Zero)
    slope = tau.diff(t)
    stretch = {rate: slope * rate / tau for rate in v}
    scaled = [sympy.expand(simplify((tau / slope) ** 2 * x.xreplace(stretch))) for x in linear]
    rows = [k for k, x in enumerate(scaled) if x != 0 and free_of(x, [t])]
    inside = {y for k in rows for y in (q[k], v[k])}
    if any(scaled[k].free_symbols & (moving - inside) for k in rows):
        return tau, [], []
    chosen = [scaled[k] + v[k] for k in rows], [q[k] for k in rows], [v[k] for k in rows]
    return tau, exponents(*chosen, t), rows


def _in_turning_axes(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> list[Expr]:
    """Of x'' = S x + D x' of two coordinates, constant in axes that turn with half of a wave's.

    With x = R y, R' = W R J:  y'' = (R^-1 S R + W R^-1 D R J + W^2) y + (R^-1 D R - 2 W J) y'.
    """
    waves = {u.args[0] for a in accelerations for u in a.atoms(sympy.sin, sympy.cos)}
    turning = [u for u in waves if free_of(u.diff(t), [t]) and u.diff(t) != 0]
    if len(turning) != 1 or any(a.count_ops() > _MOST_OPERATIONS for a in accelerations):
        return []
    [angle] = turning
    S, D = (sympy.Matrix([[simplify(a.diff(x)) for x in y] for a in accelerations]) for y in (q, v))
    J = sympy.Matrix([[0, -1], [1, 0]])
    entries = sympy.Tuple(*S, *D)
    changing = free_of(entries, [*q, *v]) and not free_of(entries, [t])
    for theta in (angle / 2, -angle / 2) if changing else ():
        W, R = theta.diff(t), sympy.Matrix(2, 2, [sympy.cos(theta), -sympy.sin(theta),
                                                 sympy.sin(theta), sympy.cos(theta)])  # fmt: skip
        of_x, of_v = ((R.T * A * R).applyfunc(simplify) for A in (S, D))
        if free_of(sympy.Tuple(*of_x, *of_v), [t]):
            still = of_x + W * of_v * J + W**2 * sympy.eye(2)
            moved = still * sympy.Matrix(list(q)) + (of_v - 2 * W * J) * sympy.Matrix(list(v))
            found = [f for e in exponents(list(moved), q, v, t) for f in e.functions(t)]
            return [f * turn for f in found for turn in (sympy.cos(theta), sympy.sin(theta))]
    return []


def _turning_pairs(
    accelerations: Sequence[Expr], q: Sequence[Symbol], v: Sequence[Symbol], t: Symbol
) -> dict[int, tuple[int, Expr]]:
    """x'' = a x + b y + c x' + d y', y'' = a y - b x + c y' - d x' with 2 b = d' - c d.

    In axes that turn with -d/2 both are w'' = c w' + (a - d^2/4) w, as in a field B(t) = d.  The
    place of y and d by that of x.
    """
    found: dict[int, tuple[int, Expr]] = {}
    terms, moving = [_terms(each) for each in accelerations], {*q, *v}
    for k, m in combinations(range(len(q)), 2):
        a, b, c, d = (
            [simplify(sympy.Add(*_factors(terms[i], y[j], moving))) for i, j in ((k, at), (m, to))]
            for y in (q, v) for at, to in ((k, m), (m, k))
        )  # fmt: skip
        if free_of(sympy.Tuple(a[0], c[0], d[0]), [t]) or d[0] == 0:
            continue
        gaps = (a[0] - a[1], b[0] + b[1], c[0] - c[1], d[0] + d[1])
        if not any(map(simplify, (*gaps, 2 * b[0] - d[0].diff(t) + c[0] * d[0]))):
            found[k] = m, d[0]
    return found


def _of_one_wave(function: Expr) -> Expr:
    """A product of sines and cosines as a sum, where their arguments have a ratio in numbers."""
    inside = [wave.args[0] for wave in function.atoms(sympy.sin, sympy.cos)]
    alike = all(simplify(u / inside[0]).is_number for u in inside)
    return TR8(function) if alike else function


def _terms(acceleration: Expr) -> Sequence[Expr]:
    """Of a sum, none where it is too long to be looked through."""
    short = sympy.count_ops(acceleration) <= _MOST_OPERATIONS
    return sympy.Add.make_args(sympy.expand(acceleration)) if short else ()


def _forced(
    acceleration: Expr, root: Expr, Y: Sequence[Expr], moving: set[Symbol], t: Symbol
) -> list[Expr]:
    """A motion under the terms of x'' with the time alone, by variation of constants."""
    force = sympy.Add(*(f for f in _terms(acceleration) if f.free_symbols.isdisjoint(moving)))
    if force == 0 or len(Y) < 2:
        return []
    parts = [antiderivative(simplify(y * root * force), t) for y in Y]
    if any(part is None for part in parts):
        return []
    [one, other], [first, second] = Y, parts
    return [simplify((other * first - one * second) / root)]


def _products(Y: Sequence[Expr]) -> list[Expr]:
    """Of two Y; with 1, sin and cos of twice the argument for those of sine and cosine."""
    waves = [f for y in Y for f in sympy.Mul.make_args(y) if f.func in (sympy.sin, sympy.cos)]
    if waves:
        envelope, double = simplify(Y[0] / waves[0]) ** 2, 2 * waves[0].args[0]
        return [envelope, envelope * sympy.sin(double), envelope * sympy.cos(double)]
    return [sympy.expand(a * b) for a, b in combinations_with_replacement(Y, 2)]


def _of_equation(
    acceleration: Expr, x: Symbol, rate: Symbol, field: Expr, moving: set[Symbol], t: Symbol
) -> tuple[Expr, list[Expr], Expr] | None:
    """sqrt(mu), the two Y, if known, and p, by the terms of x'' that are linear in x and x'.

    With a field in axes that turn with half of it.
    """
    terms = _terms(acceleration)
    p, own = (-simplify(sympy.Add(*_factors(terms, y, moving))) for y in (rate, x))
    own = simplify(own + field**2 / 4)
    if free_of(sympy.Tuple(p, own, field), [t]):
        return None
    integral = antiderivative(p, t)
    Y = _elementary(simplify(own - p.diff(t) / 2 - p**2 / 4), t, p)
    if integral is None or not Y:
        return sympy.S.One, [], p
    logs = integral.atoms(sympy.log)
    integral = integral.xreplace({f: sympy.log(positive(f.args[0], t)) for f in logs})
    root = simplify(sympy.exp(sympy.expand(integral / 2)))
    return root, Y, p


def _changes_by(acceleration: Expr, others: set[Symbol], moving: set[Symbol], t: Symbol) -> bool:
    """Whether the coefficient of another coordinate depends on time: no formula is sought then."""
    terms = _terms(acceleration) if t in acceleration.free_symbols else ()
    return any(not free_of(c, [t]) for y in others for c in _factors(terms, y, moving))


def _factors(terms: Sequence[Expr], x: Symbol, moving: set[Symbol]) -> Iterator[Expr]:
    """Of x in the terms that are x times a function of time."""
    for factor, rest in (term.as_independent(x, as_Add=False) for term in terms):
        if rest == x and factor.free_symbols.isdisjoint(moving):
            yield factor


def _elementary(I: Expr, t: Symbol, p: Expr) -> list[Expr]:  # noqa: E741
    """Two solutions of y'' + I y = 0, or one, with hyperbolic functions where p has some."""
    if I == 0:
        return [sympy.S.One, t]
    if free_of(I, [t]):
        if I.is_nonpositive:
            inside = frequency_of(-I) * t
            if p.has(sympy.tanh, sympy.coth, sympy.cosh, sympy.sinh):
                return [sympy.cosh(inside), sympy.sinh(inside)]
            return [sympy.exp(inside), sympy.exp(-inside)]
        return [sympy.sin(frequency_of(I) * t), sympy.cos(frequency_of(I) * t)]
    Q = simplify(sympy.sqrt(sympy.factor(1 / I))).replace(sympy.Abs, lambda e: e)
    _, Q = Q.as_independent(t, as_Add=False)
    if Q.is_polynomial(t) and sympy.degree(Q, t) == 2:
        found = _of_square(simplify(I * Q**2), Q, t)
        if found:
            return found
    return elementary_solutions(I, t)


def _of_square(K: Expr, Q: Expr, t: Symbol) -> list[Expr]:
    """sqrt(Q) sin, cos of s theta, theta' = 1/Q, s^2 = K + D/4, for I = K/Q^2, D = 4 a c - b^2.

    For s = 0 they are sqrt(Q) and sqrt(Q) theta.
    """
    a, b, c = sympy.Poly(Q, t).all_coeffs()
    D = simplify(4 * a * c - b**2)
    square = simplify(K + D / 4)
    if not (D.is_positive and square.is_nonnegative):
        return []
    root = sympy.sqrt(D)
    theta = sympy.atan(simplify(Q.diff(t) / root))
    if square == 0:
        return [sympy.sqrt(Q), sympy.sqrt(Q) * theta]
    angle = simplify(2 * frequency_of(square) / root) * theta
    return [sympy.sqrt(Q) * sympy.sin(angle), sympy.sqrt(Q) * sympy.cos(angle)]


def _distinct(functions: Sequence[Expr], t: Symbol, time: Symbol) -> list[Expr]:
    """Terms without constant factors, each once, in the time of the problem."""
    terms = (
        term.as_independent(t, as_Add=False)[1].xreplace({t: time})
        for f in functions for term in sympy.Add.make_args(sympy.expand(f))
    )  # fmt: skip
    return [f for f in dict.fromkeys(terms) if f != 0]
