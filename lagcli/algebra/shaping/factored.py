"""Polynomials as products of their factors, each in its shortest shape."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from lagcli.algebra.field import FractionField
from lagcli.algebra.ring import Monomial, Poly
from lagcli.algebra.shaping.atoms import Atoms, Exponent, Terms, multiply
from lagcli.algebra.shaping.expansions import Expansions
from lagcli.algebra.shaping.grouping import Grouper, with_squares
from lagcli.algebra.shaping.plan import OPERATION, PlannedProduct, PlannedSum, product, total
from lagcli.algebra.squared_sines import factors_and_sines
from lagcli.algebra.writing import Writer

_MAX_FACTORED = 1500  # terms
#: Operations that a form of a denominator without cos 2x may have more.
_DOUBLE = 4
#: Operations that a sum of sin² and cos² may have more than one of 1 and cos².
_UNEVEN = 4
_FEW = 3  # terms that are also shown without factoring: c² - v²
_CIRCULAR = ("cos", "sin")


class FactoredPolynomials:
    """Plans of polynomials, each made once."""

    def __init__(
        self,
        field: FractionField,
        writer: Writer,
        atoms: Atoms,
        expansions: Expansions,
        grouper: Grouper,
    ) -> None:
        self.field = field
        self.writer = writer
        self.atoms = atoms
        self.expansions = expansions
        self.grouper = grouper
        self._known: dict[tuple[tuple[tuple[Monomial, int], ...], int, bool], PlannedProduct] = {}

    def of(self, poly: Poly, *, below: bool = False) -> PlannedProduct:
        """The plan of a polynomial: its factors, each in its shortest shape."""
        key = tuple(self.field.ring.terms(poly)), len(self.atoms.roots), below
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = self._of_factors(poly, below=below)
        return known

    def _of_factors(self, poly: Poly, *, below: bool) -> PlannedProduct:
        if len(poly) > _MAX_FACTORED:
            return as_product(self.atoms, self.grouper.group(self.atoms.terms(poly)))
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
            whole = as_product(self.atoms, _expanded(self.atoms, self.atoms.terms(poly)))
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
        content, factors, sines = factors_and_sines(self.field, poly)
        factors += [(self.field.ring.generator(s), 2 * pairs) for s, pairs in sines]
        factors = with_squares(factors)
        factors.sort(key=lambda pair: str(pair[0]))
        return content, self._with_double_angles(factors)

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


def _expanded(atoms: Atoms, terms: Terms) -> PlannedSum:
    return total([product(atoms, value, list(term)) for term, value in terms.items()])


def as_product(atoms: Atoms, plan: PlannedProduct | PlannedSum) -> PlannedProduct:
    """A sum as a product of one factor."""
    return plan if isinstance(plan, PlannedProduct) else product(atoms, Fraction(1), [(plan, 1)])
