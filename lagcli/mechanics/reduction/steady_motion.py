"""One steady motion, or a family of them, as a value."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sympy import Expr, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.place import at, lies_in
from lagcli.algebra.vanishing_factors import squares_divided_by
from lagcli.mechanics.rest.family import Family
from lagcli.record import record


@record
class Steady:
    """One steady motion, or a family of them.

    Attributes
    ----------
    values
        The coordinates that are fixed, and the momenta p_c, in what is free.
    rates
        q_c' by coordinate index; None where the coordinates are singular.
    positive
        It is there where each of these is > 0.
    mirrored
        It is there with all rates and momenta reversed, too.
    derivatives
        The second and higher derivatives of U_eff, of a singular place; empty elsewhere.
    family
        What ties the coordinates where the values are one branch of a family.
    """

    values: Mapping[Symbol, Expr]
    rates: Mapping[int, Expr] | None
    positive: tuple[Expr, ...] = ()
    mirrored: bool = False
    derivatives: tuple[Expr, ...] = ()
    family: Family | None = None

    @property
    def free_rates(self) -> set[Expr]:
        """Rates that are given as themselves: any value will do."""
        return {rate for rate in (self.rates or {}).values() if rate.is_Symbol}

    @property
    def known_positive(self) -> tuple[Expr, ...]:
        """What is positive there: `positive`, and the squares of what is divided by."""
        values = (*self.values.values(), *(self.rates or {}).values())
        return tuple(dict.fromkeys((*self.positive, *squares_divided_by(values))))

    def within(self, family: Steady, q: Sequence[Symbol]) -> bool:
        """Whether it is one of a family in which more coordinates are free."""
        if sum(s in self.values for s in q) <= sum(s in family.values for s in q):
            return False
        power = 2 if family.mirrored else 1
        return all(
            is_zero(self.values.get(s, s) ** power - at(value, self.values) ** power) is True
            for s, value in family.values.items()
        )

    def member_of(self, family: Steady, q: Sequence[Symbol]) -> bool:
        """Whether it is another at the same coordinates but for momenta that are free."""
        try:
            return set(q) <= set(family.values) and lies_in(family.values, self.values)
        except ZeroDivisionError:
            return False
