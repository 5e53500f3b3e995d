"""The order of the charges that are listed, their signs, and the words for those left out."""

from __future__ import annotations

from dataclasses import replace

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System


def rank_of(name: str) -> tuple[int, str]:
    """Energy, momenta, angular momenta, boosts, the rest."""
    order = ("energy", "p_", "momentum", "L_", "angular", "boost", "dilation", "conformal")
    for k, start in enumerate(order):
        if name.startswith(start):
            return k, name if start == "L_" else ""
    return (len(order) if name else len(order) + 1), ""


def more(number: int, what: str) -> str:
    """Such as "2 more symmetries are"."""
    if number == 1:
        return f"1 more {what} is"
    return f"{number} more {what.removesuffix('y') + 'ies' if what[-1] == 'y' else what + 's'} are"


def led_momentum(charge: NoetherCharge, system: System) -> tuple[str, NoetherCharge]:
    """The name and the sign of a momentum that goes with one coordinate, the others led."""
    given = charge.transformation
    if given.time == 0 and not any(given.changes):
        negative = charge.charge.could_extract_minus_sign()
        return "constraint_integral", times(charge, sympy.Integer(-1 if negative else 1))
    t = system.t
    moving = {t, *system.q, *system.qdot}
    steady = t not in sympy.Tuple(*given.changes).free_symbols
    rates = [(x, c if steady else c / t) for x, c in zip(system.q, given.changes, strict=True)]
    constant = [(x, c) for x, c in rates if c != 0 and not c.free_symbols & moving]
    if given.time != 0 or len(constant) != 1:
        return "", charge
    [(x, c)] = constant
    name = f"momentum_{x.name}" if steady else f"boost_{x.name}"
    return name, times(charge, sympy.Integer(-1 if c.could_extract_minus_sign() else 1))


def times(charge: NoetherCharge, factor: Expr) -> NoetherCharge:
    """The charge of a constant multiple of the transformation."""
    if factor == 1:
        return charge
    given = charge.transformation
    return replace(
        charge,
        transformation=replace(
            given,
            changes=tuple(simplify(factor * c) for c in given.changes),
            time=simplify(factor * given.time),
        ),
        gauge=None if charge.gauge is None else sympy.expand(factor * charge.gauge),
        charge=sympy.expand(factor * charge.charge),
    )
