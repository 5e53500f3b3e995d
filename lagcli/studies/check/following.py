"""Whether an equation follows from the derived equations of motion."""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra import dot, left_nullspace
from lagcli.expression import Equation
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.verify import conjunction
from lagcli.studies.check.comparison import Comparison


def follows(derivation: Derivation, equation: Equation, comparison: Comparison) -> bool | None:
    """Whether left = right holds on every motion; None when undecided."""
    build = derivation.system.build
    rest = build(equation.left) - build(equation.right)
    dynamics = derivation.dynamics
    if dynamics.motion is None:
        return _is_one_of_them(rest, derivation, comparison)
    return conjunction(map(comparison.vanishes, _on_motion(rest, dynamics)))


def _on_motion(rest: Expr, dynamics: Dynamics) -> list[Expr]:
    """What has to vanish: the rest on the motion, for every choice of the multipliers.

    Where constraints are redundant, lambda + c n is as good a multiplier as lambda for
    every n with n A = 0; the rest, linear in it, must not change along n.
    """
    motion, system = dynamics.motion, dynamics.system
    assert motion is not None
    multipliers = system.multipliers
    values = {
        **dict(zip(system.qddot, motion.accelerations, strict=True)),
        **dict(zip(multipliers, motion.independent, strict=True)),
    }
    conditions = [rest.xreplace(values)]
    if dynamics.redundant:
        for vector in left_nullspace(dynamics.constraints.jacobian, dynamics.constraints.relations):
            change = dot(vector, map(rest.diff, multipliers))
            conditions.append(change.xreplace(values))
    return conditions


def _is_one_of_them(rest: Expr, derivation: Derivation, comparison: Comparison) -> bool | None:
    """Whether the rest is a multiple of one equation that was derived, solved or not.

    Two polynomials of first degree in the accelerations are multiples of each other when
    each coefficient of one times the other equals the reverse; accelerations and
    multipliers, free here, are given numbers.
    """
    system, dynamics = derivation.system, derivation.dynamics
    forces = (
        sympy.Add(*(e.multiplier * e.row[j] for e in dynamics.constraints.equations))
        for j in range(len(system.q))
    )
    derived = [
        left - applied - force
        for left, applied, force in zip(
            dynamics.lagrange.left_sides, system.applied_forces, forces, strict=True
        )
    ]
    unknowns = [*system.qddot, *system.multipliers]
    numbers = {symbol: sympy.Rational(7 + 4 * i, 5 + i) for i, symbol in enumerate(unknowns)}
    verdicts: list[bool | None] = []
    for equation in derived:
        pairs = [(equation.diff(u), rest.diff(u)) for u in unknowns]
        cross = [rest * a - equation * b for a, b in pairs if a != 0 or b != 0]
        each = [comparison.vanishes(c.xreplace(numbers)) for c in cross]
        if each and all(verdict is True for verdict in each):
            return True
        verdicts.extend(each)
    return None
