"""After what length of a coordinate a system is the same again: V = U cos(a x) after 2 pi/a."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.translates import common_period, least_part, recur
from lagcli.document import Block
from lagcli.expression import Name
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import says


def recurring(explainer: Explainer, said: Collection[str] = ()) -> Iterator[Block]:
    """That all states recur after a period of a coordinate that is not a whole turn.

    Of the coordinates that were `said` to repeat, it is not said again.
    """
    for q, period in recurrences(explainer.dynamics).items():
        if q.name in said:
            continue
        after = explainer.readable.as_written(period)
        yield says("All of them recur where ", Name(q.name), " grows by ", after, ".")


def recurrences(dynamics: Dynamics) -> dict[Symbol, Expr]:
    """The period of each coordinate in which all equations are periodic, where a turn is none."""
    system, lagrange = dynamics.system, dynamics.lagrange
    formulas = [*lagrange.lagrangian_forces, *lagrange.momenta, *system.applied_forces]
    formulas += [e.f for e in dynamics.constraints.equations]
    formulas += [
        system.build(c.equation.left) - system.build(c.equation.right)
        for c in system.problem.contacts
    ]
    whole = {q: common_period(formulas, q, (*system.q, system.t)) for q in system.q}
    found = {q: least_part(formulas, q, each) for q, each in whole.items() if each is not None}
    return {
        q: period
        for q, period in found.items()
        if not ((period / sympy.pi).is_Rational and recur(formulas, q))
    }
