"""The real force behind a multiplier: what a constraint does to each point.

Where the positions r(q) of the points determine the coordinates that they depend on, the
generalized force lambda a_j = sum_i R_i . dr_i/dq_j along these is solved for the forces R_i
on the points.  Along a coordinate on which no point depends, the angle of a body, it stays
the generalized force that it is: the torque about the point.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 2.4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, solve_linear
from lagcli.mechanics.dynamics import Dynamics

Vector = tuple[Expr, ...]


def forces_on_points(dynamics: Dynamics) -> dict[str, dict[str, Vector]]:
    """Constraint -> point -> Cartesian components of the force on it.

    Empty where the points do not determine the coordinates, or nothing was solved.
    """
    equations = dynamics.constraints.equations
    known = zip(equations, dynamics.constraint_forces, strict=True)
    return on_points(dynamics, {e.name: force for e, force in known if force is not None})


def on_points(
    dynamics: Dynamics, along: Mapping[str, Sequence[Expr]]
) -> dict[str, dict[str, Vector]]:
    """Vectors on the points that do the work given along the coordinates, by name.

    Points on which nothing acts are left out; empty where the vectors are not unique, or where
    bodies beside the points move with them and take up a part of the force.
    """
    system = dynamics.system
    components = [
        (particle.name, axis, [x.diff(q) for q in system.q])
        for particle in system.particles
        for axis, x in enumerate(particle.position)
    ]
    slots = [slot for slot in components if any(is_zero(a) is not True for a in slot[2])]
    moving = [
        j for j in range(len(system.q)) if any(is_zero(row[j]) is not True for _, _, row in slots)
    ]
    if not slots or len(slots) != len(moving) or not along or _carry_more(dynamics, moving):
        return {}
    transposed = [[row[j] for _, _, row in slots] for j in moving]
    answer: dict[str, dict[str, Vector]] = {}
    for name, work in along.items():
        solution = solve_linear(transposed, [work[j] for j in moving], shapes=dynamics.shapes)
        if solution is None or solution.singular:
            return {}
        by_point = {p.name: [sympy.S.Zero] * len(p.position) for p in system.particles}
        for (point, axis, _), component in zip(slots, solution.values, strict=True):
            by_point[point][axis] = component
        answer[name] = {
            point: tuple(vector)
            for point, vector in by_point.items()
            if any(component != 0 for component in vector)
        }
    return answer


def _carry_more(dynamics: Dynamics, moving: Sequence[int]) -> bool:
    """Whether T has more inertia along these coordinates than the points of the file.

    Only a difference that is quadratic in the velocities tells that; a point without a mass
    has one that is not known.
    """
    system = dynamics.system
    if any(particle.mass is None for particle in system.particles):
        return False
    rest = system.L - system.points_energy
    more = [rest.diff(system.qdot[j], v) for j in moving for v in system.qdot]
    return all(not entry.has(*system.qdot) for entry in more) and any(
        is_zero(entry) is False for entry in more
    )


def fixed_axes(dynamics: Dynamics, point: str) -> tuple[str, ...]:
    """The axes along which a point never moves: a force along them does no work."""
    [particle] = [p for p in dynamics.system.particles if p.name == point]
    placed = zip("xyz", particle.position, strict=False)
    q = dynamics.system.q
    return tuple(axis for axis, x in placed if all(is_zero(x.diff(s)) is True for s in q))


def turning_coordinates(dynamics: Dynamics) -> list[int]:
    """Coordinates on which no point depends, such as the angle of a body about its centre."""
    positions = [x for particle in dynamics.system.particles for x in particle.position]
    return [
        j
        for j, q in enumerate(dynamics.system.q)
        if all(is_zero(x.diff(q)) is True for x in positions)
    ]
