"""Formulas rebuilt from their parts, some of the nodes by a rule."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from lagcli.graph.nodes import Graph, Node, ancestry

#: A node made of parts that are rebuilt already -> what stands for it.
Rule = Callable[[Graph, Node], Node]


def rewritten(graph: Graph, roots: Sequence[Node], rule: Rule) -> list[Node]:
    """The formulas with a rule applied to each node, parts first."""
    known: dict[Node, Node] = {}
    for node in ancestry(roots):
        known[node] = rule(graph, graph.rebuilt(node, known))
    return [known[root] for root in roots]
