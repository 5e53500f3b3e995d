"""A term as its sign, the factors above and those below; powers of a letter as books have them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Mapping
from fractions import Fraction
from math import gcd, lcm, prod

from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    factors_of,
    opposite,
    power_of,
    quotient_of,
    walk,
)
from lagcli.notation.likeness import parity
from lagcli.notation.ordering import Ordering, positive_first

#: Terms of a sum of products of masses that is multiplied out.
_MULTIPLIED = 4
_INVERSE = {"tan": "cot", "cot": "tan"}


def parts_of(node: Expression) -> tuple[bool, list[Expression], list[Expression]]:
    """Whether there is a minus, the factors above and those below."""
    match node:
        case Negative(operand=inner):
            minus, above, below = parts_of(inner)
            return not minus, above, below
        case Quotient(numerator=numerator, denominator=denominator):
            one, above, under = parts_of(numerator)
            other, below, over = parts_of(denominator)
            return one ^ other, [*above, *over], [*under, *below]
        case Product(factors=factors):
            found = [parts_of(factor) for factor in factors]
            minus = sum(m for m, _, _ in found) % 2 == 1
            above = [f for _, parts, _ in found for f in parts if f != ONE]
            return minus, above or [ONE], [f for _, _, parts in found for f in parts]
        case _:
            return False, [node], []


def with_last(before: Expression, last: Sum) -> Expression:
    """The product with one more factor, its sign in front."""
    if isinstance(before, Negative):
        return Negative(with_last(before.operand, last))
    factors = factors_of(before)
    return Product((*factors, last))


def odd_base(node: Expression) -> tuple[Sum | None, bool]:
    """The sum that a factor is, or is an odd whole power of."""
    if isinstance(node, Sum):
        return node, True
    if isinstance(node, Power) and isinstance(node.base, Sum):
        return node.base, parity(node.exponent) == 1
    return None, False


def whole_power(node: Expression) -> tuple[Expression, int]:
    """Base and exponent, which is a whole number."""
    if isinstance(node, Power) and parity(node.exponent) is not None:
        exponent = node.exponent
        assert isinstance(exponent, Number)
        return node.base, int(exponent.value)
    return node, 1


def base_and_exponent(node: Expression) -> tuple[Expression, Expression]:
    """The two of a power; the exponent 1 of anything else."""
    return (node.base, node.exponent) if isinstance(node, Power) else (node, ONE)


def with_base(node: Expression, base: Expression) -> Expression:
    """The same power of another base."""
    return Power(base, node.exponent) if isinstance(node, Power) else base


def with_content(node: Sum) -> tuple[Fraction, Sum]:
    """(6, p² − 3 p q) of 6 p² − 18 p q, (1/3, 1 + 3 q²) of 1/3 + q²: the number of all terms.

    But of m/2 + M: only a fraction that stands alone has its denominator taken out.
    """
    parts = [parts_of(term) for term in node.terms]
    alone = not any(isinstance(part, Number) and part.decimal for part in walk(node)) and any(
        all(isinstance(f, Number) for f in (*above, *below)) and _number_of(above, below) % 1
        for _, above, below in parts
    )
    values, rests = [], []
    for _, above, below in parts:
        taken = [f for f in above if isinstance(f, Number) and (alone or f.value.denominator == 1)]
        lower = [f for f in below if isinstance(f, Number)] if alone else []
        values.append(_number_of(taken, lower))
        rests.append(
            tuple([f for f in fs if f not in gone] for fs, gone in ((above, taken), (below, lower)))
        )
    scale = lcm(*(value.denominator for value in values))
    common = gcd(*(int(value * scale) for value in values))
    if common == scale:
        return Fraction(1), node
    terms = []
    for (minus, *_), value, (rest, under) in zip(parts, values, rests, strict=True):
        left = Number(value * scale / common)
        term = quotient_of([left, *rest] if left != ONE or not rest else rest, under)
        terms.append(Negative(term) if minus else term)
    return Fraction(common, scale), Sum(tuple(terms))


def _number_of(above: Iterable[Expression], below: Iterable[Expression]) -> Fraction:
    over, under = (
        prod((f.value for f in fs if isinstance(f, Number)), start=Fraction(1))
        for fs in (above, below)
    )
    return over / under


def over_root(node: Expression) -> Expression:
    """x (1 − l/√(x² + y²)) for x (√(x² + y²) − l)/√(x² + y²), of a product."""
    minus, above, below = parts_of(node)
    if any(isinstance(whole_power(f)[0], Sum) for f in below):  # a fraction in a sum over a sum
        return node
    for root in (f for f in below if isinstance(f, Call) and f.function == "sqrt"):
        for place, factor in enumerate(above if isinstance(root.arguments[0], Sum) else ()):
            terms = factor.terms if isinstance(factor, Sum) else ()
            left = [term for term in terms if term not in (root, opposite(root))]
            if len(terms) != 2 or len(left) != 1 or root in walk(left[0]):
                continue
            turned = opposite(root) in terms
            other, over, under = parts_of(left[0])
            ratio = quotient_of(over, [*under, root])
            above[place] = Sum((ONE, Negative(ratio) if other ^ turned else ratio))
            below = [f for f in below if f is not root]
            whole = quotient_of([*above], below)
            return over_root(Negative(whole) if minus ^ turned else whole)
    return node


def cancelled(
    above: list[Expression], below: list[Expression]
) -> tuple[list[Expression], list[Expression]]:
    """The factors above and below without the sums that both have."""
    left = Counter(dict(map(whole_power, above)))
    for base, exponent in map(whole_power, below):
        if isinstance(base, Sum) and left[base] > 0:
            common = min(left[base], exponent)
            above, below = _less(above, base, common), _less(below, base, common)
    return above or [ONE], below


def with_conjugates(factors: list[Expression]) -> list[Expression]:
    """R² − l² for (R + l) (R − l)."""
    for place, one in enumerate(factors):
        for other in factors[place + 1 :]:
            if (square := _difference_of_squares(one, other)) is not None:
                rest = [square if f is one else f for f in factors if f is not other]
                return with_conjugates(rest)
    return factors


def _difference_of_squares(one: Expression, other: Expression) -> Sum | None:
    """a² − b² of a + b and a − b, letters."""
    if not (isinstance(one, Sum) and isinstance(other, Sum)):
        return None
    if len(one.terms) != 2 or len(other.terms) != 2:
        return None
    signed = [{parts_of(t)[1][0]: parts_of(t)[0] for t in each.terms} for each in (one, other)]
    letters = [t.operand if isinstance(t, Negative) else t for s in (one, other) for t in s.terms]
    plus, minus = (x for x in sorted(signed, key=lambda s: any(s.values())))
    if not all(isinstance(x, Name) for x in letters) or plus.keys() != minus.keys():
        return None
    if any(plus.values()) or sum(minus.values()) != 1:
        return None
    above, below = sorted(minus, key=lambda x: minus[x])
    two = Number(Fraction(2))
    return Sum((Power(above, two), Negative(Power(below, two))))


def _less(factors: list[Expression], base: Expression, times: int) -> list[Expression]:
    """The factors with a power of one of them lowered."""
    found: list[Expression] = []
    for factor in factors:
        own, exponent = whole_power(factor)
        if own != base:
            found.append(factor)
        elif exponent > times:
            found.append(power_of(base, exponent - times))
    return found


def with_whole_powers(node: Expression) -> Expression:
    """l^(3/2) as l sqrt(l), 1/tan as cot, |a| |b| as |a b|, in a product, a quotient or alone."""
    if isinstance(node, Power):
        return quotient_of(_whole(node), [])
    minus, above, below = parts_of(node)
    turned = {id(f): other for f in below if (other := _reciprocal(f)) is not None}
    if turned:
        below = [f for f in below if id(f) not in turned]
        above = [*(f for f in above if f != ONE), *turned.values()]
    above = _with_one_modulus([part for factor in above for part in _whole(factor)])
    below = _with_one_modulus([part for factor in below for part in _whole(factor)])
    whole = quotient_of(above or [ONE], below)
    return Negative(whole) if minus else whole


def with_one_root(node: Expression, positive: Container[str], ordering: Ordering) -> Expression:
    """sqrt((m g l + k a²)/(m l²)) for sqrt((m g l + k a²)/m)/l, where l > 0.

    Numbers stay before the root.
    """
    minus, above, below = parts_of(node)
    match [f for f in above if not isinstance(f, Number)]:
        case [Call(function="sqrt", arguments=(Quotient() as inner,)) as root]:
            negative, under, over = parts_of(inner.denominator)
        case _:
            return node
    left = [f for f in below if isinstance(f, Number)]
    taken = [whole_power(f) for f in below if not isinstance(f, Number)]
    letters = all(isinstance(b, Name) and not b.primes and b.name in positive for b, _ in taken)
    sums = any(isinstance(f, Sum) for f in factors_of(inner.numerator))
    if not taken or not letters or not sums or negative or over:
        return node
    number, inside = Fraction(1), dict[Expression, int]()
    for base, exponent in (*map(whole_power, under), *((b, 2 * e) for b, e in taken)):
        if isinstance(base, Number):
            number /= base.value**exponent
        else:
            inside[base] = inside.get(base, 0) - exponent
    shown = product_of_powers(number, inside, ordering)
    assert isinstance(shown, Quotient)
    before = [f for f in (shown.numerator,) if f != ONE]
    whole = Call("sqrt", (quotient_of([*before, inner.numerator], [shown.denominator]),))
    found = quotient_of([whole if f is root else f for f in above], left)
    return Negative(found) if minus else found


def _with_one_modulus(factors: list[Expression]) -> list[Expression]:
    """|q B| for |q| |B|, of letters."""
    moduli = [f for f in factors if isinstance(f, Call) and f.function == "abs"]
    letters = [part for f in moduli for part in factors_of(f.arguments[0])]
    if len(moduli) < 2 or not all(isinstance(part, Name) for part in letters):
        return factors
    place = factors.index(moduli[0])
    left = [f for f in factors if f not in moduli]
    return [*left[:place], Call("abs", (Product((*letters,)),)), *left[place:]]


def _reciprocal(node: Expression) -> Expression | None:
    """cot for 1/tan, also of powers; None of anything else."""
    match node:
        case Call(function=function, arguments=arguments, primes=0) if function in _INVERSE:
            return Call(_INVERSE[function], arguments)
        case Power(base=base, exponent=exponent):
            inner = _reciprocal(base)
            return None if inner is None else Power(inner, exponent)
        case _:
            return None


def _whole(node: Expression) -> list[Expression]:
    """The factors x^n, sqrt(x) of x^(n + 1/2)."""
    if not isinstance(node, Power) or not isinstance(node.base, (Name, Call)):
        return [node]
    exponent = half_of(node.exponent)
    if exponent is None or exponent < 1:
        return [node]
    return [power_of(node.base, exponent.numerator // 2), Call("sqrt", (node.base,))]


def half_of(node: Expression) -> Fraction | None:
    """n/2 of an exponent that is one, n odd."""
    match node:
        case Number(value=value) if value.denominator == 2:
            return value
        case Quotient(numerator=Number(value=a), denominator=Number(value=b)) if b == 2:
            return Fraction(a, 2) if a.denominator == 1 else None
        case _:
            return None


def product_of_powers(
    number: Fraction, powers: Mapping[Expression, int | Fraction], ordering: Ordering
) -> Expression:
    """number · prod base^exponent, its factors in order, as one quotient."""
    found: list[list[Expression]] = []
    for sign, value in (1, abs(number.numerator)), (-1, number.denominator):
        chosen = [(b, Fraction(sign * e)) for b, e in powers.items() if sign * e > 0]
        shown = [power_of(base, exponent) for base, exponent in ordering.arranged(chosen)]
        found.append([Number(Fraction(value)), *shown] if value != 1 else shown)
    whole = quotient_of(found[0] or [ONE], found[1])
    return Negative(whole) if number < 0 else whole


def multiplied(node: Sum, ordering: Ordering) -> Sum:
    """m1 m2 + m1 m3 + 4 m2 m3 for m1 (m2 + m3) + 4 m2 m3, of quantities of one kind."""
    names = {part.name for part in walk(node) if isinstance(part, Name)}
    if len({name.rstrip("0123456789_").lower() for name in names}) != 1:
        return node
    terms = [each for term in node.terms for each in distributed(term, ordering)]
    if not len(node.terms) < len(terms) <= _MULTIPLIED:
        return node
    return Sum(tuple(positive_first(ordering.sorted(terms))))


def distributed(term: Expression, ordering: Ordering) -> list[Expression]:
    """The terms of a product with one bracket; the product itself where it is none."""
    minus, above, below = parts_of(term)
    sums = [factor for factor in above if isinstance(factor, Sum)]
    if len(sums) != 1 or below or len(above) == 1:
        return [term]
    if not any(isinstance(part, Name) for part in walk(sums[0])):  # (2 + sqrt(2)) k
        return [term]
    found: list[Expression] = []
    for each in sums[0].terms:
        other, factors, under = parts_of(each)
        if under:
            return [term]
        whole = power_product([f for f in (*above, *factors) if f is not sums[0]], ordering)
        found.append(Negative(whole) if minus ^ other else whole)
    return found


def power_product(factors: Iterable[Expression], ordering: Ordering) -> Expression:
    """The product of numbers and powers, each base once."""
    number, powers = Fraction(1), dict[Expression, int | Fraction]()
    for base, exponent in map(whole_power, factors):
        if isinstance(base, Number):
            number *= base.value**exponent
        else:
            powers[base] = powers.get(base, Fraction(0)) + exponent
    return product_of_powers(number, powers, ordering)
