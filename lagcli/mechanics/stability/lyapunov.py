"""Instability by the linearised equations: some root has a positive real part (Lyapunov).

Of symmetric M, C and K with M positive definite, s² M + s C + K is positive definite for large s;
where K has a negative eigenvalue, its determinant vanishes at some s > 0.  The same holds with
gyroscopic terms where all motions are damped (Kelvin, Tait and Chetaev).

References
----------
Lyapunov, *The General Problem of the Stability of Motion* (1892), chapter I, section 24.
Merkin, *Introduction to the Theory of Stability*, sections 3.3 and 6.5.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, Float, I, im

from lagcli.algebra.positivity import sign_of, weak_sign
from lagcli.mechanics.stability.near import Near
from lagcli.mechanics.stability.verdict import Stability, unstable
from lagcli.mechanics.theorems import KELVIN_TAIT_CHETAEV

#: The second variation of V is negative for some displacement.
FALLS = "{V} decreases to second order in some direction"
_ROOT = "a root of the characteristic polynomial"
GROWING = f"{_ROOT} has a positive real part"
_NUMERIC = Float("1e-20")


def by_a_growing_root(near: Near) -> Stability | None:
    """Unstable, where some root surely has a positive real part."""
    others, positive = near.others, near.positive
    if len(others) > 1 and sign_of(others[0], positive) == -1:
        return unstable(_by_potential(near) or f"{_ROOT} is positive")
    conditions, squares = near.conditions or (), _squares(near)
    real = [W for W in squares if not W.has(I)]
    if -1 in near.signs([*conditions, *real]) or any(map(_not_real, squares)):
        return growing(near)
    if reason := _by_potential(near):
        return unstable(reason)
    candidates = [*others[: len(others) > 1], *conditions, *squares]
    weak = [e for e in candidates if weak_sign(e, positive) == -1]
    return Stability(growing=-weak[0]) if weak else None


def growing(near: Near) -> Stability:
    """Unstable by a root, with the reason."""
    return unstable(_by_potential(near) or GROWING)


def falls(near: Near) -> bool:
    """Whether K has a negative eigenvalue, by the signs of one list that decides."""
    listed = map(near.signs, near.curvatures)
    return any(-1 in signs or _zero_before_others(signs) for signs in listed)


def _squares(near: Near) -> list[Expr]:
    """The ω² that are not 0, each unstable where it is negative or not real."""
    return [W for W in near.squares or () if W != 0] if near.even else []


def _not_real(W: Expr) -> bool:
    return bool(W.has(I) and W.is_number and abs(im(W.evalf(30))) > _NUMERIC)


def _zero_before_others(signs: Sequence[int | None]) -> bool:
    """e_j = 0 but e_k not, k > j: not all W have one sign."""
    return any(s == 0 and any(later in (1, -1) for later in signs[k:]) for k, s in enumerate(signs))


def _by_potential(near: Near) -> str:
    """The reason in terms of the potential, where its second variation decides."""
    if not (near.potential_decides and falls(near)):
        return ""
    if near.linear.gyroscopic:
        return f"{FALLS}, and all motions are damped ({KELVIN_TAIT_CHETAEV.name})"
    return f"{FALLS}, so {_ROOT} is positive" if near.linear.damped else FALLS
