"""cos a cos b + sin a sin b = cos(a - b) in sums of products of two factors.

That is what the mass matrix of bodies that turn is made of.  Nothing is expanded: the
two terms are recognized as they stand.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, factors_of
from lagcli.record import record

_UNIT = Fraction(1)


@record
class Pair:
    """coefficient * left * right."""

    coefficient: Fraction
    left: Node
    right: Node


Key = tuple[Fraction, Node, Node, Node, Node]


class AnglePairs:
    """Joins pairs of one graph; what a node splits into is remembered."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph
        self._splits: dict[Node, tuple[tuple[str, Node, Node], ...]] = {}

    def __call__(self, pairs: Sequence[Pair]) -> Node:
        """The sum of the pairs, with differences and sums of angles where they fit."""
        done: list[tuple[Node, Fraction]] = []
        open_pairs = list(pairs)
        while open_pairs:
            joined: list[Pair] = []
            used: set[int] = set()
            sines = {key: i for i, pair in enumerate(open_pairs) for key in self._keys(pair, "sin")}
            for i, pair in enumerate(open_pairs):
                for key in () if i in used else self._keys(pair, "cos"):
                    partner, sign = sines.get(key), -1
                    if partner is None:
                        partner, sign = sines.get((-key[0], *key[1:])), 1
                    if partner is None or partner in used or partner == i:
                        continue
                    used |= {i, partner}
                    _, left, a, right, b = key
                    if a is b and sign < 0:  # cos^2 + sin^2 = 1
                        joined.append(Pair(pair.coefficient, left, right))
                    else:
                        angle = self.graph.combination(((a, _UNIT), (b, Fraction(sign))))
                        cosine = self.graph.call("cos", (angle,))
                        done.append((self.graph.product(left, right, cosine), pair.coefficient))
                    break
            for i, pair in enumerate(open_pairs):
                if i not in used:
                    rest = self.graph.product(pair.left, pair.right)
                    if joined and any(True for _ in self._keys(pair, "sin")):
                        joined.append(pair)
                    else:
                        done.append((rest, pair.coefficient))
            open_pairs = joined
        return self.graph.combination(done)

    def _keys(self, pair: Pair, function: str) -> Iterator[Key]:
        """The pair as coefficient * (left f(a)) * (right f(b)), in both orders."""
        for name, a, left in self._split(pair.left):
            if name == function:
                for other, b, right in self._split(pair.right):
                    if other == function:
                        yield (pair.coefficient, left, a, right, b)
                        if function == "sin":
                            yield (pair.coefficient, right, b, left, a)

    def _split(self, node: Node) -> tuple[tuple[str, Node, Node], ...]:
        """Each way to write the node as rest * sin(a) or rest * cos(a): name, a, rest."""
        known = self._splits.get(node)
        if known is None:
            known = self._splits[node] = tuple(self._ways(node))
        return known

    def _ways(self, node: Node) -> Iterator[tuple[str, Node, Node]]:
        factors = factors_of(node)
        for position, (base, exponent) in enumerate(factors):
            if isinstance(base, Call) and base.function in {"sin", "cos"} and exponent == 1:
                others = [*factors[:position], *factors[position + 1 :]]
                yield base.function, base.arguments[0], self.graph.monomial(others)
