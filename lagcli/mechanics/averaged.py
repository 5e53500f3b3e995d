"""One coordinate under a rapidly oscillating force: the potential of the averaged motion.

Where M q'' = F0(q) + F1(q) cos(w t) + F2(q) sin(w t) with constant M, and w is large against the
frequencies of the motion in F0, the coordinate averaged over 2 pi/w moves as in

    V_eff = V0 + (F1^2 + F2^2)/(4 M w^2),    V0' = -F0,

up to terms that are smaller by powers of 1/w.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 30 (eqs. 30.8 and 30.9).
Arnold, *Mathematical Methods of Classical Mechanics*, 2nd ed., section 52 (averaging).
"""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of
from lagcli.mechanics.dynamics import Dynamics
from lagcli.record import record


@record
class Averaged:
    """The frequency w of the force and V_eff(q), up to a constant."""

    frequency: Expr
    potential: Expr


def averaged(dynamics: Dynamics) -> Averaged | None:
    """V_eff of a system with one coordinate; None where the force is not of that form."""
    system = dynamics.system
    if len(system.q) != 1 or dynamics.constraints.equations:
        return None
    q, t = system.q[0], system.t
    M = simplify(dynamics.lagrange.mass_matrix[0][0])
    force = sympy.expand(dynamics.lagrange.forcing[0])
    if not free_of(M, (q, t, *system.qdot)) or not free_of(force, system.qdot):
        return None
    waves = [f for f in force.atoms(sympy.sin, sympy.cos) if f.has(t)]
    rates = {_positive(simplify(f.args[0].diff(t))) for f in waves}
    if len(rates) != 1 or any(is_zero(f.args[0].subs(t, 0)) is not True for f in waves):
        return None
    w = rates.pop()
    cosine, sine = sympy.cos(w * t), sympy.sin(w * t)
    F1, F2 = force.coeff(cosine), force.coeff(sine)
    F0 = sympy.expand(force - F1 * cosine - F2 * sine)
    if not all(free_of(f, (t,)) for f in (F0, F1, F2, w)) or is_zero(w) is not False:
        return None
    if free_of(F1, [q]) and free_of(F2, [q]):  # it shakes the body, and no more
        return None
    slow = antiderivative(simplify(F0), q) if F0 != 0 else sympy.S.Zero
    if slow is None:
        return None
    return Averaged(w, simplify(-slow + (F1**2 + F2**2) / (4 * M * w**2)))


def _positive(rate: Expr) -> Expr:
    return -rate if rate.could_extract_minus_sign() else rate
