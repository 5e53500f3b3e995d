"""Whether forces without a potential can feed energy into a system.

A theorem that needs only that energy does not grow holds where what a force does at rest has a
potential of its own, dF_i/dq_j = dF_j/dq_i identically, and the power of the rest,
sum q_j' (F_j(q, q') - F_j(q, 0)), is nowhere positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from sympy import Add, Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.mechanics.oscillations.characteristic import determinant
from lagcli.mechanics.reduction.readable import weak_sign
from lagcli.mechanics.system import System

_MOST = 6


def cannot_feed(system: System) -> bool:
    """Whether this is proved of all applied forces and the dissipation."""
    forces = system.applied_forces
    if all(is_zero(force) is True for force in forces):
        return True
    still = dict.fromkeys(system.qdot, S.Zero)
    at_rest = [force.xreplace(still) for force in forces]
    pairs = combinations(range(len(forces)), 2)
    q = system.q
    if any(is_zero(at_rest[i].diff(q[j]) - at_rest[j].diff(q[i])) is not True for i, j in pairs):
        return False
    loss = Add(
        *(v * (rest - force) for v, rest, force in zip(system.qdot, at_rest, forces, strict=True))
    )
    return _never_negative(loss, system.qdot)


def _never_negative(loss: Expr, velocities: Sequence[Symbol]) -> bool:
    whole = simplify(loss)
    if sign(whole) in (0, 1) or weak_sign(whole) == 1:
        return True
    if all(weak_sign(term) == 1 for term in Add.make_args(loss)):
        return True
    moving = [v for v in velocities if whole.has(v)]
    second = [[simplify(whole.diff(a, b)) for b in moving] for a in moving]
    if len(moving) > _MOST or any(not free_of(e, velocities) for row in second for e in row):
        return False
    # a quadratic form is not negative where no principal minor is
    return all(
        _principal(second, chosen)
        for size in range(1, len(moving) + 1)
        for chosen in combinations(range(len(moving)), size)
    )


def _principal(matrix: Sequence[Sequence[Expr]], chosen: Sequence[int]) -> bool:
    minor = determinant([[matrix[i][j] for j in chosen] for i in chosen])
    return minor is not None and (minor == 0 or sign(minor) == 1 or weak_sign(minor) == 1)
