"""The charges that are listed: names, order, signs, and the words for those left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import sympy
from sympy import Expr

from lagcli.algebra import simplify
from lagcli.algebra.jumps import is_continuous
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.discovery.cartesian import Cartesian
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.names import Naming, distinct
from lagcli.mechanics.discovery.point import is_energy
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.record import replace


class Listing:
    """Charges with names that differ: of point symmetries, sorted, and the others.

    Those of symmetries of L are sorted anew with each that is added; the others stand as found.
    """

    def __init__(
        self,
        system: System,
        constraints: Sequence[ConstraintEquation],
        kinds: Kinds,
        cartesian: Cartesian | None,
    ) -> None:
        self.points: tuple[NoetherCharge, ...] = ()
        self.hidden: tuple[NoetherCharge, ...] = ()
        self.naming = Naming(system.t, system.q, kinds, cartesian)
        self._system = system
        self._constrained = bool(constraints)
        self._moved = any(e.drift != 0 for e in constraints)  # and so does work
        self._found: list[tuple[str, NoetherCharge]] = []

    @property
    def _names(self) -> list[str]:
        return [c.name for c in (*self.points, *self.hidden)]

    def add(self, charges: Iterable[NoetherCharge]) -> None:
        """Name charges of point symmetries, and sort all of them anew."""
        kept = map(self._without_constant, filter(self._lasts, charges))
        self._found += [self._named(charge) for charge in kept]
        self._found.sort(key=lambda pair: rank_of(pair[0]))
        names = distinct([shown(name, charge) for name, charge in self._found])
        self.points = tuple(
            replace(times(charge, self.naming.orientation(name, charge)), name=name)
            for name, (_, charge) in zip(names, self._found, strict=True)
        )

    def keep_only(self, charges: Sequence[NoetherCharge]) -> None:
        """Leave out the charges of point symmetries that are not among the given ones."""
        pairs = zip(self._found, self.points, strict=True)
        self._found = [pair for pair, charge in pairs if charge in charges]
        self.add(())

    def rebase(self, change: Callable[[Sequence[NoetherCharge]], list[NoetherCharge]]) -> None:
        """Take other combinations of the charges of point symmetries, with their own names."""
        old = [charge for _, charge in self._found]
        new = change(old)
        if any(one is not other for one, other in zip(old, new, strict=True)):
            self._found = []
            self.add(new)

    def add_hidden(self, named: Iterable[tuple[str, NoetherCharge]]) -> None:
        """Other charges, with the names that they have, if any, made to differ."""
        kept = [(x, self._without_constant(each)) for x, each in named if self._lasts(each)]
        names = distinct([*self._names, *(name for name, _ in kept)])[len(self._names) :]
        self.hidden += tuple(
            replace(charge, name=name) for name, (_, charge) in zip(names, kept, strict=True)
        )

    def _lasts(self, charge: NoetherCharge) -> bool:
        """Whether it is constant also where the argument of a sign passes 0."""
        return self._system.is_continuous and is_continuous(charge.charge)

    def _without_constant(self, charge: NoetherCharge) -> NoetherCharge:
        """Without a constant that G brings into Q, where that is shorter."""
        moving = (self._system.t, *self._system.q, *self._system.qdot)
        gauge = sympy.expand(charge.gauge or sympy.S.Zero)
        constant = gauge.as_independent(*moving, as_Add=True)[0]
        if constant == 0:
            return charge
        sign = -1 if is_energy(charge.transformation) else 1  # of h + G
        Q = sympy.expand(charge.charge + sign * constant)
        longer = simplify(Q).count_ops() > simplify(charge.charge).count_ops()  # (x + b)^2
        return charge if longer else replace(charge, gauge=gauge - constant, charge=Q)

    def _named(self, charge: NoetherCharge) -> tuple[str, NoetherCharge]:
        given = charge.transformation
        name = self.naming.of_point(given.changes, given.time)
        if name == "damped_energy":
            name = self.naming.of_damping(charge.charge)
        name = name or self.naming.of_relative(charge.charge, given.changes, self._system.qdot)
        if name == "energy" and self._moved and charge.gauge != 0:
            name = "moving_energy"
        if name or not self._constrained:
            return name, charge
        return led_momentum(charge, self._system)


def shown(name: str, charge: NoetherCharge) -> str:
    """p_x stands for ∂L/∂x' alone, from which a translation with a gauge G differs by -G."""
    if name.startswith("p_") and charge.gauge is not None and charge.gauge != 0:
        return f"translation_{name.removeprefix('p_')}"
    return name


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
