"""From the trees of a problem to nodes: a definition is one node, however often it is used.

A prime on a definition is its total time derivative.  Where the rate of a definition is
to stay a quantity of its own, `rates_as_symbols` makes it a symbol.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from lagcli import expression as tree
from lagcli.expression import Expression
from lagcli.graph.derivative import Differentiation, partial
from lagcli.graph.nodes import Graph, Node, Symbol

_UNIT = Fraction(1)


class GraphReader:
    """Turns trees into nodes of one graph.

    Parameters
    ----------
    graph
        Makes the nodes.
    coordinates
        Their names: q has the rate q', q' the rate q''.
    definitions
        Name -> tree, each using earlier ones only.
    """

    def __init__(
        self, graph: Graph, coordinates: tuple[str, ...], definitions: Mapping[str, Expression]
    ) -> None:
        self.graph = graph
        self.definitions = definitions
        flow: dict[Symbol, Node] = {graph.symbol("t"): graph.one}
        for order in (0, 1):
            flow |= {graph.symbol(q, order): graph.symbol(q, order + 1) for q in coordinates}
        #: d/dt along any motion
        self.total_derivative = Differentiation(graph, flow)
        self._velocities = 0
        for q in coordinates:
            self._velocities |= graph.symbol(q, 1).mask
        self._definitions: dict[tuple[str, bool], Node] = {}
        #: the symbol of a rate -> the node whose rate it is
        self.rates: dict[Symbol, Node] = {}

    def __call__(self, node: Expression, *, rates_as_symbols: bool = False) -> Node:
        """The node of a tree.

        Raises
        ------
        ArithmeticError
            When a part is not defined, as 1/0.
        """
        return self._node(node, rates_as_symbols)

    def rate_symbol(self, name: str, position: Node) -> Symbol:
        """A symbol for the total time derivative of a position r(q, t)."""
        symbol = self.graph.symbol(name, 1)
        self.rates.setdefault(symbol, position)
        return symbol

    def definition(self, name: str, *, rates_as_symbols: bool = False) -> Node:
        """The node of a definition."""
        if (name, rates_as_symbols) not in self._definitions:
            for each, formula in self.definitions.items():  # in order: no deep recursion
                self._definitions[each, rates_as_symbols] = self._node(formula, rates_as_symbols)
        return self._definitions[name, rates_as_symbols]

    def _node(self, node: Expression, opaque: bool) -> Node:
        graph = self.graph
        match node:
            case tree.Number(value=value):
                return graph.constant(value)
            case tree.Name(name=name, primes=primes):
                return self._name(name, primes, opaque)
            case tree.Negative(operand=operand):
                return graph.scaled(self._node(operand, opaque), -1)
            case tree.Sum(terms=terms):
                return graph.combination(self._term(term, opaque) for term in terms)
            case tree.Product(factors=factors):
                return graph.product(*(self._node(factor, opaque) for factor in factors))
            case tree.Quotient(numerator=numerator, denominator=denominator):
                return graph.quotient(
                    self._node(numerator, opaque), self._node(denominator, opaque)
                )
            case tree.Power(base=base, exponent=exponent):
                return graph.power(self._node(base, opaque), self._node(exponent, opaque))
            case tree.Call(function=function, arguments=arguments, primes=primes):
                return graph.call(
                    function, tuple(self._node(a, opaque) for a in arguments), (1,) * primes
                )
            case tree.PartialCall(function=function, indices=indices, arguments=arguments):
                return graph.call(
                    function,
                    tuple(self._node(a, opaque) for a in arguments),
                    tuple(sorted(indices)),
                )
            case tree.Diff(operand=operand, variable=variable):
                # it sees through definitions, so through their rates as well
                by = self._name(variable.name, variable.primes, opaque=False)
                assert isinstance(by, Symbol)
                return partial(graph, by)(self._node(operand, opaque=False))
        raise TypeError(f"not an expression: {node!r}")

    def _term(self, term: Expression, opaque: bool) -> tuple[Node, Fraction]:
        if isinstance(term, tree.Negative):
            return self._node(term.operand, opaque), -_UNIT
        return self._node(term, opaque), _UNIT

    def _name(self, name: str, primes: int, opaque: bool) -> Node:
        if name not in self.definitions:
            return self.graph.symbol(name, primes)
        node = self.definition(name, rates_as_symbols=opaque and not primes)
        if opaque and primes == 1 and not node.mask & self._velocities:
            return self.rate_symbol(name, node)
        for _ in range(primes):
            node = self.total_derivative(node)
        return node
