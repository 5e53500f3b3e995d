"""Eliminating symbols from an expression with the help of relations f = 0.

A relation that is linear in a symbol is solved for it, the solution is put in everywhere,
and so on.  A symbol that is then left only inside sin and cos becomes two symbols
with c² + s² = 1.  What cannot be solved is used as a polynomial: the expression is
divided by it with remainder (pseudo-division), or the symbol goes into a resultant.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence

import sympy
from sympy import Dummy, Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.polynomial_roots import coefficients
from lagcli.algebra.ring import Poly, factorization
from lagcli.platform.effort import EFFORT, Work
from lagcli.record import record

_PASSES = 12
_MAX_TERMS = 4000  # measured: at most 13
_OF_FACTORS = 20  # units of work for a term
_UNLIMITED = Work(float("inf"))

#: Whether an expression may be divided by: it does not vanish where the relations hold.
Nonzero = Callable[[Expr], bool]


@record
class EliminatedExpression:
    """An expression with symbols eliminated where that was possible.

    `left` are the symbols that remain although they were to go; `relations` what
    the relations have become, and `solutions` what was put in for which symbol, in order.
    """

    expression: Expr
    left: frozenset[Symbol]
    relations: tuple[Expr, ...]
    solutions: tuple[tuple[Symbol, Expr], ...]

    @property
    def complete(self) -> bool:
        """Whether nothing is left of what was to go."""
        return not self.left


class EliminationRun:
    """One run: relations, an expression, and the symbols to remove, first ones first."""

    def __init__(
        self,
        expression: Expr,
        relations: Iterable[Expr],
        remove: Sequence[Symbol],
        nonzero: Nonzero,
        *,
        work: Work = _UNLIMITED,
    ) -> None:
        self.expression = expression
        self.relations = list(relations)
        self.remove = list(remove)
        self.solutions: list[tuple[Symbol, Expr]] = []
        self._meaning: dict[Symbol, Expr] = {}  # of the symbols for a sine and a cosine
        self._divisible = nonzero
        self._work = work

    def run(self) -> EliminatedExpression:
        """Remove what can be removed."""
        while not self._work.over:
            if self._substitute_one():
                continue
            if not self._split_angles():
                break
        self._divide()
        present = self._present(self.expression)
        return EliminatedExpression(
            self.expression, frozenset(present), tuple(self.relations), tuple(self.solutions)
        )

    def _nonzero(self, divisor: Expr) -> bool:
        return self._divisible(divisor.xreplace(self._meaning))

    def _present(self, expression: Expr) -> set[Symbol]:
        return set(self.remove) & set(expression.free_symbols)

    # -- linear ----------------------------------------------------------------------------

    def _substitute_one(self) -> bool:
        """Solve one relation for one symbol, the simplest first, and put it in."""
        kept: list[Expr] = []
        best: tuple[tuple[int, ...], int, Symbol, Expr] | None = None
        for relation in self.relations:
            field = Field([relation])
            poly = self._essential(field, relation)
            if poly is None:
                continue
            kept.append(field.polynomial_to_sympy(poly))
            for cost, symbol, value in self._linear(field, poly):
                if best is None or cost < best[0]:
                    best = (cost, len(kept) - 1, symbol, value)
        self.relations = kept
        if best is None:
            return False
        _, index, symbol, value = best
        del self.relations[index]
        self.relations = [r.xreplace({symbol: value}) for r in self.relations]
        self.expression = self.expression.xreplace({symbol: value})
        self.solutions.append((symbol, value))
        return True

    def _essential(self, field: Field, relation: Expr) -> Poly | None:
        """The numerator without repeated factors and without those that cannot vanish."""
        try:
            element = field(relation)
        except ZeroDivisionError:
            return None
        if element.is_zero() or element.size() > _MAX_TERMS:
            return None
        ring = field.ring
        product = ring.one
        EFFORT.done += _OF_FACTORS * element.size()
        for factor, _ in factorization(ring.lift(element.numerator))[1]:
            if not self._nonzero(field.polynomial_to_sympy(factor)):
                product = product * ring.lift(factor)
        return ring.lift(element.numerator) if product.is_constant() else product

    def _linear(self, field: Field, poly: Poly) -> Iterable[tuple[tuple[int, ...], Symbol, Expr]]:
        """The symbols in which the relation is linear, with the cost of each solution."""
        ring = field.ring
        poly = ring.lift(poly)
        used = ring.used(poly)
        for position, symbol in enumerate(self.remove):
            number = field.number_of(symbol)
            if number not in used or ring.degree(poly, number) != 1:
                continue
            others = (field.generators[g].expression for g in used if g != number)
            if any(symbol in e.free_symbols for e in others):
                continue
            rest, slope = coefficients(field, poly, number)
            divisor = field.to_sympy(slope)
            varying = len(self._present(divisor))
            if not self._nonzero(divisor):
                continue
            value = field.to_sympy(-rest / slope)
            yield (varying, slope.size(), position, rest.size()), symbol, value

    # -- angles ------------------------------------------------------------------------------

    def _split_angles(self) -> bool:
        """A symbol that occurs only inside sin and cos becomes two, with c² + s² = 1."""
        everything = [self.expression, *self.relations]
        field = Field(everything)
        try:
            elements = [field(e) for e in everything]
        except ZeroDivisionError:
            return False
        ring = field.ring
        used = {g for e in elements for p in (e.numerator, e.denominator) for g in ring.used(p)}
        wanted = {s for s in self.remove if not isinstance(s, Dummy)}
        for g in sorted(used):
            generator = field.generators[g]
            if generator.kind not in ("cos", "sin") or generator.argument is None:
                continue
            symbols = generator.argument.free_symbols & wanted
            if not symbols or any(
                symbols & field.generators[h].expression.free_symbols
                for h in used
                if h not in (g, generator.partner)
            ):
                continue
            c, s = Dummy("#c", real=True), Dummy("#s", real=True)
            argument = generator.argument
            images = {sympy.cos(argument): c, sympy.sin(argument): s}
            plain = [field.to_sympy(e).xreplace(images) for e in elements]
            self._meaning |= {c: sympy.cos(argument), s: sympy.sin(argument)}
            self.expression, self.relations = plain[0], [*plain[1:], c**2 + s**2 - 1]
            self.remove += [s, c]
            return True
        return False

    # -- remainders ----------------------------------------------------------------------------

    def _divide(self) -> None:
        """Reduce the expression modulo the relations that are left.

        To fewer symbols or lower degrees; then in the order of the symbols, as x'^2 = f(x, z)
        is a step on the way to z alone.
        """
        for measure in (_of_all, tuple):
            for _ in range(_PASSES):
                present = self._present(self.expression)
                if not present or self._work.over:
                    return
                before = self.expression
                for symbol in self.remove:
                    if symbol in present:
                        self._divide_by(symbol, measure)
                if self.expression == before:
                    break

    def _divide_by(self, symbol: Symbol, measure: Callable[[list[int]], tuple[int, ...]]) -> None:
        field = Field([self.expression, *self.relations])
        try:
            element = field(self.expression)
        except ZeroDivisionError:
            return
        number = field.number_of(symbol)
        if number is None:
            return
        divisors = []
        for relation in self.relations:
            poly = field(relation).numerator
            parts = coefficients(field, poly, number)
            if len(parts) > 1 and self._nonzero(field.to_sympy(parts[-1])):
                divisors.append((len(parts), len(poly), poly))
        for _, _, poly in sorted(divisors, key=lambda d: d[:2]):
            above = remainder(field, element.numerator, poly, number)
            below = remainder(field, element.denominator, poly, number)
            if below.is_zero():
                continue
            shorter = above / below
            if measure(self._degrees(field, shorter)) < measure(self._degrees(field, element)):
                element = shorter
        self.expression = field.to_sympy(element)

    def _degrees(self, field: Field, element: Element) -> list[int]:
        """In each symbol that is to go."""
        ring = field.ring
        degrees = []
        for symbol in self.remove:
            number = field.number_of(symbol)
            above, below = ring.lift(element.numerator), ring.lift(element.denominator)
            both = (0,) if number is None else (ring.degree(p, number) for p in (above, below))
            degrees.append(max(both))
        return degrees


def _of_all(degrees: list[int]) -> tuple[int, ...]:
    return sum(d > 0 for d in degrees), sum(degrees)


def remainder(field: Field, poly: Poly, divisor: Poly, generator: int) -> Element:
    """The remainder of a division in one generator, leading coefficients divided by."""
    a = coefficients(field, poly, generator)
    b = coefficients(field, divisor, generator)
    while len(a) >= len(b):
        factor = a[-1] / b[-1]
        shift = len(a) - len(b)
        for k, each in enumerate(b):
            a[shift + k] = a[shift + k] - factor * each
        a.pop()
        while len(a) > 1 and a[-1].is_zero():
            a.pop()
        if len(a) == 1:
            break
    total, power, x = field.rational(0), field.rational(1), field.generator(generator)
    for each in a:
        total = total + each * power
        power = power * x
    return total


def eliminate(
    expression: Expr,
    relations: Sequence[Expr],
    remove: Sequence[Symbol],
    nonzero: Nonzero,
    *,
    work: Work = _UNLIMITED,
) -> EliminatedExpression:
    """The expression freed of symbols: at first by dividing by constants only, then by all."""
    wanted: Collection[Symbol] = set(remove)

    def constant(divisor: Expr) -> bool:
        return not (divisor.free_symbols & wanted) and nonzero(divisor)

    first = EliminationRun(expression, relations, remove, constant, work=work).run()
    if first.complete:
        return first
    second = EliminationRun(expression, relations, remove, nonzero, work=work).run()
    return second if second.complete or len(second.left) < len(first.left) else first
