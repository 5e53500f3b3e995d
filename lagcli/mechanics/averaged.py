"""Motion under a rapidly oscillating force: the potential of the averaged motion.

Where M q'' = F0(q) + F1(q) cos(w t) + F2(q) sin(w t) with constant M and F0 = -grad V0, and w is
large against the frequencies of the motion in F0, the coordinates averaged over 2 pi/w move as in

    V_eff = V0 + (F1^T M^-1 F1 + F2^T M^-1 F2)/(4 w^2)

up to terms that are smaller by powers of 1/w.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 30 (eqs. 30.8 and 30.9).
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 52 (averaging).
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify, solve_linear
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.mechanics.dynamics import Dynamics
from lagcli.record import record

_MOST_COORDINATES = 4


@record
class Averaged:
    """The frequency w of the force and V_eff(q), up to a constant."""

    frequency: Expr
    potential: Expr


def averaged(dynamics: Dynamics) -> Averaged | None:
    """V_eff of a system without constraints; None where the force is not of that form."""
    system = dynamics.system
    n = len(system.q)
    if not 0 < n <= _MOST_COORDINATES or dynamics.constraints.equations:
        return None
    q, t = system.q, system.t
    M = [[simplify(x) for x in row] for row in dynamics.lagrange.mass_matrix]
    force = [sympy.expand(f) for f in dynamics.lagrange.forcing]
    if not all(free_of(x, (*q, t, *system.qdot)) for row in M for x in row):
        return None
    if not all(free_of(f, system.qdot) for f in force):
        return None
    waves = [f for F in force for f in F.atoms(sympy.sin, sympy.cos) if f.has(t)]
    rates = {_positive(simplify(f.args[0].diff(t))) for f in waves}
    if len(rates) != 1 or any(is_zero(f.args[0].subs(t, 0)) is not True for f in waves):
        return None
    w = rates.pop()
    cosine, sine = sympy.cos(w * t), sympy.sin(w * t)
    F1, F2 = [f.coeff(cosine) for f in force], [f.coeff(sine) for f in force]
    F0 = [sympy.expand(f - a * cosine - b * sine) for f, a, b in zip(force, F1, F2, strict=True)]
    if not all(free_of(f, (t,)) for f in (*F0, *F1, *F2, w)) or is_zero(w) is not False:
        return None
    if all(free_of(f, q) for f in (*F1, *F2)):  # it shakes the body, and no more
        return None
    slow = _potential(F0, q)
    solved = [solve_linear(M, F) for F in (F1, F2)]
    if slow is None or any(each is None or each.singular for each in solved):
        return None
    moved = (dot(F, each.values) for F, each in zip((F1, F2), solved, strict=True) if each)
    return Averaged(w, simplify(slow + sympy.Add(*moved) / (4 * w**2)))


def _potential(force: Sequence[Expr], q: Sequence[Symbol]) -> Expr | None:
    """V with -grad V = F, by one coordinate after another; None where there is none."""
    V = sympy.S.Zero
    for f, x in zip(force, q, strict=True):
        rest = simplify(f + V.diff(x))
        part = antiderivative(rest, x) if rest != 0 else sympy.S.Zero
        if part is None:
            return None
        V -= part
    balanced = (is_zero(f + V.diff(x)) for f, x in zip(force, q, strict=True))
    return V if all(each is True for each in balanced) else None


def _positive(rate: Expr) -> Expr:
    return -rate if rate.could_extract_minus_sign() else rate
