"""Steady motions under velocity constraints in the shape in which they are read."""

from __future__ import annotations

from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.decimals import written
from lagcli.algebra.entry import Field
from lagcli.algebra.positivity import vanishing_part
from lagcli.expression import Expression
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.minimal import minimal
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.exceptions import unless_written
from lagcli.mechanics.rest.held import held
from lagcli.mechanics.stability.statement import stated
from lagcli.mechanics.steady.moving_frames import plane_of_rotation
from lagcli.mechanics.steady.rolling import RollingMotion, RollingMotions
from lagcli.statements.motions import SteadyMotion, SteadySection


def applies(derivation: Derivation) -> bool:
    """Whether a coordinate may turn at a constant rate that no constant momentum gives.

    Under a velocity constraint, or where a force acts along what L contains at most linearly, once
    the constraints on the positions are put in.
    """
    kinds = derivation.dynamics.constraints.kinds.values()
    if any(kind != "holonomic" for kind in kinds):
        return True
    if kinds and not derivation.problem.contacts:
        fewer = minimal(derivation)
        return fewer is not derivation and applies(fewer)
    dynamics, system = derivation.dynamics, derivation.system
    state, forces = (*system.q, *system.qdot, system.t), system.applied_forces
    pairs = zip(dynamics.lagrange.lagrangian_forces, forces, strict=True)
    pushed = any(free_of(along, state) and is_zero(f) is not True for along, f in pairs)
    if kinds or not pushed or system.problem.contacts or RestPoints(dynamics).has_no_value:
        return False
    return not any(each.sticking for each in held(dynamics))


def rolling_section(found: RollingMotions) -> SteadySection:
    """The conditions, and each motion with its stability."""
    names, order = found.system.names, found.system.order
    return SteadySection(
        conditions={
            names[j]: written(vanishing_part(_numerator(c)), order)
            for j, c in found.conditions.items()
        },
        motions=tuple(_motion(found, motion) for motion in found.motions or ()),
        complete=found.complete,
        unless=() if found.motions else unless_written(found.unless, order),
        acting=("inertia",),
        plane=plane_of_rotation(RestPoints(found.dynamics)),
        eliminated=tuple(n for j, n in enumerate(names) if j not in found.velocities),
    )


def _numerator(condition: Expr) -> Expr:
    """What vanishes with it, without the inertia below and without a number before it."""
    field = Field([condition])
    _, rest = field.polynomial_to_sympy(field(condition).numerator).primitive()
    return simplify(rest)


def _motion(found: RollingMotions, motion: RollingMotion) -> SteadyMotion:
    system, values = found.system, motion.values
    order = system.order
    judged, squares = found.verdict(motion)
    coordinates = {system.names[j]: system.q[j] for j in found.coordinates}
    turning = {system.names[j]: system.qdot[j] for j in found.turning}

    def shaped(value: Expr) -> Expression:
        return written(value, order)

    free = [s for s in (*coordinates.values(), *turning.values()) if s not in values]
    return SteadyMotion(
        at={name: shaped(values[q]) for name, q in coordinates.items() if q in values},
        free=tuple(s.name for s in free),
        rates={name: shaped(values.get(u, u)) for name, u in turning.items()},
        momenta={},
        where=conditions(motion.known_positive, order),
        mirrored=False,
        verdict=stated(judged, order, motion.known_positive, potential=""),
        frequencies_squared=tuple(map(shaped, squares)),
        rolling=True,
    )
