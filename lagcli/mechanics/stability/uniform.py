"""Uniform acceleration near a motion whose linearised equations have the root 0 alone.

Where some coordinates c stay at rest once they rest, q_c'' = 0 for q_c' = 0, and then another
acceleration depends on them only, a_j = g(q_c): beside a zero of g the velocity q_j' grows in
proportion to t, in an exact solution.  A blade that is turned a little from across the slope
begins to slide, where there is a slope: sin(alpha) is a factor of g that may be 0.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Mul, S, Symbol

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of
from lagcli.algebra.signs import sign
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.stability.near import Near
from lagcli.mechanics.stability.verdict import Stability, unstable

_ASIDE = "near it, on other surfaces that are allowed, a force moves it away"
#: By an exact solution.
_ACCELERATES = "near it there are motions with a constant acceleration"


def by_uniform_acceleration(dynamics: Dynamics) -> Stability | None:
    """Unstable, where an exact solution leaves from beside any state in which c does not move.

    Where factors of the acceleration that no motion changes may be 0, it is so where they are not.
    """
    motion, constraints = dynamics.motion, dynamics.constraints.equations
    if motion is None or any(is_zero(e.drift) is not True for e in constraints):
        return None
    q, qdot = dynamics.system.q, dynamics.system.qdot
    state = (*q, *qdot, dynamics.system.t)
    found = motion.accelerations
    resting = [j for j in range(len(q)) if found[j].xreplace({qdot[j]: S.Zero}) == 0]
    fixed = [q[j] for j in resting if all(free_of(e.f, [q[j]]) for e in constraints if e.holonomic)]
    still = {qdot[j]: S.Zero for j in resting}
    others = [simplify(a.xreplace(still)) for j, a in enumerate(found) if j not in resting]
    leaving = [_may_be_zero(a, state) for a in others if _of_these_only(a, fixed, state)]
    if not leaving:
        return None
    fewest = min(leaving, key=len)
    if not fewest:
        return unstable(_ACCELERATES)
    return Stability(growing=Mul(*fewest) ** 2, reason=_ACCELERATES)


def by_neighbouring_surfaces(near: Near) -> Stability | None:
    """Unstable beside a surface of integrable velocity constraints on which it rests everywhere.

    Where a displacement e to another surface brings a force along it, e f(q) + O(e^2) with
    f(q0) not 0, the scaled time sqrt(e) t has a motion M q'' = f(q) that leaves at once.
    """
    linear = near.linear
    constraints, values = linear.dynamics.constraints, linear.point.values
    still = dict.fromkeys(linear.system.qdot, S.Zero)
    slopes = (f.diff(v).xreplace(still) for f in linear.rest.forcing for v in still)
    if constraints.nonholonomic or any(x != 0 for x in slopes):
        return None
    if near.dimension != len(linear.M) or not near.inertia_is_definite:
        return None
    rows = [[at(a, values) for a in e.row] for e in constraints.equations if e.holonomic]
    columns = list(zip(*linear.stiffness, strict=True))
    forces = [[dot(b, column) for column in columns] for b in linear.basis]
    changes = (
        [simplify(dot(f, d)) for f in forces for d in nullspace(rows)]
        if rows
        else [simplify(x) for force in forces for x in force]
    )
    changes = [each for each in changes if each != 0]
    if any(sign_of(each**2, near.positive) == 1 for each in changes):
        return unstable(_ASIDE)
    return Stability(growing=changes[0] ** 2, reason=_ASIDE) if changes else None


def _may_be_zero(a: Expr, state: Sequence[Symbol]) -> list[Expr]:
    """The factors of an acceleration that are constant and may be 0."""
    factors = (factor for factor, power in factors_of(a) if power > 0 and free_of(factor, state))
    return [factor for factor in factors if sign(factor) not in (1, -1)]


def _of_these_only(a: Expr, fixed: Sequence[Symbol], state: Sequence[Symbol]) -> bool:
    """Whether an acceleration changes with the fixed coordinates and with nothing else."""
    return not free_of(a, fixed) and free_of(a, [x for x in state if x not in fixed])
