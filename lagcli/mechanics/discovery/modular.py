"""Values of field elements modulo a prime at random points that obey the field's rules.

A formula that vanishes does so at every point; one that does not vanishes at a random point
modulo p with a probability of degree/p (Schwartz, J. ACM 27 (1980) 701).  With p near 2^61
ranks are then right but for one case in 10^15, at the price of integers.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import nmod_mat, nmod_poly
from sympy import Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Poly, factorization
from lagcli.platform.effort import EFFORT

#: p = 7 mod 8 and p != 1 mod 3, 5, 7: odd roots are unique, square roots a power; the square
#: roots of 2, 3, 5, 7 … and of 2 + sqrt(2), 5 + sqrt(5) … that linear chains have are there too.
PRIME = 2305843009213561919

_TRIES = 400  # measured: at most 18
_LARGEST = 4096  # numerator or denominator
#: Coefficients with the powers of the generators.
Terms = list[tuple[int, tuple[tuple[int, int], ...]]]


class NoPoint(Exception):
    """No point was found at which all roots exist modulo p."""


@dataclass(frozen=True, slots=True)
class CompiledElement:
    """An element as lists of terms."""

    above: Terms
    below: Terms

    def __call__(self, point: Sequence[int]) -> int:
        """The value at a point; NoPoint where the denominator vanishes."""
        bottom = evaluated(self.below, point)
        if bottom == 0:
            raise NoPoint
        top = evaluated(self.above, point)
        return top if bottom == 1 else top * pow(bottom, -1, PRIME) % PRIME


class ModularPoints:
    """Random values of the generators of a field; those of constants stay the same.

    Parameters
    ----------
    field
        Its generators must all be there already.
    variables
        The symbols that change from point to point: t, q, q'.
    """

    def __init__(self, field: Field, variables: Sequence[Symbol]) -> None:
        self.field = field
        self._source = random.Random("lagcli discovery")
        moving = set(variables)
        self.constant = [
            not (generator.expression.free_symbols & moving) for generator in field.generators
        ]
        self.rules = {
            g: (power, self.terms(-(rule - field.ring.generator(g) ** power)))
            for g, (power, rule) in field.ring.rules.items()
        }
        self._either = False  # whether roots of constants are drawn with either sign
        self.signs: dict[int, Terms] = {}  # s f - |f|
        for g, rule in reversed(field.ring.mixed):
            self.signs[g] = self.terms(rule)
        self.constants = self._drawn({}, wanted=True)

    def point(self) -> list[int]:
        """New values of the variables and of what depends on them."""
        values = self._drawn(self.constants, wanted=False)
        return [values[g] for g in range(len(self.field.generators))]

    def compiled(self, element: Element) -> CompiledElement:
        """The element ready for `value`."""
        return CompiledElement(self.terms(element.numerator), self.terms(element.denominator))

    def constant_value(self, poly: Poly) -> int:
        """A polynomial in constants alone."""
        point = [self.constants.get(g, 0) for g in range(len(self.field.generators))]
        return evaluated(self.terms(poly), point)

    def terms(self, poly: Poly) -> Terms:
        """Its coefficients and monomials."""
        return [(c, monomial) for monomial, c in self.field.ring.terms(poly)]

    def _drawn(self, known: dict[int, int], *, wanted: bool) -> dict[int, int]:
        """Values of the generators whose constancy is as wanted, beside the known ones."""
        for attempt in range(_TRIES):
            self._either = wanted and 2 * attempt >= _TRIES
            values = dict(known)
            if all(
                self.draw(g, values)
                for g in range(len(self.field.generators))
                if g not in values and self.constant[g] is wanted
            ):
                return values
        raise NoPoint

    def draw(self, g: int, values: dict[int, int]) -> bool:
        """Give generator g a value (its partner too); False where its root does not exist."""
        if g in values:
            return True
        generator = self.field.generators[g]
        u = self._source.randrange(2, PRIME - 2)
        if generator.kind in ("cos", "cosh"):
            # cos = (1 - u^2)/(1 + u^2), sin = 2u/(1 + u^2); the hyperbolic ones with -u^2
            square = u * u % PRIME if generator.kind == "cos" else -u * u % PRIME
            scale = pow(1 + square, -1, PRIME)
            values[g] = (1 - square) * scale % PRIME
            values[generator.partner] = 2 * u * scale % PRIME
            return True
        if g in self.rules:
            power, terms = self.rules[g]
            point = [values.get(k, 0) for k in range(len(self.field.generators))]
            root = _root(evaluated(terms, point), power)
            if root is None:
                return False
            # sqrt(6 + 2 sqrt(29)) may be there for the other root of 29 alone
            other = self._either and power % 2 == 0 and self._source.random() < 0.5
            values[g] = PRIME - root if other else root
            return True
        if g in self.signs:
            point = [values.get(k, 0) for k in range(len(self.field.generators))]
            size = -evaluated(self.signs[g], point)  # at s = 0
            point[g] = 1
            u = size * pow(evaluated(self.signs[g], point) + size, -1, PRIME) % PRIME
        values[g] = u
        return True


def evaluated(terms: Terms, point: Sequence[int] | Mapping[int, int], prime: int = PRIME) -> int:
    """A polynomial, as its coefficients and monomials, modulo a prime."""
    total = 0
    EFFORT.done += len(terms)
    for coefficient, monomial in terms:
        value = coefficient
        for g, exponent in monomial:
            x = point[g]
            value = value * (x if exponent == 1 else pow(x, exponent, prime)) % prime
        total += value
    return total % prime


def linear_root(poly: nmod_poly) -> int | None:
    """A root of a polynomial in one unknown, None where it has none modulo its prime."""
    if poly.degree() < 1:
        return None
    found = (each for each, _ in factorization(poly)[1] if each.degree() == 1)
    return next((int(-each[0] / each[1]) for each in found), None)


def _root(value: int, index: int) -> int | None:
    """A root that has itself a square root, where the index is even."""
    while index % 2 == 0:
        root = pow(value, (PRIME + 1) // 4, PRIME)
        if root * root % PRIME != value:
            return None
        # of s and -s exactly one is a square, since p = 3 mod 4
        value = root if pow(root, (PRIME - 1) // 2, PRIME) == 1 else PRIME - root
        index //= 2
    return pow(value, pow(index, -1, PRIME - 1), PRIME) if index > 1 else value


def square_root(value: int) -> int | None:
    """A square root, None where there is none."""
    root = pow(value % PRIME, (PRIME + 1) // 4, PRIME)
    return root if (root * root - value) % PRIME == 0 else None


def small_fraction(value: int) -> Fraction | None:
    """The fraction with numerator and denominator up to 4096 that is `value` modulo p."""
    a, b, x, y = PRIME, value % PRIME, 0, 1
    while b > _LARGEST:
        quotient = a // b
        a, b, x, y = b, a - quotient * b, y, x - quotient * y
    return Fraction(b, y) if y and abs(y) <= _LARGEST else None


def kernel_modulo(
    rows: Sequence[Sequence[int]], width: int
) -> tuple[list[list[int]], list[dict[int, int]]]:
    """The reduced rows, and the basis of the kernel with one free column in each vector."""
    if not rows:
        return [], [{i: 1} for i in range(width)]
    EFFORT.done += len(rows) * width * min(len(rows), width) // 700
    reduced, rank = nmod_mat([list(row) for row in rows], PRIME).rref()
    table = [[int(x) for x in row] for row in reduced.table()[:rank]]
    pivots = [next(j for j, x in enumerate(row) if x) for row in table]
    bound = set(pivots)
    vectors = []
    for free in range(width):
        if free in bound:
            continue
        vector = {free: 1}
        for pivot, row in zip(pivots, table, strict=True):
            if row[free]:
                vector[pivot] = -row[free] % PRIME
        vectors.append(vector)
    return table, vectors


def independent(
    rows: Sequence[Sequence[int]], known: int, kernel: Sequence[dict[int, int]]
) -> list[dict[int, int]]:
    """The vectors of a kernel that are no combinations of the known and of earlier ones.

    The first columns hold the values of the known functions, the others those of the unknowns.
    """
    table = [
        [*row[:known], *(sum(c * row[known + k] for k, c in v.items()) % PRIME for v in kernel)]
        for row in rows
    ]
    return [kernel[k - known] for k in pivot_columns(table) if k >= known] if kernel else []


def pivot_columns(rows: Sequence[Sequence[int]]) -> list[int]:
    """The columns that are no combinations of earlier ones."""
    reduced, rank = nmod_mat([list(row) for row in rows], PRIME).rref()
    return [next(j for j, x in enumerate(row) if int(x)) for row in reduced.table()[:rank]]
