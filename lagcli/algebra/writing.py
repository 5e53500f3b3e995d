"""Sums, products and powers as trees, written the way a textbook writes them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import gcd

from lagcli.algebra.circular_factors import single_angles, tangents, upright
from lagcli.evaluation import finite_value
from lagcli.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    all_negative,
    multiple_of,
    operation_count,
    opposite,
    product_of,
    terms_of,
    without_minus,
)
from lagcli.notation.ordering import Factor, Ordering, positive_first

#: sqrt(2)*E^(1/4) is (4*E)^(1/4), but sqrt(3)*a^(1/6) has no 27.
_LARGE = 10


class Writer:
    """Builds trees in a fixed order of names.

    Parameters
    ----------
    order
        Parameters, ``t``, coordinates, multipliers, as they are to follow in a product.
    """

    def __init__(self, order: Sequence[str] = ()) -> None:
        self.ordering = Ordering(order)

    def number(self, value: Fraction) -> Expression:
        """A rational: 3, -3, 3/2."""
        return self.product(value, ())

    def product(self, coefficient: Fraction, factors: Iterable[Factor]) -> Expression:
        """coefficient * prod base^exponent, with what divides in one denominator."""
        if coefficient == 0:
            return ZERO
        coefficient, pairs = upright(*_flattened(coefficient, factors))
        coefficient, pairs = single_angles(coefficient, _merged(pairs))
        pairs = self._joined_exponentials(self._into_brackets(tangents(pairs)))
        pairs = _powers_of_moduli(self._into_roots(_without_moduli(pairs)))
        coefficient, pairs = self._joined_roots(coefficient, pairs)
        if coefficient < 0:
            coefficient, pairs = self._turned(coefficient, pairs)
        above = self._factors(pairs, 1)
        below = self._factors(pairs, -1)
        return multiple_of(coefficient, above, below)

    def _into_brackets(self, pairs: list[Factor]) -> list[Factor]:
        """exp(-2 x) - exp(-x) for (1 - exp(x)) exp(-2 x), m a - sqrt(k m) for its sqrt(m)."""
        for goes, most in ((_is_exponential, 3), (_is_root, 0)):
            outside = [pair for pair in pairs if goes(*pair)]
            for base in [b for b, e in pairs if outside and e == 1 and isinstance(b, Sum)]:
                parts = [_flattened(Fraction(1), [(term, Fraction(1))]) for term in base.terms]
                if any(e > 0 and goes(b, e) for _, part in parts for b, e in part):
                    inside = self.sum(self.product(c, [*part, *outside]) for c, part in parts)
                    if operation_count(inside) <= operation_count(base) + most:
                        rest = [p for p in pairs if p not in outside and p[0] != base]
                        pairs = [*rest, (inside, Fraction(1))]
                        break
        return pairs

    def _joined_exponentials(self, pairs: list[Factor]) -> list[Factor]:
        """exp(a)^k exp(b) = exp(k a + b), x^n x^k = x^(n + k)."""
        result: list[Factor] = []
        exponents: list[Factor] = []
        powers: dict[Expression, list[Factor]] = {}
        for base, exponent in pairs:
            if isinstance(base, Call) and base.function == "exp":
                exponents.append((base.arguments[0], exponent))
            elif isinstance(base, Power) and exponent.denominator == 1:
                powers.setdefault(base.base, []).append((base.exponent, exponent))
            else:
                result.append((base, exponent))
        whole = self._collected(exponents)
        if whole != ZERO:
            result.append((Call("exp", (whole,)), Fraction(1)))
        for base, parts in powers.items():
            plain = [(ONE, exponent) for b, exponent in result if b == base]
            result = [pair for pair in result if pair[0] != base]
            whole = self._collected([*parts, *plain])
            if isinstance(whole, Negative):
                result.append((Power(base, whole.operand), Fraction(-1)))
            elif whole != ZERO:
                result.append((Power(base, whole), Fraction(1)))
        return result

    def _collected(self, multiples: list[Factor]) -> Expression:
        """k a + n b + ... for (a, k), (b, n), ..., like terms added."""
        found: dict[tuple[Factor, ...], Fraction] = {}
        for node, multiple in multiples:
            for term in terms_of(node):
                coefficient, pairs = _flattened(multiple, [(term, Fraction(1))])
                key = tuple(_merged(pairs))
                found[key] = found.get(key, Fraction(0)) + coefficient
        return self.sum(self.product(coefficient, pairs) for pairs, coefficient in found.items())

    def _factors(self, pairs: list[Factor], sign: int) -> list[Expression]:
        chosen = [(base, exponent * sign) for base, exponent in pairs if exponent * sign > 0]
        return [self.power(base, exponent) for base, exponent in self.ordering.arranged(chosen)]

    def _into_roots(self, pairs: list[Factor]) -> list[Factor]:
        """sqrt(r² a + b) |r|/r² as sqrt(a + b/r²)."""
        half = Fraction(1, 2)
        exponents = dict(pairs)
        for modulus, power in pairs:
            if not isinstance(modulus, Call) or modulus.function != "abs":
                continue
            (inner,) = modulus.arguments
            if power + exponents.get(inner, Fraction(0)) != -1:
                continue
            for root, exponent in pairs:
                if not isinstance(root, Sum) or exponent != half:
                    continue
                square = (inner, Fraction(-2))
                divided = self.sum(
                    self.product(Fraction(1), [(term, Fraction(1)), square]) for term in root.terms
                )
                if operation_count(divided) <= operation_count(root):
                    for each in (modulus, inner, root):
                        exponents.pop(each, None)
                    return self._into_roots([*exponents.items(), (divided, half)])
        return pairs

    def _joined_roots(
        self, coefficient: Fraction, pairs: list[Factor]
    ) -> tuple[Fraction, list[Factor]]:
        """sqrt(a)*sqrt(b)/sqrt(c) as sqrt(a*b/c), sqrt(k)*r^(3/2) as r*sqrt(k*r)."""
        half = Fraction(1, 2)
        coefficient, pairs = self._joined_higher_roots(coefficient, pairs)
        roots = [(b, e) for b, e in pairs if abs(e) == half or _is_half_power(b, e)]
        if len(roots) < 2 and not any(isinstance(base, Number) for base, _ in roots):
            return coefficient, pairs
        rest = [pair for pair in pairs if pair not in roots]
        above = any(e > 0 for _, e in roots)  # else 1/(r sqrt(k r)), not 1/sqrt(k r^3)
        for place, (base, exponent) in enumerate(roots):
            if abs(exponent) > half and (exponent > 0 or not above):
                root = half if exponent > 0 else -half
                rest.append((base, exponent - root))
                roots[place] = base, root
        number = Fraction(1)
        inside: list[Factor] = []
        for base, exponent in roots:
            if isinstance(base, Number):
                # 1/2 * sqrt(2) = 1/sqrt(2), sqrt(6 g/l)/4 = sqrt(3 g/(8 l))
                value, sign = base.value, (1 if exponent > 0 else -1)
                divisor = coefficient.denominator
                if sign > 0 and divisor % value == 0:
                    coefficient, sign = coefficient * value, -1
                elif sign > 0 and gcd(value.numerator, divisor) > 1 and len(roots) > 1:
                    coefficient, value = coefficient * divisor, value / divisor**2
                elif sign < 0 and coefficient.numerator % value == 0:
                    coefficient, sign = coefficient / value, 1
                number *= value**sign
            else:
                inside.append((base, exponent * 2))
        radicand = self.product(number, inside)
        if isinstance(radicand, Quotient) and radicand.numerator == ONE:
            return coefficient, [*rest, (radicand.denominator, -half)]
        return coefficient, [*rest, (radicand, half)]

    def _joined_higher_roots(
        self, coefficient: Fraction, pairs: list[Factor]
    ) -> tuple[Fraction, list[Factor]]:
        """a^(1/4)/(m^(1/4)*sqrt(w)) as (a/(m*w^2))^(1/4), (9*a)^(1/3)/3 as (a/3)^(1/3).

        With a root of a sum within: (a^2 + b^2)^(1/4)/sqrt(l) as sqrt(sqrt(a^2 + b^2)/l).
        """
        for index in sorted({e.denominator for _, e in pairs if e.denominator > 2}, reverse=True):
            roots = [p for p in pairs if p[1].denominator > 1 and _is_in_root(index, *p)]
            if all(isinstance(base, Number) for base, _ in roots):  # (a + b)^(1/3)*4^(1/3)
                roots += [p for p in pairs if p[1] == Fraction(1, index) and p not in roots][:1]
            if (
                len(roots) > 1 and len({e for _, e in roots}) == 1
            ):  # (m g)^(2/3) for m^(2/3)*g^(2/3)
                [alike] = {abs(e) for _, e in roots}
                if alike.numerator > 1:
                    side = 1 if roots[0][1] > 0 else -1
                    whole = self.product(Fraction(1), [(b, Fraction(1)) for b, _ in roots])
                    pairs = [*(pair for pair in pairs if pair not in roots), (whole, side * alike)]
                    continue
            if len(roots) > 1 and any(e.denominator == index for _, e in roots):
                number, inside = _flattened(Fraction(1), [_raised(b, e * index) for b, e in roots])
                absorbed = number / coefficient.denominator**index
                if _height(absorbed) < _height(number):
                    number, coefficient = absorbed, coefficient * coefficient.denominator
                whole = self.product(number, inside)
                rest = [pair for pair in pairs if pair not in roots]
                if isinstance(whole, Quotient) and whole.numerator == ONE:
                    return coefficient, [*rest, (whole.denominator, Fraction(-1, index))]
                return coefficient, [*rest, (whole, Fraction(1, index))]
        for exponent in sorted({abs(e) for b, e in pairs if _is_like_power(b, e)}):
            own = [(b, e) for b, e in pairs if abs(e) == exponent and _is_like_power(b, e)]
            if len(own) > 1:  # (m g/k)^(4/3) for m^(4/3)*g^(4/3)/k^(4/3)
                whole = self.product(Fraction(1), [(b, e / exponent) for b, e in own])
                pairs = [*(pair for pair in pairs if pair not in own), (whole, exponent)]
        half = Fraction(1, 2)
        if any(abs(e) == half for _, e in pairs):
            pairs = [
                (Call("sqrt", (b,)), 2 * e) if isinstance(b, Sum) and e.denominator == 4 else (b, e)
                for b, e in pairs
            ]
        return coefficient, pairs

    def _turned(self, coefficient: Fraction, pairs: list[Factor]) -> tuple[Fraction, list[Factor]]:
        """m*(x'' - a - b) for -m*(-x'' + a + b): no minus before a bracket that has one first."""
        for position, (base, exponent) in enumerate(pairs):
            if not isinstance(base, Sum) or exponent != 1:
                continue
            negatives = sum(isinstance(term, Negative) for term in base.terms)
            mostly = isinstance(base.terms[0], Negative) and len(base.terms) <= 2 * negatives + 1
            if mostly or (finite_value(base) or 0) < 0:
                turned = self.negative_sum(base)
                return -coefficient, [*pairs[:position], (turned, exponent), *pairs[position + 1 :]]
        return coefficient, pairs

    def power(self, base: Expression, exponent: Fraction) -> Expression:
        """base^exponent for a positive rational exponent."""
        if exponent == 1:
            return base
        if exponent == Fraction(1, 2):
            if isinstance(base, Negative) and isinstance(base.operand, Sum):
                base = self.negative_sum(base.operand)  # sqrt(a - b), not sqrt(-(b - a))
            return Call("sqrt", (base,))
        if exponent.denominator == 1:
            return Power(base, Number(exponent))
        fraction = Quotient(
            Number(Fraction(exponent.numerator)), Number(Fraction(exponent.denominator))
        )
        return Power(base, fraction)

    def sum(self, terms: Iterable[Expression]) -> Expression:
        """The terms in a textbook's order, a positive one first where there is one."""
        parts: list[Expression] = []
        for term in terms:
            if isinstance(term, Negative) and isinstance(term.operand, Sum):
                term = self.negative_sum(term.operand)
            parts.extend(terms_of(term))
        parts = [part for part in parts if part != ZERO]
        if not parts:
            return ZERO
        if len(parts) == 1:
            return parts[0]
        parts = self.ordering.sorted(parts)
        if self.ordering.term(parts[0])[0] == 0:
            parts = positive_first(parts)
        return Sum(tuple(parts))

    def negative(self, node: Expression) -> Expression:
        """-node; the sign goes into a sum whose terms are all negative."""
        match node:
            case Negative(operand=operand):
                return operand
            case Number(value=value) if value == 0:
                return node
            case Sum():
                return self.negative_sum(node)
            case _:
                return Negative(node)

    def negative_sum(self, node: Sum) -> Expression:
        """The sum of the terms with their signs changed."""
        return self.sum(map(opposite, node.terms))


