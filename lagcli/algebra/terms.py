"""A sum of terms, one for each monomial in the velocities: the shape of L, h and p.

The shortest shape brackets wherever that saves an operation.  A Lagrangian, an energy or
an equation of motion is read term by term: m1 l1² θ1'²/2 + m2 l1 l2 θ1' θ2' cos(θ1 − θ2) + …
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from fractions import Fraction

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.leaves import Translator
from lagcli.algebra.ring import Monomial
from lagcli.algebra.shaping.shaper import Shaper
from lagcli.algebra.simplification import shape
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    length,
    name_nodes,
    operation_count,
    terms_of,
    walk,
)
from lagcli.notation.factors import parts_of
from lagcli.notation.given_sums import has_like_terms
from lagcli.notation.likeness import signed_key
from lagcli.notation.ordering import is_letter
from lagcli.record import record

#: A bracket is worth it from this share of the operations of the terms one by one.
_WORTH_A_BRACKET = 0.72

#: Terms that hold fractions stay apart up to this multiple of the operations.
_APART = 1.6

#: What is no polynomial in the velocities stays whole as the file has it: -m c² sqrt(1 - v²/c²).
_GIVEN_WHOLE = 1.6

#: How many times as long as the result the sum of squared components may be that the file has.
_PROJECTIONS = 0.8

Term = tuple[Monomial, int]


def terms(
    expression: Expr,
    order: Sequence[str],
    leading: Collection[str],
    *,
    as_given: float = 0,
) -> Expression:
    """The expression as a sum over the monomials in the quantities `leading`.

    Parameters
    ----------
    expression
        A polynomial in the leading quantities; anything else gets its shortest shape.
    order
        Parameters, ``t``, coordinates, multipliers, as they are to follow in a product.
    leading
        Names of velocities, accelerations, momenta, multipliers.
    as_given
        Prefer the expression as it stands where that is no longer, and what is at rest up to
        this multiple of the operations.
    """
    writer = Writer(order)
    field = Field([expression], alone=True)
    try:
        element = field(expression)
    except ZeroDivisionError:
        return Translator(writer).tree(expression)
    shaper = Shaper(field, writer)
    growth = _common_exponential(field, element)
    split = _Splitter(field, shaper, order, leading).split(element / growth)
    if split is None and not as_given:
        return shape(expression, order)
    given = Translator(writer).tree(expression) if as_given else None
    if split is None:
        assert given is not None
        result = shape(expression, order)
        return given if length(given) <= _GIVEN_WHOLE * length(result) else result
    static = writer.sum(split.static)
    at_rest = _at_rest(expression, leading) if growth.is_one() else ()
    if (
        as_given
        and at_rest
        and length(given_rest := _given(at_rest, writer)) <= as_given * length(static)
        and not (isinstance(given_rest, Sum) and has_like_terms(given_rest))
    ):
        static = given_rest
    elif len(at_rest) > 1 and not as_given:
        apart = writer.sum(shaper.shape(field(part)) for part in at_rest)
        # k1 (x - l1) - k2 (y - x - l2), the terms of V differentiated; not x (U/d² - B²/m)
        most = _APART if any(map(_holds_fraction, terms_of(static))) else 1
        if operation_count(apart) <= most * operation_count(static):
            static = apart
    result = writer.sum([*split.moving, static])
    if not growth.is_one():
        one = Fraction(1)
        result = writer.product(one, [(result, one), (shaper.shape(growth), one)])
    if given is None:
        moving = sympy.Add(expression, *(-part for part in at_rest))
        if not at_rest or moving == 0 or _roots(at_rest) <= _roots([moving]):
            return result
        # with the roots of what is at rest a sum of sines before velocities may not cancel
        parts = (terms(each, order, leading) for each in (moving, sympy.Add(*at_rest)))
        apart = writer.sum(parts)
        return apart if operation_count(apart) < operation_count(result) else result
    most = _PROJECTIONS * length(result) if _has_projections(given) else length(result)
    return given if length(given) <= most else result


def _has_projections(node: Expression) -> bool:
    """Whether squares of components are added, of which sin² + cos² = 1 leaves less."""

    def projects(term: Expression) -> bool:
        return isinstance(term, Power) and any(
            isinstance(term.base, Sum) and isinstance(p, Call) and p.function in ("sin", "cos")
            for p in walk(term.base)
        )

    sums = (part for part in walk(node) if isinstance(part, Sum))
    return any(sum(map(projects, each.terms)) > 1 for each in sums)


def _common_exponential(field: Field, element: Element) -> Element:
    """What all terms have to the same power: exp(c t/m) of (m x'' + c x' + k x) exp(c t/m)."""
    above, below = (
        [dict(monomial) for monomial, _ in field.ring.terms(part)]
        for part in (element.numerator, element.denominator)
    )
    found = field.rational(1)
    for index in {index for monomial in (*above, *below) for index in monomial}:
        powers = {a.get(index, 0) - b.get(index, 0) for a in above for b in below}
        if len(powers) == 1 and field.generators[index].kind == "exp":
            found *= field.generator(index) ** powers.pop()
    return found


def _at_rest(expression: Expr, leading: Collection[str]) -> Sequence[Expr]:
    """The terms without a leading quantity as they stand: the potential energy of the file.

    None of them where other terms have parts without one too.
    """
    parts = expression.args if expression.is_Add else (expression,)
    moving = {s: sympy.S.Zero for s in expression.free_symbols if s.name in leading}
    static = [part for part in parts if not part.free_symbols & moving.keys()]
    if any(p.xreplace(moving) != 0 for p in parts if p.free_symbols & moving.keys()):
        return ()
    return static


def _roots(parts: Iterable[Expr]) -> set[Expr]:
    """The radicands of sums in them."""
    powers = {p for part in parts for p in part.atoms(sympy.Pow) if p.base.is_Add}
    return {p.base for p in powers if p.exp.is_Rational and not p.exp.is_Integer}


def _given(parts: Iterable[Expr], writer: Writer) -> Expression:
    return writer.sum([Translator(writer).tree(part) for part in parts])


@record
class _Split:
    """The terms with leading quantities, and those without."""

    moving: tuple[Expression, ...]
    static: tuple[Expression, ...]


class _Splitter:
    def __init__(
        self, field: Field, shaper: Shaper, order: Sequence[str], leading: Collection[str]
    ) -> None:
        self.field = field
        self.shaper = shaper
        self.parameters = frozenset(order[: order.index("t")] if "t" in order else ())
        self.leading = leading

    def split(self, element: Element) -> _Split | None:
        """The terms; None where the element is no polynomial in the leading quantities."""
        ring = self.field.ring
        used = {*ring.used(element.numerator), *ring.used(element.denominator)}
        moving = {i for i in used if self._is_leading(i)}
        for index in used - moving:
            names = {s.name for s in self.field.generators[index].expression.free_symbols}
            if names & set(self.leading):
                return None
        if moving & set(ring.used(element.denominator)):
            return None
        by_degree: dict[tuple[int, int], dict[Monomial, list[Term]]] = {}
        for monomial, coefficient in ring.terms(element.numerator):
            fast = tuple((i, e) for i, e in monomial if i in moving)
            group = by_degree.setdefault(self._degree(fast), {})
            group.setdefault(fast, []).append((monomial, coefficient))
        found: list[Expression] = []
        static: list[Expression] = []
        for degree, group in by_degree.items():
            if any(degree):
                found.extend(self._bracketed(list(group.values()), element))
            else:
                static.extend(self._without_leading(group[()], element))
        return _Split(tuple(found), tuple(static))

    def _is_leading(self, index: int) -> bool:
        generator = self.field.generators[index]
        return generator.kind == "symbol" and generator.expression.name in self.leading

    def _degree(self, fast: Monomial) -> tuple[int, int]:
        """The degrees in accelerations and in the other leading quantities."""
        accelerations = others = 0
        for index, exponent in fast:
            if self.field.generators[index].expression.name.endswith("''"):
                accelerations += exponent
            else:
                others += exponent
        return accelerations, others

    def _by_function(self, static: list[Term], whole: Element) -> list[list[Term]]:
        """What has no leading quantity in it, apart by the functions of the coordinates.

        Also by the powers of a coordinate that a single term divides by: k/r² - 2 b/r³.
        """
        below = list(self.field.ring.terms(whole.denominator))
        dividing = {i for i, _ in below[0][0] if not self._is_known(i)} if len(below) == 1 else ()
        groups: dict[Monomial, list[Term]] = {}
        for monomial, coefficient in static:
            functions = tuple(
                (i, e) for i, e in monomial if i in dividing or self._tells_apart(i, e)
            )
            groups.setdefault(functions, []).append((monomial, coefficient))
        return list(groups.values())

    def _is_known(self, index: int) -> bool:
        """Whether it is a parameter."""
        return str(self.field.generators[index].expression) in self.parameters

    def _tells_apart(self, index: int, exponent: int) -> bool:
        """Whether it is a function; an even power of a sine may meet a constant, 1 - cos²."""
        kind = self.field.generators[index].kind
        return kind != "symbol" and not (kind in ("cos", "sin") and exponent % 2 == 0)

    def _bracketed(self, groups: list[list[Term]], whole: Element) -> list[Expression]:
        """One expression for each group, or one bracket where that is flat and much shorter."""
        shapes = [self._shape(group, whole) for group in groups]
        alike = self._with_equal_factors(groups, shapes)
        single = [part for places in alike for part in self._alike(places, groups, shapes, whole)]
        if len(groups) < 2:
            return single
        together = self._shape([term for group in groups for term in group], whole)
        apart = sum(map(operation_count, single)) + len(single) - 1
        worth = operation_count(together) <= _WORTH_A_BRACKET * apart
        if worth and is_flat(together) and not _holds_fraction(together):
            return [together]
        return single

    def _with_equal_factors(
        self, groups: list[list[Term]], shapes: list[Expression]
    ) -> list[list[int]]:
        """The places of groups that share a bracket: c (x'² + y'²), m (x y' - y x').

        And m (r'² + r² φ'²), squares with the same parameters before what is not constant.
        """
        found: dict[object, list[int]] = {}
        for place, group in enumerate(groups):
            fast, _ = self._factor(group[0][0])
            key: object = place
            if len(fast) == 1 and fast[0][1] == 2:
                key = frozenset((self._factor(monomial)[1], c) for monomial, c in group)
                shared = self._parameters(shapes[place])
                halves = any(isinstance(f, Quotient) for f in shared)  # of an energy, no force
                if halves and any(isinstance(f, (Name, Power)) for f in shared):
                    key = "squares", shared
            elif self._degree(fast) == (0, 1):
                key = self._parameters(shapes[place]) or self._bracket(shapes[place]) or place
            found.setdefault(key, []).append(place)
        return list(found.values())

    def _parameters(self, term: Expression) -> frozenset[Expression]:
        """The parameters and the number that multiply or divide a term without a bracket."""
        match term:
            case Negative(operand=inner):
                return self._parameters(inner)
            case Quotient(numerator=above, denominator=below):
                return self._parameters(above) | {Quotient(below, below)}
            case Product(factors=factors) if not _sums(factors):
                return frozenset(f for f in factors if self._is_parameter(f))
            case _:
                return frozenset()

    def _bracket(self, term: Expression) -> tuple[object, ...] | None:
        """What tells the bracket of parameters, its only one, and other parameters of a product."""
        _, above, below = parts_of(term)
        sums = [f for f in above if isinstance(f, Sum)]
        if len(sums) != 1 or below or not all(map(self._is_parameter, name_nodes(sums[0]))):
            return None
        others = frozenset(f for f in above if self._is_parameter(f))
        return "bracket", signed_key(sums[0])[1], others

    def _is_parameter(self, factor: Expression) -> bool:
        base = factor.base if isinstance(factor, Power) else factor
        return isinstance(base, Number) or (isinstance(base, Name) and base.name in self.parameters)

    def _factor(self, monomial: Monomial) -> tuple[Monomial, Monomial]:
        """The leading quantities of a monomial, and the rest."""
        fast = tuple(pair for pair in monomial if self._is_leading(pair[0]))
        return fast, tuple(pair for pair in monomial if pair not in fast)

    def _alike(
        self,
        places: list[int],
        every: list[list[Term]],
        shapes: list[Expression],
        whole: Element,
    ) -> list[Expression]:
        """The shape of the groups at these places, which share a bracket."""
        groups, apart = [every[place] for place in places], [shapes[place] for place in places]
        if len(groups) == 1:
            return apart
        if self._bracket(apart[0]) is not None:
            return [self._before_velocities(apart)]
        if self._factor(groups[0][0][0])[0][0][1] == 1:
            together = self._shape([term for group in groups for term in group], whole)
            return [together] if is_flat(together) else apart
        writer = self.shaper.writer
        if len({frozenset((self._factor(m)[1], c) for m, c in group) for group in groups}) > 1:
            return [self._before_squares(apart)]
        squares = []
        for group in groups:
            ((index, exponent),) = self._factor(group[0][0])[0]
            name = self.shaper.atoms.trees[self.shaper.atoms.generator(index)[0][0]]
            squares.append(writer.power(name, Fraction(exponent)))
        factor = self._shape([(self._factor(m)[1], c) for m, c in groups[0]], whole)
        one = Fraction(1)
        return [writer.product(one, [(factor, one), (writer.sum(squares), one)])]

    def _before_velocities(self, terms: Sequence[Expression]) -> Expression:
        """(a - b) (y' cos x - x' sin x) of terms with one bracket of parameters, or minus it."""
        writer, one = self.shaper.writer, Fraction(1)
        [shared] = _sums(parts_of(terms[0])[1])
        outside = [(f, one) for f in parts_of(terms[0])[1] if self._is_parameter(f)]
        inside = []
        for minus, factors, _ in map(parts_of, terms):
            [own] = _sums(factors)
            turned = signed_key(own)[0] != signed_key(shared)[0]
            kept = [(f, one) for f in factors if f is not own and not self._is_parameter(f)]
            inside.append(writer.product(-one if minus != turned else one, kept))
        return writer.product(one, [*outside, (shared, one), (writer.sum(inside), one)])

    def _before_squares(self, terms: Sequence[Expression]) -> Expression:
        """m (r'² + r² φ'²)/2 of terms with the same parameters."""
        writer, one = self.shaper.writer, Fraction(1)
        _, above, below = parts_of(terms[0])
        every = frozenset.intersection(*(frozenset(parts_of(term)[1]) for term in terms))
        outside = [(f, one) for f in above if self._is_parameter(f) or f in every]
        inside = []
        for minus, factors, _ in map(parts_of, terms):
            kept = [(f, one) for f in factors if not self._is_parameter(f) and f not in every]
            inside.append(writer.product(-one if minus else one, kept))
        return writer.product(
            one, [*outside, (writer.sum(inside), one), *((f, -one) for f in below)]
        )

    def _without_leading(self, static: list[Term], whole: Element) -> list[Expression]:
        """The terms by their functions; those of the shortest sum where that is much shorter."""
        apart = [self._shape(group, whole) for group in self._by_function(static, whole)]
        if len(apart) < 2:
            return [part for each in apart for part in self._flat(each, nested=True)]
        together = self._shape(static, whole)
        count = _operations(apart)
        if _has_one_minus(together) and operation_count(together) < count:
            return [together]
        flat = self._flat(together, nested=False)
        if _operations(flat) < count:
            return flat
        return [part for each in apart for part in self._flat(each, nested=True)]

    def _flat(self, node: Expression, *, nested: bool) -> list[Expression]:
        """The terms of the bracket in a product, m g l sin x - m a l cos x; or of nested ones only.

        So k (r - l)²/2 - m w² r²/2, not (k (r - l)² - m w² r²)/2: the terms of the file.
        """
        writer, one = self.shaper.writer, Fraction(1)
        match node:
            case Negative(operand=inner):
                return list(map(writer.negative, self._flat(inner, nested=nested)))
            case Quotient(numerator=above, denominator=below):
                parts = self._flat(above, nested=nested)
                if len(parts) < 2:
                    return [node]
                return [writer.product(one, [(part, one), (below, -one)]) for part in parts]
            case Sum(terms=parts) if not nested or _brackets(parts):
                return list(parts)
            case Product(factors=factors) if len(sums := _sums(factors)) == 1 and (
                _brackets(sums[0].terms) if nested else not all(map(is_letter, sums[0].terms))
            ):
                rest = [(factor, one) for factor in factors if factor is not sums[0]]
                return [writer.product(one, [*rest, (part, one)]) for part in sums[0].terms]
            case _:
                return [node]

    def _shape(self, group: Iterable[Term], whole: Element) -> Expression:
        numerator = self.field.ring.build(group)
        return self.shaper.shape(self.field.element(numerator, whole.denominator))


def _sums(nodes: Iterable[Expression]) -> list[Sum]:
    return [node for node in nodes if isinstance(node, Sum)]


def _brackets(nodes: Iterable[Expression]) -> bool:
    return any(isinstance(part, Sum) for node in nodes for part in walk(node))


def _operations(terms: Sequence[Expression]) -> int:
    return sum(map(operation_count, terms)) + len(terms) - 1


def _has_one_minus(node: Expression) -> bool:
    """Whether it is a product with a bracket 1 - f: k (1 - cos x) beats k - k cos x."""
    match node:
        case Negative(operand=inner) | Quotient(numerator=inner):
            return _has_one_minus(inner)
        case Product(factors=factors):
            sums = [each for each in factors if isinstance(each, Sum)]
            return len(sums) == 1 and any(isinstance(term, Number) for term in sums[0].terms)
        case _:
            return False


def is_flat(node: Expression) -> bool:
    """Whether there is no bracket within a bracket, and one at most in a product."""
    match node:
        case Negative(operand=inner) | Quotient(numerator=inner):
            return is_flat(inner)
        case Product(factors=factors):
            return sum(isinstance(f, Sum) for f in factors) < 2 and all(
                _no_sum_below(term) for f in factors if isinstance(f, Sum) for term in f.terms
            )
        case Sum(terms=parts):
            return all(_no_sum_below(part) for part in parts)
        case _:
            return True


def _holds_fraction(node: Expression) -> bool:
    """Whether a term of a bracket is a fraction: m l² (3 θ1'²/2 + θ1' θ2')."""
    match node:
        case Negative(operand=inner) | Quotient(numerator=inner):
            return _holds_fraction(inner)
        case Product(factors=factors):
            terms = (term for each in _sums(factors) for term in each.terms)
            return any(isinstance(part, Quotient) for term in terms for part in walk(term))
        case _:
            return False


def _no_sum_below(node: Expression) -> bool:
    match node:
        case Sum():
            return False
        case Negative(operand=inner) | Quotient(numerator=inner):
            return _no_sum_below(inner)
        case Product(factors=factors):
            return not any(isinstance(f, Sum) for f in factors)
        case _:
            return True
