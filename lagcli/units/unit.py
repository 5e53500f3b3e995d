"""A unit as it is written: a product of powers of named units."""

from __future__ import annotations

from fractions import Fraction

from lagcli.record import record


@record
class Unit:
    """A product of powers of named units.

    Attributes
    ----------
    factors : tuple of (str, Fraction)
        Name or symbol, as in the table of units, and exponent; not 0.
    number : float
        What the product is multiplied by: 1, but where a system of units has no name for
        what is meant.
    """

    factors: tuple[tuple[str, Fraction], ...] = ()
    number: float = 1

    def __str__(self) -> str:
        """As the problem format writes it: `kg m^2/s`, `1/s`, `1`."""
        above = [_power(name, exponent) for name, exponent in self.factors if exponent > 0]
        below = [_power(name, -exponent) for name, exponent in self.factors if exponent < 0]
        if self.number != 1:
            above.insert(0, f"{self.number:.6g}")
        head = " ".join(above) or "1"
        if not below:
            return head
        return f"{head}/{below[0]}" if len(below) == 1 else f"{head}/({' '.join(below)})"


def _power(name: str, exponent: Fraction) -> str:
    if exponent == 1:
        return name
    return f"{name}^{exponent}" if exponent.denominator == 1 else f"{name}^({exponent})"


#: The unit of an angle, a number, a ratio.
DIMENSIONLESS = Unit()
