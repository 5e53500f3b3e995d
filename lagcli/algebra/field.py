"""The fraction field of a ring with rules: elements and their arithmetic.

An element is numerator / denominator, both reduced by the rules (sin² = 1 − cos²,
root^q = radicand), without a common polynomial factor, the denominator's leading
coefficient positive.  Zero has exactly one such form.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import inf

from sympy import Expr

from lagcli.algebra.ring import Poly, Ring
from lagcli.platform.effort import EFFORT
from lagcli.record import field, record


@record
class Generator:
    """What a generator of the field stands for.

    `kind` is symbol, cos, sin, cosh, sinh, exp, power, root, abs, sign or opaque; `partner`
    is the sine of a cosine and the other way round; `argument` the argument of which
    the angles are integer multiples; `index` and `radicand` belong to a root.
    """

    kind: str
    expression: Expr
    argument: Expr | None = None
    partner: int = -1
    index: int = 0
    radicand: Poly | None = None
    nonnegative: bool = False


@record
class Element:
    """numerator / denominator of a field."""

    field: FractionField = field(repr=False)
    numerator: Poly
    denominator: Poly

    def __add__(self, other: Element) -> Element:
        return self.field.sum((self, other))

    def __sub__(self, other: Element) -> Element:
        return self.field.sum((self, -other))

    def __neg__(self) -> Element:
        return Element(self.field, -self.numerator, self.denominator)

    def __mul__(self, other: Element) -> Element:
        field = self.field
        lift = field.ring.lift
        a, b = lift(self.numerator), lift(self.denominator)
        c, d = lift(other.numerator), lift(other.denominator)
        if not b.is_constant() or not d.is_constant():
            # gcd before the product keeps both small
            left, right = a.gcd(d), c.gcd(b)
            a, d, c, b = a / left, d / left, c / right, b / right
        return field.element(a * c, b * d)

    def __truediv__(self, other: Element) -> Element:
        return self * other.inverse()

    def __pow__(self, exponent: int) -> Element:
        if exponent < 0:
            return self.inverse() ** -exponent
        field = self.field
        lift = field.ring.lift
        return field.element(lift(self.numerator) ** exponent, lift(self.denominator) ** exponent)

    def inverse(self) -> Element:
        """1 / self; ZeroDivisionError for zero."""
        return self.field.element(self.denominator, self.numerator)

    def is_zero(self) -> bool:
        """Whether the normal form is 0."""
        return bool(self.numerator == 0)

    def is_one(self) -> bool:
        """Whether the normal form is 1."""
        return bool(self.numerator == self.denominator)

    def is_polynomial(self) -> bool:
        """Whether the denominator is an integer."""
        return bool(self.denominator.is_constant())

    def rational(self) -> Fraction | None:
        """The value of a rational constant, None for anything else."""
        if not (self.numerator.is_constant() and self.denominator.is_constant()):
            return None
        zero = self.numerator == 0
        top = 0 if zero else int(self.numerator.leading_coefficient())
        return Fraction(top, int(self.denominator.leading_coefficient()))

    def size(self) -> int:
        """The number of terms above and below: the cost of computing with it."""
        return len(self.numerator) + len(self.denominator)


def common_denominator(
    field: FractionField, elements: Iterable[Element], most: float = inf
) -> Poly:
    """The least common multiple of the denominators.

    Raises
    ------
    OverflowError
        Where it might have more than `most` terms.
    """
    lift = field.ring.lift
    common = field.ring.one
    for each in elements:
        below = lift(each.denominator)
        if len(common) * len(below) > most:
            raise OverflowError
        common = lift(common) * (below / lift(common).gcd(below))
    return common


def over_common_denominator(
    field: FractionField, elements: Sequence[Element], most: float = inf
) -> list[Poly]:
    """The numerators of the elements over the least common multiple of their denominators.

    Raises
    ------
    OverflowError
        Where that might have more than `most` terms.
    """
    ring, common = field.ring, common_denominator(field, elements, most)
    return [
        ring.reduce(ring.lift(e.numerator) * (ring.lift(common) / ring.lift(e.denominator)))
        for e in elements
    ]


class FractionField:
    """Q(g0, g1, …) modulo its ring's rules; `lagcli.algebra.entry.Field` gives it generators."""

    def __init__(self, capacity: int = 8) -> None:
        self.ring = Ring(capacity)
        self.generators: list[Generator] = []
        #: Some generators may depend on each other in ways that no rule tells.
        self.doubtful = False
        self.has_roots = False
        #: Root -> d, where sqrt(f/d²) was put in and became sqrt(f)/d.
        self.root_scales: dict[int, Poly] = {}
        #: Root -> its radicand as it was put in.
        self.radicands: dict[int, Expr] = {}

    def add_generator(self, generator: Generator) -> int:
        """Add a generator; its number is returned."""
        self.generators.append(generator)
        self.has_roots |= generator.kind == "root"
        return self.ring.add()

    def element(self, numerator: Poly, denominator: Poly) -> Element:
        """The normal form of numerator / denominator."""
        ring = self.ring
        EFFORT.fraction(len(numerator), len(denominator))
        numerator, denominator = ring.reduce(numerator), ring.reduce(denominator)
        if denominator == 0:
            raise ZeroDivisionError
        if numerator == 0:
            return Element(self, ring.zero, ring.one)
        if denominator != 1:
            common = numerator.gcd(denominator)
            if common != 1:
                numerator, denominator = numerator / common, denominator / common
            if self.has_roots:
                numerator, denominator = self._without_roots(numerator, denominator)
                numerator, denominator = self._divided(numerator, denominator)
            if denominator.leading_coefficient() < 0:
                numerator, denominator = -numerator, -denominator
        return Element(self, numerator, denominator)

    def _without_roots(self, numerator: Poly, denominator: Poly) -> tuple[Poly, Poly]:
        """1/root^k = root^(q - k)/radicand, so that each has one form."""
        ring = self.ring
        for index in ring.used(denominator):
            generator = self.generators[index]
            if generator.kind != "root":
                continue
            root = ring.generator(index)
            power = 0
            while denominator % root == 0:
                denominator, power = denominator / root, power + 1
            if power:
                numerator = ring.reduce(numerator * root ** (generator.index - power))
                denominator = ring.reduce(denominator * ring.lift(generator.radicand))
                common = numerator.gcd(denominator)
                numerator, denominator = numerator / common, denominator / common
        return numerator, denominator

    def _divided(self, numerator: Poly, denominator: Poly) -> tuple[Poly, Poly]:
        """N/D as Q/c where N c = Q D by the rules."""
        ring = self.ring
        if any(g in ring.rules for g in ring.used(denominator)):
            content = denominator.content()
            quotient = self.quotient(numerator, denominator / content)
            if quotient is not None:
                return quotient, ring.constant(int(content))
        return numerator, denominator

    def quotient(self, numerator: Poly, denominator: Poly) -> Poly | None:
        """Q with N = Q D by the rules, which hide the factor: N is reduced; None without one.

        D is monic in a generator that no rule of its other generators knows, so that the
        quotient in the powers of that generator is unique.
        """
        ring = self.ring
        used = ring.used(denominator)
        bound = {g for each in used if each in ring.rules for g in ring.used(ring.rules[each][1])}
        for index in used:
            degree = ring.degree(denominator, index)
            if index in bound or ring.degree(numerator, index) < degree:
                continue
            leading = ring.coefficients(denominator, index)[degree]
            if leading not in (1, -1):
                continue
            quotient, rest = ring.zero, numerator
            while rest != 0 and (power := ring.degree(rest, index)) >= degree:
                part = ring.coefficients(rest, index)[power] * leading
                part = part * ring.generator(index) ** (power - degree)
                quotient, rest = quotient + part, ring.reduce(rest - part * denominator)
            return quotient if rest == 0 else None
        return None

    def rational(self, value: Fraction | int) -> Element:
        """The element of a rational number."""
        ring = self.ring
        return Element(self, ring.constant(value.numerator), ring.constant(value.denominator))

    def generator(self, index: int) -> Element:
        """The element g_index."""
        return Element(self, self.ring.generator(index), self.ring.one)

    def polynomial(self, poly: Poly) -> Element:
        """The element of a polynomial."""
        return Element(self, self.ring.reduce(poly), self.ring.one)

    def lifted(self, element: Element) -> Element:
        """The same element in the ring's present context."""
        lift = self.ring.lift
        return Element(self, lift(element.numerator), lift(element.denominator))

    def sum(self, elements: Iterable[Element]) -> Element:
        """The sum; terms over equal denominators are added first."""
        ring = self.ring
        groups: list[list[Poly]] = []  # [denominator, numerator]
        for each in elements:
            denominator, numerator = ring.lift(each.denominator), ring.lift(each.numerator)
            for group in groups:
                if group[0] == denominator:
                    group[1] = group[1] + numerator
                    break
            else:
                groups.append([denominator, numerator])
        if not groups:
            return self.rational(0)
        groups.sort(key=lambda group: (len(group[0]), group[0].total_degree()))
        below, above = groups[0]
        for denominator, numerator in groups[1:]:
            common = below.gcd(denominator)
            rest = denominator / common
            above = above * rest + numerator * (below / common)
            below = below * rest
        return self.element(above, below)

    def product(self, elements: Iterable[Element]) -> Element:
        """The product."""
        result = self.rational(1)
        for each in elements:
            result = each if result.is_one() else result * each
        return result
