"""How a file writes its formulas, and answers written in the same manner.

The algebra decides what is bracketed with what.  Which way round a difference stands, where a
minus goes and whether a number comes first does not change a value, and follows the file:

    R − a where the file has R − a, not a − R;      1 − cos θ, not cos θ − 1;
    l √l for l^(3/2);      cot θ for 1/tan θ;       (a − b)/(…), not −(b − a)/(…).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import isqrt

from lagcli.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    factors_of,
    opposite,
    power_of,
    quotient_of,
    terms_of,
    walk,
)
from lagcli.notation.angles import (
    difference_of_angles,
    with_added_square,
    with_single_angles,
    with_versines,
    without_halved_sines,
    without_tangents,
    without_unlike_multiples,
)
from lagcli.notation.brackets import NamedMomenta, squares_as_brackets
from lagcli.notation.factors import (
    cancelled,
    multiplied,
    odd_base,
    over_root,
    parts_of,
    power_product,
    product_of_powers,
    whole_power,
    with_base,
    with_conjugates,
    with_content,
    with_last,
    with_one_root,
    with_whole_powers,
)
from lagcli.notation.fractions import Brackets
from lagcli.notation.given_formulas import given, order_of_names
from lagcli.notation.given_potential import GivenPotential
from lagcli.notation.given_sums import (
    GivenSums,
    arranged,
    differ_in_parameters,
    has_like_terms,
)
from lagcli.notation.likeness import EVEN, ODD, Key, Monomial, multiplied_out, parity, signed_key
from lagcli.notation.logarithms import ratios_in, with_ratios
from lagcli.notation.ordering import (
    Ordering,
    accelerates,
    has_rate,
    is_letter,
    negative_of,
    positive_first,
)
from lagcli.notation.reciprocals import GivenFractions
from lagcli.notation.signs_of_sums import FirstSigns, SumSigns
from lagcli.problem_data import Problem
from lagcli.rewriting import expressions_in, put_in, rebuilt

_ARC = frozenset(("acos", "asin", "acosh", "asinh"))


class Manner:
    """The way in which one file writes sums.

    Parameters
    ----------
    problem
        Whose formulas are taken as the example.
    """

    def __init__(self, problem: Problem) -> None:
        self._known: dict[tuple[Expression, bool], Expression] = {}
        self._squares = FirstSigns()  # of squared brackets
        self._within = FirstSigns()  # of brackets in a denominator
        self._above = FirstSigns()  # of factors above that may stand either way
        self._beside: dict[frozenset[tuple[Monomial, Fraction]], Expression] = {}  # roots
        quantities = (*problem.parameters, *problem.coordinates)
        self._positive = frozenset(q.name for q in quantities if q.assume == "positive")
        self._ordering = Ordering(order_of_names(problem))
        self._sums = GivenSums(given(problem), self._energies(problem), self._ordering)
        self._fractions = GivenFractions(given(problem), self._ordering)
        self._ratios = ratios_in(given(problem))
        calls = (p for node in given(problem) for p in walk(node) if isinstance(p, Call))
        self._angles = {signed_key(x)[1] for call in calls for x in call.arguments}
        self._potential = GivenPotential(problem.potential, self._ordering)
        names = [q.name for q in problem.coordinates]
        self._momenta = NamedMomenta(names, self._positive, self._ordering)
        self._signs = SumSigns(
            given(problem), self._ordering, self._sums, self._momenta, self._positive
        )
        self._brackets = Brackets(self._ordering, frozenset("p_" + name for name in names))

    def _energies(self, problem: Problem) -> Iterator[Sum]:
        """T − V and T + V, as sums of the terms of the file; none of m x'²/2 + M x'²/4."""
        if problem.kinetic is None or problem.potential is None:
            return
        T, V = map(_terms, (problem.kinetic, problem.potential))
        alike = has_like_terms(Sum(T)) or differ_in_parameters(Sum(T), self._ordering)
        if len(T) + len(V) > 1 and not alike:
            yield Sum((*T, *V))
            yield Sum((*T, *map(opposite, V)))

    def anew(self, one_way: Mapping[Key, int] | None = None) -> None:
        """Begin another section, which is written as if it were the only one.

        `one_way` has the sums that it would have both ways, see `both_ways`.
        """
        one_way = one_way or {}
        self._signs.anew({key: sign for key, sign in one_way.items() if sign})
        self._sums.anew({key for key, sign in one_way.items() if not sign})
        for memory in (self._known, self._within, self._above, self._squares, self._beside):
            memory.clear()

    def both_ways(self, section: object) -> dict[Key, int]:
        """The sums of constants that a written section has as a − b and b − a; their one sign.

        0 for a denominator m + I/R² of the file that other rows have as m R² + I.
        """
        signs = self._signs.both_ways(expressions_in(section))
        return signs | dict.fromkeys(self._sums.unfit(), 0)

    def expect(self, left: Expression, right: Expression) -> None:
        """Of a section with the condition a > b: a denominator has a − b."""
        difference = Sum((*_terms(left), *map(opposite, _terms(right))))
        if len(difference.terms) > 1:
            self._signs.keep(difference)

    def __call__(self, node: Expression) -> Expression:
        """The formula as the file would write it; its value stays."""
        node = with_single_angles(without_unlike_multiples(node, self._ordering))
        node = self._in_manner(node, inside=False)
        terms = self._brackets.spread(node)
        if any(
            isinstance(f, Sum) and any(parts_of(t)[2] for t in f.terms) for f in factors_of(node)
        ):
            terms = self._opened(node)
        node = Sum((*positive_first(terms),)) if len(terms) > 1 else self._without_minus(node)
        self._keep_brackets(node)
        return self._fractions(squares_as_brackets(self._potential(node), self._squares))

    def _keep_brackets(self, node: Expression) -> None:
        """Of c (a − b)/d: a product of brackets after it has a − b."""
        for term in terms_of(node):
            self._above.keep_odd(parts_of(term)[1])

    def _without_minus(self, node: Expression) -> Expression:
        """(b − a − c)/d for −(a − b + c)/d; of a whole answer also b − a for −(a − b)."""
        if isinstance(node, Negative) and isinstance(node.operand, Sum):
            turned = negative_of(node.operand)
            return node if isinstance(turned.terms[0], Negative) else turned
        minus, above, below = parts_of(node)
        several = sum(odd_base(factor)[1] for factor in above) > 1
        for place, factor in enumerate(above if minus else ()):
            base, odd = odd_base(factor)
            if base is None or not odd or self._signs.wrong(base) is not None:
                continue
            if self._signs.against(base) is not None:
                continue
            if several and self._above.has(base):
                continue
            if several and self._momenta.are_subtracted(negative_of(base)):
                continue
            minuses = sum(isinstance(term, Negative) for term in base.terms)
            if 2 * minuses + 1 >= len(base.terms):  # no more minus signs than before
                above[place] = with_base(factor, negative_of(base))
                return quotient_of(above, below)
        return node

    def vanishing(self, node: Expression) -> Expression:
        """What is 0 where the node is: x2 − x1 − l where the file has that, not x1 − x2 + l."""
        shown = self(node)
        if isinstance(shown, Negative):
            return shown.operand
        return negative_of(shown) if isinstance(shown, Sum) and self._signs.wrong(shown) else shown

    def _in_manner(self, node: Expression, *, inside: bool) -> Expression:
        """The same; `inside` a function or a root the sign of a denominator is left alone."""
        if isinstance(node, (Name, Number)):
            return node
        known = self._known.get((node, inside))
        if known is None:
            deeper = inside or isinstance(node, (Call, PartialCall))
            parts = rebuilt(node, lambda part: self._in_manner(part, inside=deeper))
            known = self._known[node, inside] = self._written(parts, inside=inside)
        return known

    def _written(self, node: Expression, *, inside: bool) -> Expression:
        match node:
            case Product(factors=(*_, Sum(terms=(first, *_)) as series)) if first == ONE:
                # a period, 2 pi sqrt(l/g) (1 + a²/16): what stands before the series stays there
                before = quotient_of(list(node.factors[:-1]), [])
                return with_last(self._written(before, inside=inside), series)
            case Product() | Quotient():
                node = with_one_root(with_whole_powers(node), self._positive, self._ordering)
                if self._momenta.occur(node):
                    node = self._momenta.product(node)
                return self._signed(self._with_one_fraction(node), inside=inside)
            case Call(function="sqrt", arguments=(Sum() as inner,)) if outside := self._before_root(
                inner
            ):
                number, rest = outside
                return Product((Number(number), self._written(Call("sqrt", (rest,)), inside=True)))
            case Call(function="sqrt", arguments=(Sum() as inner,)) if self._momenta.occur(inner):
                return self._momenta.root(inner)
            case Power():
                return self._power(node)
            case Call(function=function, arguments=(Sum() as inner,)) if function in ODD | EVEN:
                return self._function(node, inner)
            case Call(function=function, arguments=(Negative(operand=inner),)) if (
                function in ODD | EVEN
            ):
                turned = Call(function, (inner,), node.primes)
                return turned if function in EVEN else Negative(turned)
            case Negative(operand=Negative(operand=inner)):
                return inner
            case Negative(operand=Sum() as inner) if self._signs.wrong(negative_of(inner)) is False:
                return negative_of(inner)
            case Negative(operand=Product() | Quotient() as inner):
                return self._signed(node, inside=inside) if _sums(inner) else node
            case Sum() if self._ratios and (joined := with_ratios(node, self._ratios)) != node:
                return (
                    joined if not isinstance(joined, Sum) else self._written(joined, inside=inside)
                )
            case Sum(terms=(one, other)) if angle := difference_of_angles(one, other):
                return angle
            case Sum():
                node = self._beside_roots(node)
                like = self._sums.like(node)
                if like is not None and like[0] == 1:
                    return like[1]
                return self._sum(with_added_square(node))
            case Call(function=function, arguments=(Sum() as inner,)) if function in _ARC:
                return self._arc(node, inner)
            case Call(function="sqrt", arguments=(Quotient(numerator=Number(value=1)) as inner,)):
                return Quotient(ONE, Call("sqrt", (inner.denominator,)))  # sqrt(1/x) = 1/sqrt(x)
            case Call(function="sqrt", arguments=(Negative(operand=Sum() as inner),)) if any(
                isinstance(term, Negative) for term in inner.terms
            ):
                return Call("sqrt", (negative_of(inner),))
            case Call(function="sqrt", arguments=(inner,)):
                if isinstance(inner, (Sum, Product)):
                    inner = self._as_before(inner)
                self._signs.keep_odd(inner)
                return self._without_squares(inner)
            case _:
                return node

    def _before_root(self, radicand: Sum) -> tuple[Fraction, Sum] | None:
        """2 and c² p² + (m c² + k x²/2)² of 4 c² p² + (2 m c² + k x²)², a bracket of the file."""
        terms = [self._with_given_square(term) for term in radicand.terms]
        content, rest = with_content(Sum((*terms,)))
        number = Fraction(isqrt(content.numerator))
        return (number, rest) if number > 1 and number**2 == content else None

    def _with_given_square(self, term: Expression) -> Expression:
        """4 (a + b/2)² for (2 a + b)², where the file has a + b/2."""
        minus, above, below = parts_of(term)
        numbers = Fraction(1)
        for place, factor in enumerate(above):
            base, exponent = whole_power(factor)
            like = self._sums.like(base) if isinstance(base, Sum) and exponent == 2 else None
            if like is not None and like[0].denominator == 1:
                above[place] = power_of(like[1], exponent)
                numbers *= like[0] ** exponent
        if numbers == 1:
            return term
        whole = quotient_of([power_product((Number(numbers), *above), self._ordering)], below)
        return Negative(whole) if minus else whole

    def _without_squares(self, radicand: Expression) -> Expression:
        """sqrt(a)/|p| for sqrt(a/p²) with a letter p that is not known to be positive."""
        minus, *sides = parts_of(radicand)
        outside: list[list[Expression]] = [[], []]
        for factors, out in zip(sides, outside, strict=True):
            for factor in list(factors):
                base, exponent = whole_power(factor)
                if isinstance(base, Name) and base.name not in self._positive and exponent == 2:
                    factors.remove(factor)
                    out.append(Call("abs", (base,)))
        rest = quotient_of(*sides) if sides[0] else ONE
        if minus or not any(outside) or rest == ONE:
            return Call("sqrt", (radicand,))
        return quotient_of([*outside[0], Call("sqrt", (rest,))], outside[1])

    def _with_one_fraction(self, node: Expression) -> Expression:
        """(k l − m g)/(m l) for (k − m g/l)/m, but for brackets of the file."""
        node = self._brackets.joined(node)
        _, above, _ = parts_of(node)
        if any(isinstance(f, Sum) and self._signs.is_settled(f) for f in above):
            return node
        found = self._brackets.merged(node)
        if found is None:
            return node
        whole, inside = found
        shown = self._written(inside, inside=True)
        return put_in(whole, {inside: shown})

    def _arc(self, node: Call, inner: Sum) -> Expression:
        """arccos((a + b)/c) for arccos(a/c + b/c), but 1 − E/(m g l)."""
        if len(inner.terms) == 2 and any(map(_constant, inner.terms)):
            return node
        found = self._brackets.over_one(inner.terms)
        if found is None:
            return node
        above, inverse = found
        whole = inverse.times_sum(self._written(above, inside=True), self._ordering)
        return Call(node.function, (self._written(whole, inside=True),), node.primes)

    def _as_before(self, node: Expression) -> Expression:
        """A radicand, or what stands beside a root, as the section has written it before."""
        value = multiplied_out(node)
        if value is None:
            return node
        turned = frozenset((term, -c) for term, c in value.items())
        if turned in self._beside and isinstance(before := self._beside[turned], Sum):
            return negative_of(before)
        return self._beside.setdefault(frozenset(value.items()), node)

    def _beside_roots(self, node: Sum) -> Sum:
        """a ± sqrt(b) with one a for both roots of an equation."""
        roots = [term for term in node.terms if any(map(_is_root, walk(term)))]
        rest = [term for term in node.terms if term not in roots]
        if not roots or not rest:
            return node
        before = terms_of(self._as_before(Sum((*positive_first(rest),)))) if rest[1:] else rest
        if not isinstance(before[0], Negative) and self._ends_with_roots(node, roots):
            return Sum((*before, *roots))
        return Sum((*roots, *before) if node.terms[0] in roots else (*before, *roots))

    def _ends_with_roots(self, node: Sum, roots: list[Expression]) -> bool:
        """Whether it is b + sqrt(b² − a c), of constants; c sqrt(p² + m² c²) + F x is not."""
        calls = (p for root in roots for p in walk(root) if isinstance(p, Call))
        long = any(_is_root(call) and isinstance(call.arguments[0], Sum) for call in calls)
        names = [part for part in walk(node) if isinstance(part, Name)]
        return long and not any(has_rate(x) or self._ordering.is_coordinate(x) for x in names)

    def _sum(self, node: Sum) -> Expression:
        """The sum, its brackets as in the denominator above: a - b (u - v), not a + b (v - u)."""
        whole = multiplied(self._ordered(node), self._ordering)
        found = map(over_root, self._sums.within(whole).terms)
        first, *rest = with_versines(tuple(found))
        return Sum((first, *map(self._as_within, rest))) if rest else first

    def _ordered(self, node: Sum) -> Sum:
        """The sum without brackets around inner sums, a positive term first where there is one."""
        terms = [each for term in node.terms for each in terms_of(term)]
        terms = [each for term in terms for each in self._opened(term)]
        terms = self._brackets.velocity(terms)
        if not isinstance(terms[0], Negative):
            return node if tuple(terms) == node.terms else Sum((*self._ordering.in_powers(terms),))
        if accelerates(terms[0]):  # m l² θ'' − m l y'' sin θ + …
            first = [t for t in terms if not isinstance(t, Negative) and accelerates(t)][:1]
            return Sum((*first, *(t for t in terms if t not in first)))
        # in order anew: a bracket that was turned has changed the sign of its term
        return Sum((*positive_first(self._ordering.sorted(terms)),))

    def _opened(self, term: Expression) -> list[Expression]:
        """2 Ω y' and Ω² x of Ω (2 y' + Ω x), where the file does not have the bracket."""
        own = (f for f in parts_of(term)[1] if isinstance(f, Sum))
        still = (f for f in own if not all(is_letter(t) and has_rate(t) for t in f.terms))
        if any(map(self._signs.is_settled, still)):
            return [term]
        return self._brackets.opened(term)

    def _as_within(self, term: Expression) -> Expression:
        minus, above, below = parts_of(term)
        for place, factor in enumerate(above):
            base, odd = odd_base(factor)
            if base is None or not odd or self._signs.wrong(base) is not None:
                continue
            if self._signs.against(base) is None and self._within.turns(base):
                above[place] = with_base(factor, negative_of(base))
                minus = not minus
        whole = quotient_of(above, below)
        return Negative(whole) if minus else whole

    def _function(self, node: Call, inner: Sum) -> Expression:
        """sin(a − b) = −sin(b − a), cos(a − b) = cos(b − a); sin((a − b)/2) for sin(a/2 − b/2)."""
        ratio, shown = self._sums.like(inner) or with_content(inner)
        if abs(ratio) != 1:
            whole = product_of_powers(abs(ratio), {shown: 1}, self._ordering)
            turned = Call(node.function, (whole,), node.primes)
            return turned if node.function in EVEN or ratio > 0 else Negative(turned)
        wrong = self._signs.wrong(inner)
        if wrong is None and all(map(is_letter, inner.terms)):  # cos(θ − φ) in the file's order
            wrong = self._signs.begins_worse(inner)
        if not wrong or _constant(inner):
            return node
        turned = Call(node.function, (negative_of(inner),), node.primes)
        return turned if node.function in EVEN else Negative(turned)

    def _power(self, node: Power) -> Expression:
        """(−sin(a − b))² = sin²(a − b), sums in their right sign."""
        base = node.base
        if isinstance(base, Negative) and parity(node.exponent) == 0:
            return self._power(Power(base.operand, node.exponent))
        if isinstance(base, Sum) and parity(node.exponent) == 0:
            like = self._sums.like(base)
            if like is not None and abs(like[0]) == 1:
                return Power(like[1], node.exponent)
            wrong = self._signs.against(base)
            if wrong is None:
                wrong = self._signs.wrong(base)
            turned = self._momenta.are_subtracted(base)
            if not self._momenta.are_subtracted(negative_of(base)):
                turned = turned or self._signs.begins_worse(base)
            if wrong or (wrong is None and turned):
                return Power(negative_of(base), node.exponent)
        return with_whole_powers(node)

    def _with_common(self, node: Expression) -> Expression:
        """m l (cos x + cos y) for m (l cos x + l cos y), but for a bracket of the file."""
        minus, above, below = parts_of(node)
        found, changed = list[Expression](), False
        for factor in above:
            common = self._common(factor) if isinstance(factor, Sum) else None
            changed |= common is not None
            found += common or [factor]
        if not changed:
            return node
        whole = quotient_of([power_product(found, self._ordering)], below)
        return Negative(whole) if minus else whole

    def _common(self, node: Sum) -> list[Expression] | None:
        """The parameters that all terms have, and what is left of the sum; None without any."""
        terms = [parts_of(term) for term in node.terms]
        powers = [dict(map(whole_power, above)) for _, above, _ in terms]
        letters = (b for b in powers[0] if isinstance(b, Name) and self._ordering.is_parameter(b))
        least = ((base, min(each.get(base, 0) for each in powers)) for base in letters)
        shared = dict[Expression, int]((base, e) for base, e in least if e > 0)
        # (g² cos θ − g/R) sin θ, (m x'²/2 + k x²/2) exp(c t), but m g a (1 − 3 cos θ/8)
        fractions = all(below for _, _, below in terms) or any(
            not isinstance(f, Number) for _, _, below in terms for f in below
        )
        if not shared or fractions or self._signs.is_bracket(node):
            return None
        left = []
        for (minus, above, below), each in zip(terms, powers, strict=True):
            if len(each) < len(above):
                return None  # a factor twice
            exponents = {b: e - shared.get(b, 0) for b, e in each.items()}
            kept = [power_of(b, e) for b, e in exponents.items() if e]
            whole = quotient_of(kept or [ONE], below)
            left.append(Negative(whole) if minus else whole)
        return [*(power_of(b, e) for b, e in shared.items()), Sum(tuple(left))]

    def _signed(self, node: Expression, *, inside: bool) -> Expression:
        """A product or quotient with every sum in its right sign, the sign of all before it."""
        minus, above, below = self._sums.in_product(*parts_of(self._with_common(node)))
        above, below = map(with_conjugates, cancelled(*self._sums.with_half(above, below)))
        above, below = without_halved_sines(without_tangents(above), below, self._angles)
        free: list[tuple[list[Expression], int]] = []  # sums that may stand either way
        for factors in (above, below):
            for place, factor in enumerate(factors):
                base, odd = odd_base(factor)
                if base is None or not odd:
                    continue
                if accelerates(base.terms[0]):  # a bracket, not an equation of motion
                    base = Sum((*positive_first(base.terms),))
                    factors[place] = with_base(factor, base)
                    factor = factors[place]
                wrong = None if inside else self._signs.against(base)
                if wrong is None:
                    wrong = self._signs.wrong(base, below=factors is below and not inside)
                if wrong:
                    turned = self._in_manner(negative_of(base), inside=inside)
                    factors[place] = with_base(factor, turned)
                    minus = not minus
                elif wrong is None:
                    free.append((factors, place))
        several = len(free) > 1 and not inside  # sqrt((a − b) c), not sqrt(−(b − a) c)
        for factors, place in free if several else ():
            base, _ = odd_base(factors[place])
            assert base is not None
            if self._momenta.are_subtracted(base):  # (r p − a) (r p − b)
                base = negative_of(base)
                factors[place] = with_base(factors[place], base)
                minus = not minus
            if self._above.turns(base):
                factors[place] = with_base(factors[place], negative_of(base))
                minus = not minus
        for factors, place in free if minus else ():
            base, _ = odd_base(factors[place])
            assert base is not None
            if several and self._above.has(base):
                continue
            turned = negative_of(base)
            if several and self._momenta.are_subtracted(turned):  # r p − k, not k − r p
                continue
            if 2 * sum(isinstance(t, Negative) for t in base.terms) >= len(base.terms):
                factors[place] = with_base(factors[place], turned)
                minus = False
                break
        for factor in () if inside else below:
            base, _ = odd_base(factor)
            if base is not None:
                self._signs.keep(base)
                self._within.update(
                    {k: s for s, k in map(signed_key, _brackets(base)) if k not in self._within}
                )
        if any(odd_base(factor)[0] is not None for factor in above):
            above = [*arranged(above, self._ordering)]
        else:
            above = self._ordering.with_letters(above)
        below = self._ordering.with_letters(below)
        whole = over_root(quotient_of(above, below))
        return Negative(whole) if minus else whole


def _terms(node: Expression) -> tuple[Expression, ...]:
    """The terms of a sum; V: 0 has none."""
    terms = terms_of(node)
    return tuple(term for term in terms if term != ZERO)


def _brackets(node: Sum) -> Iterator[Sum]:
    """The sums among the factors of the terms."""
    for term in node.terms:
        for factor in parts_of(term)[1]:
            base, _ = odd_base(factor)
            if base is not None:
                yield base


def _sums(node: Expression) -> bool:
    _, above, below = parts_of(node)
    return any(odd_base(factor)[0] is not None for factor in (*above, *below))


def _is_root(node: Expression) -> bool:
    return isinstance(node, Call) and node.function == "sqrt"


def _constant(node: Expression) -> bool:
    return not any(isinstance(part, Name) for part in walk(node))
