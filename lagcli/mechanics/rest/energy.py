"""Whether the energy function can grow: the hypothesis of Lagrange and Dirichlet and of Routh.

With L free of t, h = sum q_j' dL/dq_j' - L has the rate sum q_j' Q_j, the constraints doing
no work where no one of them moves.  Forces at rest that have a potential of their own on the
constraint surface, dF_i/dq_j = dF_j/dq_i for displacements along it, add that potential to h; the
power of the rest, sum q_j' (F_j(q, q') - F_j(q, 0)), must be nowhere positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, product

from sympy import Abs, Add, Expr, Integer, S, Symbol
from sympy import sign as sign_function

from lagcli.algebra import dot, is_zero, nullspace, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign
from lagcli.mechanics.dynamics import Dynamics

_MOST = 6  # 2^6 principal minors
_MOST_SIGNS = 3  # velocities: 26 directions


def never_grows(dynamics: Dynamics) -> bool:
    """Whether this is proved of all forces, the dissipation and the constraints."""
    lost = _lost(dynamics)
    return lost is not None and _never_negative(*lost)


def always_shrinks(dynamics: Dynamics) -> bool:
    """Whether forces take energy out of every motion: their power is 0 at rest alone."""
    loss, velocities = _lost(dynamics) or (S.Zero, ())
    if loss == 0 or not velocities or len(velocities) > _MOST_SIGNS:
        return False
    sizes = {v: Symbol(f"#{v.name}", positive=True) for v in velocities}
    directions = (d for d in product((0, 1, -1), repeat=len(sizes)) if any(d))
    return all(
        sign(
            simplify(loss.xreplace({v: k * x for k, (v, x) in zip(d, sizes.items(), strict=True)}))
        )
        == 1
        for d in directions
    )


def is_kept(dynamics: Dynamics) -> bool:
    """Whether no power is taken out and none is fed in."""
    lost = _lost(dynamics)
    return lost is not None and is_zero(lost[0]) is True


def _lost(dynamics: Dynamics) -> tuple[Expr, Sequence[Symbol]] | None:
    """The power that forces take out, in independent velocities; None: h has no such rate."""
    system, constraints = dynamics.system, dynamics.constraints
    if any(is_zero(e.drift) is not True for e in constraints.equations):
        return None
    forces = [_near_rest(force, system.qdot) for force in system.applied_forces]
    if all(is_zero(force) is True for force in forces):
        return S.Zero, ()
    rows = dynamics.independent_rows
    along = nullspace(rows) if rows else _axes(len(forces))
    still = dict.fromkeys(system.qdot, S.Zero)
    at_rest = [force.xreplace(still) for force in forces]
    if not _have_potential(at_rest, system.q, along):
        return None
    return _loss(forces, at_rest, system.qdot, along)


def _near_rest(force: Expr, velocities: Sequence[Symbol]) -> Expr:
    """The force where velocities are small: sign(v - v0) is that of -v0."""
    still = dict.fromkeys(velocities, S.Zero)
    put_in: dict[Expr, Expr] = {}
    for node in force.atoms(sign_function, Abs):
        known = sign(node.args[0].xreplace(still))
        if known in (1, -1):
            put_in[node] = Integer(known) * (node.args[0] if isinstance(node, Abs) else S.One)
    return force.xreplace(put_in)


def _axes(n: int) -> list[list[Expr]]:
    return [[S.One if i == j else S.Zero for j in range(n)] for i in range(n)]


def _have_potential(
    forces: Sequence[Expr], q: Sequence[Symbol], along: Sequence[Sequence[Expr]]
) -> bool:
    """Whether sum F_j dq_j is closed on the surface that the displacements `along` span."""
    n = range(len(q))
    curl = [[forces[i].diff(q[j]) - forces[j].diff(q[i]) for j in n] for i in n]
    return all(
        is_zero(Add(*(u[i] * curl[i][j] * v[j] for i in n for j in n if u[i] and v[j]))) is True
        for u, v in combinations(along, 2)
    )


def _loss(
    forces: Sequence[Expr],
    at_rest: Sequence[Expr],
    velocities: Sequence[Symbol],
    along: Sequence[Sequence[Expr]],
) -> tuple[Expr, list[Symbol]]:
    """The power taken out, in as many velocities u as there are displacements, q' = B u."""
    differences = [rest - force for rest, force in zip(at_rest, forces, strict=True)]
    if len(along) == len(velocities):
        flow: Sequence[Expr] = velocities
        chosen = list(velocities)
    else:
        chosen = [Symbol(f"#u{k}", real=True) for k in range(len(along))]
        flow = [
            Add(*(u * vector[j] for u, vector in zip(chosen, along, strict=True)))
            for j in range(len(velocities))
        ]
        put_in = dict(zip(velocities, flow, strict=True))
        differences = [d.xreplace(put_in) for d in differences]
    return dot(flow, differences), chosen


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
