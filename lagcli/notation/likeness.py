"""What is equal though it is written otherwise: up to signs and order, or when multiplied out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, TypeAlias

from lagcli.expression import (
    Call,
    Expression,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
)

Key: TypeAlias = tuple[object, ...]
#: The sign and the key of a part.
KeyOf: TypeAlias = Callable[[Expression], tuple[int, Any]]
#: Letters with their exponents.
Monomial: TypeAlias = frozenset[tuple[str, int]]
Polynomial: TypeAlias = dict[Monomial, Fraction]

ODD = frozenset(("sin", "tan", "sinh", "tanh", "asin", "atan", "asinh", "atanh", "sign"))
EVEN = frozenset(("cos", "cosh", "abs", "sec"))
_MOST = 80  # terms of a sum that is multiplied out


def signed_key(node: Expression, of: KeyOf | None = None) -> tuple[int, Key]:
    """(sign, key): equal keys for what is equal up to its sign and the order of terms and factors.

    The sign says which of the two it is, so that a − b and b − a have one key and two signs.
    `of` gives those of the parts.
    """
    of = of or signed_key
    match node:
        case Negative(operand=operand):
            sign, key = of(operand)
            return -sign, key
        case Sum(terms=terms):
            pairs = sorted(((k, s) for s, k in map(of, terms)), key=repr)
            lead = pairs[0][1]
            return lead, ("+", *((s * lead, k) for k, s in pairs))
        case Product(factors=factors):
            signed = [of(each) for each in factors]
            minus = sum(s < 0 for s, _ in signed) % 2
            return -1 if minus else 1, ("*", *sorted((k for _, k in signed), key=repr))
        case Quotient(numerator=above, denominator=below):
            (a, one), (b, other) = of(above), of(below)
            return a * b, ("/", one, other)
        case Power(base=base, exponent=exponent):
            sign, key = of(base)
            odd = parity(exponent)
            if odd is None:  # of (a − b)^(3/2) the opposite is not (b − a)^(3/2)
                return 1, ("^", sign, key, of(exponent))
            return sign if odd else 1, ("^", key, of(exponent))
        case Call(function=function, arguments=arguments, primes=primes):
            inner = [of(each) for each in arguments]
            if function in EVEN:
                return 1, (function, inner[0][1])
            if function in ODD:
                return inner[0][0], (function, inner[0][1])
            return 1, (function, primes, *inner)
        case PartialCall(function=function, indices=indices, arguments=arguments):
            return 1, (function, indices, *map(of, arguments))
        case _:
            return 1, (str(node),)


class SignedNumbers:
    """`signed_key` with a number for each key, of large trees whose parts recur."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[Expression, tuple[int, int]]] = {}
        self._numbers: dict[Key, int] = {}

    def __call__(self, node: Expression) -> tuple[int, int]:
        """The sign and the number."""
        if id(node) not in self._known:
            if isinstance(node, Negative):
                sign, number = self(node.operand)
                sign = -sign
            else:
                sign, key = signed_key(node, self)
                number = self._numbers.setdefault(key, len(self._numbers))
            self._known[id(node)] = node, (sign, number)
        return self._known[id(node)][1]


def parity(exponent: Expression) -> int | None:
    """0 or 1 of a whole number, None of anything else."""
    match exponent:
        case Number(value=value) | Negative(operand=Number(value=value)):
            return value.numerator % 2 if value.denominator == 1 else None
        case _:
            return None


def multiplied_out(node: Expression) -> Polynomial | None:
    """The terms of an expression; None where there are too many."""
    match node:
        case Number(value=value):
            return {frozenset(): value} if value else {}
        case Negative(operand=operand):
            inner = multiplied_out(operand)
            return None if inner is None else {term: -c for term, c in inner.items()}
        case Sum(terms=terms):
            return _added(map(multiplied_out, terms))
        case Product(factors=factors):
            return _times(map(multiplied_out, factors))
        case Quotient(numerator=above, denominator=below):
            return _times([multiplied_out(above), _power(below, -1)])
        case Power(base=base, exponent=Number(value=value)) if value.denominator == 1:
            return _power(base, int(value))
        case Call() | PartialCall():
            sign, key = signed_key(node)
            return {frozenset([(repr(key), 1)]): Fraction(sign)}
        case _:
            return {frozenset([(repr(node), 1)]): Fraction(1)}


def _power(base: Expression, exponent: int) -> Polynomial | None:
    inner = multiplied_out(base)
    if inner is not None and len(inner) == 1:
        ((term, value),) = inner.items()
        return {frozenset((letter, e * exponent) for letter, e in term): value**exponent}
    if 0 < exponent < 5:
        return _times([inner] * exponent)
    return {frozenset([(repr(base), exponent)]): Fraction(1)}


def _added(parts: Iterable[Polynomial | None]) -> Polynomial | None:
    terms: list[tuple[Monomial, Fraction]] = []
    for part in parts:
        if part is None or len(terms) > _MOST:
            return None
        terms += part.items()
    return _collected(terms)


def _times(parts: Iterable[Polynomial | None]) -> Polynomial | None:
    found: Polynomial = {frozenset(): Fraction(1)}
    for part in parts:
        if part is None or len(found) * len(part) > _MOST:
            return None
        found = _collected((joined(a, b), x * y) for a, x in found.items() for b, y in part.items())
    return found


def _collected(terms: Iterable[tuple[Monomial, Fraction]]) -> Polynomial:
    found: Polynomial = {}
    for term, value in terms:
        found[term] = found.get(term, Fraction(0)) + value
    return {term: value for term, value in found.items() if value}


def inverse(term: Monomial) -> Monomial:
    """1 over a product of powers."""
    return frozenset((letter, -exponent) for letter, exponent in term)


def joined(a: Monomial, b: Monomial) -> Monomial:
    """The product of two products of powers."""
    exponents = dict(a)
    for letter, exponent in b:
        exponents[letter] = exponents.get(letter, 0) + exponent
    return frozenset(pair for pair in exponents.items() if pair[1])
