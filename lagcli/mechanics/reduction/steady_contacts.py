"""The one-sided contacts on a steady motion: those that are closed must press.

References
----------
Pfeiffer, Glocker, *Multibody Dynamics with Unilateral Contacts* (1996), section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.signs import sign
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady_motion import Steady
from lagcli.mechanics.rest.held import one_sided
from lagcli.record import replace

#: What is not negative on a motion, and whether it is not 0 either.
Demand = tuple[Expr, bool]


def demands_on_motion(dynamics: Dynamics) -> tuple[Demand, ...]:
    """What the one-sided contacts demand, in the q and q' that the relations do not solve for."""
    demands: list[Demand] = []
    for each in one_sided(dynamics):
        parts = each.demands if each.given else (each.gap,)
        found = [dynamics.on_motion(part) for part in parts if part is not None]
        demands += [(part, not each.given) for part in found if part is not None]
    system, solved = dynamics.system, _solved(dynamics)
    demands += [(q, bool(q.is_positive)) for q in solved if q.is_nonnegative]
    flow = dict(zip(system.q, system.qdot, strict=True))
    for q, value in reversed([(q, v) for q, v in solved.items() if q in flow]):
        put_in = {q: value, flow[q]: system.total_derivative(value)}
        demands = [(part.xreplace(put_in), strict) for part, strict in demands]
    return tuple(demands)


def pressed(demands: Iterable[Demand], positive: Iterable[Expr]) -> tuple[Expr, ...] | None:
    """`positive` and what else is positive where all demands are met; None where one is not."""
    known = list(positive)
    for value, strict in demands:
        side = sign(value, known)
        if side == -1 or (side == 0 and strict) or weak_sign(value, known) == -1:
            return None
        known += [value] if side is None else []
    return tuple(dict.fromkeys(known))


def _solved(dynamics: Dynamics) -> dict[Symbol, Expr]:
    relations = dynamics.constraints.relations
    return {} if relations is None else dict(relations.solved)


class SteadyContacts:
    """What presses, and what may open, on the steady motions of a reduced system."""

    def __init__(self, routh: Routh) -> None:
        assert routh.reduced is not None
        self.routh = routh
        self.system = routh.reduced.system

    @cached_property
    def _demands(self) -> tuple[Demand, ...]:
        return demands_on_motion(self.routh.given.dynamics)

    @property
    def signed(self) -> tuple[str, ...]:
        """The coordinates that are eliminated and that the file assumes not to be negative."""
        solved = _solved(self.routh.given.dynamics)
        signs = {q: sign(value) for q, value in solved.items() if q.is_nonnegative}
        return tuple(q.name for q, known in signs.items() if known is None)

    @property
    def one_sided(self) -> int:
        """How many one-sided constraints and contacts the file has."""
        return len(one_sided(self.routh.given.dynamics))

    def standing(self, motion: Steady) -> Steady | None:
        """The motion where every one-sided contact holds; None where one does not."""
        positive = pressed(self._pressing(motion), motion.positive)
        return None if positive is None else replace(motion, positive=positive)

    def _pressing(self, motion: Steady) -> list[Demand]:
        """What is not negative on it, and whether it is not 0; only what is known."""
        rates = motion.rates
        if rates is None:
            moving = any(is_zero(motion.values.get(p, p)) is not True for p in self.routh.momenta)
            rates = {} if moving else dict.fromkeys(self.routh.cyclic, S.Zero)
        still: dict[Expr, Expr] = dict.fromkeys(self.system.qdot, S.Zero)
        still |= {self.routh.system.qdot[j]: rate for j, rate in rates.items()}
        try:
            found = [(at(x.xreplace(still), motion.values), strict) for x, strict in self._demands]
        except ZeroDivisionError:
            return []
        if any(x.has(S.NaN, S.ComplexInfinity) for x, _ in found):
            return []
        return [(x, strict) for x, strict in found if free_of(x, self.routh.system.qdot)]

    def where_pressed(self, values: Mapping[Symbol, Expr]) -> tuple[Expr, ...] | None:
        """What must be positive for all one-sided contacts to press; None where one does not.

        `values` are a place, at the momenta of the cyclic coordinates.
        """
        try:
            anywhere, there = (
                self._pressing(Steady(x, self.routh.rates_at(x))) for x in ({}, values)
            )
        except ZeroDivisionError:
            return ()
        known = {k for k, (value, _) in enumerate(anywhere) if sign(value) == 1}
        open_ = [value for k, (value, _) in enumerate(there) if k not in known and sign(value) != 1]
        if any(sign(value) in (0, -1) or weak_sign(value) == -1 for value in open_):
            return None
        return tuple(open_)

    def grazes(self, motion: Steady) -> bool:
        """Whether nothing presses on something that is closed, so that it may open."""
        return any(is_zero(value) is True for value, _ in self._pressing(motion))
