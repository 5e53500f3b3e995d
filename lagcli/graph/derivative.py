"""Derivatives on a graph, each node's worked out once (forward mode).

A derivation D is given by its values on the symbols: 1 on one of them is a partial
derivative, q' on q and q'' on q' the total time derivative along the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, Symbol
from lagcli.graph.walk import parts_first

_UNIT = Fraction(1)


class Differentiation:
    """D with D(ab) = D(a) b + a D(b), D(f(u)) = f'(u) D(u), from its values on symbols.

    Parameters
    ----------
    graph
        Makes the nodes.
    rates
        D of each symbol; 0 on those that are not named.

    Notes
    -----
    A part in which a single symbol s changes has D = (d/ds) * D(s): then the partial
    derivative that a Jacobian holds is shared with the rates made of it.
    """

    def __init__(self, graph: Graph, rates: Mapping[Symbol, Node]) -> None:
        self.graph = graph
        self.mask = 0
        self._known: dict[Node, Node] = {}
        #: d/ds and D(s) by the bit of s, where D(s) is not 1.
        self._single: dict[int, tuple[Differentiation, Node]] = {}
        for symbol, rate in rates.items():
            if rate is not graph.zero:
                self.mask |= symbol.mask
                self._known[symbol] = rate
                if rate is not graph.one:
                    self._single[symbol.mask] = (partial(graph, symbol), rate)

    def __call__(self, root: Node) -> Node:
        """D of a node."""
        known = self._known
        if not root.mask & self.mask:
            return self.graph.zero
        for node in parts_first(root, known, self._needed):
            known[node] = self._rule(node)
        return known[root]

    def _needed(self, node: Node) -> list[Node]:
        """The parts that change, but none where a single symbol does."""
        if node.mask & self.mask in self._single:
            return []
        return [part for part in node.parts if part.mask & self.mask]

    def _rule(self, node: Node) -> Node:
        mask, graph = self.mask, self.graph
        single = self._single.get(node.mask & mask)
        if single is not None:  # (d/ds) * D(s)
            by_symbol, rate = single
            return graph.product(by_symbol(node), rate)
        if isinstance(node, Sum):
            return graph.combination(
                (self._known[term], coefficient)
                for term, coefficient in node.terms
                if term.mask & mask
            )
        if isinstance(node, Product):
            return graph.sum(
                self._of_factor(node, position)
                for position, (base, _) in enumerate(node.factors)
                if base.mask & mask
            )
        assert isinstance(node, Call)
        return graph.sum(
            graph.product(slope(graph, node, place), self._known[argument])
            for place, argument in enumerate(node.arguments, start=1)
            if argument.mask & mask
        )

    def _of_factor(self, node: Product, position: int) -> Node:
        """D(b^e) times the other factors, with D(b^e) = e b^(e - 1) D(b)."""
        factors = list(node.factors)
        base, exponent = factors[position]
        factors[position] = (base, exponent - 1)
        factors.append((self._known[base], _UNIT))
        return self.graph.scaled(self.graph.monomial(factors), exponent)


def partial(graph: Graph, symbol: Symbol) -> Differentiation:
    """d/ds."""
    return Differentiation(graph, {symbol: graph.one})


def slope(graph: Graph, node: Call, place: int) -> Node:
    """The partial derivative of f(x_1, …) by x_place, at the arguments of the call."""
    rule = _SLOPES.get(node.function)
    if rule is not None and not node.indices:
        return rule(graph, node.arguments, place)
    raised = tuple(sorted((*node.indices, place)))
    return graph.call(node.function, node.arguments, raised)


Rule = Callable[[Graph, tuple[Node, ...], int], Node]


def _named(function: str, sign: int = 1) -> Rule:
    return lambda g, x, _: g.scaled(g.call(function, x), sign)


def _algebraic(square: int, exponent: Fraction, sign: int = 1) -> Rule:
    """Sign * (1 + square * x^2)^exponent."""

    def rule(g: Graph, x: tuple[Node, ...], _: int) -> Node:
        radicand = g.sum([g.one, g.scaled(g.monomial([(x[0], Fraction(2))]), square)])
        return g.scaled(g.monomial([(radicand, exponent)]), sign)

    return rule


def _power(g: Graph, x: tuple[Node, ...], place: int) -> Node:
    """By the base, e b^(e - 1); by the exponent, b^e log(b)."""
    base, exponent = x
    if place == 1:
        return g.product(exponent, g.power(base, g.sum([exponent, g.constant(-1)])))
    return g.product(g.call("^", x), g.call("log", (base,)))


def _atan2(g: Graph, x: tuple[Node, ...], place: int) -> Node:
    """atan2(a, b): b/(a^2 + b^2) and -a/(a^2 + b^2)."""
    a, b = x
    square = g.sum(g.monomial([(u, Fraction(2))]) for u in x)
    return g.quotient(b if place == 1 else g.scaled(a, -1), square)


def _acosh(g: Graph, x: tuple[Node, ...], _: int) -> Node:
    """1/(sqrt(x - 1) sqrt(x + 1))."""
    half = Fraction(-1, 2)
    return g.monomial((g.sum([x[0], g.constant(shift)]), half) for shift in (-1, 1))


def _with_product(first: str, second: str, sign: int) -> Rule:
    return lambda g, x, _: g.scaled(g.product(g.call(first, x), g.call(second, x)), sign)


def _inverse_square(function: str, sign: int = 1) -> Rule:
    return lambda g, x, _: g.scaled(g.monomial([(g.call(function, x), Fraction(-2))]), sign)


_SLOPES: dict[str, Rule] = {
    "exp": _named("exp"),
    "log": lambda g, x, _: g.monomial([(x[0], Fraction(-1))]),
    "abs": _named("sign"),
    "sign": lambda g, _x, _: g.zero,
    "side": lambda g, _x, _: g.zero,
    "sin": _named("cos"),
    "cos": _named("sin", -1),
    "tan": _inverse_square("cos"),
    "cot": _inverse_square("sin", -1),
    "sec": _with_product("sec", "tan", 1),
    "csc": _with_product("csc", "cot", -1),
    "asin": _algebraic(-1, Fraction(-1, 2)),
    "acos": _algebraic(-1, Fraction(-1, 2), -1),
    "atan": _algebraic(1, Fraction(-1)),
    "atan2": _atan2,
    "sinh": _named("cosh"),
    "cosh": _named("sinh"),
    "tanh": _inverse_square("cosh"),
    "asinh": _algebraic(1, Fraction(-1, 2)),
    "acosh": _acosh,
    "atanh": _algebraic(-1, Fraction(-1)),
    "^": _power,
}
