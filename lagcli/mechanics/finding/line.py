"""Functions of one coordinate u as quotients of polynomials in one variable z.

The variable is u itself, or z = tan(k u/2) where u stands in sines and cosines of k u
alone.  Then k u = pi is z = infinity, where a quotient has the zeros that its degrees tell.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import sympy
from sympy import Dummy, Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.ring import Poly
from lagcli.record import record

_MAX_DEGREE = 16  # measured: at most 4


class NotAlgebraic(Exception):
    """A function that is no quotient of polynomials in u, or in sines and cosines of k u."""


@record
class Factor:
    """An irreducible factor of one function by powers of z, constant term first."""

    function: int
    coefficients: tuple[Expr, ...]
    exponent: int  # negative in a denominator


class FunctionsOnLine:
    """Several functions of u.

    Parameters
    ----------
    u
        The coordinate.
    functions
        Functions of u and the parameters.

    Attributes
    ----------
    rate : Expr or None
        k; None where z is u itself.
    factors : tuple of Factor
        Those that depend on u.

    Raises
    ------
    NotAlgebraic
        Where one of them is of another kind, or of too high a degree.
    """

    def __init__(self, u: Symbol, functions: Sequence[Expr]) -> None:
        self.u = u
        self.functions = tuple(functions)
        field = Field(self.functions)
        normal = [field.to_sympy(field(f)) for f in self.functions]
        angle = _angle(u, normal)
        self.rate = None if angle is None else sympy.cancel(angle / u)
        z: Symbol = Dummy("#z", real=True)
        self._field = Field([_in_z(f, u, z, angle) for f in normal])
        self._z = self._field.number_of(z)
        self._polys: list[tuple[Poly, tuple[Expr, ...]]] = []
        self.factors = tuple(
            factor
            for index, f in enumerate(normal)
            for factor in self._factored(index, _in_z(f, u, z, angle))
        )
        if any(
            z in generator.expression.free_symbols and generator.expression != z
            for generator in self._field.generators
        ):
            raise NotAlgebraic

    def _factored(self, index: int, function: Expr) -> Iterator[Factor]:
        element, ring = self._field(function), self._field.ring
        for sign, poly in ((1, element.numerator), (-1, element.denominator)):
            for factor, exponent in ring.lift(poly).factor()[1] if poly != 0 else ():
                degree = 0 if self._z is None else ring.degree(factor, self._z)
                if degree > _MAX_DEGREE:
                    raise NotAlgebraic
                if degree:
                    yield Factor(index, self._known(factor, degree), sign * int(exponent))

    def _known(self, poly: Poly, degree: int) -> tuple[Expr, ...]:
        """The coefficients of a factor, which several functions may have."""
        for other, coefficients in self._polys:
            if poly in (other, -other):
                return coefficients
        self._polys.append((poly, self._coefficients(poly, degree)))
        return self._polys[-1][1]

    def _coefficients(self, poly: Poly, degree: int) -> tuple[Expr, ...]:
        assert self._z is not None
        found, zero = self._field.ring.coefficients(poly, self._z), self._field.ring.zero
        powers = range(degree + 1)
        return tuple(self._field.polynomial_to_sympy(found.get(k, zero)) for k in powers)

    def events(self) -> Iterator[Expr]:
        """What vanishes where roots meet or go to infinity as the parameters change."""
        ring = self._field.ring
        if self._z is None:
            return
        place = ring.capacity - 1 - self._z
        for poly, coefficients in self._polys:
            yield coefficients[-1]
            if len(coefficients) > 2:
                yield self._field.polynomial_to_sympy(poly.discriminant(place))
        for (one, _), (other, _) in combinations(self._polys, 2):
            yield self._field.polynomial_to_sympy(one.resultant(other, place))
        if self.rate is not None:
            # of a pole there the coefficients of the highest powers tell
            yield from (f for f in self.at(sympy.pi / self.rate) if not f.has(*NO_VALUE))

    def at_zero(self) -> list[Expr]:
        """What vanishes where a root or a pole goes through u = 0."""
        return [coefficients[0] for _, coefficients in self._polys]

    def at(self, place: Expr) -> list[Expr]:
        """The functions at one place u."""
        return [f.xreplace({self.u: place}) for f in self.functions]


def _angle(u: Symbol, functions: Sequence[Expr]) -> Expr | None:
    """k u, where u stands in its sines and cosines alone; None where u stands by itself."""
    circular = {g for f in functions for g in f.atoms(sympy.sin, sympy.cos) if u in g.free_symbols}
    if not circular:
        return None
    angles = {g.args[0] for g in circular}
    rest = [f.xreplace({g: Dummy() for g in circular}) for f in functions]
    if len(angles) > 1 or any(u in f.free_symbols for f in rest):
        raise NotAlgebraic
    [angle] = angles
    if u in sympy.cancel(angle / u).free_symbols:
        raise NotAlgebraic
    return angle


def _in_z(function: Expr, u: Symbol, z: Symbol, angle: Expr | None) -> Expr:
    """cos k u = (1 - z^2)/(1 + z^2), sin k u = 2 z/(1 + z^2)."""
    if angle is None:
        return function.xreplace({u: z})
    below = 1 + z**2
    return function.xreplace(
        {sympy.sin(angle): 2 * z / below, sympy.cos(angle): (1 - z**2) / below}
    )
