"""Poisson brackets, with the sign of {q, p} = 1:

    {f, g} = sum_j (df/dq_j dg/dp_j - df/dp_j dg/dq_j)

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 9.5.  Landau and Lifshitz,
*Mechanics*, 3rd ed., section 42, have the opposite sign.
"""

from __future__ import annotations

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.mechanics.system import System


def poisson(f: Expr, g: Expr, system: System) -> Expr:
    """{f, g} of functions of q, p, t, simplified."""
    return simplify(
        sympy.Add(
            *(
                f.diff(q) * g.diff(p) - f.diff(p) * g.diff(q)
                for q, p in zip(system.q, system.momenta, strict=True)
            )
        )
    )


def rate(f: Expr, hamiltonian: Expr, system: System) -> Expr:
    """df/dt = {f, H} + the partial derivative of f by t."""
    return simplify(poisson(f, hamiltonian, system) + f.diff(system.t))