def _is_half_power(base: Expression, exponent: Fraction) -> bool:
    """Whether it is r^(3/2) of a letter or a function."""
    return isinstance(base, (Name, Call)) and exponent.denominator == 2


def _is_in_root(index: int, base: Expression, exponent: Fraction) -> bool:
    """Whether base^exponent may stand under a common root of this index."""
    if isinstance(base, Number) and exponent.denominator < index:  # (4*a)^(1/4), not (27*a)^(1/6)
        raised = index * exponent
        return raised.denominator == 1 and base.value ** abs(int(raised)) < _LARGE
    if isinstance(base, Number):
        return exponent.denominator == index and abs(exponent) < 1
    plain = isinstance(base, Name) or (isinstance(base, Call) and base.function == "abs")
    return plain and abs(exponent) < 1 and index % exponent.denominator == 0


def _is_like_power(base: Expression, exponent: Fraction) -> bool:
    """Whether it is r^(4/3) of a letter or a modulus."""
    plain = isinstance(base, Name) or (isinstance(base, Call) and base.function == "abs")
    return plain and abs(exponent) > 1 and exponent.denominator > 2


def _height(value: Fraction) -> int:
    """How long a rational is."""
    return abs(value.numerator) * value.denominator


def _raised(base: Expression, exponent: Fraction) -> Factor:
    """|p|^2 as p^2."""
    even = isinstance(base, Call) and exponent % 2 == 0
    return (base.arguments[0], exponent) if even else (base, exponent)  # type: ignore[attr-defined]


