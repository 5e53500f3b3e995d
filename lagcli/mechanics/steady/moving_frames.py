"""Velocities that all may have in common: the equations hold in a frame that moves with them.

Of M(q) q'' = F(q, q') these are the constant c with

    M(q + s c) = M(q),   F(q + s c, q' + u c) = F(q, q')   for all s and u,

so that with q(t) also q(t) + u c t is a motion: two masses that a spring joins, two coupled discs.
Each constraint f(q, q') = 0 must keep its values in the same way: then so do its gradient a, with
a . c = 0, and its multiplier.

Where L, all constraints and the forces keep their values when one pair (x, y) of coordinates turns
about its origin, steady rotations have x and y that are not constant: polar coordinates are needed.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 3.
"""

from __future__ import annotations

from itertools import chain, combinations

from sympy import Expr, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.mechanics.rest.rest_conditions import RestConditions


def moving_frames(rest: RestConditions) -> dict[Symbol, list[Expr]]:
    """The c by the coordinate at which each is 1."""
    if rest.depends_on_time:
        return {}
    kept = [e.f for e in rest.dynamics.constraints.equations]
    system, s, u = rest.system, Symbol("#s", real=True), Symbol("#u", real=True)
    found = {}
    for free, c in rest.translations.items():
        moved = {q: q + s * x for q, x in zip(system.q, c, strict=True)}
        moved |= {v: v + u * x for v, x in zip(system.qdot, c, strict=True)}
        same = (
            is_zero(e.xreplace(moved) - e) for e in chain(*rest.mass_matrix, rest.forcing, kept)
        )
        if sum(x != 0 for x in c) > 1 and all(each is True for each in same):
            found[free] = c
    return found


def plane_of_rotation(rest: RestConditions) -> tuple[str, ...]:
    """The names of x and y, where nothing changes as (x, y) turns about the origin; else ()."""
    system, equations = rest.system, rest.dynamics.constraints.equations
    if rest.depends_on_time or not all(e.holonomic for e in equations):
        return ()
    forces = system.applied_forces
    kept = [system.L, *(e.f for e in equations)]
    acting = [q for q, f in zip(system.q, forces, strict=True) if is_zero(f) is not True]
    if any(all(free_of(f, [q]) for f in (*kept, *forces)) for q in acting):  # what nothing holds
        return ()
    for pair in combinations(range(len(system.q)), 2):
        (x, y), (u, v) = ([s[j] for j in pair] for s in (system.q, system.qdot))
        others = [f for j, f in enumerate(forces) if j not in pair]
        along_x, along_y = (forces[j] for j in pair)

        def turned(f: Expr, x: Symbol = x, y: Symbol = y, u: Symbol = u, v: Symbol = v) -> Expr:
            return x * f.diff(y) - y * f.diff(x) + u * f.diff(v) - v * f.diff(u)

        changes = [*map(turned, (*kept, *others))]
        changes += [turned(along_x) + along_y, turned(along_y) - along_x]
        changes += [x * along_y - y * along_x]  # a torque
        if all(is_zero(change) is True for change in changes):
            return () if all(free_of(f, (x, y)) for f in (*kept, *forces)) else (x.name, y.name)
    return ()
