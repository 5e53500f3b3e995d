"""Polynomial relations that hold: some are solved and substituted, others reduce.

x − R*theta = 0 gives x → R*theta.  x² + y² − l² = 0 has no such solution; numerators and
denominators are then taken modulo the ideal of the relations (a Gröbner basis of it).
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Sequence
from functools import cached_property
from itertools import islice
from math import gcd
from operator import mul
from typing import TypeAlias

from sympy import Expr, Symbol, count_ops

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ideal import Ideal
from lagcli.algebra.ring import Poly

Exponents: TypeAlias = tuple[int, ...]

_IDEALS = 8  # ideals in all
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
    moving
        Symbols whose value changes, so that nothing is divided by what depends on them.
        Where they are not given, nothing is divided by a function of anything.

    Attributes
    ----------
    solved
        symbol -> expression, for the relations that are linear in a symbol with a
        constant coefficient.
    remaining
        The other relations, solutions substituted.
    """

    def __init__(
        self,
        expressions: Sequence[Expr],
        eliminate: Sequence[Symbol] = (),
        moving: Collection[Symbol] = (),
    ) -> None:
        self.solved: dict[Symbol, Expr] = {}
        self.remaining: list[Expr] = []
        places = {symbol: place for place, symbol in enumerate(moving)}
        symbols = sorted(
            {s for e in expressions for s in e.free_symbols},
            key=lambda s: (places.get(s, -1), s.name),
        )
        #: Without a preference the one that comes last is solved for.
        self._direction = 1 if eliminate else -1
        self._welcome = list(eliminate) or _dynamic(symbols) or symbols
        self._moving = frozenset(moving)
        self._ideals: dict[int, tuple[Field, list[Ideal], Iterator[Ideal]]] = {}
        if not self._add_all(expressions):  # of z - b x + f = 0, f = 0 and z = b x the short ones
            self._add_all(sorted(expressions, key=count_ops))

    def __bool__(self) -> bool:
        return bool(self.solved or self.remaining)

    def substitute(self, expression: Expr) -> Expr:
        """The expression with the solved symbols replaced."""
        if not expression.free_symbols & self.solved.keys():
            return expression
        return expression.xreplace(self.solved)

    def folding(self, field: Field) -> list[tuple[Symbol, Element]]:
        """The solutions whose terms move differently, as R theta' sin(phi) - W*y, by name."""
        moving = {*self._moving, *self._welcome}
        found = []
        for symbol, value in self.solved.items():
            if value.free_symbols & moving:
                element = field(value)
                static = [
                    g for g in field.ring.used(element.numerator)
                    if not field.generators[g].expression.free_symbols & moving
                ]  # fmt: skip
                parts = _by_outside(field, element.numerator, static)
                if sum(len(outside) for outside, _ in parts) > 1:
                    found.append((symbol, element))
        return sorted(found, key=lambda pair: pair[0].name)

    def _add_all(self, expressions: Sequence[Expr]) -> bool:
        """Solve them in turn; False where one is seen to follow from the others."""
        self.solved, self.remaining = {}, []
        new = [self._add(expression) for expression in expressions]
        # a relation that came before the solution of one of its symbols
        for expression in self.remaining[:]:
            if expression.free_symbols & self.solved.keys():
                self.remaining.remove(expression)
                new.append(self._add(expression))
        return all(new)

    def _add(self, expression: Expr) -> bool:
        expression = self.substitute(expression)
        field = Field([expression])
        try:
            relation = field(expression)
        except ZeroDivisionError:
            return True
        if relation.is_zero():
            return False
        found = self._solution(field, relation)
        if found is None:
            rest = field.polynomial_to_sympy(relation.numerator)
            if rest in self.remaining or -rest in self.remaining:
                return False
            self.remaining.append(rest)
            return True
        symbol, value = found
        self.solved = {s: e.xreplace({symbol: value}) for s, e in self.solved.items()}
        self.solved[symbol] = value
        return True

    def _solution(self, field: Field, relation: Element) -> tuple[Symbol, Expr] | None:
        """The most welcome symbol in which the relation is linear, and its value."""
        best: tuple[tuple[int, ...], Symbol, Element] | None = None
        ring, poly = field.ring, relation.numerator
        used = ring.used(poly)
        hidden = {
            s for g in used if field.generators[g].kind != "symbol"
            for s in field.generators[g].expression.free_symbols
        }  # fmt: skip
        for position, symbol in enumerate(self._welcome):
            number = field.number_of(symbol)
            if number not in used or symbol in hidden or ring.degree(poly, number) != 1:
                continue
            slope = ring.derivative(poly, number)
            nonzero = slope == relation.denominator or self._divides(field, slope)
            if not nonzero or self._loses_a_branch(field, poly, number):
                continue
            value = field.element(slope * ring.generator(number) - ring.lift(poly), slope)
            sign = int(symbol.is_positive is True and _negative(value))
            cost = (sign, len(value.denominator), value.denominator.total_degree(),
                    len(value.numerator), self._direction * position)  # fmt: skip
            if best is None or cost < best[0]:
                best = (cost, symbol, value)
        return None if best is None else (best[1], field.to_sympy(best[2]))

    def _loses_a_branch(self, field: Field, poly: Poly, number: int) -> bool:
        """Whether slope*x + rest has a factor without x: where that is 0, x is anything.

        y*(x - 2*y) = 0 is solved by y = 0 as well as by x = 2*y.
        """
        ring = field.ring
        slope = ring.derivative(poly, number)
        rest = ring.lift(poly) - slope * ring.generator(number)
        common = slope if rest == 0 else slope.gcd(rest)
        factor = field.polynomial_to_sympy(common)
        return bool(factor.free_symbols & self._moving) and factor.is_nonzero is not True

    def _divides(self, field: Field, slope: Poly) -> bool:
        """Whether a relation may be divided by this: it is 0 nowhere."""
        generators = [field.generators[g] for g in field.ring.used(slope)]
        varying = {*self._welcome, *self._moving}
        for each in generators:
            symbols = each.expression.free_symbols
            if symbols & varying:
                return False
            if symbols and each.kind != "symbol" and not self._moving:
                return False
        return len(slope) == 1 or all(g.nonnegative for g in generators)

    @cached_property
    def generic(self) -> Generic:
        """The same relations solved for anything, parameters too, that has a slope at all.

        For the decision whether a formula is 0, which generic points make: with d for
        l1 cos a + l2 cos b it is a question about rational functions.
        """
        # velocities before coordinates: these then stay in relations among themselves
        welcome = sorted(
            self._welcome, key=lambda s: sum(s in e.free_symbols for e in self.remaining)
        )
        symbols = {s for e in self.remaining for s in e.free_symbols} - {*welcome}
        order = [*welcome, *sorted(symbols, key=lambda s: s.name)]
        return Generic(self.remaining, order, {*self._moving, *self._welcome})

    def reductions(self, field: Field, element: Element) -> list[Element]:
        """Equal elements on the relations: numerator and denominator modulo an ideal.

        The denominator is 0 on the relations only where that of the element is.  The
        shortest few of them.
        """
        found: list[Element] = []
        for ideal in self._ideals_in(field):
            below = ideal.remainder(element.denominator)
            if below.is_zero():
                continue
            each = field.lifted(ideal.remainder(element.numerator) / below)
            new = (each.numerator, each.denominator)
            if all(new != (x.numerator, x.denominator) for x in map(field.lifted, found)):
                found.append(each)
        found.sort(key=Element.size)
        return found[:_READ]

    def modulo(self, field: Field, poly: Poly) -> list[Element]:
        """The remainders by each ideal that are no longer, shortest first."""
        found = [ideal.remainder(poly) for ideal in self._ideals_in(field) if ideal.touches(poly)]
        found = [each for each in found if len(each.numerator) <= len(poly)]
        return sorted(found, key=Element.size)[:_READ]

    def shared_out(self, field: Field, poly: Poly) -> Poly:
        """An equal polynomial: each coefficient by its remainder where that is shorter.

        Coefficients of the monomials in what a relation does not have in it: so
        (x² + y²)*x'² + y*z'² becomes l²*x'² + y*z'², and no variable is preferred.
        """
        ring = field.ring
        for ideal in sorted(self._ideals_in(field), key=lambda ideal: len(ideal.inside)):
            total = ring.zero
            for outside, inner in _by_outside(field, poly, ideal.inside):
                if len(inner) > 1 and ideal.touches(inner):
                    rest = ideal.remainder(inner)
                    if rest.denominator == 1 and len(rest.numerator) < len(inner):
                        inner = ring.lift(rest.numerator)
                total = total + inner * outside
            poly = total
        return ring.reduce(poly)

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
        for ideal in self._ideals_in(field, 1):
            # coefficient by coefficient of what the relations do not have in them
            parts = _by_outside(field, poly, ideal.inside)
            return all(ideal.remainder(inner).is_zero() for _, inner in parts)
        return False

    def _ideals_in(self, field: Field, count: int = _IDEALS) -> list[Ideal]:
        """The first ideals, made at their first use."""
        if not self.remaining:
            return []
        known = self._ideals.get(id(field))
        if known is None or known[0] is not field:
            self._ideals = {id(field): (field, [], self._ideals_of(field))}
        _, ideals, source = self._ideals[id(field)]
        ideals.extend(islice(source, max(0, count - len(ideals))))
        return ideals[:count]

    def _ideals_of(self, field: Field) -> Iterator[Ideal]:
        polys = [field(e).numerator for e in self.remaining]
        ring = field.ring
        variables = [
            n for n in sorted({g for p in polys for g in ring.used(p)})
            if field.generators[n].kind in ("cos", "sin")
            or field.generators[n].expression in self._welcome
        ]  # fmt: skip
        polys = [ring.lift(p) for p in polys]
        squares = [n for n in variables if any(ring.degree(p, n) > 1 for p in polys)]
        # the ideal of all, of those between the squared ones, of single ones: using fewer can
        # leave less, as x² + y² = l² without x x' + y y' = 0
        pure = [p for p in polys if not ({*variables} - {*squares}) & {*ring.used(p)}]
        subsets = [polys, *([pure] if 1 < len(pure) < len(polys) else [])]
        subsets += [[p] for p in sorted(polys, key=len) if len(polys) > 1]
        for subset in subsets:
            used = {n for p in subset for n in ring.used(p)}
            within = [n for n in squares or variables if n in used]
            orders = [within, within[::-1]] if len(within) > 1 else [within]
            for first in orders:
                rest = [n for n in reversed(variables) if n not in first]
                yield Ideal(field, subset, [*rest, *first])


