"""After what length of a coordinate a system is the same again: V = U cos(a x) after 2 pi/a."""

from __future__ import annotations

from collections.abc import Iterator

import sympy
from sympy import Expr, Symbol, igcd, ilcm
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.document import Block
from lagcli.expression import Name
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import says


def recurring(explainer: Explainer) -> Iterator[Block]:
    """That all states recur after a period of a coordinate that is not a whole turn."""
    for q, period in recurrences(explainer.dynamics).items():
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
    found = ((q, _period(q, formulas, (*system.q, system.t))) for q in system.q)
    return {
        q: period
        for q, period in found
        if period is not None
        and not ((period / sympy.pi).is_Rational and _after_a_turn(q, formulas))
    }


def _after_a_turn(q: Symbol, formulas: list[Expr]) -> bool:
    return all(is_zero(f.xreplace({q: q + 2 * sympy.pi}) - f) is True for f in formulas)


def _period(q: Symbol, formulas: list[Expr], state: tuple[Symbol, ...]) -> Expr | None:
    """Of functions of sines and cosines of r q + …, the rates r commensurable; else None."""
    nodes = {n for f in formulas for n in f.atoms(TrigonometricFunction) if not free_of(n, [q])}
    rates = [simplify(n.args[0].diff(q)) for n in nodes]
    hidden: dict[Expr, Expr] = {n: sympy.Dummy() for n in nodes}
    if not rates or not all(free_of(r, state) for r in rates):
        return None
    if not all(free_of(f.xreplace(hidden), [q]) for f in formulas):
        return None
    ratios = [simplify(r / rates[0]) for r in rates]
    if not all(ratio.is_Rational for ratio in ratios):
        return None
    common = sympy.Rational(igcd(*(r.p for r in ratios), 0), ilcm(*(r.q for r in ratios), 1))
    for _ in range(3):  # sin²(q) and tan(q) are the same again after half of a period of sin(q)
        half = {
            n: n.func(n.args[0] + sympy.pi * r / common) for n, r in zip(nodes, ratios, strict=True)
        }
        if not all(is_zero(f.xreplace(half) - f) is True for f in formulas):
            break
        common *= 2
    return simplify(2 * sympy.pi / (rates[0] * common))
