"""From an element of the field to the shortest of a few readable shapes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from sympy import Expr

from lagcli.algebra.division import commonest_ratio
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Monomial, Poly, factorization
from lagcli.algebra.roots import is_nonnegative
from lagcli.algebra.shaping.atoms import Atoms, Exponent, Term, Terms, multiply
from lagcli.algebra.shaping.expansions import LONG, Expansions
from lagcli.algebra.shaping.factored import FactoredPolynomials, as_product
from lagcli.algebra.shaping.grouping import Grouper
from lagcli.algebra.shaping.plan import (
    PlannedProduct,
    PlannedSum,
    cleared,
    product,
    total,
    write,
)
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression

#: How many times as long N/D may be and still be kept together, where Q + R/D is another way
#: and both have a factor in common: (M + m) g sin²α/(M + m sin²α), not g − M g cos²α/(…).
_TOGETHER = 1.35
#: Twice the terms of a numerator that is kept together although a number could be taken out.
_TOGETHER_TERMS = 8
#: How many times as long the velocities may be apart where a sum below cancels.
_APART = 1.1
#: Operations that sqrt((r² - k²) B)/(r² - k²) may have more than sqrt((r - k) B/(r + k))/(r - k).
_OWN_ROOT = 2


class Shaper:
    """Writes elements of one field with one writer.

    Parameters
    ----------
    scaled
        Whether sqrt(f/d²) is kept where it was put in so, instead of sqrt(f)/d.
    shorter
        Gives an equal polynomial with fewer terms where relations allow one.
    """

    def __init__(
        self,
        field: Field,
        writer: Writer,
        *,
        scaled: bool = False,
        shorter: Callable[[Poly], Poly | None] | None = None,
    ) -> None:
        self.field = field
        self.writer = writer
        self.scaled = scaled
        self.atoms = Atoms(field, writer, self.shape, scaled=scaled)
        self.expansions = Expansions(field, self.atoms)
        self.grouper = Grouper(self.atoms, shorter)
        self.factored = FactoredPolynomials(
            field, writer, self.atoms, self.expansions, self.grouper
        )

    def shape(self, element: Element) -> Expression:
        """The tree of an element."""
        return self.written(self.plan(element))

    def written(self, plan: PlannedProduct | PlannedSum) -> Expression:
        """The tree of a plan made here."""
        return write(plan, self.atoms, self.writer)

    def to_sympy(self, tree: Expression) -> Expr:
        """The SymPy expression of a tree made here."""
        return self.atoms.to_sympy(tree)

    def plan(self, element: Element, *, divide: bool = True) -> PlannedProduct | PlannedSum:
        """The cheapest plan; `divide` allows Q + R/D."""
        element = self.field.lifted(element)
        if element.is_zero():
            return product(self.atoms, Fraction(0), [])
        for index in self.field.ring.used(element.numerator):
            self.atoms.generator(index)  # so that the radicands are known
        above = self.factored.of(element.numerator)
        below = self.factored.of(element.denominator, below=True)
        best: PlannedProduct | PlannedSum = self._joined(above, below)
        ways = (self._by_roots, self._by_powers, self._by_poles) if divide else ()
        apart = (candidate for way in ways for candidate in way(element))
        for candidate in (*self._spread(element, below), *apart):
            if candidate.score < best.score:
                best = candidate
        for candidate in self._over_own_root(element):
            if candidate.cost <= best.cost + _OWN_ROOT:
                best = candidate
        for candidate, shorter in self._divided(element) if divide else ():
            worth = shorter or candidate.cost < best.cost
            if candidate.score < best.score and worth and not self._alike(candidate, best):
                best = candidate
        fast = self._by_velocities(element) if divide else ()
        shortest = min(fast, key=lambda each: each.score, default=best)
        return shortest if shortest.cost <= _APART * best.cost else best

    @staticmethod
    def _alike(candidate: PlannedProduct | PlannedSum, whole: PlannedProduct | PlannedSum) -> bool:
        """Whether Q and R/D share a factor, or Q and a term of R, and N/D is not much longer."""
        if not isinstance(candidate, PlannedSum) or candidate.cost * _TOGETHER < whole.cost:
            return False
        shared = [{p for p, _ in term.parts} for term in candidate.terms]
        if set.intersection(*shared):
            return True
        inside = [
            {p for p, _ in term.parts}
            for parts in shared
            for bracket in parts
            if isinstance(bracket, PlannedSum)
            for term in bracket.terms
        ]
        return any(parts and any(parts < term for term in inside) for parts in shared)

    def _by_roots(self, element: Element) -> Iterator[PlannedSum]:
        """A/r_1^3 + B/r_2^3: the parts of the numerator with different roots apart.

        A root that the denominator holds as well may belong to a common factor.
        """
        if element.is_polynomial() or self._is_root_of_quadratic(element):
            return
        kinds = self.field.generators
        used = self.field.ring.used
        roots = {g for g in used(element.numerator) if kinds[g].kind == "root"}
        outside = roots.difference(used(element.denominator))
        for apart in (roots, outside) if outside != roots else (roots,):
            groups: dict[Monomial, list[tuple[Monomial, int]]] = {}
            for monomial, coefficient in self.field.ring.terms(element.numerator):
                key = tuple(pair for pair in monomial if pair[0] in apart)
                groups.setdefault(key, []).append((monomial, coefficient))
            if len(groups) > 1:
                yield self.together(
                    self.field.element(self.field.ring.build(terms), element.denominator)
                    for terms in groups.values()
                )

    def _by_powers(self, element: Element) -> Iterator[PlannedSum]:
        """A/f^7 - B/f^13: the numerator in powers of a sum below, where that is shorter."""
        field, above = self.field, element.numerator
        for factor, exponent in factorization(element.denominator)[1]:
            if len(factor) < 2 or exponent < 2 or len(above) < 2:
                continue
            digits: list[Poly] = []
            rest = above
            while rest != 0 and len(digits) < exponent:
                rest, digit = divmod(rest, factor)
                digits.append(digit)
            if len(rest) + sum(map(len, digits)) < len(above):
                below = [element.denominator / factor**k for k in range(len(digits) + 1)]
                pairs = zip([*digits, rest], below, strict=True)
                yield self.together(field.element(n, d) for n, d in pairs if n != 0)

    def _by_poles(self, element: Element) -> Iterator[PlannedProduct]:
        """g (1/(x − y)² + 1/(y − z)²): partial fractions, each pole f = x − a(y, …) alone."""
        ring, field = self.field.ring, self.field
        factors = [*factorization(element.denominator)[1]]
        poles = [(f, e, *pole) for f, e in factors if (pole := self._pole(f))]
        if len(poles) < 2:
            return
        below = ring.one
        for f, exponent, *_ in poles:
            below *= f**exponent
        content = element.numerator.term_content()
        sums = [f for f, _ in factorization(element.numerator)[1] if len(f) > 1]
        for common in (content, *(content * f for f in sums)):
            parts = self._at_poles(element.numerator / common, below, poles)
            if parts is not None:
                outside = field.element(common, element.denominator / below)
                front = as_product(self.atoms, self.plan(outside, divide=False))
                apart = [*front.parts, (self.together(parts), 1)]
                yield product(self.atoms, front.coefficient, apart)

    def _at_poles(
        self, above: Poly, below: Poly, poles: Iterable[tuple[Poly, int, int, Poly]]
    ) -> list[Element] | None:
        """N/(f^k D) at x = a is (N/D)(x = a)/f^k; None where that is no polynomial over f^k."""
        ring, field = self.field.ring, self.field
        parts: list[Element] = []
        for f, exponent, x, place in poles:
            numerator = ring.zero
            for power in range(exponent, 0, -1):
                rest = below / f**power
                top, bottom = (ring.compose(p, {x: place}) for p in (above, rest))
                at_pole, remainder = divmod(top, bottom)
                if remainder != 0:
                    return None
                numerator += at_pole * f ** (exponent - power)
                above, below = (above - at_pole * rest) / f, below / f
            if numerator != 0:
                parts.append(field.element(numerator, f**exponent))
        return parts if above == 0 else [*parts, field.polynomial(above)]

    def _pole(self, factor: Poly) -> tuple[int, Poly] | None:
        """x and a of a factor ±(x − a) of letters alone."""
        ring = self.field.ring
        used = ring.used(factor)
        if len(factor) < 2 or any(self.field.generators[g].kind != "symbol" for g in used):
            return None
        for g in used:
            slope = ring.derivative(factor, g)
            if slope in (ring.one, -ring.one):
                return g, ring.generator(g) - factor / slope
        return None

    def _by_velocities(self, element: Element) -> Iterator[PlannedProduct | PlannedSum]:
        """M r'²/(r (r − 2 M)) + (r − 2 M) φ'²: the velocities apart where a sum cancels.

        What all of them have in common is in each, or in front.
        """
        ring, field = self.field.ring, self.field
        moving = {g for g in ring.used(element.numerator) if self._is_velocity(g)}
        if not moving or not _sums_of(element.denominator):
            return
        groups: dict[Monomial, list[tuple[Monomial, int]]] = {}
        for monomial, coefficient in ring.terms(element.numerator):
            key = tuple(pair for pair in monomial if pair[0] in moving)
            groups.setdefault(key, []).append((monomial, coefficient))
        apart: dict[frozenset[tuple[str, int]], Element] = {}  # by the sums below
        for terms in groups.values():
            part = field.lifted(field.element(ring.build(terms), element.denominator))
            below = _sums_of(part.denominator)
            apart[below] = apart[below] + part if below in apart else part
        if len(apart) < 2:
            return
        yield self.together(apart.values())
        common = field.polynomial(element.numerator.term_content())
        if common.rational() is None:
            outside = self.factored.of(common.numerator)
            inner = self.together(each / common for each in apart.values())
            yield product(self.atoms, outside.coefficient, [*outside.parts, (inner, 1)])

    def _is_velocity(self, index: int) -> bool:
        generator = self.field.generators[index]
        return generator.kind == "symbol" and generator.expression.name.endswith("'")

    def together(self, elements: Iterable[Element]) -> PlannedSum:
        """The sum of the plans of each."""
        parts: list[PlannedProduct] = []
        for each in elements:
            plan = self.plan(each, divide=False)
            parts.extend(plan.terms if isinstance(plan, PlannedSum) else (plan,))
        return total(parts)

    def _divided(self, element: Element) -> Iterator[tuple[PlannedProduct | PlannedSum, bool]]:
        """N/D = Q + R/D for a factor D of the denominator, and whether it has fewer terms.

        What all of N has in common stays in front of the sum, or is multiplied into it.
        """
        if not 2 <= len(element.numerator) <= LONG:
            return
        divisors = [f**e for f, e in factorization(element.denominator)[1] if len(f) > 1]
        if not divisors:
            return
        common = element.numerator.term_content()
        primitive = element.numerator / common
        for divisor in divisors:
            for quotient, remainder, shorter in self._quotients(element.numerator, divisor):
                yield self._sum_of(quotient, remainder, divisor, element.denominator), shorter
            if common.is_constant():
                continue
            for quotient, remainder, shorter in self._quotients(primitive, divisor):
                if quotient.is_constant() and 2 * len(primitive) <= _TOGETHER_TERMS:
                    continue  # (a - b)/(a + b), not 1 - 2 b/(a + b)
                inner = self._sum_of(quotient, remainder, divisor, element.denominator)
                outside = self.factored.of(common)
                parts = [*outside.parts, (inner, 1)]
                yield product(self.atoms, outside.coefficient, parts), shorter

    def _sum_of(
        self, quotient: Poly, remainder: Poly, divisor: Poly, denominator: Poly
    ) -> PlannedSum:
        """Q D/denominator + R/denominator."""
        element = self.field.element
        return self.together(
            (element(quotient, denominator / divisor), element(remainder, denominator))
        )

    def _quotients(self, numerator: Poly, divisor: Poly) -> Iterator[tuple[Poly, Poly, bool]]:
        """Q and R with N = Q D + R, neither 0, and whether together they are shorter than N.

        At most one term longer: (2 a x'² - 4 g a² x²)/D = (2 a x'² + g)/D - g.
        """
        found = [divmod(numerator, divisor)]
        ratio = commonest_ratio(self.field.ring, numerator, divisor)
        if ratio is not None and ratio != found[0][0]:
            found.append((ratio, numerator - ratio * divisor))
        for quotient, rest in found:
            terms = len(quotient) + len(rest)
            if quotient != 0 and rest != 0 and terms <= len(numerator) + 1:
                yield quotient, rest, terms < len(numerator)

    def _joined(self, above: PlannedProduct, below: PlannedProduct) -> PlannedProduct:
        inverse = [(p, -e) for p, e in below.parts]
        over_sum = any(isinstance(p, PlannedSum) for p, _ in below.parts)
        number = Fraction(above.coefficient) / below.coefficient
        exponents: dict[int, Exponent] = {}
        sums: list[tuple[int | PlannedSum, Exponent]] = []
        for part, exponent in [*above.parts, *inverse]:
            if isinstance(part, int):
                exponents[part] = exponents.get(part, 0) + exponent
                continue
            if over_sum and isinstance(exponent, int):
                factor, part = cleared(self.atoms, part)
                number *= factor**exponent
            sums.append((part, exponent))
        parts: list[tuple[int | PlannedSum, Exponent]] = [
            *((a, e) for a, e in sorted(exponents.items()) if e), *sums
        ]  # fmt: skip
        return product(self.atoms, number, parts)

    def _over_own_root(self, element: Element) -> Iterator[PlannedProduct]:
        """sqrt(A B)/(a B) for sqrt(A/B)/a, where a is a factor of A."""
        field, ring = self.field, self.field.ring
        roots = [
            g
            for g, _ in next(ring.terms(element.numerator.term_content()))[0]
            if field.generators[g].kind == "root" and field.generators[g].index == 2
        ]
        radicands = [ring.lift(field.generators[g].radicand) for g in roots]
        shared = [radicand.gcd(element.denominator) for radicand in radicands]
        if len(roots) < 2 or any(each.is_constant() for each in shared):
            return
        if sum(not is_nonnegative(field, each) for each in radicands) > 1:
            return
        rest, inside, common = element.numerator, ring.one, ring.one
        for g, radicand, each in zip(roots, radicands, shared, strict=True):
            rest, inside, common = rest / ring.generator(g), inside * radicand, common * each
        if (inside / common).is_constant():
            return  # 1/sqrt(A)
        known, self.atoms.roots = self.atoms.roots, []
        factors = [self.factored.of(common), self.factored.of(inside / common)]
        trees = [(self.written(each), Fraction(1)) for each in factors]
        above, below = self.factored.of(rest), self.factored.of(element.denominator, below=True)
        self.atoms.roots = known
        root = self.atoms.add(self.writer.product(Fraction(1), trees)), Fraction(1, 2)
        plan = self._joined(above, below)
        yield product(self.atoms, plan.coefficient, [root, *plan.parts])

    def _spread(
        self, element: Element, below: PlannedProduct
    ) -> Iterator[PlannedProduct | PlannedSum]:
        """Terms with denominators of their own, where these are products of atoms."""
        divisors = [(p, -e) for p, e in below.parts if isinstance(p, int)]
        if (
            len(divisors) < len(below.parts)
            or not divisors
            or not 2 <= len(element.numerator) <= LONG
            or self._is_root_of_quadratic(element)
        ):
            return
        divisor = tuple(sorted(divisors))
        for terms in self.expansions.of(element.numerator):
            divided: Terms = {
                multiply(term, divisor): Fraction(value) / below.coefficient
                for term, value in terms.items()
                if value  # powers of roots that are equal have cancelled
            }
            if not divided:
                continue
            yield self.grouper.group(divided, spread=True)
            below_each: dict[Term, Terms] = {}
            for term, value in divided.items():
                under = tuple(pair for pair in term if pair[1] < 0)
                below_each.setdefault(under, {})[term] = value
            content = self.atoms.terms(element.numerator.term_content())
            known = [all(self.atoms.is_known(a) for t in x for a, _ in t) for x in (content, terms)]
            # k (x − y)/(m l²) − g sin x/l, but k (l² − h²)/(m l²) and (1 − 2 M/r) s'
            if len(below_each) > 1 and known[0] and (not known[1] or content.keys() == {()}):
                parts = [self.grouper.group(each, spread=True) for each in below_each.values()]
                yield total([as_product(self.atoms, part) for part in parts])

    def _is_root_of_quadratic(self, element: Element) -> bool:
        """Whether N is b + sqrt(b² - a c), of letters at rest, which stays over one denominator."""
        kinds = [self.field.generators[g] for g in self.field.ring.used(element.numerator)]
        roots = [each for each in kinds if each.kind == "root"]
        letters = [each for each in kinds if each not in roots]
        if len(roots) != 1 or any(each.kind != "symbol" for each in letters):
            return False
        if any(self._is_fast(each.expression.name) for each in letters):
            return False
        radicand = self.field.ring.lift(roots[0].radicand)
        return len(radicand) > 1 and self.field.quotient(element.denominator, radicand) is None

    @staticmethod
    def _is_fast(name: str) -> bool:
        return name.endswith("'") or name.startswith("p_")


def _sums_of(poly: Poly) -> frozenset[tuple[str, int]]:
    """The factors of more than one term, with their exponents."""
    return frozenset((str(f), int(e)) for f, e in factorization(poly)[1] if len(f) > 1)
