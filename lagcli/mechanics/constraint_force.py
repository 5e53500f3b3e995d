"""The real force behind a multiplier: what a constraint does to each point.

Where the positions r(q) of the points determine the coordinates, the generalized force
lambda a_j = sum_i R_i . dr_i/dq_j is solved for the forces R_i on the points.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 2.4.
"""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, solve_linear
from lagcli.mechanics.dynamics import Dynamics


def forces_on_points(dynamics: Dynamics) -> dict[str, dict[str, tuple[Expr, ...]]]:
    """Constraint -> point -> Cartesian components of the force on it.

    Empty where the points do not determine the coordinates, or nothing was solved.
    """
    system = dynamics.system
    components = [
        (particle.name, axis, [x.diff(q) for q in system.q])
        for particle in system.particles
        for axis, x in enumerate(particle.position)
    ]
    slots = [slot for slot in components if any(is_zero(a) is not True for a in slot[2])]
    if not slots or len(slots) != len(system.q):
        return {}
    transposed = [[row[j] for _, _, row in slots] for j in range(len(system.q))]
    answer: dict[str, dict[str, tuple[Expr, ...]]] = {}
    for equation, force in zip(
        dynamics.constraints.equations, dynamics.constraint_forces, strict=True
    ):
        if force is None:
            continue
        solution = solve_linear(transposed, list(force), shapes=dynamics.shapes)
        if solution is None or solution.singular:
            return {}
        by_point = {p.name: [sympy.S.Zero] * len(p.position) for p in system.particles}
        for (name, axis, _), component in zip(slots, solution.values, strict=True):
            by_point[name][axis] = component
        answer[equation.name] = {
            name: tuple(components)
            for name, components in by_point.items()
            if any(component != 0 for component in components)
        }
    return answer
