"""Whether an equilibrium or a steady motion is stable, where that can be proved.

The one judge of all sections: what it is given is the linearised motion M x'' + C x' + K x = 0 of
a system without cyclic coordinates left (for a steady motion, of the Routhian), and what holds
beyond first order: whether energy can grow, how many equilibria are near.  In this order:

- a root of the characteristic polynomial with a positive real part: `lyapunov`;
- a strict minimum of the potential, energy never growing: `lagrange_dirichlet`;
- the real parts of all roots: `roots`.

Where signs depend on values, the conditions are given instead.
"""

from __future__ import annotations

from lagcli.algebra import simplify
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of
from lagcli.mechanics.averaged import averaged
from lagcli.mechanics.rest.characteristic import Characteristic
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.rest.singular import OnMeridians, singular, singular_everywhere
from lagcli.mechanics.stability.corners import by_both_sides
from lagcli.mechanics.stability.lagrange_dirichlet import (
    NO_FORCE,
    by_higher_order,
    by_minimum,
    by_separate_curvatures,
    without_inertia,
)
from lagcli.mechanics.stability.lyapunov import FALLS, by_a_growing_root, falls
from lagcli.mechanics.stability.near import Near
from lagcli.mechanics.stability.roots import by_roots
from lagcli.mechanics.stability.uniform import by_neighbouring_surfaces, by_uniform_acceleration
from lagcli.mechanics.stability.verdict import Stability, undecided, unstable
from lagcli.record import replace

#: Of contacts without a force.
GRAZES = "nothing presses on a closed contact, which may open"
#: Of constraints whose displacements move.
DRIFTS = "a velocity constraint has a term without velocities that depends on the place"
#: Of a system without a degree of freedom.
EXCLUDED = "the constraints exclude every displacement"
_OPEN_INERTIA = "every position is an equilibrium, and the kinetic energy may be negative"
#: Where all rest everywhere.
NEUTRAL = "every possible position near it is an equilibrium, and the kinetic energy does not grow"
_POWERS = "all roots are 0, and to first order displacements grow in proportion to a power of t"
NO_MOTION = "the equations of motion are singular there"
_JUMPS = "a force jumps there, or its derivative does"


def judge(linear: Linearization, characteristic: Characteristic | None = None) -> Stability:
    """The stability of what was linearised about."""
    near = Near(linear, characteristic)
    if not linear.M:
        return Stability(stable=True, reason=EXCLUDED)
    try:
        if reason := _not_smooth(near):
            return (reason == _JUMPS and by_both_sides(near)) or undecided(reason)
        apart = by_separate_curvatures(near)
        if apart is not None:
            return apart
        if reason := _without_polynomial(near):
            return _among_equilibria(near) or undecided(reason)
        found = by_a_growing_root(near) or _judged(near)
        if found.exact and found.across and not linear.damped:
            drifting = near.drifting
            if len(drifting) < len(linear.system.q):
                return replace(found, along=drifting)
            return _among_equilibria(near, found.reason) or found
        return _among_equilibria(near, found.reason) or found if found.is_open else found
    except ZeroDivisionError:
        return undecided(NO_MOTION)


def judge_on_average(linear: Linearization) -> Stability | None:
    """By the potential of the motion averaged over a rapid drive; None without one."""
    found, point = averaged(linear.dynamics), linear.point
    if found is None or point.free:
        return None
    q, V = linear.system.q, found.potential
    curvatures = [at(V.diff(x, 2), point.values) for x in q]
    pairs = ((x, y) for k, x in enumerate(q) for y in q[:k])
    if any(simplify(at(V.diff(x, y), point.values)) != 0 for x, y in pairs):
        return None
    signs = [sign_of(k, point.positive) for k in curvatures]
    if 0 in signs:
        return None
    open_ = tuple(k for k, known in zip(curvatures, signs, strict=True) if known is None)
    minimum = None if -1 in signs else open_
    return Stability(rapid=found.frequency, minimum=minimum, reverses=bool(minimum))


def judge_on_meridians(linear: OnMeridians) -> Stability:
    """The stability where only the coordinates are singular, by the potential alone."""
    near, no_coordinates = Near(linear), f"{singular(linear.dynamics)} singular there"
    try:
        if not (near.has_energy and linear.smooth and linear.regular):
            return undecided(no_coordinates)
        if near.hypotheses.lacking:
            return undecided(near.hypotheses.lacking)
        if singular_everywhere(linear.dynamics):
            whole = Near(Linearization(linear.rest, linear.point))
            return without_inertia(whole) or undecided(no_coordinates)
        if falls(near) and not linear.turns:
            return unstable(FALLS)
        found = by_minimum(near)
    except ZeroDivisionError:
        return undecided(NO_MOTION)
    gone = {linear.system.q[j] for j in linear.indeterminate}
    differs = any(e.free_symbols & gone for e in (found and found.minimum) or ())
    if found is None or differs or (found.stable is False and linear.turns):
        return undecided(no_coordinates)
    along = {*linear.point.free} - {linear.system.q[j] for j in linear.indeterminate}
    across = found.across and bool(along)  # at a pole of a sphere the azimuth is no family
    return replace(found, reverses=not linear.turns, asymptotic=False, across=across)


def _not_smooth(near: Near) -> str:
    if near.linear.drifts:
        return DRIFTS
    if not near.linear.regular:
        return "the mass matrix is singular there"
    if not near.linear.smooth:
        return _JUMPS
    return ""


def _without_polynomial(near: Near) -> str:
    if near.powers is None:
        return "the characteristic polynomial was not found"
    if not near.same_on_branches:
        return "the motion near it differs along the family"
    return ""


def _among_equilibria(near: Near, reason: str = "") -> Stability | None:
    """Stable along them, where every position is one and the kinetic energy never grows.

    Where that is not known to be positive, this is the better `reason` of an open verdict.
    """
    stays = near.kinetic_energy_stays or not near.hypotheses.lacking
    if not near.rests_everywhere:
        return None
    if not stays:
        return undecided(_OPEN_INERTIA) if near.has_energy and reason == NO_FORCE else None
    return Stability(stable=True, reason=NEUTRAL, across=True, minimum=(), neutral=True)


def _judged(near: Near) -> Stability:
    if len(near.others) == 1 and not near.linear.gyroscopic:
        return _without_roots(near)
    energy = by_minimum(near)
    if energy is not None and (energy.stable is not None or energy.reverses):
        return energy
    roots = by_roots(near)
    if energy is None:
        lacking = near.hypotheses.lacking if near.has_energy else ""
        known = roots.stable is not None or roots.opposed or roots.exact
        return undecided(lacking) if lacking and not known else roots
    if energy.minimum and roots.stable is None and not (energy.across and roots.is_open):
        return replace(roots, minimum=None if roots.hurwitz is not None else energy.minimum)
    return energy if roots.is_open and (energy.reason or energy.across) else roots


def _without_roots(near: Near) -> Stability:
    """Where all roots are 0."""
    if (leaving := by_uniform_acceleration(near.linear.dynamics)) is not None:
        return leaving
    forced = any(x != 0 for row in near.linear.K for x in row)
    found = by_higher_order(near) or by_both_sides(near) or by_neighbouring_surfaces(near)
    return found or undecided(_POWERS if forced else NO_FORCE)
