"""Long sums put together by what varies: m1*g*u + m2*g*u as (m1 + m2)*g*u."""

from __future__ import annotations

from fractions import Fraction

from lagcli.graph.nodes import Graph, Node, Product, Sum, split

_UNIT = Fraction(1)


def gathered(graph: Graph, node: Node, varying: int) -> Node:
    """The sum with the terms of one varying factor put together.

    Parameters
    ----------
    graph
        Makes the nodes.
    node
        Anything; only a sum is changed.
    varying
        The mask of the symbols that are no constants.
    """
    if not isinstance(node, Sum):
        return node
    groups: dict[Node, list[tuple[Node, Fraction]]] = {}
    constant, terms = _flat(node)
    for term, number in terms:
        steady, changing = _parted(graph, term, varying)
        inner, changing = split(changing)
        groups.setdefault(changing, []).append((steady, number * inner))
    return graph.combination(
        [
            *((graph.product(_factored(graph, parts), u), _UNIT) for u, parts in groups.items()),
            (graph.one, constant),
        ]
    )


def _flat(node: Sum) -> tuple[Fraction, list[tuple[Node, Fraction]]]:
    """The constant and the terms with those of inner sums among them."""
    constant, terms = Fraction(0), []
    stack: list[tuple[Node, Fraction]] = [(node, _UNIT)]
    while stack:
        inner, factor = stack.pop()
        if isinstance(inner, Sum):
            constant += inner.constant * factor
            stack.extend((term, number * factor) for term, number in reversed(inner.terms))
        else:
            terms.append((inner, factor))
    return constant, terms


def _parted(graph: Graph, node: Node, varying: int) -> tuple[Node, Node]:
    """The constant and the varying factor of a term."""
    if not isinstance(node, Product):
        return (graph.one, node) if node.mask & varying else (node, graph.one)
    steady = [pair for pair in node.factors if not pair[0].mask & varying]
    changing = [pair for pair in node.factors if pair[0].mask & varying]
    return graph.monomial(steady), graph.monomial(changing)


def _factored(graph: Graph, parts: list[tuple[Node, Fraction]]) -> Node:
    """Sum of coefficient * node with the factors that all share before it: (m1 + m2)*g."""
    common: dict[Node, Fraction] | None = None
    for node, _ in parts:
        factors = dict(node.factors) if isinstance(node, Product) else {node: _UNIT}
        if common is None:
            common = factors
        else:
            common = {base: e for base, e in common.items() if factors.get(base) == e}
    if not common or len(parts) == 1:
        return graph.combination(parts)
    outside = graph.monomial(common.items())
    inside = graph.combination((graph.quotient(node, outside), c) for node, c in parts)
    return graph.product(outside, inside)
