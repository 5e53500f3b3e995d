"""Putting formulas in for symbols, each node rebuilt once."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.graph.nodes import Graph, Node, Symbol, mask_of
from lagcli.graph.walk import parts_first


class Substitution:
    """The nodes with formulas put in for symbols, all at once.

    Parameters
    ----------
    graph
        Makes the nodes.
    formulas
        What stands for each symbol; it is not looked into again.
    """

    def __init__(self, graph: Graph, formulas: Mapping[Symbol, Node]) -> None:
        self.graph = graph
        self.mask = mask_of(formulas)
        self._known: dict[Node, Node] = {symbol: node for symbol, node in formulas.items()}  # noqa: C416

    def __call__(self, root: Node) -> Node:
        """The node with the formulas put in."""
        known = self._known
        if not root.mask & self.mask:
            return root
        for node in parts_first(root, known, self._changing):
            known[node] = self.graph.rebuilt(node, known)
        return known[root]

    def _changing(self, node: Node) -> list[Node]:
        return [part for part in node.parts if part.mask & self.mask]
