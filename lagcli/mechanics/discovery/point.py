"""Point symmetries up to a boundary term: found by the linear search, proved by Noether.

For applied forces F_j and dissipation the multipliers are integrating factors, and the
boundary term takes up what the forces do: dG/dt = K + sum_j F_j eta_j.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot
from lagcli.mechanics.discovery.boundary import gauge_of
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.search import Search, SlotSolution
from lagcli.mechanics.discovery.slots import combined
from lagcli.mechanics.discovery.turning_momenta import with_factors
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.record import replace


def transformation_of(
    search: Search, solution: SlotSolution, constants: AbstractSet[Symbol]
) -> Transformation:
    """tau and xi_j of a solution, scaled to be readable."""
    parts = search.combination(solution)
    moves = [(slot, f) for slot, f in parts if slot.kind[0] != "tau"]
    tau = sympy.Add(*(f for slot, f in parts if slot.kind[0] == "tau"))
    *changes, time = scaled((*combined(moves, len(search.equations.q)), tau), constants)
    return Transformation(tuple(changes), time)


def charge_of(
    noether: Noether,
    transformation: Transformation,
    allowed: Allowance,
    lengths: Sequence[Expr] = (),
) -> NoetherCharge | None:
    """The proved charge of a transformation; None where it is not proved."""
    gauge = _gauge(noether, transformation, allowed, lengths)
    return None if gauge is None else with_gauge(noether, transformation, gauge)


def with_gauge(
    noether: Noether, transformation: Transformation, gauge: Expr
) -> NoetherCharge | None:
    """The charge with this boundary term, if it is proved."""
    charge = _proved(noether.charge("", "discovered", transformation, gauge))
    if charge is not None and is_energy(transformation):
        # Q = -h - G by the formula; the textbook's energy is h
        return replace(charge, charge=noether.energy.function + gauge)
    return charge


def with_integrating_factors(noether: Noether, allowed: Allowance) -> Iterator[NoetherCharge]:
    """exp(-g) p_j - S, where forces leave dp_j/dt = (dg/dt) p_j + exp(g) dS/dt."""
    momenta = noether.dynamics.lagrange.momenta
    for factor, p, S in with_factors(noether.dynamics, momenta, allowed):
        changes = tuple(factor if p == other else sympy.S.Zero for other in momenta)
        charge = with_gauge(noether, Transformation(changes, sympy.S.Zero), S)
        if charge is not None:
            yield charge


def is_energy(transformation: Transformation) -> bool:
    """Whether only the time is displaced, and by a constant."""
    return transformation.time == 1 and not any(transformation.changes)


def _gauge(
    noether: Noether, transformation: Transformation, allowed: Allowance, lengths: Sequence[Expr]
) -> Expr | None:
    """G with dG/dt = K + sum F_j eta_j."""
    system = noether.system
    change = noether.change_of_action(transformation) + dot(
        system.applied_forces, noether.characteristic(transformation)
    )
    return gauge_of(change, system, allowed, lengths)


def _proved(charge: NoetherCharge) -> NoetherCharge | None:
    if charge.conserved is not True or charge.verified != "exact":
        return None
    return charge
