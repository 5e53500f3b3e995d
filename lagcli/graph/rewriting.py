"""Formulas rebuilt from their parts, some of the nodes by a rule."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry

#: A node made of parts that are rebuilt already -> what stands for it.
Rule = Callable[[Graph, Node], Node]


def rewritten(graph: Graph, roots: Sequence[Node], rule: Rule) -> list[Node]:
    """The formulas with a rule applied to each node, parts first."""
    known: dict[Node, Node] = {}
    for node in ancestry(roots):
        known[node] = rule(graph, _rebuilt(graph, node, known))
    return [known[root] for root in roots]


def _rebuilt(graph: Graph, node: Node, known: dict[Node, Node]) -> Node:
    match node:
        case Sum():
            pairs = [(known[term], number) for term, number in node.terms]
            return graph.combination([*pairs, (graph.one, node.constant)])
        case Product():
            return graph.monomial((known[base], exponent) for base, exponent in node.factors)
        case Call(function="^", arguments=(base, exponent)):
            return graph.power(known[base], known[exponent])
        case Call():
            arguments = tuple(known[part] for part in node.arguments)
            return graph.call(node.function, arguments, node.indices)
        case _:
            return node
