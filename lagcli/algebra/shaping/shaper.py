"""From an element of the field to the shortest of a few readable shapes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction

from sympy import Expr

from lagcli.algebra.division import commonest_ratio
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.ring import Monomial, Poly, factorization
from lagcli.algebra.shaping.atoms import Atoms, Exponent, Term, Terms, multiply
from lagcli.algebra.shaping.expansions import LONG, Expansions
from lagcli.algebra.shaping.grouping import Grouper, with_squares
from lagcli.algebra.shaping.plan import (
    OPERATION,
    PlannedProduct,
    PlannedSum,
    cleared,
    product,
    total,
    write,
)
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression

_MAX_FACTORED = 1500  # terms
#: How many times as long N/D may be and still be kept together, where Q + R/D is another way
#: and both have a factor in common: (M + m) g sin²α/(M + m sin²α), not g − M g cos²α/(…).
_TOGETHER = 1.35
#: Twice the terms of a numerator that is kept together although a number could be taken out.
_TOGETHER_TERMS = 8
#: Operations that a form of a denominator without cos 2x may have more.
_DOUBLE = 4
#: Operations that a sum of sin² and cos² may have more than one of 1 and cos².
_UNEVEN = 4
#: How many times as long the velocities may be apart where a sum below cancels.
_APART = 1.1
_FEW = 3  # terms that are also shown without factoring: c² - v²

_CIRCULAR = ("cos", "sin")


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
        self._known: dict[tuple[tuple[tuple[Monomial, int], ...], int, bool], PlannedProduct] = {}
        self.atoms = Atoms(field, writer, self.shape, scaled=scaled)
        self.expansions = Expansions(field, self.atoms)
        self.grouper = Grouper(self.atoms, shorter)

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
        above = self._factors(element.numerator)
        below = self._factors(element.denominator, below=True)
        best: PlannedProduct | PlannedSum = self._joined(above, below)
        apart = (*self._by_roots(element), *self._by_powers(element)) if divide else ()
        for candidate in (*self._spread(element, below), *apart):
            if candidate.score < best.score:
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
        if element.is_polynomial():
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
            outside = self._factors(common.numerator)
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
                outside = self._factors(common)
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

    def _spread(
        self, element: Element, below: PlannedProduct
    ) -> Iterator[PlannedProduct | PlannedSum]:
        """Terms with denominators of their own, where these are products of atoms."""
        divisors = [(p, -e) for p, e in below.parts if isinstance(p, int)]
        if (
            len(divisors) < len(below.parts)
            or not divisors
            or not 2 <= len(element.numerator) <= LONG
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
                yield total([_as_product(self.atoms, part) for part in parts])

    # -- polynomials ----------------------------------------------------------------------

    def _factors(self, poly: Poly, *, below: bool = False) -> PlannedProduct:
        """The plan of a polynomial: its factors, each in its shortest shape."""
        key = tuple(self.field.ring.terms(poly)), len(self.atoms.roots), below
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._of_factors(poly, below=below)
        return known

    def _of_factors(self, poly: Poly, *, below: bool) -> PlannedProduct:
        if len(poly) > _MAX_FACTORED:
            return _as_product(self.atoms, self.grouper.group(self.atoms.terms(poly)))
        parts: dict[int | PlannedSum, Exponent] = {}
        for radicand, term in self.atoms.roots:
            # c² - v² = (c - v)(c + v) is not split where its root occurs
            divisor = self.field.ring.lift(radicand)
            while (rest := self._over(poly, divisor)) is not None:
                poly = rest
                for atom, each in term:
                    parts[atom] = parts.get(atom, 0) + each
        content, factors = self._factored(poly)
        number = Fraction(int(content))
        cosines = self._parameter_cosines(factors)
        for factor, exponent in factors:
            plan = self._polynomial(factor, below=below)
            for cosine, power in cosines.items() if exponent == 1 else ():
                degree, other = self._by_tangent(factor, cosine)
                if degree and other.cost + (power == 1) < plan.cost:
                    plan = other
                    ((atom, _),) = self.atoms.generator(cosine)
                    parts[atom] = parts.get(atom, 0) + degree
            if isinstance(plan, PlannedSum):
                parts[plan] = parts.get(plan, 0) + int(exponent)
                continue
            number *= plan.coefficient ** int(exponent)
            for part, each in plan.parts:
                parts[part] = parts.get(part, 0) + each * int(exponent)
        factored = product(self.atoms, number, [(p, e) for p, e in parts.items() if e])
        alone = abs(number) == 1 and not any(isinstance(p, int) for p in parts)
        if 1 < len(poly) <= _FEW and alone and sum(e for _, e in factors) > 1:
            whole = _as_product(self.atoms, _expanded(self.atoms, self.atoms.terms(poly)))
            if whole.cost <= factored.cost:
                return whole
        return factored

    def _over(self, poly: Poly, divisor: Poly) -> Poly | None:
        """The quotient, where there is no rest."""
        quotient, rest = divmod(poly, divisor)
        return quotient if rest == 0 else self.field.quotient(poly, divisor)

    def _parameter_cosines(self, factors: Sequence[tuple[Poly, int]]) -> dict[int, int]:
        """The cosines of parameters among the factors, with their powers."""
        generators = self.field.generators
        found = {}
        for factor, exponent in factors:
            (number, *more) = self.field.ring.used(factor)
            if len(factor) == 1 and not more and generators[number].kind == "cos":
                tree = self.atoms.trees[self.atoms.generator(number)[0][0]]
                if self.writer.ordering.is_parameter(tree):
                    found[number] = exponent
        return found

    def _by_tangent(self, poly: Poly, cosine: int) -> tuple[int, PlannedProduct | PlannedSum]:
        """g cos + a sin as (1, g + a tan): the degree d in both and the rest of cos^d.

        The degree is 0 where the terms differ in it.
        """
        degrees, sine = set(), self.field.generators[cosine].partner
        angles = ((cosine, 1),)
        terms: Terms = {}
        for monomial, value in self.field.ring.terms(poly):
            powers = {g: e for g, e in monomial if g in (cosine, sine)}
            degrees.add(sum(powers.values()))
            rest = self.atoms.term(tuple(pair for pair in monomial if pair[0] not in powers))
            tangent = (
                ((self.atoms.circular("tan", angles), powers[sine]),) if sine in powers else ()
            )
            terms[multiply(rest, tangent)] = value
        degree = degrees.pop()
        if degrees or len(terms) < 2:
            return 0, product(self.atoms, Fraction(0), [])
        return degree, self.grouper.group(terms)

    def _factored(self, poly: Poly) -> tuple[int, list[tuple[Poly, int]]]:
        """Irreducible factors; (1 - cos)(1 + cos) is joined to sin², so is cosh² - 1."""
        content, factors = factorization(poly)
        factors = [(f, int(e)) for f, e in factors]
        ring = self.field.ring
        for index in ring.used(poly):
            generator = self.field.generators[index]
            if generator.kind not in ("cos", "cosh"):
                continue
            cosine = ring.generator(index)
            exponents = {
                sign: next((e for f, e in factors if f == cosine - sign), 0) for sign in (1, -1)
            }
            pairs = min(exponents.values())
            if not pairs:
                continue
            # (cos - 1)(cos + 1) = -sin²
            if generator.kind == "cos":
                content = int(content) * (-1) ** pairs
            kept = []
            for f, e in factors:
                if f == cosine - 1 or f == cosine + 1:
                    e -= pairs
                if e:
                    kept.append((f, e))
            factors = [*kept, (ring.generator(generator.partner), 2 * pairs)]
        factors = with_squares(factors)
        factors.sort(key=lambda pair: str(pair[0]))
        return int(content), self._with_double_angles(factors)

    def _with_double_angles(self, factors: list[tuple[Poly, int]]) -> list[tuple[Poly, int]]:
        """Sines and cosines joined to one factor where that is shorter: 2 sin cos = sin(2a)."""
        kinds = self.field.generators
        used = self.field.ring.used
        single = [(f, e) for f, e in factors if len(f) == 1 and kinds[used(f)[0]].kind in _CIRCULAR]
        if len(single) < 2:
            return factors
        joined = self.field.ring.one
        for f, e in single:
            joined *= f**e
        plain = self.grouper.group(self.atoms.terms(joined))
        best = self._polynomial(joined)
        if not isinstance(best, PlannedProduct) or best.cost >= plain.cost:
            return factors
        return [*(pair for pair in factors if pair not in single), (joined, 1)]

    def _polynomial(self, poly: Poly, *, below: bool = False) -> PlannedProduct | PlannedSum:
        """The shortest plan of an irreducible polynomial, its sign left to the product.

        Below a fraction 7 + 9 sin² x comes before 23 - 9 cos 2x.
        """
        best, doubled = self._bracketed(poly)
        return self._bracketed(poly, below=True)[0] if below and doubled else best

    def _bracketed(
        self, poly: Poly, *, below: bool = False
    ) -> tuple[PlannedProduct | PlannedSum, bool]:
        """The shortest plan, and whether there are cosines of multiples in it."""
        best: PlannedProduct | PlannedSum | None = None
        lowest, doubled = 0, False
        forms = self.expansions.of(poly, below=below)
        fewest = min(map(len, forms))
        for terms in forms:
            plan = self.grouper.group(terms)
            if isinstance(plan, PlannedSum):
                turned = plan.negated()
                score = min(plan.score, turned.score)
                score += OPERATION * plan.fractional  # its number below doubles the other terms
                if turned.score < plan.score:
                    plan = PlannedProduct(
                        Fraction(-1), ((turned, 1),), turned.cost + 1, turned.cost
                    )
            else:  # its sign goes to the whole product, as that of a sum does
                score = plan.score - OPERATION * (plan.coefficient < 0)
            # I1 + (I3 - I1) cos², which is I1 sin² + I3 cos²
            if len(terms) > fewest and terms == self.atoms.terms(poly):
                score += _UNEVEN * OPERATION
            multiple = self.atoms.has_double_angle(terms)
            if below and multiple:
                score += _DOUBLE * OPERATION
            if best is None or score < lowest:
                best, lowest, doubled = plan, score, multiple
        assert best is not None
        return best, doubled


def _sums_of(poly: Poly) -> frozenset[tuple[str, int]]:
    """The factors of more than one term, with their exponents."""
    return frozenset((str(f), int(e)) for f, e in factorization(poly)[1] if len(f) > 1)


def _expanded(atoms: Atoms, terms: Terms) -> PlannedSum:
    return total([product(atoms, value, list(term)) for term, value in terms.items()])


def _as_product(atoms: Atoms, plan: PlannedProduct | PlannedSum) -> PlannedProduct:
    return plan if isinstance(plan, PlannedProduct) else product(atoms, Fraction(1), [(plan, 1)])
