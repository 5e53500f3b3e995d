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
        self._coordinates = frozenset(coordinates)
        self._velocities = 0
        self._changing = graph.symbol("t").mask
        for q in coordinates:
            self._velocities |= graph.symbol(q, 1).mask
            self._changing |= graph.symbol(q, 0).mask | graph.symbol(q, 1).mask
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
                if opaque and (rate := self._typed_rate(base)) is not None:
                    return graph.power(rate, self._node(exponent, opaque))
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

    def _typed_rate(self, node: Expression) -> Symbol | None:
        """The rate of l sin θ for l θ' cos θ + …, a velocity of a point that is written out."""
        terms = tree.terms_of(node)
        parts = [part for term in terms if (part := self._integrated(term)) is not None]
        if len(parts) < len(terms):
            return None
        position = self.graph.sum(parts)
        # no name of a file has brackets
        name = next((s.name for s, r in self.rates.items() if r is position), "")
        return self.rate_symbol(name or f"[{len(self.rates)}]", position)

    def _integrated(self, term: Expression) -> Node | None:
        """l sin θ of l θ' cos θ, -l cos θ of l θ' sin θ, a x of a x'; None of anything else."""
        if isinstance(term, tree.Negative):
            inner = self._integrated(term.operand)
            return None if inner is None else self.graph.scaled(inner, -1)
        factors = tree.factors_of(term)
        moving = [f for f in factors if isinstance(f, tree.Name) and f.primes == 1]
        if len(moving) != 1 or moving[0].name not in self._coordinates:
            return None
        q = tree.Name(moving[0].name)
        functions = {tree.Call("cos", (q,)): ("sin", 1), tree.Call("sin", (q,)): ("cos", -1)}
        turning = [f for f in factors if f in functions]
        rest = [self._node(f, False) for f in factors if f not in (*moving, *turning)]
        if len(turning) > 1 or any(each.mask & self._changing for each in rest):
            return None
        whole = self._node(q, False)
        sign = 1
        if turning:
            function, sign = functions[turning[0]]
            whole = self.graph.call(function, (whole,), ())
        return self.graph.scaled(self.graph.product(*rest, whole), sign)

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
