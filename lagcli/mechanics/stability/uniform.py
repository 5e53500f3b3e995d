"""Uniform acceleration near a motion whose linearised equations have the root 0 alone.

Where some coordinates c stay at rest once they rest, q_c'' = 0 for q_c' = 0, and then another
acceleration depends on them only, a_j = g(q_c): beside a zero of g the velocity q_j' grows in
proportion to t, in an exact solution.  A blade that is turned a little from across the slope
begins to slide.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.dynamics import Dynamics


def displaced_it_accelerates(dynamics: Dynamics) -> bool:
    """Whether an exact solution leaves from beside any state in which no coordinate of c moves."""
    motion, constraints = dynamics.motion, dynamics.constraints.equations
    if motion is None or any(is_zero(e.drift) is not True for e in constraints):
        return False
    q, qdot = dynamics.system.q, dynamics.system.qdot
    found = motion.accelerations
    resting = [j for j in range(len(q)) if found[j].xreplace({qdot[j]: S.Zero}) == 0]
    fixed = [q[j] for j in resting if all(free_of(e.f, [q[j]]) for e in constraints if e.holonomic)]
    still = {qdot[j]: S.Zero for j in resting}
    others = [simplify(a.xreplace(still)) for j, a in enumerate(found) if j not in resting]
    return any(_of_these_only(a, fixed, (*q, *qdot, dynamics.system.t)) for a in others)


def _of_these_only(a: Expr, fixed: Sequence[Symbol], state: Sequence[Symbol]) -> bool:
    """Whether an acceleration changes with the fixed coordinates and with nothing else."""
    return not free_of(a, fixed) and free_of(a, [x for x in state if x not in fixed])
