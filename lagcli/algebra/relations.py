"""Polynomial relations that hold: some are solved and substituted, others reduce.

x − R*theta = 0 gives x → R*theta.  x² + y² − l² = 0 has no such solution; numerators and
denominators are then taken modulo the ideal of the relations (a Gröbner basis of it).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice, permutations

from sympy import Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ideal import Ideal
from lagcli.algebra.ring import Poly

_ORDERS = 2  # monomial orders that are tried
_IDEALS = 6  # ideals in all
_READ = 3  # reductions that are shaped


class Relations:
    """Relations f = 0 between the symbols of expressions.

    Parameters
    ----------
    expressions
        The f.
    eliminate
        Symbols to solve for, the most welcome first.  By default the primed symbols and
        those that occur with a prime too: coordinates and their velocities.

    Attributes
    ----------
    solved
        symbol -> expression, for the relations that are linear in a symbol with a
        constant coefficient.
    remaining
        The other relations, solutions substituted.
    """

    def __init__(self, expressions: Sequence[Expr], eliminate: Sequence[Symbol] = ()) -> None:
        self.solved: dict[Symbol, Expr] = {}
        self.remaining: list[Expr] = []
        symbols = sorted({s for e in expressions for s in e.free_symbols}, key=lambda s: s.name)
        #: Without a preference the name that comes last is solved for.
        self._direction = 1 if eliminate else -1
        self._welcome = list(eliminate) or _dynamic(symbols) or symbols
        self._ideals: dict[int, tuple[Field, list[Ideal]]] = {}
        for expression in expressions:
            self._add(expression)
        # a relation that came before the solution of one of its symbols
        for expression in self.remaining[:]:
            if expression.free_symbols & self.solved.keys():
                self.remaining.remove(expression)
                self._add(expression)

    def __bool__(self) -> bool:
        return bool(self.solved or self.remaining)

    def substitute(self, expression: Expr) -> Expr:
        """The expression with the solved symbols replaced."""
        if not expression.free_symbols & self.solved.keys():
            return expression
        return expression.xreplace(self.solved)

    def _add(self, expression: Expr) -> None:
        expression = self.substitute(expression)
        field = Field([expression])
        try:
            relation = field(expression)
        except ZeroDivisionError:
            return
        if relation.is_zero():
            return
        found = self._solution(field, relation.numerator)
        if found is None:
            self.remaining.append(field.polynomial_to_sympy(relation.numerator))
            return
        symbol, value = found
        self.solved = {s: e.xreplace({symbol: value}) for s, e in self.solved.items()}
        self.solved[symbol] = value

    def _solution(self, field: Field, poly: Poly) -> tuple[Symbol, Expr] | None:
        """The most welcome symbol in which the relation is linear, and its value."""
        best: tuple[tuple[int, ...], Symbol, Element] | None = None
        ring = field.ring
        used = ring.used(poly)
        welcome = set(self._welcome)
        hidden = {
            s for g in used if field.generators[g].kind != "symbol"
            for s in field.generators[g].expression.free_symbols
        }  # fmt: skip
        for position, symbol in enumerate(self._welcome):
            number = field.number_of(symbol)
            if number not in used or symbol in hidden or ring.degree(poly, number) != 1:
                continue
            slope = ring.derivative(poly, number)
            generators = [field.generators[g] for g in ring.used(slope)]
            if any(g.expression.free_symbols & welcome for g in generators):
                continue
            if len(slope) > 1 and not all(g.nonnegative for g in generators):
                continue
            value = field.element(slope * ring.generator(number) - ring.lift(poly), slope)
            sign = int(symbol.is_positive is True and _negative(value))
            cost = (sign, len(value.denominator), value.denominator.total_degree(),
                    len(value.numerator), self._direction * position)  # fmt: skip
            if best is None or cost < best[0]:
                best = (cost, symbol, value)
        return None if best is None else (best[1], field.to_sympy(best[2]))

    def reductions(self, field: Field, element: Element) -> list[Element]:
        """Equal elements on the relations: numerator, denominator or both modulo an ideal.

        The shortest few of them.
        """
        found: list[Element] = []
        for ideal in self._ideals_in(field):
            below = ideal.remainder(element.denominator)
            if below.is_zero():
                continue
            candidates = [ideal.remainder(element.numerator) / below]
            if not element.is_polynomial():
                candidates.append(field.polynomial(element.numerator) / below)
            for each in map(field.lifted, candidates):
                new = (each.numerator, each.denominator)
                if all(new != (x.numerator, x.denominator) for x in map(field.lifted, found)):
                    found.append(each)
        found.sort(key=Element.size)
        return found[:_READ]

    def shortest(self, field: Field, element: Element) -> Element:
        """An equal element of at most half the size, where there is one."""
        best = min((element, *self.reductions(field, element)), key=Element.size)
        return best if 2 * best.size() <= element.size() + 1 else element

    def shorter(self, field: Field, poly: Poly) -> Poly | None:
        """An equal polynomial with fewer terms, None when none was found."""
        best = None
        for ideal in self._ideals_in(field):
            if not ideal.touches(poly):
                continue
            rest = ideal.remainder(poly)
            fewer = len(rest.numerator) < len(poly if best is None else best)
            if fewer and rest.denominator == 1:
                best = rest.numerator
        return best

    def contain(self, field: Field, poly: Poly) -> bool:
        """Whether the polynomial is found to lie in the ideal of the relations."""
        return any(ideal.remainder(poly).is_zero() for ideal in self._ideals_in(field)[:1])

    def _ideals_in(self, field: Field) -> list[Ideal]:
        if not self.remaining:
            return []
        known = self._ideals.get(id(field))
        if known is not None and known[0] is field:
            return known[1]
        polys = [field(e).numerator for e in self.remaining]
        ring = field.ring
        variables = [
            n for n in sorted({g for p in polys for g in ring.used(p)})
            if field.generators[n].kind in ("cos", "sin")
            or field.generators[n].expression in self._welcome
        ]  # fmt: skip
        polys = [ring.lift(p) for p in polys]
        squares = [n for n in variables if any(ring.degree(p, n) > 1 for p in polys)]
        # the ideal of all, and those of single relations: using fewer can leave less
        subsets = [polys, *([p] for p in sorted(polys, key=len) if len(polys) > 1)]
        ideals: list[Ideal] = []
        for subset in subsets:
            within = [n for n in squares or variables if any(ring.degree(p, n) for p in subset)]
            for first in islice(permutations(within), _ORDERS):
                if len(ideals) < _IDEALS:
                    rest = [n for n in reversed(variables) if n not in first]
                    ideals.append(Ideal(field, subset, [*rest, *first]))
        self._ideals = {id(field): (field, ideals)}
        return ideals


def _dynamic(symbols: Sequence[Symbol]) -> list[Symbol]:
    names = {s.name for s in symbols}
    return [s for s in symbols if "'" in s.name or s.name + "'" in names]


def _negative(value: Element) -> bool:
    number = value.rational()
    return number is not None and number <= 0