class Generic(Relations):
    """Relations solved by division by anything that is not identically 0."""

    def vanish(self, field: Field, poly: Poly) -> bool | None:
        """Whether a polynomial is 0 at generic points, by its remainders.

        For y = a/b, sum c_k y^k is 0 where sum c_k a^k b^(K - k) is.  None where a symbol
        that was solved for stands inside a function, or what was divided by is 0 after all.
        """
        ring = field.ring
        try:
            values = [(field.number_of(s), field(value)) for s, value in self.solved.items()]
        except ZeroDivisionError:
            return None
        hidden = {
            s for g in field.generators if g.kind != "symbol" for s in g.expression.free_symbols
        }
        if hidden & self.solved.keys():
            return None
        ideals = self._ideals_in(field, 1)
        solved = [(number, value) for number, value in values if number is not None]
        below = [field.ring.lift(value.denominator) for _, value in solved]
        if any(ideal.remainder(each).is_zero() for ideal in ideals for each in below):
            return None
        inside = {number for number, _ in solved}.union(*(ideal.inside for ideal in ideals))
        for _, value in solved:
            inside.update(ring.used(value.numerator), ring.used(value.denominator))
        inside |= {field.generators[number].partner for number in inside}
        parts = _by_outside(field, poly, inside)
        return all(self._vanishes(field, part, solved, ideals) for _, part in parts)

    def _vanishes(
        self,
        field: Field,
        poly: Poly,
        solved: Sequence[tuple[int, Element]],
        ideals: Sequence[Ideal],
    ) -> bool:
        ring = field.ring
        for number, value in solved:
            for ideal in ideals:
                poly = ring.lift(ideal.remainder(poly).numerator)
            degree = ring.degree(ring.lift(poly), number)
            if degree:
                above, below = ring.lift(value.numerator), ring.lift(value.denominator)
                total = ring.zero
                for power, coefficient in ring.coefficients(poly, number).items():
                    total = total + coefficient * above**power * below ** (degree - power)
                poly = ring.reduce(total)
        return bool(poly == 0) or self.contain(field, poly)

    def _divides(self, field: Field, slope: Poly) -> bool:
        """By anything but a velocity: x x' + y y' = 0 and x y' = y x' leave none that is not 0."""
        used = [field.generators[number] for number in field.ring.used(slope)]
        return not any("'" in g.expression.name for g in used if g.kind == "symbol")


