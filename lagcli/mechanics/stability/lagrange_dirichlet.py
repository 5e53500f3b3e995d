"""Stability where the potential has a strict minimum: Lagrange and Dirichlet, and Routh.

The hypotheses: the energy function never grows, the kinetic energy is positive definite, and the
potential (at given momenta of cyclic coordinates, U_eff) has a strict minimum.  Where all motions
are damped, it is asymptotically stable (Kelvin, Tait and Chetaev).

Of one coordinate the first derivative of V that is not 0 decides: where V decreases to one side,
a motion that begins there at rest leaves on that side, with damping, too.

References
----------
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 22.
Merkin, *Introduction to the Theory of Stability*, sections 3.1 to 3.5.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from sympy import Dummy, Expr, Mul, Symbol, count_ops, prod

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.determinants import determinant
from lagcli.algebra.place import at
from lagcli.algebra.positivity import deciding, sign_of, weak_sign
from lagcli.mechanics.inequalities import contradictory
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.stability.higher import (
    order_at_critical_values,
    order_of_minimum,
    potential_derivatives,
)
from lagcli.mechanics.stability.lowest_form import by_lowest_form
from lagcli.mechanics.stability.lyapunov import FALLS
from lagcli.mechanics.stability.near import Hypotheses, Near
from lagcli.mechanics.stability.roots import ALL_ROOTS, NEUTRAL, by_roots
from lagcli.mechanics.stability.verdict import Stability, undecided, unstable
from lagcli.mechanics.theorems import (
    HURWITZ,
    KELVIN_TAIT_CHETAEV,
    LAGRANGE_DIRICHLET,
    LASALLE,
    ROUTH,
    Theorem,
)
from lagcli.record import replace

NO_FORCE = "there is no force to first order"
_STRICT = "{V} has a strict minimum"
DECREASES = "{V} decreases to one side, where a motion from rest leaves"
_FLAT = "{V} has no second derivative there"


def by_minimum(near: Near) -> Stability | None:
    """The verdict by the second derivatives of V; None where a hypothesis is not known to hold."""
    if near.hypotheses.lacking:
        return _where_inertia_is_positive(near)
    open_: list[tuple[Expr, ...]] = []
    for curvatures in near.curvatures:
        signs = near.signs(curvatures)
        neutral = signs.count(0)
        last = set(signs[len(signs) - neutral :]) <= {0}
        if set(signs) <= {0, 1} and last:
            return _minimum(near, neutral)
        if neutral and not (last and neutral == _even_dimension(near)):
            continue
        if -1 in signs or -1 in (weak_sign(e, near.positive) for e in curvatures):
            continue
        pairs = zip(curvatures, signs, strict=True)
        left = tuple(e for e, known in pairs if known is None)
        if not contradictory(left, near.positive):
            open_.append(left)
    if not open_:
        return by_lowest_form(near) if near.zeros > 2 * near.dimension_released else None
    shortest = min(open_, key=lambda left: sum(int(count_ops(e)) for e in left))
    derivatives = potential_derivatives(near.linear) if len(shortest) == 1 else []
    return Stability(
        by=_theorem(near),
        asymptotic=near.decays,
        minimum=shortest,
        reverses=near.potential_decides,
        across=near.dimension_released > 0,
        critical=order_at_critical_values(
            derivatives, near.positive, partial(_is_free, near.linear), near.linear.M[0][0]
        ),
    )


def _where_inertia_is_positive(near: Near) -> Stability | None:
    """Of one freedom, if its inertia m is positive where k/m is: r > 2 M where r > 6 M.

    Where k/m is negative, one root is positive, whatever the sign of m.
    """
    linear = near.linear
    if len(linear.M) != 1 or not near.has_energy or linear.nonholonomic or not linear.regular:
        return None
    m, k = linear.M[0][0], linear.K[0][0]
    square = deciding(simplify(k / m), near.positive)
    odd = prod(f for f in Mul.make_args(square) if not (f.is_Pow and f.exp.is_even))
    if sign_of(square, near.positive) is not None or sign_of(m, (*near.positive, odd)) != 1:
        return None
    return Stability(by=_theorem(near), asymptotic=near.decays, minimum=(square,), reverses=True)


def _is_free(linear: Linearization, values: Mapping[Symbol, Expr]) -> bool:
    """Whether no force acts anywhere, at the momenta of the point, with these values put in.

    A coordinate in the values is that of the point, and not where the force is looked at.
    """
    q = linear.system.q
    here: dict[Expr, Expr] = {x: Dummy(x.name, real=True) for x in q}
    put_in = {here.get(s, s): value.xreplace(here) for s, value in values.items()}
    known = {s: p.xreplace(here) for s, p in linear.point.values.items() if s not in q}
    momenta = {s: at(p, put_in) for s, p in known.items()}
    force = linear.forces_at_rest[0].xreplace(put_in).xreplace(momenta)
    return is_zero(force) is True


def _even_dimension(near: Near) -> int:
    """Of a family of equilibria along which V is even, without damping; else 0."""
    return near.dimension_released if not near.linear.damped and near.is_even else 0


def by_separate_curvatures(near: Near) -> Stability | None:
    """By the signs of a K that is diagonal, of which no determinant is needed; None: not so."""
    linear = near.linear
    if linear.nonholonomic or linear.damped or linear.gyroscopic or linear.point.family is not None:
        return None
    signs = near.signs(near.diagonal)
    if None in signs or 0 in signs or near.hypotheses.lacking:
        return None
    return unstable(FALLS) if -1 in signs else at_strict_minimum(near) if signs else None


def by_higher_order(near: Near) -> Stability | None:
    """Where V has no second derivative; None: not known."""
    if len(near.linear.system.q) > 1:
        return by_lowest_form(near)
    derivatives = potential_derivatives(near.linear)
    found = by_derivatives(derivatives, near.hypotheses, near.positive) if derivatives else None
    if found is not None and found.stable and near.decays:
        damped = found.reason.replace(
            f" ({LAGRANGE_DIRICHLET.name})", ", and all motions are damped"
        )
        return replace(_stable(damped, LASALLE), asymptotic=True)
    return None if found is None or found.is_open else found


def by_derivatives(
    derivatives: Sequence[Expr], hypotheses: Hypotheses, positive: Sequence[Expr]
) -> Stability:
    """Of one coordinate, by the second and higher derivatives of V there."""
    if hypotheses.lacking:
        return undecided(hypotheses.lacking)
    order, curvature = order_of_minimum(derivatives, positive), derivatives[0]
    if order is not None and order < 0:
        higher = DECREASES if order % 2 else f"{{V}} has a maximum of order {-order} there"
        return unstable(FALLS if order == -2 else higher)
    if order is not None:
        return _stable(_STRICT + f" of order {order}" * (order > 2) + " there")
    if sign_of(curvature, positive) == 0 or weak_sign(curvature, positive) == -1:
        return undecided("{V} has no minimum of second order")
    critical = order_at_critical_values(derivatives, positive)
    return Stability(minimum=(curvature,), reverses=True, by=LAGRANGE_DIRICHLET, critical=critical)


def _minimum(near: Near, neutral: int) -> Stability:
    if neutral == 0:
        return at_strict_minimum(near)
    if neutral == len(near.restoring.M):
        return by_higher_order(near) or undecided(_FLAT if near.linear.gyroscopic else NO_FORCE)
    if neutral > near.dimension_released:
        return by_lowest_form(near) or undecided(NEUTRAL)
    if near.linear.damped and (found := by_roots(near)).stable:
        return found
    if not near.is_even:
        return undecided("{V} has a minimum across the family, perhaps not evenly along it")
    return replace(_stable(f"{_STRICT} across the family"), across=True)


def at_strict_minimum(near: Near) -> Stability:
    """Stable at a strict minimum of V, asymptotically where all motions are damped."""
    if near.complete and not near.linear.nonholonomic:
        damped = f"{_STRICT} there, and all motions are damped"
        return replace(_stable(damped, KELVIN_TAIT_CHETAEV), asymptotic=True)
    if near.linear.damped and near.zeros == 0 and by_roots(near).stable:
        reached = f"{_STRICT} there, and the damping reaches all motions"
        return replace(_stable(reached, HURWITZ), asymptotic=True)
    if near.decays and not near.linear.nonholonomic:
        falling = f"{_STRICT} there, and every motion loses energy"
        return replace(_stable(falling, LASALLE), asymptotic=True)
    return _stable(f"{_STRICT} there")


def without_inertia(near: Near) -> Stability | None:
    """By a minimum in all displacements, those without inertia among them; None: not known.

    T bounds nothing that has no share in it: a minimum across the rest of V is not enough, nor
    does a force along it move it away.
    """
    K = near.linear.K
    minors = [determinant([row[:k] for row in K[:k]]) for k in range(1, len(K) + 1)]
    if None in minors:
        return None
    signs = near.signs([simplify(minor) for minor in minors if minor is not None])
    if set(signs) - {1, None}:
        return None
    open_ = tuple(m for m, known in zip(minors, signs, strict=True) if m is not None and not known)
    if not open_:
        return _stable(f"{_STRICT} there")
    return Stability(by=LAGRANGE_DIRICHLET, minimum=open_)


def _theorem(near: Near) -> Theorem:
    """By which a strict minimum of V is stable, asymptotically where all motions are damped."""
    if near.complete:
        return KELVIN_TAIT_CHETAEV
    return LASALLE if near.decays else LAGRANGE_DIRICHLET


def _stable(why: str, by: Theorem = LAGRANGE_DIRICHLET) -> Stability:
    return Stability(stable=True, reason=f"{why} ({by.name})", by=by, minimum=())


def always(found: Stability, name: str) -> Stability:
    """The verdict where the conditions for a `minimum`, or by `hurwitz`, turned out to hold."""
    theorem = found.by or LAGRANGE_DIRICHLET
    place = "across the family" if found.across else "there"
    lead = f"{_STRICT} {place}" if name == "minimum" else ALL_ROOTS
    reason = f"{lead} ({theorem.name})"
    return replace(found, stable=True, reason=reason, minimum=(), hurwitz=None, spectrum=None)


def by_routh(found: Stability) -> Stability:
    """The same of a motion with momenta of cyclic coordinates."""
    if found.by is not LAGRANGE_DIRICHLET:
        return found
    reason = found.reason.replace(LAGRANGE_DIRICHLET.name, ROUTH.name)
    return replace(found, by=ROUTH, reason=reason)
