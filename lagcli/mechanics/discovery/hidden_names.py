"""What a textbook calls an integral of second degree in the velocities."""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.mechanics.discovery.slots import Slot
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System


def hidden_name(
    functions: Sequence[tuple[Slot, Expr]], charge: NoetherCharge, system: System
) -> str:
    """runge_lenz_x, fradkin_xy, energy_x, or an empty text."""
    q, v = system.q, system.qdot
    rest = dict.fromkeys(v, 0)
    S, V = charge.charge.xreplace(rest), -system.L.xreplace(rest)
    if all(not (f.free_symbols & set(q)) for _, f in functions):
        if len(functions) != 1 or functions[0][0].kind[0] != "pair":
            return ""
        i, j = int(functions[0][0].kind[1]), int(functions[0][0].kind[2])
        if (is_zero(V.diff(q[i], q[j])) is True and i == j) or i != j:
            quadratic = all(is_zero(V.diff(q[i], x).diff(x)) is True for x in q)
            one, other = system.names[i], system.names[j]
            joined = f"{one}{other}" if len(one + other) == 2 else f"{one}_{other}"
            if i != j:
                return f"fradkin_{joined}" if quadratic else ""
        if i == j and all(is_zero(V.diff(q[i], x)) is True for k, x in enumerate(q) if k != i):
            return f"energy_{system.names[i]}"
        return ""
    for x in q:
        # A = p x L - m k r/|r|: its potential part is x V, and V is central
        ratio = S / (x * V) if V != 0 else V
        if S != 0 and all(is_zero(ratio.diff(y)) is True for y in q):
            central = all(
                is_zero(V.diff(y) * z - V.diff(z) * y) is True
                for k, y in enumerate(q) for z in q[:k]
            )  # fmt: skip
            return f"runge_lenz_{x.name}" if central and len(q) > 1 else ""
    return ""