def _is_exponential(base: Expression, _: Fraction) -> bool:
    return isinstance(base, Call) and base.function == "exp"


def _is_root(base: Expression, exponent: Fraction) -> bool:
    return isinstance(base, Name) and exponent == Fraction(1, 2)


def _merged(pairs: Iterable[Factor]) -> list[Factor]:
    exponents: dict[Expression, Fraction] = {}
    for base, exponent in pairs:
        exponents[base] = exponents.get(base, Fraction(0)) + exponent
    return [(base, exponent) for base, exponent in exponents.items() if exponent]


def _flattened(coefficient: Fraction, factors: Iterable[Factor]) -> tuple[Fraction, list[Factor]]:
    """Signs, numbers, products, quotients and powers out of the factors."""
    result: list[Factor] = []
    stack = list(factors)
    stack.reverse()
    while stack:
        base, exponent = stack.pop()
        whole = exponent.denominator == 1
        match base:
            case Negative(operand=operand) if whole:
                coefficient = -coefficient if exponent % 2 else coefficient
                stack.append((operand, exponent))
            case Number(value=value) if whole:
                coefficient *= value ** int(exponent)
            case Product(factors=inner) if whole:
                stack.extend((each, exponent) for each in reversed(inner))
            case Quotient(numerator=above, denominator=below) if whole:
                stack.extend([(below, -exponent), (above, exponent)])
            case Power(base=inner_base, exponent=Number(value=value)) if whole:
                stack.append((inner_base, exponent * value))
            case Power(base=inner_base, exponent=Number(value=value)) if value % 2 == 0:
                stack.append((_modulus(inner_base), exponent * value))  # sqrt(f²) = |f|
            case Call(function="sqrt", arguments=(radicand,)):
                stack.append((radicand, exponent / 2))
            case Sum() if whole and all_negative(base):
                coefficient = -coefficient if exponent % 2 else coefficient
                result.append((without_minus(base), exponent))
            case _:
                result.append((base, exponent))
    return coefficient, result


