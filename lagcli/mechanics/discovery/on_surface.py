"""The search on a constraint surface: in which order, and what it is in words."""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr

from lagcli.mechanics.discovery.ansatz import TimeFunctions, products_of_two, time_functions
from lagcli.mechanics.discovery.constrained import dimension_of_states, rank_on_surface
from lagcli.mechanics.discovery.listing import more
from lagcli.mechanics.discovery.momentum_equation import Momenta
from lagcli.mechanics.discovery.setting import Setting
from lagcli.mechanics.discovery.under_constraints import UnderConstraints
from lagcli.mechanics.noether import NoetherCharge, Transformation
from lagcli.record import replace

ALL_ARE_KNOWN = "every other integral is in general a function of these"
_MOST_IN_SPACE = 4  # measured: at most 3


def search_on_surface(
    setting: Setting, of_lagrangian: Sequence[Transformation]
) -> tuple[NoetherCharge, ...]:
    """Momenta along admissible displacements, then integrals that hold on the surface.

    Returns the momentum equations, of symmetries of L without a constant charge.
    """
    motion, listing = setting.dynamics.motion, setting.listing
    times = time_functions(
        setting.equations,
        None if motion is None else motion.accelerations,
        potential=setting.canonical,
    )
    search = UnderConstraints(setting.noether, setting.coordinate_kinds, times, setting.allowed)
    integrated = search.integrated()
    listing.keep_only(search.new([], listing.points))
    listing.add(integrated)
    listing.add(search.linear(setting.point_charges))
    momenta = search.momenta(of_lagrangian, listing.points)
    listing.add(search.new(_values(setting), momenta.conserved))
    nonholonomic = setting.dynamics.constraints.nonholonomic
    turning = nonholonomic and not all_are_known(setting)
    if turning:
        listing.add(search.turning(_values(setting)))
    setting.words.append(_sentence(times))
    if search.timed:
        setting.words.append(
            "along the displacements of constant momenta, and of the velocities of lengths "
            "whose accelerations are linear, with functions of t or of the coordinates"
        )
    if turning:
        setting.words.append(
            "and linear functions of the velocities that turn into each other at constant rates, "
            "by the time or by a coordinate, or have an integrating factor"
        )
    known = all_are_known(setting)
    if known:
        setting.words.append(ALL_ARE_KNOWN)
    elif (
        setting.dynamics.degrees_of_freedom > 1
        and setting.system.t not in setting.equations_symbols
    ):
        found = search.quadratic(setting.charges)
        if _few(setting, [*setting.charges, *found]):
            solved = search.of_velocities([*setting.charges, *found])
            search.unsolved = max(0, search.unsolved - len(solved))  # the same, in other terms
            found += solved
        if nonholonomic:
            found = _independent(setting, found)
        elif len(setting.fixed_charges) < len(setting.charges):  # products without the time
            values = _values(setting)
            found = search.new([*values, *products_of_two(values)], found)
        listing.add_hidden(("", charge) for charge in found)
        setting.words.append(
            "and of second degree without explicit time, with coefficients of second degree"
        )
    if search.unsolved and not known:
        setting.stopped.append(
            f"{more(search.unsolved, 'integral')} there, whose coefficients were not solved"
        )
    return _named(setting, momenta)


def all_are_known(setting: Setting) -> bool:
    """Whether all integrals are functions of those of point symmetries."""
    states = dimension_of_states(setting.dynamics)
    return states > 0 and rank_on_surface(setting.dynamics, _values(setting)) == states


def _values(setting: Setting) -> list[Expr]:
    return [c.charge for c in setting.point_charges]


def _named(setting: Setting, momenta: Momenta) -> tuple[NoetherCharge, ...]:
    naming = setting.listing.naming
    names = (naming.of_point(c.transformation.changes, sympy.S.Zero) for c in momenta.changing)
    return tuple(
        replace(c, name=name or f"momentum_{k}", source="momentum equation")
        for k, (c, name) in enumerate(zip(momenta.changing, names, strict=True), 1)
    )


def _sentence(times: TimeFunctions) -> str:
    return (
        "on the constraints, first integrals of first degree in the velocities "
        "along admissible displacements"
        + (" with the exponents of the linear part" if times.exponents else "")
        + ", coefficients of first degree in the coordinates"
    )


def _independent(setting: Setting, found: Sequence[NoetherCharge]) -> list[NoetherCharge]:
    """Those that are no functions of the others: no Poisson brackets make these of use."""
    kept: list[NoetherCharge] = []
    known = [c.charge for c in setting.fixed_charges]
    number = rank_on_surface(setting.dynamics, known)
    for charge in sorted(found, key=lambda c: sympy.count_ops(c.charge)):
        values = [*known, *(c.charge for c in kept), charge.charge]
        rank = rank_on_surface(setting.dynamics, values)
        if number is None or rank is None or rank > number + len(kept):
            kept.append(charge)
    return kept


def _few(setting: Setting, known: Sequence[NoetherCharge]) -> bool:
    """Whether fewer than n are known that do not contain the time, on a surface at rest."""
    constraints = setting.dynamics.constraints
    holonomic = all(kind == "holonomic" for kind in constraints.kinds.values())
    fixed = [c.charge for c in known if setting.system.t not in c.charge.free_symbols]
    if constraints.moving or not (holonomic and len(setting.system.q) <= _MOST_IN_SPACE):
        return False
    number = rank_on_surface(setting.dynamics, fixed)
    return number is not None and number < setting.dynamics.degrees_of_freedom
