"""Putting formulas in for symbols, each node rebuilt once."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.graph.nodes import Graph, Node, Symbol, mask_of


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
        stack = [root]
        while stack:
            node = stack[-1]
            if node in known or not node.mask & self.mask:
                stack.pop()
                continue
            missing = [p for p in node.parts if p.mask & self.mask and p not in known]
            if missing:
                stack.extend(missing)
                continue
            stack.pop()
            known[node] = self.graph.rebuilt(node, known)
        return known.get(root, root)
