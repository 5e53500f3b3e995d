"""Values of the parameters at which there are more symmetries: two of them equal, one of them 0.

Ranks modulo a prime are enough to see it; which symmetries they are, a run with those values
tells (`--set m2=m1`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.mechanics.discovery.limits import Clock, OutOfTime
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.slots import Equations

_MOST = 6


def special_values(
    parameters: Sequence[Symbol],
    equations: Equations,
    accelerations: Sequence[Expr] | None,
    dimension: int,
    count: Callable[[Equations, Sequence[Expr] | None], int],
    clock: Clock,
) -> list[str]:
    """Phrases such as "k2 = k1 (8)", the number being that of the symmetries there.

    Parameters
    ----------
    count
        The number of symmetries of given equations.
    """
    found = []
    for tested, (parameter, value) in enumerate(_candidates(parameters, equations)):
        if tested == _MOST:
            break
        put = {parameter: value}
        try:
            there = Equations(
                equations.t,
                equations.q,
                equations.v,
                tuple(tuple(m.subs(put) for m in row) for row in equations.mass),
                tuple(f.subs(put) for f in equations.forcing),
            )
            moved = None if accelerations is None else [a.subs(put) for a in accelerations]
            if _finite(there, moved):
                clock.check()
                number = count(there, moved)
                if number > dimension:
                    found.append(f"{parameter.name} = {value} ({number})")
        except (OutOfTime, NoPoint, ZeroDivisionError):
            break
    return found


def _candidates(
    parameters: Sequence[Symbol], equations: Equations
) -> Iterator[tuple[Symbol, Expr]]:
    """b = a for parameters that differ only in their number; c = 0 where that may be."""
    stem = {p: re.sub(r"_?\d+$|_?[a-zA-Z]$", "", p.name) for p in parameters}
    for one, other in combinations(parameters, 2):
        if stem[one] and stem[one] == stem[other] and one.name != stem[one]:
            yield other, one
    inertia = {s for row in equations.mass for m in row for s in m.free_symbols}
    for each in parameters:
        if each not in inertia and not (each.is_nonzero or each.is_integer):
            yield each, sympy.S.Zero


def _finite(equations: Equations, accelerations: Sequence[Expr] | None) -> bool:
    expressions = [
        *(m for row in equations.mass for m in row), *equations.forcing, *(accelerations or ())
    ]  # fmt: skip
    return not any(e.has(sympy.zoo, sympy.nan, sympy.oo) for e in expressions)
