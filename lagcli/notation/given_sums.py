"""Sums of a file, found again in its answers: R² + 2 R z where the algebra has R (R + 2 z).

Two sums are the same where they are when multiplied out, with functions, roots and denominators
that are no single terms as letters.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from math import gcd, lcm, prod
from typing import TypeAlias, cast

from lagcli.expression import (
    ONE,
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
    children,
    operation_count,
    power_of,
    quotient_of,
    terms_of,
    walk,
)
from lagcli.notation.factors import (
    base_and_exponent,
    odd_base,
    over_root,
    parts_of,
    power_product,
    product_of_powers,
    whole_power,
    with_base,
    with_content,
)
from lagcli.notation.fractions import products
from lagcli.notation.likeness import (
    Key,
    Monomial,
    Polynomial,
    inverse,
    joined,
    multiplied_out,
    parity,
    signed_key,
)
from lagcli.notation.ordering import Ordering, is_letter, is_rate, positive_first
from lagcli.rewriting import rebuilt

#: How many times as long as the answer's the file's own sum may be.
_LONGER = 1.4
#: Terms of a sum, or a part of one, that is looked for within longer sums.
_SHORT = 4
#: Terms of a sum without its brackets, in which those of the file are looked for.
_SEVERAL = 8
#: The letters of a sum or its square, what it is multiplied out, and it.
_Short: TypeAlias = tuple[frozenset[Expression], Polynomial, Expression]


class GivenSums:
    """The sums among formulas, by what they are when multiplied out.

    Parameters
    ----------
    energies
        Whole formulas, which may have a letter in all of their terms.
    ordering
        Of the factors of a product.
    """

    def __init__(
        self, formulas: Iterable[Expression], energies: Iterable[Sum], ordering: Ordering
    ) -> None:
        self._found: dict[frozenset[Expression], list[tuple[Polynomial, Sum]]] = {}
        self._ordering = ordering
        self._short: list[_Short] = []
        formulas = [*formulas]
        divided = (p for node in formulas for p in walk(node) if isinstance(p, Quotient))
        below = (f for part in divided for f in parts_of(part.denominator)[1])
        self._below = {arranged_within(base, ordering) for base, _ in map(whole_power, below)}
        self._fits: dict[Key, set[bool]] = {}  # whether denominators can be these sums
        self._unfit: Container[Key] = ()
        for whole in energies:
            self._keep(whole, multiplied_out(whole))
        self._whole = {shown for found in self._found.values() for _, shown in found}
        for part in (part for node in formulas for part in walk(node)):
            value = multiplied_out(part) if isinstance(part, Sum) else None
            if value and not set.intersection(*({x for x, _ in term} for term in value)):
                self._keep(cast(Sum, part), value)
        for names, found in self._found.items():
            for value, shown in found:
                self._keep_short(names, value, shown)

    def anew(self, unfit: Container[Key]) -> None:
        """Begin another section, in which not all rows can have these denominators."""
        self._fits.clear()
        self._unfit = unfit

    def unfit(self) -> Iterator[Key]:
        """The sums that are denominators of some rows of the section, and cannot be of others."""
        return (key for key, found in self._fits.items() if len(found) > 1)

    def _keep_short(self, leaves: frozenset[Expression], value: Polynomial, node: Sum) -> None:
        """Keep a sum and its square, to be found within longer sums; none of squared rates."""
        if len(value) > _SHORT or any(
            isinstance(part, Quotient) or (isinstance(part, Power) and is_rate(part.base))
            for part in walk(node)
        ):
            return
        square = Power(node, Number(Fraction(2)))
        for part, out in ((square, multiplied_out(square)), (node, value)):
            if out and all(part != known for _, _, known in self._short):
                self._short.append((leaves, out, part))

    def within(self, node: Sum) -> Sum:
        """a (x + y)² + b for a x² + 2 a x y + a y² + b, where the file has x + y.

        k (z − y) − c (y − x) for k z − (k + c) y + c x, where it has z − y and y − x.
        """
        names = leaves(node)
        near = [each for each in self._short if each[0] <= names]
        if not near or len(node.terms) < 2:
            return node
        found = self._with_short(node, near)
        apart = [each for term in node.terms for each in products(term, self._ordering)]
        if not len(node.terms) < len(apart) <= _SEVERAL:
            return found
        other = self._with_short(Sum((*apart,)), near)
        if len(other.terms) >= len(found.terms) or _cost(other) > _cost(found):
            letters = [each for each in near if all(map(is_letter, terms_of(each[2])))]
            other = self._with_short(Sum((*apart,)), letters)  # a x + b (x − y), (m + M) x'
            if len(other.terms) == len(apart) or self._effort(other) >= self._effort(found):
                return found
        return Sum((*positive_first(self._ordering.sorted(other.terms)),))

    def _effort(self, node: Sum) -> int:
        """The operations, and brackets that the file has not."""
        node = Sum((*map(over_root, node.terms),))
        inner = (p for p in walk(node) if isinstance(p, Sum) and p is not node)
        return _cost(node) + sum(self.like(each) is None for each in inner)

    def _with_short(self, node: Sum, near: Sequence[_Short]) -> Sum:
        letters: dict[str, Expression] | None = None
        marked, brackets = _marked(node.terms)
        parts = [multiplied_out(term) for term in marked]
        if any(part is None or len(part) > _SHORT for part in parts):
            return node
        terms, polys = list(node.terms), cast(list[Polynomial], parts)
        for _, value, given in near:
            for used, ratio, scale in _multiples(polys, value):
                again = any(given in parts_of(term)[1] for term in node.terms)
                letters = letters or _letters(node) | brackets
                if not (scale or again) or not all(letter in letters for letter, _ in scale):
                    continue
                powers = {letters[x]: e for x, e in scale}
                letters_only = all(map(is_letter, terms_of(given)))
                if letters_only and any(is_rate(x) and x in leaves(given) for x in powers):
                    continue  # x' y' − y'², not (x' − y') y'
                powers[_base(given)] = 2 if isinstance(given, Power) else 1
                whole = product_of_powers(ratio, powers, self._ordering)
                before = sum(_cost(terms[k]) for k in used) + len(used) - 1
                if _cost(whole) < before + _worth(given) + again:
                    rest = [k for k in range(len(terms)) if k not in used[1:]]
                    terms[used[0]] = whole
                    polys[used[0]] = {}
                    terms, polys = [terms[k] for k in rest], [polys[k] for k in rest]
                    break
        return node if len(terms) == len(node.terms) else self._with_short(Sum((*terms,)), near)

    def _keep(self, node: Sum, value: Polynomial | None) -> None:
        if value and 1 < len(value) < len(node.terms):  # R² − l²/4 + l²/12 is R² − l²/6
            node = self._collected(node, value)
            value = multiplied_out(node)
        if value and len(value) >= len(node.terms) and is_tidy(node):  # M + M is 2 M
            shown = cast(Sum, arranged_within(node, self._ordering))
            self._found.setdefault(leaves(node), []).append((value, shown))

    def _collected(self, node: Sum, value: Polynomial) -> Sum:
        """The sum with like terms as one; itself where a letter of them is none of its parts."""
        letters = _letters(node)
        if any(x not in letters for term in value for x, _ in term):
            return node
        terms = []
        for term, number in value.items():
            powers = {letters[x]: e for x, e in sorted(term)}
            whole = product_of_powers(abs(number), powers, self._ordering)
            terms.append(Negative(whole) if number < 0 else whole)
        whole = Sum((*terms,))
        return self._multiplied(whole, _denominator(whole))  # 6 R² − l²

    def like(self, node: Expression) -> tuple[Fraction, Sum] | None:
        """(c, S): the node is c S with a sum S of the file that is not much longer."""
        found = self._found.get(leaves(node))
        value = multiplied_out(node) if found else None
        for other, given in found or () if value else ():
            first = next(iter(other))
            ratio = (value or {}).get(first, Fraction(0)) / other[first]
            alike = value == {term: ratio * c for term, c in other.items()}
            if given in self._whole and abs(ratio) != 1:  # no 2 (m v²/2 − k r²/2) for m v² − k r²
                continue
            if alike and operation_count(given) <= _LONGER * operation_count(node) + 1:
                return ratio, given
        return None

    def multiple(self, node: Sum) -> tuple[Fraction, Monomial, Sum] | None:
        """(c, m, S): the node is c m S with a sum S of the file and a product m of powers."""
        found = self._found.get(leaves(node))
        value = multiplied_out(node) if found else None
        for other, given in found or () if value else ():
            assert value is not None
            for term, number in value.items() if len(value) == len(other) else ():
                first = next(iter(other))
                ratio, scale = number / other[first], joined(term, inverse(first))
                if value == {joined(t, scale): ratio * c for t, c in other.items()}:
                    return ratio, scale, given
        return None

    def in_product(
        self, minus: bool, above: list[Expression], below: list[Expression]
    ) -> tuple[bool, list[Expression], list[Expression]]:
        """The sign and the factors, with the sums of the file for their multiples."""
        number, above, below = self._divided(above, below)
        other, above, below = self._over_given(above, below)
        number *= other
        for factors, sign in (above, 1), (below, -1):
            number *= self._joined(factors) ** sign
            for place, factor in enumerate(factors):
                base, exponent = whole_power(factor)
                if not isinstance(base, Sum):
                    continue
                ratio, shown = self.like(base) or with_content(base)
                before = number * ratio ** (sign * exponent) * _numbers(above) / _numbers(below)
                plain = sign == exponent == 1 and self._ordering.is_parameter(shown)
                below_terms = _denominator(shown) if plain else 1
                if below_terms > 1 and before.numerator % below_terms == 0:
                    ratio /= below_terms  # 3 (M + 2 m), not 6 (M/2 + m)
                    shown = self._multiplied(shown, below_terms)
                if ratio != 1:
                    number *= ratio ** (sign * exponent)
                    factors[place] = with_base(factor, shown)
        whole = [any(isinstance(f, Number) for f in factors) for factors in (above, below)]
        within = any(isinstance(f, Number) for factors in (above, below) for f in factors[1:])
        if number == 1 and not within and not all(whole):
            return minus, above, below
        for factors, sign in (above, 1), (below, -1):
            numbers = [f for f in factors if isinstance(f, Number)]
            factors[:] = [f for f in factors if not isinstance(f, Number)]
            for each in numbers:
                number *= each.value**sign
        if number.denominator != 1:
            below.insert(0, Number(Fraction(number.denominator)))
        if abs(number.numerator) != 1 or not above:
            above.insert(0, Number(Fraction(abs(number.numerator))))
        return minus ^ (number < 0), above, below

    def _over_given(
        self, above: list[Expression], below: list[Expression]
    ) -> tuple[Fraction, list[Expression], list[Expression]]:
        """A number, and r'²/(1 − rs/r) for r r'²/(r − rs) where the file has such a denominator.

        So F/(m + I/R²) for F R²/(m R² + I), if every row of the section can be written so.
        """
        number = Fraction(1)
        for place, factor in enumerate(below):
            base, exponent = whole_power(factor)
            like = self.multiple(base) if isinstance(base, Sum) else None
            if like is None or not like[1]:
                continue
            letters = {repr(n): n for n in walk(base) if isinstance(n, Name)}
            left = Counter[Expression](dict(map(whole_power, above)))
            for letter, power in like[1]:
                left[letters.get(letter, ONE)] -= power * exponent
            fits = ONE not in left and min(left.values()) >= 0 and len(left) >= len(above)
            if like[2] not in self._below:
                key = signed_key(like[2])[1]
                self._fits.setdefault(key, set()).add(fits)
                fits = fits and key not in self._unfit and all(e > 0 for _, e in like[1])
            if not fits:
                continue
            number /= like[0] ** exponent
            below[place] = power_of(like[2], exponent)
            above = [power_of(x, e) for x, e in left.items() if e] or [ONE]
        return number, above, below

    def with_half(
        self, above: list[Expression], below: list[Expression]
    ) -> tuple[list[Expression], list[Expression]]:
        """(M + 2 m) x'²/2 for (M/2 + m) x'², as energies are written."""
        powers = map(whole_power, above)
        squared = any(e == 2 and not self._ordering.is_parameter(b) for b, e in powers)
        sums = [f for f in above if isinstance(f, Sum) and _denominator(f) == 2]
        if not squared or len(sums) != 1 or any(isinstance(f, Number) for f in (*above, *below)):
            return above, below
        double = self._multiplied(sums[0], 2)
        return [double if f is sums[0] else f for f in above], [Number(Fraction(2)), *below]

    def _multiplied(self, node: Sum, number: int) -> Sum:
        """The sum multiplied by a number, term by term."""
        inverse = Number(Fraction(-1))
        terms = []
        for term in node.terms:
            minus, above, below = parts_of(term)
            under = (Power(f, inverse) for f in below)
            whole = power_product((Number(Fraction(number)), *above, *under), self._ordering)
            terms.append(Negative(whole) if minus else whole)
        return Sum((*terms,))

    def _joined(self, factors: list[Expression]) -> Fraction:
        """A number, with R² − l² of the file for (R + l) (R − l) among the factors."""
        number = Fraction(1)
        sums = [f for f in factors if odd_base(f)[0] is not None]
        for one, other in combinations(sums, 2):
            (a, m), (b, n) = base_and_exponent(one), base_and_exponent(other)
            like = self.like(Product((a, b))) if m == n else None
            if like is None or not {one, other} <= {*factors}:
                continue
            if like[0] == 1 or parity(m) is not None:
                factors[factors.index(one)] = with_base(one, like[1])
                factors.remove(other)
                number *= like[0] ** whole_power(one)[1]
        return number

    def _divided(
        self, above: list[Expression], below: list[Expression]
    ) -> tuple[Fraction, list[Expression], list[Expression]]:
        """A number, and the factors with a sum of the file for (rs − r)/r, a/b + cos θ."""
        number = Fraction(1)
        for place, factor in enumerate(above):
            like = self.multiple(factor) if isinstance(factor, Sum) else None
            if like is None or not like[1]:
                continue
            letters = {repr(n): n for n in walk(factor) if isinstance(n, Name)}
            left = Counter[Expression](dict(map(whole_power, below)))
            for letter, exponent in like[1]:
                left[letters.get(letter, ONE)] -= exponent
            if ONE in left or min(left.values(), default=0) < 0:
                continue
            number *= like[0]
            above[place] = like[2]
            kept = [Power(x, Number(Fraction(e))) for x, e in left.items() if e]
            below = parts_of(power_product(kept, self._ordering))[1] if kept else []
        return number, above, below


def has_like_terms(node: Sum) -> bool:
    """Whether two terms without a squared bracket have a part in common: m g y + m g (y + l)."""
    plain = (
        term
        for term in node.terms
        if not any(isinstance(p, Power) and isinstance(p.base, Sum) for p in walk(term))
    )
    found = [each for term in plain for each in multiplied_out(term) or ()]
    return len(set(found)) < len(found)


def differ_in_parameters(node: Sum, ordering: Ordering) -> bool:
    """Whether two terms differ in parameters alone: m g l cos θ/2 + M g l cos θ."""
    found = []
    for term in node.terms:
        _, above, below = parts_of(term)
        varying = frozenset(f for f in (*above, *below) if not ordering.is_parameter(f))
        if varying and not any(isinstance(odd_base(f)[0], Sum) for f in varying):
            found.append(varying)
    return len(set(found)) < len(found)


def _cost(term: Expression) -> int:
    """The operations of a term, without signs: these belong to the sums."""
    return operation_count(term) - sum(isinstance(part, Negative) for part in walk(term))


def _worth(given: Expression) -> int:
    """Operations that a sum of the file may cost: a root, which it has above and below."""
    roots = [t for t in terms_of(given) if isinstance(t, Call) and t.function == "sqrt"]
    return sum(operation_count(root) + 1 for root in roots) + (len(terms_of(given)) > 2)


def _multiples(
    parts: Sequence[Polynomial], value: Polynomial
) -> Iterator[tuple[list[int], Fraction, Monomial]]:
    """Places k, c and m where the parts at these places are together c m times a sum."""
    owner = {term: k for k, part in enumerate(parts) for term in part}
    first = next(iter(value))
    for term, place in owner.items():
        ratio, scale = parts[place][term] / value[first], joined(term, inverse(first))
        wanted = {joined(t, scale): ratio * c for t, c in value.items()}
        used = sorted({owner[t] for t in wanted if t in owner})
        if len(used) < 2 or sum(len(parts[k]) for k in used) != len(wanted):
            continue
        if all(wanted.get(t) == c for k in used for t, c in parts[k].items()):
            yield used, ratio, scale


def _marked(
    terms: Sequence[Expression],
) -> tuple[list[Expression], dict[str, Expression]]:
    """The terms with a letter for each bracket that several have as a factor; the brackets."""
    keys = Counter(signed_key(f)[1] for t in terms for f in parts_of(t)[1] if isinstance(f, Sum))
    found: dict[str, Expression] = {}
    signs: dict[Key, int] = {}
    marked = []
    for term in terms:
        minus, above, below = parts_of(term)
        for place, factor in enumerate(above):
            sign, key = signed_key(factor)
            if keys[key] > 1:  # of sums alone
                minus ^= signs.setdefault(key, sign) != sign
                above[place] = Name(f"#{[*signs].index(key)}")
                found.setdefault(repr(above[place]), factor)
        whole = quotient_of(above, below)
        marked.append(Negative(whole) if minus else whole)
    return (marked, found) if found else ([*terms], found)


def _letters(node: Expression) -> dict[str, Expression]:
    """What stands for the letters of a polynomial."""
    found: dict[str, Expression] = {}
    for part in walk(node):
        if isinstance(part, (Call, PartialCall)):
            sign, key = signed_key(part)
            if sign > 0:
                found[repr(key)] = part
        else:
            found[repr(part)] = part
    return found


def leaves(node: Expression) -> frozenset[Expression]:
    """The names in it."""
    return frozenset(part for part in walk(node) if isinstance(part, Name))


def arranged_within(node: Expression, ordering: Ordering) -> Expression:
    """The formula with the factors of each product in their order."""
    node = rebuilt(node, lambda part: arranged_within(part, ordering))
    return Product(arranged(node.factors, ordering)) if isinstance(node, Product) else node


def arranged(factors: Sequence[Expression], ordering: Ordering) -> tuple[Expression, ...]:
    """The factors, of different bases, in their order."""
    whole = {_base(factor): factor for factor in factors}
    ranked = ordering.arranged([(base, Fraction(1)) for base in whole])
    return tuple(whole[base] for base, _ in ranked) if len(whole) == len(factors) else (*factors,)


def is_tidy(node: Expression) -> bool:
    """Whether it can be printed as it stands: numbers whole and first, no bracket for nothing."""
    match node:
        case Number(value=value):
            return value.denominator == 1
        case Product(factors=(first, *rest)):
            bad = any(isinstance(f, (Number, Negative, Quotient, Product)) for f in rest)
            bad = bad or isinstance(first, (Negative, Quotient, Product))
            bad = bad or (isinstance(first, Number) and first.value <= 1)
            bad = bad or len(set(map(_base, node.factors))) < len(node.factors)
        case Sum(terms=terms):
            bad = any(isinstance(term, Sum) for term in terms) or isinstance(terms[0], Negative)
            bad = bad or sum(not leaves(term) for term in terms) > 1
        case Negative(operand=inner):
            bad = isinstance(inner, (Negative, Sum))
        case Quotient(numerator=above, denominator=below):
            bad = isinstance(above, (Negative, Quotient)) or isinstance(below, Quotient)
            bad = bad or gcd(_number(above), _number(below)) > 1
        case Power(base=base, exponent=exponent):
            bad = isinstance(base, Product) or exponent == ONE  # (2 l θ')², x¹
            bad = bad or (isinstance(base, Quotient) and not all(map(is_letter, children(base))))
        case _:
            bad = False
    return not bad and all(map(is_tidy, children(node)))


def _numbers(factors: Iterable[Expression]) -> Fraction:
    """The product of the numbers among factors."""
    return prod((f.value for f in factors if isinstance(f, Number)), start=Fraction(1))


def _denominator(node: Sum) -> int:
    """The least number by which the fractions of numbers in a sum become whole."""
    below = (f for term in node.terms for f in parts_of(term)[2] if isinstance(f, Number))
    return lcm(*(f.value.numerator for f in below))


def _number(node: Expression) -> int:
    """The whole number that a product begins with."""
    first = node.factors[0] if isinstance(node, Product) else node
    return first.value.numerator if isinstance(first, Number) else 1


def _base(node: Expression) -> Expression:
    return node.base if isinstance(node, Power) else node
