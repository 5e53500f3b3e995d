"""From nodes back to trees, what occurs more than once named: s1, s2, …

A part is named when several others are made of it and it costs something: a function's
value, or two operations or more.  Names follow the order of use; a named part uses only
those before it.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import count

from lagcli import expression as tree
from lagcli.expression import Expression
from lagcli.graph.nodes import Call, Constant, Node, Product, Sum, Symbol, split
from lagcli.graph.walk import parts_first
from lagcli.record import record

_UNIT = Fraction(1)


@record
class Shared:
    """Trees and the named parts that they use.

    Attributes
    ----------
    roots : tuple of Expression
        One for each node that was given.
    named : dict
        Name -> tree, in order of use.
    """

    roots: tuple[Expression, ...]
    named: dict[str, Expression]


def with_shared_parts(
    roots: Sequence[Node], order: Sequence[str], taken: Collection[str]
) -> Shared:
    """Trees of the roots with common parts named.

    Parameters
    ----------
    roots
        What is to be written.
    order
        Names in the order in which a product shows them.
    taken
        Names that are not to be used.
    """
    stem = next(stem for stem in _stems() if not _collides(stem, taken))
    writer = GraphWriter(order)
    named: dict[str, Expression] = {}
    shared = repeated(roots)
    for node in in_order_of_use(roots):
        if node in shared:
            name = f"{stem}{len(named) + 1}"
            named[name] = writer.tree(node)
            writer.name(node, name)
    return Shared(tuple(map(writer.tree, roots)), named)


def written_out(roots: Sequence[Node], order: Sequence[str]) -> tuple[Expression, ...]:
    """Trees of the roots without named parts, which may be very long."""
    return tuple(map(GraphWriter(order).tree, roots))


def operations(roots: Sequence[Node]) -> int:
    """The operations that the roots show when they are written out (`operation_count`)."""
    counts: dict[Node, int] = {}
    for node in in_order_of_use(roots):
        inner = sum(counts[part] for part in node.parts)
        counts[node] = inner + _own_operations(node)
    return sum(counts[root] for root in roots)


def _own_operations(node: Node) -> int:
    match node:
        case Sum(constant=constant, terms=terms):
            return len(terms) - (not constant) + sum(abs(c) != 1 for _, c in terms)
        case Product(factors=factors):
            return len(factors) - 1 + sum(exponent != 1 for _, exponent in factors)
        case Call():
            return 1
        case _:
            return 0


def _stems() -> Iterator[str]:
    yield from ("s", "shared")
    yield from ("shared" + "_" * length for length in count(1))


def _collides(stem: str, taken: Iterable[str]) -> bool:
    return any(re.fullmatch(r"_?\d+", name.removeprefix(stem)) for name in taken)


def in_order_of_use(roots: Sequence[Node]) -> Iterator[Node]:
    """Every node once, after its parts, as the roots come to them."""
    seen: set[Node] = set()
    stack: list[tuple[Node, bool]] = [(root, False) for root in reversed(roots)]
    while stack:
        node, ready = stack.pop()
        if ready:
            yield node
        elif node not in seen:
            seen.add(node)
            stack.append((node, True))
            stack.extend((part, False) for part in reversed(node.parts))


def repeated(roots: Sequence[Node]) -> set[Node]:
    """The nodes that are worth a name; a multiple -x is a use of x, not a part itself."""
    uses: dict[Node, int] = {}
    for node in in_order_of_use(roots):
        if split(node)[1] is node:
            for part in dict.fromkeys(split(part)[1] for part in node.parts):
                uses[part] = uses.get(part, 0) + 1
    for root in dict.fromkeys(split(root)[1] for root in roots):
        uses[root] = uses.get(root, 0) + 1
    return {node for node, count in uses.items() if count > 1 and _is_worth_a_name(node)}


def _is_worth_a_name(node: Node) -> bool:
    if isinstance(node, Constant | Symbol):
        return False
    leaves = all(isinstance(part, Constant | Symbol) for part in node.parts)
    return isinstance(node, Call) or not leaves or _own_operations(node) > 1


class GraphWriter:
    """Nodes -> trees in a fixed order of names; products inside products are joined."""

    def __init__(self, order: Sequence[str]) -> None:
        self._rank = {name: rank for rank, name in enumerate(order)}
        self._trees: dict[Node, Expression] = {}
        self._number: dict[Node, int] = {}
        self.names: dict[Node, Expression] = {}
        self._leading: set[Node] = set()

    def name(self, node: Node, name: str, *, leading: bool = False) -> None:
        """Write the node by this name from now on; before all letters of a product if `leading`."""
        if leading:
            self._leading.add(node)
        self._number[node] = len(self.names)
        self.names[node] = tree.Name(name)

    def tree(self, root: Node) -> Expression:
        """The tree of a node."""
        if root not in self.names:
            for node in parts_first(root, self._trees, self._unnamed):
                self._trees[node] = self._written(node)
        return self._at(root)

    def _unnamed(self, node: Node) -> list[Node]:
        return [part for part in node.parts if part not in self.names]

    def _at(self, node: Node) -> Expression:
        name = self.names.get(node)
        return self._trees[node] if name is None else name

    def _written(self, node: Node) -> Expression:
        match node:
            case Constant(value=value):
                return _number(value)
            case Symbol(name=name, primes=primes):
                return tree.Name(name, primes)
            case Sum():
                return self._sum(node)
            case Product():
                return self._product(_UNIT, node)
            case Call(function="^", arguments=(base, exponent)):
                return tree.Power(self._at(base), self._at(exponent))
            case Call(function=function, arguments=arguments, indices=indices):
                shown = tuple(map(self._at, arguments))
                if indices and len(shown) > 1:
                    return tree.PartialCall(function, indices, shown)
                return tree.Call(function, shown, len(indices))
        raise TypeError(f"no node: {node!r}")

    # -- sums -------------------------------------------------------------------------------

    def _sum(self, node: Sum) -> Expression:
        terms = list(self._terms(node, _UNIT))
        # a positive term first, where there is one
        first = next((i for i, t in enumerate(terms) if not isinstance(t, tree.Negative)), 0)
        terms.insert(0, terms.pop(first))
        return terms[0] if len(terms) == 1 else tree.Sum(tuple(terms))

    def _terms(self, node: Sum, factor: Fraction) -> Iterator[Expression]:
        for term, coefficient in node.terms:
            number = coefficient * factor
            if isinstance(term, Sum) and term not in self.names and abs(number) == 1:
                yield from self._terms(term, number)
            else:
                yield self._multiple(number, term)
        if node.constant:
            yield _number(node.constant * factor)

    def _multiple(self, number: Fraction, term: Node) -> Expression:
        if abs(number) == 1:
            shown = self._at(term)
            return shown if number > 0 else tree.opposite(shown)
        if isinstance(term, Product) and term not in self.names:
            return self._product(number, term)
        return self._quotient(number, [(self._key(term), self._at(term), _UNIT)])

    # -- products -------------------------------------------------------------------------

    def _product(self, number: Fraction, node: Product) -> Expression:
        exponents: dict[Node, Fraction] = {}
        stack = list(reversed(node.factors))
        while stack:
            base, exponent = stack.pop()
            number_inside, rest = split(base)
            if rest is not base and exponent.denominator == 1 and base not in self.names:
                number *= number_inside ** int(exponent)
                stack.append((rest, exponent))
            elif isinstance(base, Product) and base not in self.names and exponent.denominator == 1:
                stack.extend((inner, power * exponent) for inner, power in reversed(base.factors))
            else:
                exponents[base] = exponents.get(base, Fraction(0)) + exponent
        return self._quotient(
            number, [(self._key(b), self._at(b), e) for b, e in exponents.items() if e]
        )

    def _quotient(
        self, number: Fraction, factors: list[tuple[tuple[int, ...], Expression, Fraction]]
    ) -> Expression:
        factors.sort(key=lambda each: each[0])
        above = [_raised(base, e) for _, base, e in factors if e > 0]
        below = [_raised(base, -e) for _, base, e in factors if e < 0]
        return tree.multiple_of(number, above, below)

    def _key(self, base: Node) -> tuple[int, ...]:
        """Leading names, parameters, t, q, q'; then other names of parts; sums; functions."""
        match base:
            case _ if base in self._leading:
                return (0, -1, self._number[base])
            case Symbol(name=name, primes=primes):
                return (0, primes, self._rank.get(name, len(self._rank)), base.index)
            case Constant():
                return (-1, base.index)
            case _ if base in self.names:
                return (1, self._number[base])
            case Call():
                return (3, base.index)
            case _:
                return (2, base.index)


def _number(value: Fraction) -> Expression:
    size = abs(value)
    shown: Expression = tree.Number(Fraction(size.numerator))
    if size.denominator != 1:
        shown = tree.Quotient(shown, tree.Number(Fraction(size.denominator)))
    return tree.Negative(shown) if value < 0 else shown


def _raised(base: Expression, exponent: Fraction) -> Expression:
    if exponent == 1:
        return base
    if exponent == Fraction(1, 2):
        return tree.Call("sqrt", (base,))
    return tree.Power(base, _number(exponent))
