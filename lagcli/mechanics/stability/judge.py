"""Whether an equilibrium or a steady motion is stable, where that can be proved.

The one judge of all sections: what it is given is the linearised motion M x'' + C x' + K x = 0 of
a system without cyclic coordinates left (for a steady motion, of the Routhian), and what holds
beyond first order: whether energy can grow, how many equilibria are near.  In this order:

- a root of the characteristic polynomial with a positive real part: unstable (Lyapunov);
- a strict minimum of the potential, energy never growing: stable (Lagrange and Dirichlet, Routh),
  asymptotically where all motions are damped (Kelvin, Tait and Chetaev, or Hurwitz);
- all roots with negative real parts, beside one root 0 for each dimension of a family of
  equilibria: asymptotically stable (Hurwitz), or to the family (Lyapunov and Malkin);
- all roots imaginary and simple: stable to first order, which is the motion itself where the
  equations are linear.

Where signs depend on values, the conditions are given instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sympy import Expr, Float, I, count_ops, im

from lagcli.algebra import simplify
from lagcli.mechanics.oscillations.characteristic import Characteristic
from lagcli.mechanics.oscillations.equilibria import at
from lagcli.mechanics.oscillations.linearization import Linearization
from lagcli.mechanics.oscillations.singular import OnMeridians
from lagcli.mechanics.reduction.averaged import averaged
from lagcli.mechanics.stability.higher import (
    order_at_critical_values,
    order_of_minimum,
    potential_derivatives,
)
from lagcli.mechanics.stability.hurwitz import hurwitz_conditions
from lagcli.mechanics.stability.near import Near, contradictory, one_is_negative
from lagcli.mechanics.stability.signs import is_positive, sign_of, weak_sign
from lagcli.mechanics.stability.spectrum import conditions_of
from lagcli.mechanics.stability.uniform import displaced_it_accelerates
from lagcli.mechanics.theorems import (
    HURWITZ,
    KELVIN_TAIT_CHETAEV,
    LAGRANGE_DIRICHLET,
    LYAPUNOV_MALKIN,
    ROUTH,
    Theorem,
)
from lagcli.record import record

#: What the file leaves open, and how it would say it.
NOT_DEFINITE = (
    "the kinetic energy is not known to be positive definite (a parameter is declared positive "
    "by {assume: positive})"
)
#: Of contacts without a force.
GRAZES = "nothing presses on the contact, which may open"
_INDEFINITE = "the kinetic energy is not positive definite"
#: Of constraints whose displacements move.
DRIFTS = "a velocity constraint has a term without velocities that depends on the place"
#: Of a system without a degree of freedom.
EXCLUDED = "the constraints exclude every displacement"
_FALLING = "a squared frequency is negative, since {V} has no minimum there"
_GROWING = "a root of the characteristic polynomial has a positive real part"
#: By an exact solution.
ACCELERATES = "near it there are motions with a constant acceleration"
_ALL_ROOTS = "all roots have negative real parts"
_NO_SECOND = "{V} has no minimum of second order"
_EVERYWHERE = "every position is an equilibrium, and the kinetic energy does not grow"
_NEUTRAL = "there is no force to first order"
_FLAT = "{V} has no second derivative there"
_POWERS = "all roots are 0, and to first order displacements grow in proportion to a power of t"
_MAY_FEED = "a force that is not linear, or has no potential, may feed energy"
_MOST_ROLLING = 4
_NUMERIC = Float("1e-20")


@record(kw_only=True)
class Stability:
    """The verdict with its reason; "{V}" in the reason stands for the potential.

    Attributes
    ----------
    by
        The theorem that decides, or that does so where the conditions hold.
    asymptotic
        Whether it is asymptotically stable, where it is stable.
    minimum, spectrum, hurwitz
        What must be positive for a minimum of V, for frequencies that are real and distinct,
        for roots that all have negative real parts; empty: it is always so.  None: not asked
        for, never so, or not decided.
    reverses
        Whether it is unstable where one of `minimum` is negative.  (Of the others it is.)
    exact
        The equations of motion are linear: the spectrum decides beyond first order.
    across
        Stable up to displacements along a family of equilibria.
    growing
        It is unstable where this is positive, and it is nowhere negative.
    opposed
        It is unstable where one of these is negative, and they are nowhere all positive.
    rapid
        The frequency of a drive: the verdict is on the averaged motion where that is large.
    critical
        The order of the minimum where the one condition of `minimum` is an equality; 0: it is no
        minimum, and unstable.  None: not known.
    """

    stable: bool | None = None
    reason: str = ""
    by: Theorem | None = None
    asymptotic: bool = False
    minimum: tuple[Expr, ...] | None = None
    spectrum: tuple[Expr, ...] | None = None
    hurwitz: tuple[Expr, ...] | None = None
    reverses: bool = False
    exact: bool = False
    across: bool = False
    growing: Expr | None = None
    opposed: tuple[Expr, ...] = ()
    rapid: Expr | None = None
    critical: int | None = None

    @property
    def is_open(self) -> bool:
        """Whether nothing was decided, not even under conditions."""
        decided = (self.stable, self.minimum, self.spectrum, self.hurwitz, self.growing, self.rapid)
        return all(each is None for each in decided) and not self.opposed


def by_routh(found: Stability) -> Stability:
    """The same of a motion with momenta of cyclic coordinates."""
    if found.by is not LAGRANGE_DIRICHLET:
        return found
    reason = found.reason.replace(LAGRANGE_DIRICHLET.name, ROUTH.name)
    return replace(found, by=ROUTH, reason=reason)


def undecided(reason: str) -> Stability:
    """No verdict, and why."""
    return Stability(reason=reason)


def unstable(reason: str) -> Stability:
    """What leaves."""
    return Stability(stable=False, reason=reason)


def judge(linear: Linearization, characteristic: Characteristic | None = None) -> Stability:
    """The stability of what was linearised about."""
    near = Near(linear, characteristic)
    if not linear.M:
        return Stability(stable=True, reason=EXCLUDED)
    try:
        reason = _not_smooth(near)
        if reason:
            return undecided(reason)
        apart = by_separate_curvatures(near)
        if apart is not None:
            return apart
        reason = _without_roots(near)
        if reason:
            return undecided(reason)
        found = by_a_growing_root(near) or _judged(near)
        return _among_equilibria(near) or found if found.is_open else found
    except ZeroDivisionError:
        return undecided("the equations of motion are singular there")


def judge_on_average(linear: Linearization) -> Stability | None:
    """By the potential of the motion averaged over a rapid drive; None without one."""
    found, point = averaged(linear.dynamics), linear.point
    if found is None or point.free:
        return None
    curvature = at(found.potential.diff(linear.system.q[0], 2), point.values)
    known = sign_of(curvature, point.positive)
    if known == 0:
        return None
    minimum = {1: (), -1: None, None: (curvature,)}[known]
    return Stability(rapid=found.frequency, minimum=minimum, reverses=known is None)


def judge_on_meridians(linear: OnMeridians) -> Stability:
    """The stability where only the coordinates are singular, by the potential alone."""
    near = Near(linear)
    try:
        if not (near.has_energy and linear.smooth and linear.regular):
            return undecided("the coordinates are singular there")
        if not near.inertia_is_definite:
            return undecided(NOT_DEFINITE)
        turning = linear.turns
        if _falls(near) and not turning:
            return unstable("{V} has no minimum there")
        found = by_minimum(near)
    except ZeroDivisionError:
        return undecided("the equations of motion are singular there")
    if found is None:
        return undecided("the coordinates are singular there")
    return replace(found, reverses=not turning, asymptotic=False)


def _not_smooth(near: Near) -> str:
    if near.linear.drifts:
        return DRIFTS
    if not near.linear.regular:
        return "the mass matrix is singular there"
    if not near.linear.smooth:
        return "a force jumps there, or its derivative does"
    return ""


def _without_roots(near: Near) -> str:
    if near.powers is None:
        return "the characteristic polynomial was not found"
    if not near.same_on_branches:
        return "the motion near it differs along the family"
    return ""


def _among_equilibria(near: Near) -> Stability | None:
    """Stable along them, where every position is one and the kinetic energy never grows."""
    if not (near.rests_everywhere and near.has_energy and near.inertia_is_definite):
        return None
    return Stability(stable=True, reason=_EVERYWHERE, across=True, minimum=())


def _judged(near: Near) -> Stability:
    if len(near.others) == 1 and not near.linear.gyroscopic:
        forced = any(x != 0 for row in near.linear.K for x in row)
        if forced and displaced_it_accelerates(near.linear.dynamics):
            return unstable(ACCELERATES)
        return by_higher_order(near) or undecided(_POWERS if forced else _NEUTRAL)
    if near.has_energy and not near.inertia_is_definite:
        roots = by_roots(near)
        known = roots.stable is not None or roots.opposed or roots.exact
        return (
            roots
            if known
            else undecided(_INDEFINITE if near.inertia_is_indefinite else NOT_DEFINITE)
        )
    energy = by_minimum(near) if near.has_energy else None
    if energy is not None and (energy.stable is not None or energy.reverses):
        return energy
    roots = by_roots(near)
    if energy is not None and energy.minimum and roots.stable is None:
        keep = None if roots.hurwitz is not None else energy.minimum
        return replace(roots, minimum=keep)
    found = roots.spectrum is not None or roots.hurwitz is not None or roots.opposed
    if roots.stable is not None or found:
        return roots
    return energy if energy is not None and energy.reason else roots


def by_separate_curvatures(near: Near) -> Stability | None:
    """By the signs of a K that is diagonal, of which no determinant is needed; None: not so."""
    linear = near.linear
    if linear.nonholonomic or linear.damped or linear.gyroscopic or linear.point.family is not None:
        return None
    signs = near.signs(near.diagonal)
    if None in signs or 0 in signs or not (near.has_energy and near.inertia_is_definite):
        return None
    return unstable(_FALLING) if -1 in signs else _strict_minimum(near) if signs else None


# -- a growing root --------------------------------------------------------------------------------


def by_a_growing_root(near: Near) -> Stability | None:
    """Unstable, where some root surely has a positive real part (Lyapunov)."""
    others, positive = near.others, near.positive
    if len(others) > 1 and sign_of(others[0], positive) == -1:
        return unstable(_no_minimum(near) or "a root of the characteristic polynomial is positive")
    if -1 in near.signs(near.conditions or ()) or any(map(_not_real, _squares(near))):
        return unstable(_no_minimum(near) or _GROWING)
    # det(s² M + s C + K) of symmetric M, C, K has a positive root s where K has a negative one
    decided = near.complete or near.damping_is_even
    if decided and near.linear.has_potential and near.inertia_is_definite and _falls(near):
        return unstable(_no_minimum(near) or _GROWING)
    candidates = [*others[: len(others) > 1], *(near.conditions or ()), *_squares(near)]
    weak = [e for e in candidates if weak_sign(e, positive) == -1]
    return Stability(growing=-weak[0]) if weak else None


def _squares(near: Near) -> list[Expr]:
    """The ω² that are not 0, each unstable where it is negative or not real."""
    return [W for W in near.squares or () if W != 0] if near.even else []


def _not_real(W: Expr) -> bool:
    return bool(W.has(I) and W.is_number and abs(im(W.evalf(30))) > _NUMERIC)


def _falls(near: Near) -> bool:
    """Whether K has a negative eigenvalue, by the signs of one list that decides."""
    return near.restoring is near.linear and any(
        -1 in signs or _zero_before_others(signs) for signs in map(near.signs, near.curvatures)
    )


def _zero_before_others(signs: Sequence[int | None]) -> bool:
    """e_j = 0 but e_k not, k > j: not all W have one sign."""
    return any(s == 0 and any(later in (1, -1) for later in signs[k:]) for k, s in enumerate(signs))


def _no_minimum(near: Near) -> str:
    """The reason in terms of the potential, where that is one."""
    linear = near.linear
    if linear.nonholonomic or not linear.has_potential or not near.inertia_is_definite:
        return ""
    if near.complete and linear.gyroscopic:
        name = KELVIN_TAIT_CHETAEV.name
        return f"{{V}} has no minimum there, and all motions are damped ({name})"
    if linear.gyroscopic:
        return ""
    return "{V} has no minimum there" if linear.damped else _FALLING


# -- a minimum -------------------------------------------------------------------------------------


def by_minimum(near: Near) -> Stability | None:
    """By Lagrange and Dirichlet or Routh; None where the potential has no minimum.

    That energy never grows and that the kinetic energy is positive definite was checked.
    """
    decides = near.complete or near.damping_is_even
    open_: list[tuple[Expr, ...]] = []
    for curvatures in near.curvatures:
        signs = near.signs(curvatures)
        neutral = signs.count(0)
        if set(signs) <= {0, 1} and set(signs[len(signs) - neutral :]) <= {0}:
            return _minimum(near, neutral)
        if -1 in signs or neutral or -1 in (weak_sign(e, near.positive) for e in curvatures):
            continue
        pairs = zip(curvatures, signs, strict=True)
        left = tuple(e for e, known in pairs if known is None)
        if not contradictory(left, near.positive):
            open_.append(left)
    if not open_:
        return None
    shortest = min(open_, key=_length)
    derivatives = potential_derivatives(near.linear) if len(shortest) == 1 else []
    return Stability(
        by=KELVIN_TAIT_CHETAEV if near.complete else LAGRANGE_DIRICHLET,
        asymptotic=near.complete,
        minimum=shortest,
        reverses=decides and near.restoring is near.linear,
        critical=order_at_critical_values(derivatives, near.positive),
    )


def by_higher_order(near: Near) -> Stability | None:
    """Of one coordinate whose potential has no second derivative there; None: not known."""
    if not (near.has_energy and near.inertia_is_definite):
        return None
    return _by_order(potential_derivatives(near.linear), near.positive)


def _by_order(derivatives: Sequence[Expr], positive: Sequence[Expr]) -> Stability | None:
    """The verdict by the first derivative of V that is not 0 there."""
    order = order_of_minimum(derivatives, positive)
    if not order:
        return None if order is None else unstable("{V} has no minimum there")
    reason = f"{{V}} has a strict minimum of order {order} there ({LAGRANGE_DIRICHLET.name})"
    return Stability(stable=True, reason=reason, by=LAGRANGE_DIRICHLET, minimum=())


def _minimum(near: Near, neutral: int) -> Stability:
    if neutral == 0:
        return _strict_minimum(near)
    if neutral == len(near.restoring.M):
        return undecided(_FLAT if near.linear.gyroscopic else _NEUTRAL)
    if neutral > near.dimension_released:
        return undecided("neutral to first order in some direction")
    if not near.is_even:
        return undecided("{V} has a minimum across the family, perhaps not evenly along it")
    return Stability(
        stable=True,
        reason=f"{{V}} has a strict minimum across the family ({LAGRANGE_DIRICHLET.name})",
        by=LAGRANGE_DIRICHLET,
        minimum=(),
        across=True,
    )


def _strict_minimum(near: Near) -> Stability:
    lead, name = "{V} has a strict minimum there", LAGRANGE_DIRICHLET.name
    if near.complete and not near.linear.nonholonomic:
        reason = f"{lead}, and all motions are damped ({KELVIN_TAIT_CHETAEV.name})"
        return Stability(
            stable=True, reason=reason, by=KELVIN_TAIT_CHETAEV, asymptotic=True, minimum=()
        )
    if near.linear.damped and near.zeros == 0 and by_roots(near).stable:
        return _damped(f"{lead}, and the damping reaches all motions", HURWITZ)
    return Stability(stable=True, reason=f"{lead} ({name})", by=LAGRANGE_DIRICHLET, minimum=())


def always(found: Stability, name: str) -> Stability:
    """The verdict where the conditions for a `minimum`, or by `hurwitz`, turned out to hold."""
    theorem = found.by or LAGRANGE_DIRICHLET
    lead = "{V} has a strict minimum there" if name == "minimum" else _ALL_ROOTS
    reason = f"{lead} ({theorem.name})"
    return replace(found, stable=True, reason=reason, minimum=(), hurwitz=None, spectrum=None)


def _damped(why: str, by: Theorem) -> Stability:
    return Stability(stable=True, reason=f"{why} ({by.name})", by=by, asymptotic=True, minimum=())


def _length(expressions: tuple[Expr, ...]) -> int:
    return sum(int(count_ops(e)) for e in expressions)


# -- the roots -------------------------------------------------------------------------------------


def by_roots(near: Near) -> Stability:
    """The verdict by the roots of the characteristic polynomial."""
    conditions = near.conditions
    if conditions is None:
        return undecided("the roots have no simple criterion")
    signs = near.signs(conditions)
    if near.even and 0 in signs:
        return _multiple(near)
    if 0 in signs or any(weak_sign(e, near.positive) == -1 for e in conditions):
        return undecided("to first order it is at the limit of stability")
    open_ = tuple(e for e, s in zip(conditions, signs, strict=True) if s is None)
    if contradictory(open_, near.positive):
        if one_is_negative(open_, near.positive):
            return unstable(_no_minimum(near) or _GROWING)
        return Stability(opposed=open_)
    if near.even:
        return _imaginary(near, open_)
    if near.zeros and not near.as_many_equilibria:
        return undecided("neutral to first order in some direction")
    across, theorem = bool(near.zeros), LYAPUNOV_MALKIN if near.zeros else HURWITZ
    if open_:
        return Stability(asymptotic=True, hurwitz=open_, by=theorem, across=across)
    others = _ALL_ROOTS.replace("all", "all other") if across else _ALL_ROOTS
    reason = f"{others} ({theorem.name})"
    return Stability(stable=True, reason=reason, by=theorem, asymptotic=True, across=across)


def _imaginary(near: Near, open_: tuple[Expr, ...]) -> Stability:
    exact = near.linear.exact
    if near.zeros and not (exact and near.semisimple_zeros):
        return undecided("neutral to first order in some direction")
    if exact and not open_:
        reason = "the equations of motion are linear, and all their solutions are bounded"
        return Stability(stable=True, reason=reason, spectrum=(), exact=True)
    fed = not exact and not (near.linear.rest.energy_never_grows and near.linear.has_potential)
    return Stability(spectrum=open_, exact=exact, reason=_MAY_FEED if fed else "")


def _multiple(near: Near) -> Stability:
    """Where two frequencies agree for all values."""
    limit = undecided("to first order it is at the limit of stability")
    squares, positive = near.squares, near.positive
    if squares is None or near.zeros or any(weak_sign(W, positive) != 1 for W in squares):
        return limit
    each = {W: sum(1 for other in squares if simplify(W - other) == 0) for W in squares}
    growing = [W for W, count in each.items() if count > 1 and not near.semisimple(W, count)]
    if not growing:
        return _imaginary(near, tuple(W for W in each if sign_of(W, positive) is None))
    if not near.linear.exact:
        return limit
    if sign_of(growing[0], positive) is None:
        return Stability(growing=growing[0])
    return unstable("two frequencies agree, and the motion with them grows in proportion to t")


def by_polynomial(
    powers: Sequence[Expr], positive: Sequence[Expr], *, dimension: int
) -> tuple[Stability, tuple[Expr, ...]]:
    """The verdict by a characteristic polynomial alone, and ω² where there is one.

    The steady motions near it make a manifold of this dimension.
    """
    zeros = next(k for k, c in enumerate(powers) if c != 0)
    others = [simplify(c / powers[-1]) for c in powers[zeros:]]
    if len(others) == 1:
        return undecided("all roots of the linearised equations are 0"), ()
    even = all(c == 0 for c in others[1::2])
    squares = (others[0],) if even and len(others) == 3 else ()
    if even:
        in_square = [(-1) ** k * c for k, c in enumerate(others[::2])]
        sign = (-1) ** (len(in_square) - 1)
        long = len(in_square) - 1 > _MOST_ROLLING
        conditions = None if long else conditions_of([sign * c for c in in_square])
    else:
        conditions = hurwitz_conditions(others)
    if conditions is None:
        return undecided("the roots have no simple criterion"), squares
    signs = [sign_of(e, positive) for e in conditions]
    if -1 in signs:
        return unstable(_GROWING), squares
    at_limit = zeros > dimension or 0 in signs
    if at_limit or any(weak_sign(e, positive) == -1 for e in conditions):
        return undecided("to first order at the limit of stability"), squares
    open_ = tuple(e for e, known in zip(conditions, signs, strict=True) if known is None)
    if even:
        return Stability(spectrum=open_), squares
    if open_:
        return Stability(hurwitz=open_, asymptotic=True, across=True, by=LYAPUNOV_MALKIN), squares
    reason = f"all other roots have negative real parts ({LYAPUNOV_MALKIN.name})"
    found = Stability(stable=True, reason=reason, asymptotic=True, across=True, by=LYAPUNOV_MALKIN)
    return found, squares


def by_curvature(
    derivatives: Sequence[Expr], mass: Expr, positive: Sequence[Expr] = ()
) -> Stability:
    """The verdict on one coordinate with M, V'' and the next derivatives given."""
    curvature = derivatives[0]
    if not is_positive(mass, positive):
        return undecided(NOT_DEFINITE)
    square = simplify(curvature / mass)
    known = sign_of(square, positive)
    if known == -1:
        return unstable(_FALLING)
    if known == 1:
        reason = f"{{V}} has a strict minimum there ({LAGRANGE_DIRICHLET.name})"
        return Stability(stable=True, reason=reason, by=LAGRANGE_DIRICHLET, minimum=())
    if known == 0:
        return _by_order(derivatives, positive) or undecided(_NO_SECOND)
    if weak_sign(square, positive) == -1:
        return undecided(_NO_SECOND)
    critical = order_at_critical_values(derivatives, positive)
    return Stability(minimum=(square,), reverses=True, by=LAGRANGE_DIRICHLET, critical=critical)