def _by_outside(field: Field, poly: Poly, inside: Container[int]) -> list[tuple[Poly, Poly]]:
    """The polynomial as a sum of products: one in some generators by one in the others.

    The second factors, in the generators `inside`, differ by more than a number.
    """
    ring = field.ring
    within = [int(ring.capacity - 1 - i in inside) for i in range(ring.capacity)]
    without = [1 - each for each in within]
    groups: dict[Exponents, dict[Exponents, int]] = {}
    for exponents, value in ring.lift(poly).to_dict().items():
        group = groups.setdefault(tuple(map(mul, exponents, without)), {})
        group[tuple(map(mul, exponents, within))] = int(value)
    factors: dict[tuple[tuple[Exponents, int], ...], dict[Exponents, int]] = {}
    for outside, terms in groups.items():
        inner = sorted(terms.items())
        number = gcd(*terms.values()) * (1 if inner[0][1] > 0 else -1)
        factor = tuple((exponents, value // number) for exponents, value in inner)
        factors.setdefault(factor, {})[outside] = number
    build = ring.context.from_dict
    return [(build(first), build(dict(second))) for second, first in factors.items()]


def _dynamic(symbols: Sequence[Symbol]) -> list[Symbol]:
    names = {s.name for s in symbols}
    return [s for s in symbols if "'" in s.name or s.name + "'" in names]


def _negative(value: Element) -> bool:
    number = value.rational()
    return number is not None and number <= 0
