"""Hyperbolic functions of large arguments: what stays finite though they do not.

    sinh^a u / cosh^b u = tanh^a u (1 - tanh^2 u)^((b - a)/2)    for even b - a >= 0

At u = 1000 cosh u is no double, tanh u is 1.  The rounding of 1 - tanh^2 u is that of 1, its
value at u = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, ancestry
from lagcli.graph.rewriting import rewritten

_NONE, _TWO = Fraction(0), Fraction(2)


def bounded(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same formulas without quotients of functions that are no doubles."""
    if not any(isinstance(node, Call) and node.function == "cosh" for node in ancestry(roots)):
        return list(roots)
    return rewritten(graph, roots, _quotient)


def _quotient(graph: Graph, node: Node) -> Node:
    """A product, sinh and cosh of one argument as powers of tanh."""
    if not isinstance(node, Product):
        return node
    exponents = dict(node.factors)
    for base, exponent in node.factors:
        if not (isinstance(base, Call) and base.function == "cosh"):
            continue
        above = exponents.get(graph.call("sinh", base.arguments), _NONE)
        left = -exponent - above
        if above < 0 or left < 0 or left % 2:
            continue
        tanh = graph.call("tanh", base.arguments)
        rest = graph.difference(graph.one, graph.product(tanh, tanh))
        del exponents[base]
        exponents.pop(graph.call("sinh", base.arguments), None)
        for factor, power in ((tanh, above), (rest, left / _TWO)):
            exponents[factor] = exponents.get(factor, _NONE) + power
    return graph.monomial(exponents.items())
