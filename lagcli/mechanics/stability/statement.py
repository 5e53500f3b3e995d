"""A verdict in the shape in which it is read: inequalities, and their opposites."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from sympy import Expr, S

from lagcli.algebra import is_zero
from lagcli.algebra.decimals import written
from lagcli.algebra.determinants import determinant
from lagcli.mechanics.conditions import above, conditions, opposites
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.stability.lagrange_dirichlet import always
from lagcli.mechanics.stability.verdict import Stability
from lagcli.mechanics.system import System
from lagcli.statements.motions import Above, Verdict

Stated = Callable[[Sequence[Expr]], tuple[Above, ...]]


def stated(
    found: Stability, order: Sequence[str], positive: Sequence[Expr] = (), *, potential: str = "V",
    gyroscopic: bool = False, given: Sequence[Expr] = (),
) -> Verdict:  # fmt: skip
    """The statement of a verdict where each of `positive` > 0.

    `given` are conditions to be stated first where they make the others shorter.
    """

    def where(expressions: Sequence[Expr] | None) -> tuple[Above, ...] | None:
        if expressions is None:
            return None
        plain = conditions(expressions, order, positive)
        short = conditions(expressions, order, (*positive, *given)) if plain and given else plain
        return plain if short == plain else (*conditions(given, order), *short)

    for name in ("minimum", "hurwitz"):
        if found.rapid is None and getattr(found, name) and where(getattr(found, name)) == ():
            found = always(found, name)
    grown = None if found.growing is None else above(found.growing, order, positive)
    decisive = found.hurwitz if found.hurwitz is not None else found.spectrum
    if decisive is None:
        decisive = found.minimum if found.reverses else found.opposed
    return Verdict(
        stable=found.stable,
        reason=found.reason,
        theorem="" if found.by is None else found.by.name,
        potential=potential,
        asymptotic=found.asymptotic,
        across=found.across,
        along=tuple(q.name for q in found.along or ()),
        neutral=found.neutral,
        released=found.released,
        minimum=where(found.minimum),
        hurwitz=where(found.hurwitz),
        spectrum=where(found.spectrum),
        unstable=opposites(decisive or (), order, (*positive, *given))
        if found.growing is None
        else ((grown,) if grown is not None else ()),
        exact=found.exact,
        gyroscopic=gyroscopic and found.spectrum is not None,
        rapid=None if found.rapid is None else written(found.rapid, order),
        critical=found.critical,
        grows_at_equality=found.grows_at_equality,
    )


def potential_of(rest: RestPoints, usual: str = "V_eff") -> str:
    """What has the minimum: V where it is the file's V alone, else `usual`; "" with forces."""
    system = rest.system
    at_rest = dict.fromkeys(system.qdot, S.Zero)
    if any(is_zero(force.xreplace(at_rest)) is not True for force in system.applied_forces):
        return ""
    if _feeds_by_time(system):
        return ""
    if usual != "V_eff" or system.V is None:
        return usual
    alone = is_zero(system.L.xreplace(at_rest) + system.V.xreplace(at_rest))
    return "V" if alone is True else usual


def _feeds_by_time(system: System) -> bool:
    """Whether terms of L linear in the velocities depend on t: they act at rest, too."""
    at_rest = dict.fromkeys(system.qdot, S.Zero)
    rates = (system.L.diff(v, system.t).xreplace(at_rest) for v in system.qdot)
    return any(is_zero(rate) is not True for rate in rates)


def held_by_gyroscopic_terms(linear: Linearization) -> bool:
    """Whether complete damping destroys stability where V has no minimum: det K is not 0."""
    if not linear.M or linear.damped or not (linear.gyroscopic and linear.has_potential):
        return False
    whole = determinant(linear.K)
    return whole is not None and is_zero(whole) is False
