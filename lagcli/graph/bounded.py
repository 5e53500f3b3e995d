"""Hyperbolic functions of large arguments: what stays finite though they do not.

    sinh^a u / cosh^b u = tanh^a u (1 - tanh^2 u)^((b - a)/2)    for even b - a >= 0

At u = 1000 cosh u is no double, tanh u is 1.  The rounding of 1 - tanh^2 u is that of 1, its
value at u = 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry

_NONE, _TWO = Fraction(0), Fraction(2)


def bounded(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same formulas without quotients of functions that are no doubles."""
    nodes = ancestry(roots)
    if not any(isinstance(node, Call) and node.function == "cosh" for node in nodes):
        return list(roots)
    known: dict[Node, Node] = {}
    for node in nodes:
        known[node] = _rebuilt(graph, node, known)
    return [known[root] for root in roots]


def _rebuilt(graph: Graph, node: Node, known: dict[Node, Node]) -> Node:
    match node:
        case Sum():
            pairs = [(known[term], number) for term, number in node.terms]
            return graph.combination([*pairs, (graph.one, node.constant)])
        case Product():
            return _quotient(graph, [(known[base], e) for base, e in node.factors])
        case Call(function="^", arguments=(base, exponent)):
            return graph.power(known[base], known[exponent])
        case Call():
            arguments = tuple(known[part] for part in node.arguments)
            return graph.call(node.function, arguments, node.indices)
        case _:
            return node


def _quotient(graph: Graph, factors: Iterable[tuple[Node, Fraction]]) -> Node:
    """A product, sinh and cosh of one argument as powers of tanh."""
    exponents: dict[Node, Fraction] = {}
    for base, exponent in factors:
        exponents[base] = exponents.get(base, _NONE) + exponent
    for base, exponent in list(exponents.items()):
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
