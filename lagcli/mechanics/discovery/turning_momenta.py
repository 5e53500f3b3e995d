"""Linear functions of the velocities that turn into each other.

    dw/dt = (ds/dt) A w,  A constant,  so  exp(-A s) w  is constant,

along the motion, with s the time or a coordinate: the components of omega in Suslov's problem
with a rotor by the time, x' and y' of a vehicle on omniwheels by its angle.  One alone may have a
factor of all coordinates, dw/dt = (dg/dt) w + b.

References
----------
Arnold, *Ordinary Differential Equations*, section 14 (the exponential of a matrix).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement

import sympy
from sympy import Expr, Matrix, Symbol

from lagcli.algebra import is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.spectrum import frequency_of
from lagcli.mechanics.discovery.surface import independent_on_surface, relations_on_surface
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.total_derivative import boundary_term

_MOST = 6  # functions w
_MOST_OPERATIONS = 250  # of a rate as it comes


def turning(dynamics: Dynamics, forms: Sequence[Expr], allowed: Allowance) -> Iterator[list[Expr]]:
    """Constants of the motion, linear in the velocities, by the time or a coordinate.

    Those of one root or of two conjugate ones together.

    Parameters
    ----------
    forms
        Linear functions w of the velocities.
    """
    system, motion = dynamics.system, dynamics.motion
    if motion is None:
        return
    first = [forms[k] for k in independent_on_surface(forms, dynamics, allowed)][:_MOST]
    rates = {form: _on_surface(dynamics, _rate(dynamics, form)) for form in first}
    for s, speed in ((system.t, sympy.S.One), *zip(system.q, system.qdot, strict=True)):
        allowed.check()
        w = list(first)
        for form in w:  # what a rate is made of is one of them
            more = _over(rates[form], speed, system.qdot) if len(w) < 2 * _MOST else None
            if more is None:
                continue
            if len(independent_on_surface([*w, more], dynamics, allowed)) > len(w):
                w.append(more)
                rates[more] = _on_surface(dynamics, _rate(dynamics, more))
        n, vectors = len(w), [*([rates[form]] for form in w), *([speed * form] for form in w)]
        found = relations_on_surface(vectors, dynamics, allowed)
        rows, images = _closed(
            [[c.get(k, sympy.S.Zero) for k in range(n)] for c in found],
            [[-c.get(n + k, sympy.S.Zero) for k in range(n)] for c in found],
        )
        if rows:
            turned = [
                sympy.Add(*(c * form for c, form in zip(row, w, strict=True))) for row in rows
            ]
            yield from _constants(Matrix(images), turned, s)


def with_factors(
    dynamics: Dynamics, forms: Sequence[Expr], allowed: Allowance
) -> Iterator[tuple[Expr, Expr, Expr]]:
    """exp(-g), w and S, with exp(-g) w - S constant, where dw/dt = (dg/dt) w + exp(g) dS/dt."""
    system, v = dynamics.system, dynamics.system.qdot
    for form in forms if dynamics.motion is not None else ():
        allowed.check()
        rate = _rate(dynamics, form)
        if rate.count_ops() > _MOST_OPERATIONS:
            continue
        w, rate = _on_surface(dynamics, form), _on_surface(dynamics, rate)
        if w == 0 or not (w.is_polynomial(*v) and rate.is_polynomial(*v)):
            continue
        divided = _divided(rate, w, v)
        g = None if divided is None else boundary_term(divided[0], system)
        if divided is not None and g is not None:
            factor = simplify(sympy.exp(-g))
            S = boundary_term(simplify(factor * divided[1]), system)
            if S is not None:
                yield factor, form, S


def _divided(rate: Expr, w: Expr, v: Sequence[Symbol]) -> tuple[Expr, Expr] | None:
    """q and r of first degree, q != 0, with rate = q w + r; w is linear and homogeneous."""
    still = dict.fromkeys(v, sympy.S.Zero)
    slopes = [simplify(w.diff(x)) for x in v]
    a = next(k for k, c in enumerate(slopes) if c != 0)
    along = rate.diff(v[a])
    q = simplify(along.xreplace(still) / slopes[a])
    second = simplify(along.diff(v[a]) / (2 * slopes[a]))
    for x, c in zip(v, slopes, strict=True):
        q += x * simplify((along.diff(x) - second * c) / slopes[a])
    rest = rate - q * w
    flat = all(is_zero(rest.diff(x, y)) is True for x, y in combinations_with_replacement(v, 2))
    return (q, simplify(rest)) if flat and q != 0 else None


def _on_surface(dynamics: Dynamics, formula: Expr) -> Expr:
    relations = dynamics.constraints.relations
    return simplify(formula if relations is None else relations.substitute(formula))


def _rate(dynamics: Dynamics, form: Expr) -> Expr:
    """d/dt of a form on the motion, as it comes."""
    system, motion = dynamics.system, dynamics.motion
    assert motion is not None
    solved = dict(zip(system.qddot, motion.accelerations, strict=True))
    return system.total_derivative(form).xreplace(solved)


def _over(rate: Expr, speed: Expr, v: Sequence[Symbol]) -> Expr | None:
    """rate/speed where it is linear in the velocities; without what has none of them."""
    if not rate.is_polynomial(*v):
        return None
    if speed == 1:
        slopes = [rate.diff(x) for x in v]
    elif is_zero(rate.xreplace({speed: sympy.S.Zero})) is True:
        slopes = [rate.diff(x, speed) / (2 if x == speed else 1) for x in v]
    else:
        return None
    if any(is_zero(c.diff(x)) is not True for c in slopes for x in v):
        return None
    form = sympy.Add(*(simplify(c) * x for c, x in zip(slopes, v, strict=True)))
    return form if form != 0 else None


def _closed(
    rows: list[list[Expr]], images: list[list[Expr]]
) -> tuple[list[list[Expr]], list[list[Expr]]]:
    """The largest space of rows whose images lie in it, and the images by its basis."""
    while rows:
        # c images = d rows: (c, d) in the left kernel of images above -rows
        stacked = [*images, *([-x for x in row] for row in rows)]
        kernel = nullspace([list(column) for column in zip(*stacked, strict=True)])
        m = len(rows)
        if len(kernel) == m:
            chosen = [v for v in kernel if any(v[:m])]
            if len(chosen) < m:
                return [], []
            inverse = Matrix([v[:m] for v in chosen]).inv()
            action = (inverse * Matrix([v[m:] for v in chosen])).applyfunc(simplify)
            return rows, action.tolist()
        kept = [v[:m] for v in kernel if any(v[:m])]
        rows, images = (
            [[simplify(x) for x in (Matrix([c]) * Matrix(given)).row(0)] for c in kept]
            for given in (rows, images)
        )
    return [], []


def _constants(A: Matrix, w: Sequence[Expr], s: Symbol) -> Iterator[list[Expr]]:
    """exp(-lambda s) u.w for each real root, and two for each quadratic factor, of det(lambda - A).

    With (A - g)^2 = -omega^2 on u:  exp(-g s) (u cos(omega s) - u (A - g) sin(omega s)/omega).w
    """
    lam = Symbol("#lambda", real=True)
    determinant = sympy.together((lam * sympy.eye(len(w)) - A).det(method="berkowitz"))
    for factor, _ in sympy.factor_list(sympy.numer(determinant), lam)[1]:
        poly = sympy.Poly(factor, lam).monic()
        if poly.degree() not in {1, 2}:
            continue
        at = sympy.zeros(len(w))
        for c in poly.all_coeffs():
            at = (at * A + simplify(c) * sympy.eye(len(w))).applyfunc(simplify)
        growth = simplify(-poly.all_coeffs()[1] / poly.degree())
        if poly.degree() == 1 and is_zero(growth):
            continue  # a constant, found without this
        kernel = nullspace(at.T.tolist())
        yield [_constant(A, w, s, Matrix([u]), growth, poly) for u in kernel]


def _constant(
    A: Matrix, w: Sequence[Expr], s: Symbol, u: Matrix, growth: Expr, poly: sympy.Poly
) -> Expr:
    column, result = Matrix(list(w)), (u * Matrix(list(w)))[0]
    if poly.degree() == 2:
        omega = frequency_of(simplify(poly.all_coeffs()[2] - growth**2))
        across = (u * (A - growth * sympy.eye(len(w))) * column)[0]
        result = result * sympy.cos(omega * s) - across * sympy.sin(omega * s) / omega
    return simplify(sympy.exp(-growth * s) * result)


def squares_of_velocities(L: Expr, v: Sequence[Symbol]) -> Iterator[Expr]:
    """Linear functions of the velocities of which L is written with squares, as omega_1."""
    for power in sorted(L.atoms(sympy.Pow), key=sympy.default_sort_key):
        slopes = [power.base.diff(x) for x in v]
        homogeneous = power.base.xreplace(dict.fromkeys(v, sympy.S.Zero)) == 0
        if power.exp == 2 and any(slopes) and homogeneous and all(free_of(c, v) for c in slopes):
            yield power.base
