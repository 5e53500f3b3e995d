"""Functions in which a space of constant curvature is as simple as in Cartesian coordinates.

In a space of constant curvature K with n dimensions the equations

    X;ij = X,ij - Gamma^k_ij X,k = -K g_ij X

have n + 1 solutions: where K = 0 the constant 1 and n Cartesian coordinates, else the
coordinates of the sphere or the hyperboloid in n + 1 dimensions.  All isometries are made
of them, X_a grad X_b - X_b grad X_a, so it does not matter which coordinates the problem
is written in: r and phi, parabolic or elliptic ones, or those of a half plane.

Along a cyclic coordinate x the solutions change as exp(lambda x), det(lambda - B) = 0 with
dX/dx = X,x and dX,i/dx = -K g_ix X + Gamma^k_ix X,k, so their dependence on it is known.
So it is for the logarithm of a coordinate whose stretching is one of a flat metric: x^lambda.
For the other coordinates products of the functions are tried that the metric consists of.

References
----------
Obata, J. Math. Soc. Japan 14 (1962) 333 (the equation and the sphere).
Eisenhart, *Riemannian Geometry*, sections 27 and 71 (spaces of constant curvature).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, product
from math import prod

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import CIRCULAR, HYPERBOLIC, free_of
from lagcli.mechanics.discovery.ansatz import complexity
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.modular import NoPoint, independent
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.spectrum import roots_of

_MOST = 320  # measured: at most 100
_HIGHEST = 5  # power of a coordinate
_SHORT = 8  # operations of an integrand that SymPy's rules are tried on
_PARTNERS = {
    sympy.sin: sympy.cos, sympy.cos: sympy.sin, sympy.sinh: sympy.cosh, sympy.cosh: sympy.sinh
}  # fmt: skip


def ambient_functions(metric: Metric, allowed: Allowance) -> list[Expr]:
    """The solutions that are not constant; none where they were not found."""
    K = metric.curvature
    if K is None:
        return []
    if len(metric.factors) > 1:
        parts = [ambient_functions(factor, allowed) for factor in metric.factors]
        return [X for part in parts for X in part] if all(parts) else []
    if metric.n == 1:
        length = _arc_length(metric.g[0][0], metric.q[0])
        return [] if length is None else [length]
    for tried in chain([_of_warped(metric, K)], _of_cone(metric, allowed), [_of_all(metric, K)]):
        if len(tried) > _MOST:
            return []
        try:
            found = _solutions(metric, K, [sympy.Mul(*parts) for parts in tried], allowed)
        except (NoPoint, ZeroDivisionError):
            continue
        found = [X for X in found if not free_of(X, metric.q)]
        if len(found) == metric.n + (K != 0):
            return found
    return []


# -- one coordinate --------------------------------------------------------------------------


def _arc_length(g: Expr, x: Symbol) -> Expr | None:
    """X = c int sqrt(g) dx, with either sign of g and root: term by term, or of a quadratic."""
    _, function = _root(g).as_independent(x, as_Add=False)
    base, power = function.as_base_exp()
    if abs(power) == sympy.S.Half and base.is_polynomial(x) and sympy.degree(base, x) == 2:
        return _of_quadratic(base, x, inverse=power < 0)
    return antiderivative(function, x, rules=function.count_ops() <= _SHORT)


def _root(g: Expr) -> Expr:
    """sqrt(g) or sqrt(-g), with either sign of the root of a square."""
    g = sympy.factor_terms(-g if g.could_extract_minus_sign() else g)
    factors = sympy.Mul.make_args(g)
    above, below = sympy.fraction(sympy.together(sympy.Mul(*map(_half_angle, factors))))
    root = simplify(sympy.sqrt(above)) / simplify(sympy.sqrt(below))
    return root.replace(sympy.Abs, lambda e: e)


def _by_half_angles(entry: Expr) -> Expr:
    """With squares for factors 1 +- cos u, and then sin u = 2 sin(u/2) cos(u/2)."""
    factors = [f.as_base_exp() for f in sympy.Mul.make_args(sympy.factor_terms(entry))]
    halved = [_half_angle(base) for base, _ in factors]
    pairs = zip(factors, halved, strict=True)
    angles = {w.args[0] for (base, _), half in pairs if half != base for w in base.atoms(sympy.cos)}
    images = {sympy.sin(u): 2 * sympy.sin(u / 2) * sympy.cos(u / 2) for u in angles}
    powers = zip(halved, factors, strict=True)
    return sympy.Mul(*(half.xreplace(images) ** n for half, (_, n) in powers))


def _half_angle(factor: Expr) -> Expr:
    """a (1 + cos u) = 2 a cos^2(u/2), a (1 - cos u) = 2 a sin^2(u/2)."""
    for wave in factor.atoms(sympy.cos):
        a, half = factor.xreplace({wave: sympy.S.Zero}), wave.args[0] / 2
        for sign, other in ((1, sympy.cos(half)), (-1, sympy.sin(half))):
            if sympy.expand(factor - a * (1 + sign * wave)) == 0:
                return 2 * a * other**2
    return factor


def _of_quadratic(Q: Expr, x: Symbol, *, inverse: bool) -> Expr:
    """int dx/sqrt(Q), or int sqrt(Q) dx, for Q = a x^2 + b x + c (Dwight, 380.001 and 380.201)."""
    a, b, c = sympy.Poly(Q, x).all_coeffs()
    slope, D = Q.diff(x), 4 * a * c - b**2
    if a.is_negative:
        area = -sympy.asin(slope / sympy.sqrt(-D)) / sympy.sqrt(-a)
    elif D.is_negative or D == 0:
        area = sympy.log(2 * sympy.sqrt(a) * sympy.sqrt(Q) + slope) / sympy.sqrt(a)
    else:
        area = sympy.asinh(slope / sympy.sqrt(D)) / sympy.sqrt(a)
    return area if inverse else slope * sympy.sqrt(Q) / (4 * a) + D * area / (8 * a)


# -- which functions are tried ---------------------------------------------------------------


def _of_warped(metric: Metric, K: Expr) -> list[tuple[Expr, ...]]:
    """Products of f and df/ds, as for ds^2 + f^2 dy^2, with waves along cyclic coordinates."""
    factors = [
        _along(x, metric, K) if metric.is_cyclic(x) else _profile(x, metric) for x in metric.q
    ]
    if K == 0:
        pairs = zip(metric.q, factors, strict=True)
        factors = [chain(each, _of_stretching(x, metric)) for x, each in pairs]
    return list(product(*({sympy.S.One: None, **dict.fromkeys(each)} for each in factors)))


def _of_cone(metric: Metric, allowed: Allowance) -> Iterator[list[tuple[Expr, ...]]]:
    """f Y and df/ds for ds^2 + f^2 h, with the Y of a curved h of more than two coordinates."""
    for k, x in enumerate(metric.q):
        others = [i for i in range(metric.n) if i != k]
        if metric.n < 4 or any(metric.g[i][k] != 0 for i in others):
            continue
        rest = metric.of(others)
        split = [simplify(e).as_independent(*rest.q, as_Add=False) for row in rest.g for e in row]
        first = next(own for own, _ in split if own != 0)
        if not free_of(metric.g[k][k], rest.q) or any(
            not free_of(other, [x]) or not free_of(simplify(own / first), [x])
            for own, other in split
        ):
            continue
        h = Metric(rest.q, [[simplify(e / first) for e in row] for row in rest.g])
        if h.curvature != 0 and (Y := ambient_functions(h, allowed)):
            f, slope = _radius_and_slope(first, metric.g[k][k], x)
            yield [*((f, y) for y in Y), (slope,)]


def _of_all(metric: Metric, K: Expr) -> list[tuple[Expr, ...]]:
    """Of the shortest functions of each coordinate, as many as may be tried."""
    joint = _joint(metric)
    given = (
        [sympy.S.One, *_along(x, metric, K)] if metric.is_cyclic(x) else _of_coordinate(x, metric)
        for x in metric.q
    )
    factors = [sorted(each, key=complexity) for each in given]
    while True:
        plain = [[f for f in each if not _has_sums_below(f)] for each in factors]
        if prod(map(len, factors)) + len(joint[1:]) * prod(map(len, plain)) <= _MOST:
            return [*product(*factors), *product(joint[1:], *plain)]
        max(factors, key=len).pop()


def _of_coordinate(x: Symbol, metric: Metric) -> list[Expr]:
    """Those of one coordinate that the metric suggests."""
    one = sympy.S.One
    parts = _parts(metric)
    alone = [e for e in parts if e.free_symbols & set(metric.q) == {x}]
    found: dict[Expr, None] = {one: None}
    waves = ((CIRCULAR, sympy.sin, sympy.cos), (HYPERBOLIC, sympy.sinh, sympy.cosh))
    for kinds, *two in waves:  # those of a shared denominator too, as cosh(x) - cos(y)
        for a in _arguments(parts, kinds):
            if a.free_symbols & set(metric.q) == {x}:
                found |= dict.fromkeys(f(a / k) for k in (1, 2) for f in two)
    for f in _below(alone):  # 1/cosh(x)^2 of Mercator's map comes from 1/cosh(x) and tanh(x)
        found |= {1 / f: None, _PARTNERS[f.func](f.args[0]) / f: None}
    for a in _arguments(alone, (sympy.exp,)):
        found |= dict.fromkeys(sympy.exp(a * k / 2) for k in (-2, -1, 1, 2))
    shared = [1 / J for J in _joint(metric) if x in J.free_symbols]
    if any(not free_of(_without_functions(e), [x]) for e in (*alone, *shared)):
        found |= {1 / x: None, **dict.fromkeys(x**k for k in range(1, _degree(alone, x) + 1))}
        # X has the slope x^(p/2) where the metric has x^p, or that power beside a turn
        powers = [p for e in alone for b, p in [e.as_base_exp()] if b == x and not p.is_even]
        found |= {x ** (p / 2 + k): None for p in powers for k in (1, 0)}
        below = sorted(alone, key=lambda e: not e.is_Pow)  # dx^2/b tells where b is positive
        place = metric.q.index(x)
        own = metric.g[place][place]
        bases = dict.fromkeys(b for e in below for b in _bases(e) if b.is_Add)
        signs = metric.place or {}
        sums = [-b if (own * b).xreplace(signs).is_negative else b for b in bases]
        for k, b in enumerate(sums):
            # modulo a prime 4 k + 3 the roots of b and -b are never both there
            if any(free_of(sympy.cancel(b / c), [x]) for c in sums[:k]):
                continue
            found |= {sympy.sqrt(b): None, 1 / sympy.sqrt(b): None, 1 / b: None}
            found |= {x / sympy.sqrt(b): None, x / b: None, x**2 / b: None}
    return list(found)


def _profile(x: Symbol, metric: Metric) -> Iterator[Expr]:
    """f and df/ds of ds^2 + f^2 dy^2, s the length along x: X = f cos(c y), f sin(c y), df/ds.

    On a sphere of more dimensions another Y(y) stands for cos(c y), and a factor of the other
    coordinates before both terms.
    """
    others = [y for y in metric.q if y != x]
    diagonal = [sympy.factor_terms(row[k]) for k, row in enumerate(metric.g)]
    split = [g.as_independent(*others, as_Add=False) for g in diagonal]
    own = [part for part, rest in split if free_of(rest, [x])]
    if len(own) < metric.n:
        return
    A = own[metric.q.index(x)]
    for B in (part for part in own if x in part.free_symbols and part != A):
        for function in _radius_and_slope(B, A, x):
            yield function.as_independent(x, as_Add=False)[1]


def _radius_and_slope(B: Expr, A: Expr, x: Symbol) -> tuple[Expr, Expr]:
    """f and df/ds of A dx^2 + B dy^2 = ds^2 + f^2 dy^2."""
    f = _real_beside(_root(B), A)
    return f, simplify(f.diff(x) / _real_beside(_root(A), A))


def _real_beside(root: Expr, A: Expr) -> Expr:
    """With sqrt(b) or sqrt(-b), whichever is real where A is positive, as 1/(1 - r^2) in space."""
    powers = (p for p in root.atoms(sympy.Pow) if abs(p.exp) == sympy.S.Half and p.base.is_Add)
    return root.xreplace(
        {p: (-p.base) ** p.exp for p in powers if sympy.cancel(A * p.base).is_negative}
    )


def _degree(entries: Sequence[Expr], x: Symbol) -> int:
    """Of X in x: the metric has the squares of its slopes (x^3 where 9 x^4 + 1 stands in it).

    Beside 1/x^2 too: (x^2 + y^2)^2/(x y) in 1/x^2 + 1/y^2, parabolic coordinates of a half plane.
    """
    degrees = [sympy.degree(e, x) for e in entries if e.is_polynomial(x)]
    degrees += [4 for e in entries if e.as_base_exp() == (x, -2)]
    return min(_HIGHEST, int(max([2, *degrees])) // 2 + 1)


def _of_stretching(x: Symbol, metric: Metric) -> Iterator[Expr]:
    """x^lambda where x -> s x multiplies all of the metric by one power of s."""
    degrees = {
        simplify(x * e.diff(x) / e) + (y, z).count(x)
        for y, row in zip(metric.q, metric.g, strict=True)
        for z, e in zip(metric.q, row, strict=True)
        if e != 0 and not metric.is_cyclic(x)
    }
    if len(degrees) == 1 and free_of(sympy.Tuple(*degrees), metric.q):
        found = _along(x, metric, sympy.S.Zero, sympy.log(x))
        yield from (f for f in found if x.is_positive or not f.has(sympy.log))


def _along(x: Symbol, metric: Metric, K: Expr, length: Expr | None = None) -> Iterator[Expr]:
    """exp(lambda x) for a cyclic coordinate, real; powers where lambda = 0 is repeated.

    With log(x) as the `length` x^lambda, the log being the coordinate that would be cyclic.
    """
    n, c = metric.n, metric.q.index(x)
    s = sympy.S.One if length is None else x
    t = [s if i == c else sympy.S.One for i in range(n)]
    rows = [
        [sympy.Integer(k == c + 1) for k in range(n + 1)],
        *([-K * metric.g[i][c], *(t[i] * s / t[k] * metric.christoffel[k][i][c]
                                  + t[i].diff(x) * (i == k) for k in range(n))]
          for i in range(n)),
    ]  # fmt: skip
    lam = Symbol("#lambda", real=True)
    B = sympy.Matrix(rows)
    poly = (lam * sympy.eye(n + 1) - B).det(method="berkowitz").as_poly(lam)
    powers = [simplify(a) for a in poly.all_coeffs()]
    if not free_of(sympy.Tuple(*powers), metric.q):
        return
    length = length or x
    if powers[-2] == 0:  # lambda = 0 is a root at least twice
        yield from (length, length**2)
    for exponent in roots_of(sympy.Poly(powers, lam).as_expr(), lam):
        yield from exponent.functions(length)


def _parts(metric: Metric) -> list[Expr]:
    """Factors of the components of the metric and of their terms, 1 +- cos u as squares."""
    entries = [sympy.factor_terms(_by_half_angles(e)) for row in metric.g for e in row if e != 0]
    entries += [t for e in entries for t in sympy.Add.make_args(sympy.expand(e))]
    return list(dict.fromkeys(f for e in entries for f in sympy.Mul.make_args(e)))


def _joint(metric: Metric) -> list[Expr]:
    """Sums of several coordinates that stand in denominators, as 1 - x^2 - y^2 of a disk."""
    one = sympy.S.One
    origin = dict.fromkeys(metric.q, sympy.S.Zero)
    bases = {
        -p.base if p.base.xreplace(origin).is_negative else p.base  # as sqrt(l^2 - x^2 - y^2)
        for row in metric.g for e in row for p in e.atoms(sympy.Pow)
        if p.exp.is_negative and p.base.is_Add and len(p.base.free_symbols & set(metric.q)) > 1
    }  # fmt: skip
    ordered = sorted(bases, key=sympy.default_sort_key)
    half = sympy.S.Half
    return [one, *(b**k for b in ordered for k in (-1, -half, half))]


def _has_sums_below(factor: Expr) -> bool:
    """Whether it has a power of a sum of one coordinate, which no joint one stands beside."""
    return any(p.base.is_Add for p in factor.atoms(sympy.Pow))


def _arguments(expressions: Iterable[Expr], functions: tuple[type, ...]) -> list[Expr]:
    atoms = {f for e in expressions for f in e.atoms(*functions)}
    return list(dict.fromkeys(f.args[0] for f in sorted(atoms, key=sympy.default_sort_key)))


def _below(expressions: Iterable[Expr]) -> list[Expr]:
    """Sine and cosine, circular and hyperbolic, in denominators, that of tanh among them."""
    powers = {p for e in expressions for p in e.atoms(sympy.Pow) if p.exp.is_negative}
    found = {f for p in powers for f in p.base.atoms(*_PARTNERS)}
    found |= {sympy.cosh(f.args[0]) for e in expressions for f in e.atoms(sympy.tanh)}
    return sorted(found, key=sympy.default_sort_key)


def _without_functions(expression: Expr) -> Expr:
    functions = expression.atoms(*CIRCULAR, *HYPERBOLIC, sympy.exp)
    return expression.xreplace({f: sympy.Dummy() for f in functions})


def _bases(expression: Expr) -> list[Expr]:
    powers = expression.atoms(sympy.Pow) | {expression}
    return [p.as_base_exp()[0] for p in sorted(powers, key=sympy.default_sort_key)]


# -- the linear equations --------------------------------------------------------------------


def _solutions(metric: Metric, K: Expr, products: Sequence[Expr], allowed: Allowance) -> list[Expr]:
    """X;ij + K g_ij X = 0 for combinations of the products: the simplest that are independent."""
    q, gamma = metric.q, metric.christoffel
    functions = sorted(products, key=complexity, reverse=True)
    conditions = []
    for X in functions:
        slopes = [X.diff(x) for x in q]
        conditions.append([
            slopes[i].diff(q[k]) - dot([table[i][k] for table in gamma], slopes)
            + K * metric.g[i][k] * X
            for i in range(metric.n) for k in range(i + 1)
        ])  # fmt: skip
    relation = Relation(conditions, q, allowed, functions)
    rows = relation.tree.rows([[X] for X in functions], 4 * metric.n)
    vectors = independent(rows, 0, relation.kernel()[::-1])
    exact = (c for vector in vectors if (c := relation.exact(vector)) is not None)
    return [sympy.Add(*(x * functions[k] for k, x in c.items())) for c in exact]
