"""What stays constant where a contact closes: it pushes along the gradient of its gap.

At an impact the contact with the gap g(q, t) >= 0 gives an impulse P >= 0 along dg/dq,

    p_j+ - p_j- = P dg/dq_j,    dg/dt+ = -e dg/dt-  (Newton's restitution),

and for T of second degree in the velocities the work of the impulse is P times the mean of
the velocity before and after.  For Q = sum p_j Dq_j - h Dt - G, with Dq, Dt and G functions of
q and t, it follows that

    Q+ - Q- = P (sum dg/dq_j Dq_j + dg/dt Dt - Dt (1 - e)/2 dg/dt-),

0 where the displacement lies along the surface of contact, and e = 1 where the time is moved.
While the contact is closed, dg/dt = 0, its force N gives

    dQ/dt = N (sum dg/dq_j Dq_j + dg/dt Dt),

0 where the displacement lies along that surface.

References
----------
Whittaker, *Analytical Dynamics*, 4th ed., chapter 2 (Lagrange's equations of impulsive motion).
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero
from lagcli.algebra.build import free_of
from lagcli.mechanics.system import System
from lagcli.problem_data import Contact


def when_constant(
    system: System, changes: Sequence[Expr], time: Expr, gauge: Expr | None = None
) -> str:
    """When a charge is constant if its contacts are left out; empty: always.

    Parameters
    ----------
    system
        With the contacts of its file.
    changes, time
        Dq_j by coordinate and Dt of the charge's transformation.
    gauge
        Its boundary term G, 0 for None.
    """
    contacts = system.problem.contacts
    if not contacts:
        return ""
    while_open = f"while the {'gap is' if len(contacts) == 1 else 'gaps are'} open"
    striking = [c for c in contacts if c.restitution is not None]
    if not striking:  # a run ends where a gap closes
        return while_open
    of_points = all(free_of(x, system.qdot) for x in (*changes, time, gauge or sympy.S.Zero))
    if not of_points or not all(_along(system, c, changes, time) for c in striking):
        return while_open
    kept = time == 0 or all(_elastic(system, contact) for contact in striking)
    return "" if kept else "between impacts"


def _along(system: System, contact: Contact, changes: Sequence[Expr], time: Expr) -> bool:
    """Whether the displacement keeps the gap."""
    gap = system.build(contact.equation.left) - system.build(contact.equation.right)
    across = dot(map(gap.diff, system.q), changes) + gap.diff(system.t) * time
    return is_zero(across) is True


def _elastic(system: System, contact: Contact) -> bool:
    assert contact.restitution is not None
    return is_zero(system.build(contact.restitution) - 1) is True
