"""Exact coefficients of a solution that is known modulo a prime."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations, product
from math import gcd

import sympy
from flint import nmod_mat
from sympy import Expr, Rational

from lagcli.algebra import nullspace, simplify
from lagcli.algebra.field import over_common_denominator
from lagcli.algebra.ring import Monomial, Poly
from lagcli.mechanics.discovery.limits import TooMuchWork
from lagcli.mechanics.discovery.modular import PRIME, ModularPoints, small_fraction
from lagcli.platform.effort import EFFORT

_TOGETHER = 3  # parameters in one recognized monomial
_MOST_OPERATIONS = 30000  # measured: at most 2008
_MOST_ATOMS = 8
_MOST_LINEAR = 12  # all differences and sums of four constants
#: Terms: two bodies in space need more than 10,000; 35,000 of hyperbolic functions take 17 s.
_MOST_COMMON = 20_000
_POWERS = (-4, -3, -2, -1, 1, 2, 3, 4)
_NUMBERS = [sign * Rational(n) for n in ("1", "1/2", "2", "3", "4") for sign in (1, -1)]
_KINDS = ("symbol", "root", "sin", "cos", "abs")


@dataclass(frozen=True, slots=True)
class _ConstantMonomial:
    """Powers of constants, by the inverse of their value."""

    inverse: int
    atoms: tuple[Expr, ...]
    powers: tuple[int, ...]

    @property
    def expression(self) -> Expr:
        return sympy.Mul(*(x**n for x, n in zip(self.atoms, self.powers, strict=True)))


class ExactSolver:
    """Coefficients over the field of the constants (parameters and their roots)."""

    def __init__(self, points: ModularPoints) -> None:
        self.points = points
        self.field = points.field
        self._monomials: list[_ConstantMonomial] | None = None
        self._linear: list[_ConstantMonomial] | None = None
        self._signed: dict[int, tuple[_ConstantMonomial, int]] = {}

    def of(
        self, vector: Mapping[int, int], column: Callable[[int], Sequence[Expr]]
    ) -> dict[int, Expr] | None:
        """Coefficients by column for those modulo the prime; None where they were not found."""
        indices = sorted(vector)
        numbers = [vector[i] for i in indices]
        values = (
            self.recognized(numbers)
            or self.recognized(numbers, differences=True)
            or self.solved([column(i) for i in indices])
        )
        return None if values is None else dict(zip(indices, values, strict=True))

    # -- by recognition -------------------------------------------------------------------

    def recognized(self, values: Sequence[int], *, differences: bool = False) -> list[Expr] | None:
        """Rational numbers times a monomial in the constants; None where one is neither.

        The constants have random values near 2^61, so that a small fraction or a short
        product of them is no accident; it is proved later all the same.  With `differences`
        those of two constants, and their sums, take part in the monomials.
        """
        found: list[Expr] = []
        for value in values:
            known = self._recognize(value)
            if known is None and differences:
                known = self._of_differences(value)
            if known is None:
                return None
            found.append(known)
        return found

    def _recognize(self, value: int) -> Expr | None:
        plain = small_fraction(value)
        if plain is not None:
            return Rational(plain.numerator, plain.denominator)
        known = self._multiple_of(self._constant_monomials(), value) or self._two_monomials(value)
        return known or self._beside_a_number(value)

    def _multiple_of(self, monomials: Sequence[_ConstantMonomial], value: int) -> Expr | None:
        fractions = _smallest_fractions()
        for monomial in monomials:
            fraction = fractions.get(value * monomial.inverse % PRIME)
            if fraction is not None:
                return Rational(*fraction) * monomial.expression
        return None

    def _two_monomials(self, value: int) -> Expr | None:
        """A sum or difference of two monomials, as (m1 - m2)/m3."""
        if not self._signed:
            for monomial in (_ConstantMonomial(1, (), ()), *self._constant_monomials()):
                plain = pow(monomial.inverse, -1, PRIME)
                self._signed[plain] = monomial, 1
                self._signed[PRIME - plain] = monomial, -1
        for plain, (one, factor) in self._signed.items():
            found = self._signed.get((value - plain) % PRIME)
            if found is not None:
                other, sign = found
                return factor * one.expression + sign * other.expression
        return None

    def _beside_a_number(self, value: int) -> Expr | None:
        """A small number and a monomial, as 2 - 2 b."""
        for number in _NUMBERS:
            plain = number.p * pow(number.q, -1, PRIME)
            known = self._multiple_of(self._constant_monomials(), value - plain)
            if known is not None:
                return number + known
        return None

    def _of_differences(self, value: int) -> Expr | None:
        """A rational number times powers of constants, their sums and differences."""
        if self._linear is None:
            self._linear = list(self._made(self._atoms(linear=True)))
        return self._multiple_of(self._linear, value)

    def _constant_monomials(self) -> list[_ConstantMonomial]:
        if self._monomials is None:
            self._monomials = list(self._made(self._atoms()[:_MOST_ATOMS]))
        return self._monomials

    def _atoms(self, *, linear: bool = False) -> list[tuple[int, Expr]]:
        """Values and expressions of constants; their sums and differences first if `linear`."""
        constants = [
            (self.points.constants[g], self.field.generators[g].expression)
            for g, constant in enumerate(self.points.constant)
            if constant and self.field.generators[g].kind in _KINDS
        ]
        constants.sort(key=lambda each: not isinstance(each[1], sympy.Abs))  # |b| is b or -b here
        if not linear:
            return constants
        pairs = list(combinations(constants, 2))
        differences = [((a - b) % PRIME, x - y) for (a, x), (b, y) in pairs]
        sums = [((a + b) % PRIME, x + y) for (a, x), (b, y) in pairs]
        made = [pair for pair in (*differences, *sums) if pair[0]]  # |b| - b is 0 here
        return [*made, *constants][:_MOST_LINEAR]

    def _made(self, atoms: Sequence[tuple[int, Expr]]) -> Iterator[_ConstantMonomial]:
        """The shortest first."""
        inverses = [{power: pow(number, -power, PRIME) for power in _POWERS} for number, _ in atoms]
        for count in range(1, min(_TOGETHER, len(atoms)) + 1):
            for chosen in combinations(range(len(atoms)), count):
                for powers in product(_POWERS, repeat=count):
                    if sum(map(abs, powers)) > 4:
                        continue
                    value = 1
                    for k, power in zip(chosen, powers, strict=True):
                        value = value * inverses[k][power] % PRIME
                    EFFORT.done += 20
                    yield _ConstantMonomial(value, tuple(atoms[k][1] for k in chosen), powers)

    # -- by elimination -------------------------------------------------------------------

    def solved(self, columns: Sequence[Sequence[Expr]]) -> list[Expr] | None:
        """The one combination of the columns that vanishes identically in t, q, q'."""
        width = len(columns)
        if sum(sympy.count_ops(e) for column in columns for e in column) > _MOST_OPERATIONS:
            return None
        rows: list[list[Poly]] = []
        rank = 0
        for entries in zip(*columns, strict=True):
            for sparse in self.collected(entries):
                row = [sparse.get(k, self.field.ring.zero) for k in range(width)]
                values = [[self.points.constant_value(x) for x in each] for each in (*rows, row)]
                if nmod_mat(values, PRIME).rank() > rank:
                    rows.append(row)
                    rank += 1
            if rank == width - 1:
                break
        if rank != width - 1:
            return None
        matrix = [[self.field.polynomial_to_sympy(x) for x in row] for row in rows]
        kernel = nullspace(matrix) if matrix else [[sympy.S.One]]
        return [_with_inverse_roots(simplify(x)) for x in kernel[0]] if len(kernel) == 1 else None

    def collected(self, entries: Sequence[Expr]) -> list[dict[int, Poly]]:
        """sum c_a entry_a = 0 as one sparse row of constants for each monomial in t, q, q'."""
        field, ring = self.field, self.field.ring
        elements = [field(e) for e in entries]
        if len(field.generators) > len(self.points.constant):  # one that has no random value
            raise TooMuchWork
        try:
            polys = over_common_denominator(field, elements, _MOST_COMMON)
        except OverflowError:
            raise TooMuchWork from None
        groups: dict[tuple[tuple[int, int], ...], dict[int, list[tuple[Monomial, int]]]] = {}
        for index, poly in enumerate(polys):
            for monomial, coefficient in ring.terms(poly):
                moving = tuple(p for p in monomial if not self.points.constant[p[0]])
                fixed = tuple(p for p in monomial if self.points.constant[p[0]])
                groups.setdefault(moving, {}).setdefault(index, []).append((fixed, coefficient))
        rows = [{k: ring.build(terms) for k, terms in row.items()} for row in groups.values()]
        return [{k: x for k, x in row.items() if x != 0} for row in rows]


@cache
def _smallest_fractions() -> dict[int, tuple[int, int]]:
    """Numerator and denominator up to 128, by the value modulo the prime."""
    inverses = {q: pow(q, -1, PRIME) for q in range(1, 129)}
    return {
        sign * p * inverse % PRIME: (sign * p, q)
        for q, inverse in inverses.items()
        for p in range(1, 129)
        if gcd(p, q) == 1
        for sign in (1, -1)
    }


def _with_inverse_roots(value: Expr) -> Expr:
    """1/sqrt(a) for sqrt(1/a): where a charge with sqrt(a) is real they are the same."""
    return value.replace(
        lambda e: e.is_Pow and e.exp == sympy.S.Half and e.base.is_Pow and e.base.exp == -1,
        lambda e: 1 / sympy.sqrt(e.base.base),
    )
