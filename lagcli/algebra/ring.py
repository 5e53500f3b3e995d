"""Z[g0, g1, …] with rules g^q = P, on FLINT's sparse polynomials.

A FLINT context has its generators fixed.  The ring keeps spare ones and moves to a
larger context when they are used up; `lift` brings an older polynomial along.  The
order is lexicographic with the newest generator first, so that the left side of a rule
g^q = P, with P in older generators, is its leading term and division by it is reduction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeAlias

from flint import Ordering, fmpz_mpoly_ctx

Poly: TypeAlias = Any  # flint.fmpz_mpoly, which has no precise stubs
Monomial: TypeAlias = tuple[tuple[int, int], ...]  # (generator, exponent > 0), ascending

_SPARE = 8


class Ring:
    """Polynomials with integer coefficients in generators that are added on demand."""

    def __init__(self, capacity: int = _SPARE) -> None:
        self.count = 0
        self.rules: dict[int, tuple[int, Poly]] = {}  # g -> (q, g^q - P)
        self.mixed: list[tuple[int, Poly]] = []  # (g, g*A - B)
        self._open(max(capacity, 1))

    def _open(self, capacity: int) -> None:
        self.capacity = capacity
        names = [f"g{index}" for index in reversed(range(capacity))]
        self.context = fmpz_mpoly_ctx.get(names, Ordering.lex)
        self.zero: Poly = self.context.constant(0)
        self.one: Poly = self.context.constant(1)

    def add(self) -> int:
        """Add a generator; its number is returned."""
        if self.count == self.capacity:
            self._open(self.capacity + max(_SPARE, self.capacity // 2))
            self.rules = {g: (q, self.lift(rule)) for g, (q, rule) in self.rules.items()}
            self.mixed = [(g, self.lift(rule)) for g, rule in self.mixed]
        self.count += 1
        return self.count - 1

    def rule(self, generator: int, power: int, value: Poly) -> None:
        """Let generator^power = value hold; value has only older generators."""
        left = self.generator(generator) ** power
        self.rules[generator] = (power, left - self.lift(value))

    def rule_of_product(self, generator: int, factor: Poly, value: Poly) -> None:
        """Let generator*factor = value hold, with no newer generator in either."""
        left = self.generator(generator) * self.lift(factor)
        self.mixed.append((generator, left - self.lift(value)))

    def generator(self, index: int) -> Poly:
        """The polynomial g_index."""
        return self.context.gen(self.capacity - 1 - index)

    def constant(self, value: int) -> Poly:
        """The polynomial of an integer."""
        return self.context.constant(value)

    def lift(self, poly: Poly) -> Poly:
        """The same polynomial in the present context."""
        if poly.context() is self.context:
            return poly
        return poly.project_to_context(self.context)

    def reduce(self, poly: Poly) -> Poly:
        """The remainder by all rules: each g^q is replaced by its P."""
        poly = self.lift(poly)
        if not self.rules or poly.is_constant():
            return poly
        for generator in sorted(self.rules, reverse=True):
            power, rule = self.rules[generator]
            if self.degree(poly, generator) >= power:
                poly = poly % rule
        for generator, rule in self.mixed:
            if self.degree(poly, generator):
                rest = poly % rule
                if rest != poly:
                    return self.reduce(rest)
        return poly

    def degree(self, poly: Poly, generator: int) -> int:
        """The degree in one generator (of a polynomial of the present context)."""
        return int(poly.degrees()[self.capacity - 1 - generator])

    def used(self, poly: Poly) -> list[int]:
        """The generators that occur, ascending."""
        poly = self.lift(poly)
        last = self.capacity - 1
        return sorted(last - i for i, degree in enumerate(poly.degrees()) if degree > 0)

    def terms(self, poly: Poly) -> Iterator[tuple[Monomial, int]]:
        """Monomials and coefficients, leading term first."""
        poly = self.lift(poly)
        last = self.capacity - 1
        for exponents, coefficient in poly.terms():
            pairs = [(last - i, int(e)) for i, e in enumerate(exponents) if e]
            pairs.reverse()
            yield tuple(pairs), int(coefficient)

    def coefficients(self, poly: Poly, generator: int) -> dict[int, Poly]:
        """The coefficients of the powers of a generator that occur."""
        poly = self.lift(poly)
        position = self.capacity - 1 - generator
        groups: dict[int, dict[tuple[int, ...], int]] = {}
        for exponents, coefficient in poly.to_dict().items():
            power = int(exponents[position])
            rest = (*exponents[:position], 0, *exponents[position + 1 :])
            groups.setdefault(power, {})[rest] = coefficient
        return {power: self.context.from_dict(terms) for power, terms in groups.items()}

    def build(self, terms: Iterable[tuple[Monomial, int]]) -> Poly:
        """The polynomial with the given terms; equal monomials add up."""
        last = self.capacity - 1
        data: dict[tuple[int, ...], int] = {}
        for monomial, coefficient in terms:
            exponents = [0] * self.capacity
            for generator, exponent in monomial:
                exponents[last - generator] = exponent
            key = tuple(exponents)
            data[key] = data.get(key, 0) + coefficient
        return self.context.from_dict(data)

    def compose(self, poly: Poly, images: dict[int, Poly]) -> Poly:
        """The polynomial with generators replaced."""
        poly = self.lift(poly)
        if not images:
            return poly
        last = self.capacity - 1
        values = [images.get(last - i) for i in range(self.capacity)]
        gens = self.context.gens()
        arguments = [g if v is None else self.lift(v) for g, v in zip(gens, values, strict=True)]
        return poly.compose(*arguments)

    def derivative(self, poly: Poly, generator: int) -> Poly:
        """The partial derivative by a generator."""
        return self.lift(poly).derivative(self.capacity - 1 - generator)


def factorization(poly: Poly) -> tuple[Any, list[tuple[Poly, int]]]:
    """The content, and the irreducible factors with their exponents.

    FLINT's binding cannot sort factors with coefficients beyond a machine's integer (15
    digits squared); they are then the square-free ones, or the polynomial itself.
    """
    for split in (poly.factor, poly.factor_squarefree):
        try:
            content, factors = split()
        except OverflowError:
            continue
        return content, factors
    return 1, [(poly, 1)]
