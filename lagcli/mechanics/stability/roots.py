"""Stability by the roots of the characteristic polynomial (Hurwitz, Lyapunov and Malkin).

All roots with negative real parts, beside one root 0 for each dimension of a family of equilibria:
asymptotically stable, or to the family.  All roots imaginary and simple: stable to first order,
which is the motion itself where the equations are linear.

References
----------
Gantmacher, *The Theory of Matrices*, vol. 2, chapter XV.
Malkin, *Theory of Stability of Motion*, section 34.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.algebra import simplify
from lagcli.algebra.positivity import sign_of, weak_sign
from lagcli.mechanics.inequalities import contradictory, one_is_negative
from lagcli.mechanics.stability.at_the_limit import grows_at_equality
from lagcli.mechanics.stability.hurwitz import hurwitz_conditions
from lagcli.mechanics.stability.lyapunov import GROWING, growing
from lagcli.mechanics.stability.near import Near
from lagcli.mechanics.stability.spectrum import conditions_of
from lagcli.mechanics.stability.verdict import Stability, undecided, unstable
from lagcli.mechanics.theorems import HURWITZ, LYAPUNOV_MALKIN, Theorem

ALL_ROOTS = "all roots have negative real parts"
_LIMIT = "to first order it is at the limit of stability"
NEUTRAL = "neutral to first order in some direction"
_NO_CRITERION = "the roots have no simple criterion"
_MAY_FEED = "beyond first order a force that is not linear, or has no potential, may feed energy"
_RESONANT = "two frequencies coincide, and the amplitude at that frequency grows in proportion to t"
_MOST_ROLLING = 4  # measured: at most 1


def by_roots(near: Near) -> Stability:
    """The verdict by the roots of the characteristic polynomial."""
    conditions = near.conditions
    if conditions is None:
        return undecided(_NO_CRITERION)
    signs = near.signs(conditions)
    if near.even and 0 in signs:
        return _multiple(near)
    if 0 in signs or any(weak_sign(e, near.positive) == -1 for e in conditions):
        return undecided(_LIMIT)
    open_ = tuple(e for e, s in zip(conditions, signs, strict=True) if s is None)
    if contradictory(open_, near.positive):
        known = one_is_negative(open_, near.positive)
        return growing(near) if known else Stability(opposed=open_)
    if near.even:
        return _imaginary(near, open_)
    if near.zeros and not near.as_many_equilibria:
        return undecided(NEUTRAL)
    return _negative(open_, across=bool(near.zeros))


def _negative(open_: tuple[Expr, ...], *, across: bool) -> Stability:
    """All roots have negative real parts, beside those 0 of a family, where all of these > 0."""
    theorem: Theorem = LYAPUNOV_MALKIN if across else HURWITZ
    if open_:
        return Stability(asymptotic=True, hurwitz=open_, by=theorem, across=across)
    others = ALL_ROOTS.replace("all", "all other") if across else ALL_ROOTS
    reason = f"{others} ({theorem.name})"
    return Stability(stable=True, reason=reason, by=theorem, asymptotic=True, across=across)


def _imaginary(near: Near, open_: tuple[Expr, ...]) -> Stability:
    exact = near.linear.exact
    across = bool(near.zeros) and exact and not near.semisimple_zeros
    if (near.zeros and not exact) or (across and not near.drifts_along_family):
        return undecided(NEUTRAL)
    if exact and not open_:
        beside = "apart from a slow drift along the family " if across else ""
        reason = f"the equations of motion are linear, and {beside}all their solutions are bounded"
        return Stability(stable=True, reason=reason, spectrum=(), exact=True, across=across)
    limit = exact and bool(open_) and grows_at_equality(near.linear, open_)
    fed = not exact and not (near.linear.rest.energy_never_grows and near.linear.has_potential)
    reason = _MAY_FEED if fed else ""
    return Stability(
        spectrum=open_, exact=exact, reason=reason, across=across, grows_at_equality=limit
    )


def _multiple(near: Near) -> Stability:
    """Where two frequencies agree for all values."""
    squares, positive = near.squares, near.positive
    if squares is None or near.zeros or any(weak_sign(W, positive) != 1 for W in squares):
        return undecided(_LIMIT)
    each = {W: sum(1 for other in squares if simplify(W - other) == 0) for W in squares}
    resonant = [W for W, count in each.items() if count > 1 and not near.semisimple(W, count)]
    if not resonant:
        return _imaginary(near, tuple(W for W in each if sign_of(W, positive) is None))
    if not near.linear.exact:
        return undecided(_LIMIT)
    if sign_of(resonant[0], positive) is None:
        return Stability(growing=resonant[0], reason=_RESONANT)
    return unstable(_RESONANT)


def by_polynomial(
    powers: Sequence[Expr], positive: Sequence[Expr], *, dimension: int
) -> tuple[Stability, tuple[Expr, ...]]:
    """The verdict by a characteristic polynomial alone, and ω² where there is one.

    The steady motions near it make a manifold of this dimension.
    """
    zeros = next(k for k, c in enumerate(powers) if c != 0)
    others = [simplify(c / powers[-1]) for c in powers[zeros:]]
    if len(others) == 1:
        return undecided("all roots of the linearised equations are 0"), ()
    even = all(c == 0 for c in others[1::2])
    squares = (others[0],) if even and len(others) == 3 else ()
    if even:
        in_square = [(-1) ** k * c for k, c in enumerate(others[::2])]
        sign = (-1) ** (len(in_square) - 1)
        long = len(in_square) - 1 > _MOST_ROLLING
        conditions = None if long else conditions_of([sign * c for c in in_square])
    else:
        conditions = hurwitz_conditions(others)
    if conditions is None:
        return undecided(_NO_CRITERION), squares
    signs = [sign_of(e, positive) for e in conditions]
    if -1 in signs:
        return unstable(GROWING), squares
    at_limit = zeros > dimension or 0 in signs
    if at_limit or any(weak_sign(e, positive) == -1 for e in conditions):
        return undecided(_LIMIT), squares
    open_ = tuple(e for e, known in zip(conditions, signs, strict=True) if known is None)
    return Stability(spectrum=open_) if even else _negative(open_, across=dimension > 0), squares
