"""Differences that lose digits in floating point, written so that they do not.

    1 - cos x = 2 sin^2(x/2)            1 + cos x = 2 cos^2(x/2)
    cosh x - 1 = 2 sinh^2(x/2)          exp x - 1 = 2 exp(x/2) sinh(x/2)
    sqrt(1 + z) - 1 = z/(1 + sqrt(1 + z))
    1/sqrt(1 + z) - 1 = -z/(sqrt(1 + z) + 1 + z)

also with a common factor and beside other terms, as in m g l - m g l cos x + T.

References
----------
Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 1.7.
Goldberg, "What every computer scientist should know about floating-point arithmetic",
ACM Computing Surveys 23 (1991), section 1.4.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry

_UNIT, _HALF, _TWO = Fraction(1), Fraction(1, 2), Fraction(2)


class Stable:
    """Nodes in a form that keeps its digits, each rewritten once."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._known: dict[Node, Node] = {}

    def __call__(self, root: Node) -> Node:
        """The node, equal as mathematics."""
        known = self._known
        if root not in known:
            for node in ancestry([root]):
                if node not in known:
                    known[node] = self._rebuilt(node)
        return known[root]

    def _rebuilt(self, node: Node) -> Node:
        graph, known = self.graph, self._known
        match node:
            case Sum():
                return self._sum(node)
            case Product():
                return graph.monomial((known[base], exponent) for base, exponent in node.factors)
            case Call(function="^", arguments=(base, exponent)):
                return graph.power(known[base], known[exponent])
            case Call():
                arguments = tuple(known[part] for part in node.arguments)
                return graph.call(node.function, arguments, node.indices)
            case _:
                return node

    def _sum(self, node: Sum) -> Node:
        graph, known = self.graph, self._known
        terms = dict(node.terms)
        if node.constant:
            terms[graph.one] = node.constant
        done: list[tuple[Node, Fraction]] = []
        for term in list(terms):
            for function, rest in _splits(graph, term):
                # c A f and d A with d = -c or c: c A (f - 1) or c A (f + 1)
                if term not in terms or abs(terms.get(rest, 0)) != abs(terms[term]):
                    continue
                coefficient, other = terms[term], terms[rest]
                joined = self._joined(function, other == -coefficient)
                if joined is not None:
                    del terms[term], terms[rest]
                    done.append((graph.product(known.get(rest, rest), joined), coefficient))
        done += [(known.get(term, term), c) for term, c in terms.items()]
        return graph.combination(done)

    def _joined(self, node: Node, minus: bool) -> Node | None:
        """f - 1 or f + 1 without cancellation; None where there is no rule."""
        graph = self.graph
        match node:
            case Call(function="cos" | "cosh" as function, arguments=(x,)):
                half = graph.scaled(self._known[x], _HALF)
                odd = "sin" if function == "cos" else "sinh"
                inner = graph.call(odd if minus else function, (half,))
                sign = -1 if minus and function == "cos" else 1
                return graph.scaled(graph.monomial([(inner, _TWO)]), 2 * sign)
            case Call(function="exp", arguments=(x,)) if minus:
                half = graph.scaled(self._known[x], _HALF)
                return graph.scaled(
                    graph.product(graph.call("exp", (half,)), graph.call("sinh", (half,))), 2
                )
            case Product(factors=((Sum(constant=one) as base, exponent),)) if (
                minus and one == 1 and abs(exponent) == _HALF
            ):
                whole = self._known[base]
                small = self(graph.combination(base.terms))
                root = graph.monomial([(whole, _HALF)])
                if exponent > 0:
                    return graph.quotient(small, graph.sum([graph.one, root]))
                return graph.scaled(graph.quotient(small, graph.sum([root, whole])), -1)
        return None


def _splits(graph: Graph, term: Node) -> Iterator[tuple[Node, Node]]:
    """Each way to write a term as f times the rest, f a function or a root."""
    factors = term.factors if isinstance(term, Product) else ((term, _UNIT),)
    for place, (base, exponent) in enumerate(factors):
        if not (isinstance(base, Call) or abs(exponent) == _HALF):
            continue
        rest = graph.monomial([*factors[:place], *factors[place + 1 :]])
        yield graph.monomial([(base, exponent)]), rest
