"""Putting formulas in for symbols, each node rebuilt once."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, Symbol, mask_of


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
            known[node] = self._rebuilt(node)
        return known.get(root, root)

    def _rebuilt(self, node: Node) -> Node:
        known, graph = self._known, self.graph
        match node:
            case Sum():
                pairs = [(known.get(term, term), number) for term, number in node.terms]
                return graph.combination([*pairs, (graph.one, node.constant)])
            case Product():
                return graph.monomial(
                    (known.get(base, base), exponent) for base, exponent in node.factors
                )
            case Call(function="^"):
                base, exponent = (known.get(part, part) for part in node.arguments)
                return graph.power(base, exponent)
            case Call():
                arguments = tuple(known.get(part, part) for part in node.arguments)
                return graph.call(node.function, arguments, node.indices)
            case _:
                return node
