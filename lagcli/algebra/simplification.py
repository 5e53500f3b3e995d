"""The shortest readable shape of an expression's unique form."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial

from sympy import Add, Dummy, Expr, Mul, Pow, S, Symbol, exp, sqrt

from lagcli.algebra.build import HYPERBOLIC
from lagcli.algebra.cancellation import cancelled
from lagcli.algebra.division import commonest_ratio
from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.leaves import Translator, to_expression
from lagcli.algebra.relations import Relations
from lagcli.algebra.ring import Monomial, Poly, factorization
from lagcli.algebra.shaping.plan import OPERATION
from lagcli.algebra.shaping.shaper import Shaper
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Quotient,
    factors_of,
    has_nested_fraction,
    operation_count,
    terms_of,
    walk,
)
from lagcli.notation.factors import whole_power
from lagcli.platform.effort import EFFORT

_LONG = 60  # terms of an element of which ...
_OF_LONG = 2  # ... no more than these equal forms are shaped
_EQUAL = 3  # numerators that are shaped
_GIVEN_ROOT = 4  # operations that a formula may have more with sqrt(1 - v²/c²) as it was put in
_FLAT = 1.3  # times as long as nested fractions are a formula without any may be
_SHORTER = 0.8  # times as long as before it must be otherwise
_REMOVED = 1.5  # times as long a formula may be that has a value where the other is 0/0
_MAX_SHAPED = 1500  # terms; beyond, a formula is written as it was found


def shape(
    expression: Expr, order: Sequence[str] = (), relations: Relations | None = None
) -> Expression:
    """The shortest readable tree of an expression.

    Parameters
    ----------
    expression
        What to write; anything that is no rational function of the field's generators
        is kept as it is.
    order
        Parameters, ``t``, coordinates, multipliers, as they are to follow in a product.
    relations
        What may be used to shorten it.
    """
    expression, tree = shaped(expression, order, relations)
    return to_expression(expression, order) if tree is None else tree


def simplify(expression: Expr, relations: Relations | None = None) -> Expr:
    """The shortest readable shape as a SymPy expression; see `shape`."""
    if relations is None and _is_monomial(expression):
        return expression
    return shaped(expression, (), relations)[0]


def _is_monomial(expression: Expr) -> bool:
    """Whether it is a rational number times integer powers of symbols, which has one shape."""
    powers = (factor.as_base_exp() for factor in Mul.make_args(expression))
    return all(e.is_Integer and (b.is_Symbol or b.is_Rational) for b, e in powers)


def shaped(
    expression: Expr, order: Sequence[str], relations: Relations | None
) -> tuple[Expr, Expression | None]:
    """The shortest readable shape, as a SymPy expression and as a tree; see `shape`.

    The tree is None where the expression has no normal form and stays as it is.
    """
    found = _shaped(expression, order, relations)
    if expression.has(exp) and expression.has(*HYPERBOLIC):  # (sinh(x) + cosh(x)) exp(-x) = 1
        other = _shaped(expression, order, relations, one_kind=True)
        found = other if other[0].count_ops() < found[0].count_ops() else found
    rooted = {} if relations else _letters_under_roots(expression)
    if not rooted:
        return found
    whole, _ = _shaped(expression.subs({x: r**2 for x, r in rooted.items()}), (), None)
    by_roots = whole.subs({r: sqrt(x) for x, r in rooted.items()})
    # sqrt(k) − sqrt(h) over sqrt(k) + sqrt(h), and not its square over k − h
    equal = dict.fromkeys(rooted, S.One)
    removed = found[0].as_numer_denom()[1].subs(equal) == 0
    removed = removed and by_roots.as_numer_denom()[1].subs(equal) != 0
    most = (_REMOVED if removed else _SHORTER) * found[0].count_ops()
    if by_roots.count_ops() > most:
        return found
    return by_roots, to_expression(by_roots, order)


def _letters_under_roots(expression: Expr) -> dict[Symbol, Symbol]:
    """The positive letters that occur under a root and elsewhere: (k - h)/(sqrt(k) - sqrt(h))."""
    powers = [p for p in expression.atoms(Pow) if p.base.is_Symbol and p.base.is_positive]
    rooted = {p.base for p in powers if p.exp.is_Rational and p.exp.q == 2}
    if len(rooted) < 2 or not any(rooted <= each.free_symbols for each in expression.atoms(Add)):
        return {}
    return {x: Symbol(f"#{x.name}", positive=True) for x in rooted}


def _shaped(
    expression: Expr,
    order: Sequence[str],
    relations: Relations | None,
    *,
    one_kind: bool = False,
) -> tuple[Expr, Expression | None]:
    if relations:
        expression = relations.substitute(expression)
    writer = Writer(order)
    if _vanishes_for_any_roots(expression):
        return S.Zero, to_expression(S.Zero, order)
    field = Field([expression], alone=not relations, one_kind=one_kind)
    try:
        element = field(expression)
    except ZeroDivisionError:
        return expression, None
    given = Translator(writer).given(expression)
    if given is not None and element.size() > _MAX_SHAPED:
        return expression, given
    EFFORT.done += 3000 + 100 * element.size()
    tree, shaper = ReadableShapes(field, writer, relations).shortest(element)
    if given is None:
        return shaper.to_sympy(tree), tree
    before, after = operation_count(given), operation_count(tree)
    if has_nested_fraction(given) or any(map(_is_over_squares, walk(given))):
        before = int(_FLAT * before)
    if before < after:
        return expression, given
    return shaper.to_sympy(tree), tree


def _is_over_squares(node: Expression) -> bool:
    """Whether it is sqrt(p²/k⁴ + 2/(k² c²)), for sqrt(c² p² + 2 k²)/(k² c)."""
    if not (isinstance(node, Call) and node.function == "sqrt"):
        return False
    (inside,) = node.arguments
    outer = [inside.denominator] if isinstance(inside, Quotient) else []
    parts = terms_of(inside.numerator if isinstance(inside, Quotient) else inside)
    terms = [t.operand if isinstance(t, Negative) else t for t in parts]
    below = [factors_of(t.denominator) for t in terms if isinstance(t, Quotient)]
    below += map(factors_of, outer if below else [])
    powers = (whole_power(f) for factors in below for f in factors)
    return len(below) > 1 and all(isinstance(b, Name) and e % 2 == 0 for b, e in powers)


def fraction(expression: Expr, order: Sequence[str] = ()) -> Expression:
    """N/D without fractions in N and D, each in its shortest shape; see `shape`."""
    field = Field([expression])
    try:
        element = cancelled(field, field(expression))
    except ZeroDivisionError:
        return shape(expression, order)
    above, below = (
        (shape(field.polynomial_to_sympy(field.ring.lift(poly)), order), Fraction(power))
        for poly, power in ((element.numerator, 1), (element.denominator, -1))
    )
    return Writer(order).product(Fraction(1), [above, below])


def is_zero(expression: Expr, relations: Relations | None = None) -> bool | None:
    """Whether an expression vanishes, wherever the relations hold.

    Returns
    -------
    True when its normal form is 0 (modulo the relations), False when it certainly does
    not vanish identically, None when the normal form does not decide.
    """
    if relations:
        expression = relations.substitute(expression)
    if _vanishes_for_any_roots(expression):
        return True
    field = Field([expression], one_kind=True)
    try:
        element = field(expression)
    except ZeroDivisionError:
        return None
    if element.is_zero():
        return True
    if relations and relations.remaining:
        generic = relations.generic
        if relations.contain(field, element.numerator):
            return True
        found = generic.vanish(field, element.numerator)
        if found is None:
            found = is_zero(field.polynomial_to_sympy(element.numerator), generic)
        if found is not False or generic.remaining:
            return found or None
    return None if field.doubtful else False


def _vanishes_for_any_roots(expression: Expr) -> bool:
    """Whether it is 0 with letters for the roots of sums, as xi . grad V(C) where xi . grad C is.

    Measured: 0.02 s in place of 5 s for two bodies on a sphere.
    """
    roots = {
        p.base: Dummy(positive=True)
        for p in expression.atoms(Pow)
        if p.exp.is_Rational and p.exp.q > 1 and p.base.is_Add
    }
    if not (roots and expression.is_Add):
        return False
    lettered = expression.replace(
        lambda p: p.is_Pow and p.base in roots, lambda p: roots[p.base] ** p.exp
    )
    with suppress(ZeroDivisionError):
        return bool(Field([lettered])(lettered).is_zero())
    return False


class ReadableShapes:
    """The readable shapes of the elements of one field.

    Parameters
    ----------
    relations
        What may be used to shorten them.  An answer's denominator vanishes where they hold
        only where that of the element does.
    """

    def __init__(self, field: Field, writer: Writer, relations: Relations | None) -> None:
        self.field = field
        self.relations = relations if relations and relations.remaining else None
        self._solutions = relations.folding(field) if relations else []
        shorter = partial(self.relations.shorter, field) if self.relations else None
        self._denominators: dict[tuple[tuple[Monomial, int], ...], Element] = {}
        self._shapers = [Shaper(field, writer, shorter=shorter)]
        if field.root_scales:
            self._shapers.insert(0, Shaper(field, writer, scaled=True, shorter=shorter))

    def shortest(self, element: Element) -> tuple[Expression, Shaper]:
        """The best tree among equal elements, and the shaper that made it."""
        # cancelled first: a reduced numerator may share no factor with the denominator any more
        element = cancelled(self.field, element)
        candidates = [*self._equal(element), *self._folded(element)]
        for shaper in self._shapers:
            shaper.grouper.renew()
        shapes = [(shaper.plan(each), shaper) for each in candidates for shaper in self._shapers]
        for parts in self._divided(element):
            shapes += [(shaper.together(parts), shaper) for shaper in self._shapers]
        # sqrt(1 - v²/c²), where it was put in so, may cost one operation more than sqrt(c² - v²)
        plan, shaper = min(
            shapes, key=lambda pair: pair[0].score - _GIVEN_ROOT * OPERATION * pair[1].scaled
        )
        return shaper.written(plan), shaper

    def pair(self, element: Element) -> tuple[Expr, Expression]:
        """The best shape as a SymPy expression and as a tree."""
        tree, shaper = self.shortest(element)
        return shaper.to_sympy(tree), tree

    def _equal(self, element: Element) -> list[Element]:
        """Equal elements on the relations, above the denominator that shows least."""
        relations, field = self.relations, self.field
        if relations is None:
            return [element]
        above = self._alike(element.numerator)
        least = field.lifted(self._denominator(element.denominator))
        found = [cancelled(field, field.lifted(each) / least) for each in above]
        # reduced together they may have a factor in common that neither shows
        divided = [cancelled(field, each) for each in relations.reductions(field, element)]
        degree = min(each.denominator.total_degree() for each in found)
        found += [each for each in divided if each.denominator.total_degree() < degree]
        found.sort(key=_factored_size)
        return found[: _OF_LONG if found[0].size() > _LONG else _EQUAL]

    def _folded(self, element: Element) -> Iterator[Element]:
        """The element with x' for R theta' sin(phi) - W*y where x' was solved for, if shorter."""
        field = self.field
        before = len(element.numerator)
        for symbol, value in self._solutions:
            value = field.lifted(value)
            above = field.ring.lift(element.numerator)
            if len(value.numerator) > len(above):
                continue
            ratio = commonest_ratio(field.ring, above, value.numerator)
            if ratio is None:
                continue
            rest = above - ratio * value.numerator
            if len(rest) + 1 < len(above):
                whole = field(symbol) * field.element(ratio * value.denominator, field.ring.one)
                folded = whole + field.polynomial(rest)
                element = folded / field.element(element.denominator, field.ring.one)
        if len(element.numerator) < before:
            yield element

    def _denominator(self, poly: Poly) -> Element:
        """The equal of a denominator that shows least."""
        key = tuple(self.field.ring.terms(poly))
        known = self._denominators.get(key)
        if known is None:
            shaper = self._shapers[-1]
            below = [each for each in self._alike(poly) if not each.is_zero()]
            known = min(below, key=lambda each: shaper.plan(each).score)
            self._denominators[key] = known
        return known

    def _divided(self, element: Element) -> Iterator[tuple[Element, Element]]:
        """N/D = Q + R/D before the relations are used, which hide it."""
        if self.relations is None or element.is_polynomial():
            return
        field = self.field
        element = field.lifted(element)
        quotient = commonest_ratio(field.ring, element.numerator, element.denominator)
        if quotient is None:
            return
        rest = element.numerator - quotient * element.denominator
        if rest == 0 or len(rest) + 1 >= len(element.numerator):
            return
        for each in self._equal(field.element(rest, element.denominator)):
            yield field.polynomial(quotient), each

    def _alike(self, poly: Poly) -> list[Element]:
        """Polynomials that are equal on the relations, distinct."""
        assert self.relations is not None
        field = self.field
        found: list[Element] = []
        for each in (
            field.polynomial(poly),
            field.polynomial(self.relations.shared_out(field, poly)),
            self._by_factors(poly),
            *self.relations.modulo(field, poly),
        ):
            if all(each.numerator != x.numerator or each.denominator != x.denominator
                   for x in map(field.lifted, found)):  # fmt: skip
                found.append(each)
        return found

    def _by_factors(self, poly: Poly) -> Element:
        """Each factor by its shortest equal."""
        assert self.relations is not None
        field = self.field
        content, factors = factorization(field.ring.lift(poly))
        result = field.rational(int(content))
        for factor, exponent in factors:
            equal = [field.polynomial(self.relations.shared_out(field, factor))]
            equal += self.relations.modulo(field, factor)
            result = result * min(equal, key=Element.size) ** int(exponent)
        return result


def _factored_size(element: Element) -> tuple[int, int]:
    """The terms of the factors of an element, and those of itself."""
    factors = (*factorization(element.numerator)[1], *factorization(element.denominator)[1])
    return sum(len(factor) for factor, _ in factors), element.size()