def _modulus(node: Expression) -> Expression:
    absolute = isinstance(node, Call) and node.function in ("abs", "exp", "cosh", "sqrt")
    return node if absolute else Call("abs", (node,))


def _powers_of_moduli(pairs: list[Factor]) -> list[Factor]:
    """p² |p| as |p|³, |p|/p² as 1/|p|."""
    exponents = dict(pairs)
    for base, _ in pairs:
        if isinstance(base, Call) and base.function == "abs":
            (inner,) = base.arguments
            if exponents.get(inner, Fraction(1)) % 2 == 0:
                exponents[base] += exponents.pop(inner)
    return [pair for pair in exponents.items() if pair[1]]


def _without_moduli(pairs: list[Factor]) -> list[Factor]:
    """sqrt(a*b)/|b| as sqrt(a/b)."""
    half = Fraction(1, 2)
    exponents = dict(pairs)
    for base, exponent in pairs:
        if not isinstance(base, Product) or abs(exponent) != half:
            continue
        for factor in base.factors:
            modulus = Call("abs", (factor,))
            if exponents.get(modulus) == -2 * exponent:
                rest = product_of(f for f in base.factors if f is not factor)
                del exponents[modulus], exponents[base]
                exponents[Quotient(rest, factor)] = exponent
                break
    return list(exponents.items())


def name(text: str) -> Name:
    """The name of a symbol: the primes at its end are velocity and acceleration."""
    bare = text.rstrip("'")
    return Name(bare, len(text) - len(bare))
