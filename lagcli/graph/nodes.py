"""The nodes of a graph of formulas, and the graph that makes each of them once.

Two formulas made of the same parts are one object (hash-consing), so equality is
identity, and whatever is remembered of a node is remembered for every place it stands at.
A node is made after its parts: in the order of `index`, parts come first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import reduce
from operator import or_
from typing import TypeVar

Key = tuple[object, ...]
Made = TypeVar("Made", bound="Node")

#: A power of a number is worked out up to this size.
_POWER_BITS = 34_000  # 10,000 digits


class Node:
    """A formula; made by a `Graph` only.

    Attributes
    ----------
    index : int
        The place in the order in which the graph made its nodes.
    mask : int
        The symbols that occur, a bit for each.
    """

    __slots__ = ("index", "mask")

    index: int
    mask: int

    @property
    def parts(self) -> tuple[Node, ...]:
        """The nodes that it is made of."""
        return ()


class Constant(Node):
    """An exact rational number."""

    __slots__ = ("value",)

    def __init__(self, value: Fraction) -> None:
        self.value = value


class Symbol(Node):
    """A name with its primes, or pi."""

    __slots__ = ("name", "primes")

    def __init__(self, name: str, primes: int) -> None:
        self.name = name
        self.primes = primes

    def __str__(self) -> str:
        return self.name + "'" * self.primes


class Sum(Node):
    """constant + sum of coefficient * term, the terms in the order of their index.

    A multiple 2*x or -x is a sum of one term.
    """

    __slots__ = ("constant", "terms")

    def __init__(self, constant: Fraction, terms: tuple[tuple[Node, Fraction], ...]) -> None:
        self.constant = constant
        self.terms = terms

    @property
    def parts(self) -> tuple[Node, ...]:
        """The terms without their coefficients."""
        return tuple(term for term, _ in self.terms)


class Product(Node):
    """Product of base ^ exponent; no numeric factor, that belongs to a sum of one term."""

    __slots__ = ("factors",)

    def __init__(self, factors: tuple[tuple[Node, Fraction], ...]) -> None:
        self.factors = factors

    @property
    def parts(self) -> tuple[Node, ...]:
        """The bases."""
        return tuple(base for base, _ in self.factors)


class Call(Node):
    """A function at its arguments, differentiated by the arguments `indices` (from 1).

    The functions of the grammar but `sqrt`, those that a file leaves unspecified, and "^",
    a power whose exponent is no number.
    """

    __slots__ = ("arguments", "function", "indices")

    def __init__(
        self, function: str, arguments: tuple[Node, ...], indices: tuple[int, ...]
    ) -> None:
        self.function = function
        self.arguments = arguments
        self.indices = indices

    @property
    def parts(self) -> tuple[Node, ...]:
        """The arguments."""
        return self.arguments


_NOTHING = Fraction(0)
_UNIT = Fraction(1)

#: f(-x) = sign * f(x)
_PARITY = {
    **dict.fromkeys("sin tan cot csc asin atan sinh tanh asinh atanh sign".split(), -1),
    **dict.fromkeys("cos sec cosh abs".split(), 1),
}
_AT_ZERO = {
    **dict.fromkeys("sin tan asin atan sinh tanh asinh atanh abs sign".split(), 0),
    **dict.fromkeys("cos sec cosh exp".split(), 1),
}


class Graph:
    """Makes nodes, each once, with numbers folded and like terms and factors joined."""

    def __init__(self) -> None:
        self._nodes: dict[Key, Node] = {}
        self._bits = 0
        self.zero = self.constant(_NOTHING)
        self.one = self.constant(_UNIT)

    def __len__(self) -> int:
        return len(self._nodes)

    # -- leaves -------------------------------------------------------------------------

    def constant(self, value: Fraction | int) -> Node:
        """A number."""
        exact = Fraction(value)
        return self._made((Constant, exact), lambda: Constant(exact), 0)

    def symbol(self, name: str, primes: int = 0) -> Symbol:
        """The symbol of a name; the first mention of each gives it its bit."""
        key = (Symbol, name, primes)
        known = self._nodes.get(key)
        if known is None:
            bit = 0 if name == "pi" else 1 << self._bits
            self._bits += bit != 0
            known = self._made(key, lambda: Symbol(name, primes), bit)
        assert isinstance(known, Symbol)
        return known

    # -- sums -----------------------------------------------------------------------------

    def sum(self, terms: Iterable[Node]) -> Node:
        """a + b + …"""
        return self.combination((term, _UNIT) for term in terms)

    def combination(self, pairs: Iterable[tuple[Node, Fraction]]) -> Node:
        """Sum of coefficient * node, equal nodes joined."""
        constant = _NOTHING
        coefficients: dict[Node, Fraction] = {}
        for node, coefficient in pairs:
            if isinstance(node, Constant):
                constant += node.value * coefficient
                continue
            if isinstance(node, Sum) and len(node.terms) == 1 and not node.constant:
                [(node, inner)] = node.terms
                coefficient = coefficient * inner
            known = coefficients.get(node)
            coefficients[node] = coefficient if known is None else known + coefficient
        kept = [pair for pair in coefficients.items() if pair[1]]
        if not kept:
            return self.constant(constant) if constant else self.zero
        if len(kept) == 1 and not constant and kept[0][1] == 1:
            return kept[0][0]
        kept.sort(key=_by_index)
        return self._sum(constant, tuple(kept))

    def _sum(self, constant: Fraction, terms: tuple[tuple[Node, Fraction], ...]) -> Node:
        mask = 0
        for term, _ in terms:
            mask |= term.mask
        return self._made((Sum, constant, terms), lambda: Sum(constant, terms), mask)

    def scaled(self, node: Node, factor: Fraction | int) -> Node:
        """factor * node."""
        return self.combination(((node, Fraction(factor)),))

    def difference(self, left: Node, right: Node) -> Node:
        """left - right."""
        return self.combination(((left, _UNIT), (right, -_UNIT)))

    # -- products ---------------------------------------------------------------------------

    def product(self, *factors: Node) -> Node:
        """a * b * …"""
        return self.monomial((factor, _UNIT) for factor in factors)

    def quotient(self, numerator: Node, denominator: Node) -> Node:
        """numerator / denominator."""
        return self.monomial(((numerator, _UNIT), (denominator, -_UNIT)))

    def monomial(self, pairs: Iterable[tuple[Node, Fraction]]) -> Node:
        """Product of node ^ exponent, equal bases joined.

        A product among the factors stays one factor, unless a base of it stands beside it
        too: (a*b)*c keeps a*b, which other formulas may share, (a*b)*b is a*b^2.

        Raises
        ------
        ZeroDivisionError
            For a power of 0 with a negative exponent.
        """
        number, exponents = self._joined(pairs)
        if number == 0:
            return self.zero
        nested = [
            base
            for base, exponent in exponents.items()
            if isinstance(base, Product) and exponent.denominator == 1
        ]
        for base in nested:
            exponent = exponents[base]  # another product may have brought more of it
            if exponent != 1 or any(inner in exponents for inner, _ in base.factors):
                del exponents[base]
                for inside, power in base.factors:
                    exponents[inside] = exponents.get(inside, _NOTHING) + power * exponent
        kept = [pair for pair in exponents.items() if pair[1]]
        if not kept:
            return self.constant(number)
        if len(kept) == 1 and kept[0][1] == 1:
            return self.scaled(kept[0][0], number)
        kept.sort(key=_by_index)
        factors = tuple(kept)
        mask = 0
        for part, _ in factors:
            mask |= part.mask
        node = self._made((Product, factors), lambda: Product(factors), mask)
        return node if number == 1 else self._sum(_NOTHING, ((node, number),))

    def _joined(
        self, pairs: Iterable[tuple[Node, Fraction]]
    ) -> tuple[Fraction, dict[Node, Fraction]]:
        """The numeric factor, and the exponent of each base."""
        number = _UNIT
        exponents: dict[Node, Fraction] = {}
        for node, exponent in pairs:
            whole = exponent.denominator == 1
            if isinstance(node, Sum) and len(node.terms) == 1 and not node.constant and whole:
                [(node, coefficient)] = node.terms
                number *= _power(coefficient, int(exponent))
            if isinstance(node, Constant) and (whole or node.value in {0, 1}):
                if not node.value and exponent < 0:
                    raise ZeroDivisionError("division by 0")
                number *= _power(node.value, int(exponent) if whole else 1)
                continue
            if isinstance(node, Product) and len(node.factors) == 1 and whole:
                [(node, inner)] = node.factors
                exponent = exponent * inner
            known = exponents.get(node)
            exponents[node] = exponent if known is None else known + exponent
        return number, exponents

    def power(self, base: Node, exponent: Node) -> Node:
        """base ^ exponent."""
        if isinstance(exponent, Constant):
            return self.monomial(((base, exponent.value),))
        return self.call("^", (base, exponent))

    # -- functions ------------------------------------------------------------------------------

    def rebuilt(self, node: Node, known: Mapping[Node, Node]) -> Node:
        """A node of what its parts have become; those that are not known stay."""
        match node:
            case Sum():
                pairs = [(known.get(term, term), number) for term, number in node.terms]
                return self.combination([*pairs, (self.one, node.constant)])
            case Product():
                return self.monomial((known.get(base, base), e) for base, e in node.factors)
            case Call(function="^"):
                base, exponent = (known.get(part, part) for part in node.arguments)
                return self.power(base, exponent)
            case Call():
                arguments = tuple(known.get(part, part) for part in node.arguments)
                return self.call(node.function, arguments, node.indices)
            case _:
                return node

    def call(
        self, function: str, arguments: tuple[Node, ...], indices: tuple[int, ...] = ()
    ) -> Node:
        """function(arguments), differentiated by the arguments `indices`."""
        if function == "sqrt":
            return self.monomial(((arguments[0], Fraction(1, 2)),))
        first = arguments[0] if len(arguments) == 1 and not indices else None
        if isinstance(first, Constant) and not first.value and function in _AT_ZERO:
            return self.constant(_AT_ZERO[function])
        if isinstance(first, Sum) and function in _PARITY and _is_negative(first):
            # term by term: -1 * (b - a) would itself begin with a minus
            opposite = self.combination((term, -factor) for term, factor in first.terms)
            positive = self.call(function, (opposite,))
            return self.scaled(positive, _PARITY[function])
        mask = mask_of(arguments)
        key = (Call, function, arguments, indices)
        return self._made(key, lambda: Call(function, arguments, indices), mask)

    def _made(self, key: Key, make: Callable[[], Node], mask: int) -> Node:
        known = self._nodes.get(key)
        if known is None:
            known = make()
            known.index = len(self._nodes)
            known.mask = mask
            self._nodes[key] = known
        return known


def split(node: Node) -> tuple[Fraction, Node]:
    """A node as coefficient * rest: -2*x as (-2, x)."""
    if isinstance(node, Sum) and len(node.terms) == 1 and not node.constant:
        [(rest, coefficient)] = node.terms
        return coefficient, rest
    return _UNIT, node


def mask_of(nodes: Iterable[Node]) -> int:
    """The symbols that occur in some nodes, a bit for each."""
    return reduce(or_, (node.mask for node in nodes), 0)


def with_values(mask: int, values: Mapping[Symbol, Node]) -> int:
    """A mask with the symbols in the values of its symbols, in theirs, and so on."""
    more = mask | mask_of(value for symbol, value in values.items() if symbol.mask & mask)
    return mask if more == mask else with_values(more, values)


def factors_of(node: Node) -> tuple[tuple[Node, Fraction], ...]:
    """The factors of a product; of all others the node itself."""
    return node.factors if isinstance(node, Product) else ((node, Fraction(1)),)


def ancestry(roots: Iterable[Node]) -> list[Node]:
    """The roots and all that they are made of, parts first."""
    seen: set[Node] = set()
    stack = list(roots)
    while stack:
        node = stack.pop()
        if node not in seen:
            seen.add(node)
            stack.extend(node.parts)
    return sorted(seen, key=lambda node: node.index)


def _by_index(pair: tuple[Node, Fraction]) -> int:
    return pair[0].index


def _is_negative(node: Sum) -> bool:
    """Whether the first term has a minus and no number stands beside it."""
    return not node.constant and node.terms[0][1] < 0


def _power(base: Fraction, exponent: int) -> Fraction:
    size = max(base.numerator.bit_length(), base.denominator.bit_length())
    if size > 1 and size * abs(exponent) > _POWER_BITS:
        raise OverflowError("a power of a number is too long")
    return base**exponent
