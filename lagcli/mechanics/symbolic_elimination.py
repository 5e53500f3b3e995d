"""The elimination of Gauss without pivoting, every step of it named (see `closed_form`)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from lagcli.graph.nodes import Graph, Node, Symbol
from lagcli.graph.sharing import operations
from lagcli.graph.substitution import Substitution
from lagcli.notation.naming import free_stem


class StepNames:
    """Letters for the steps that no name of the file has."""

    def __init__(self, taken: Collection[str], values: str = "y", *, wide: bool) -> None:
        self.between = "_" if wide else ""
        self.matrix = free_stem(("u", "U", "w"), taken)
        self.right = free_stem((values, "Y", "v"), taken)
        self.solution = free_stem(("a", "x", "b"), taken)


class SymbolicElimination:
    """The steps: what each name stands for, as nodes of one graph."""

    def __init__(
        self,
        graph: Graph,
        matrix: Sequence[Sequence[Node]],
        right: Sequence[Node],
        names: StepNames,
    ) -> None:
        self.graph = graph
        self.named: dict[Symbol, Node] = {}
        self._names = names
        size = len(right)
        self._rows: list[list[Node]] = []
        self.values: list[Node] = []
        for i in range(size):
            self._rows.append([self._entry(matrix, i, j) for j in range(size)])
            parts = ((row[i], y, row[k]) for k, (row, y) in enumerate(self._before(i)))
            self.values.append(self._name(f"{names.right}{i + 1}", self._less(right[i], parts)))
        self.pivots = [row[i] for i, row in enumerate(self._rows)]
        self.forward = dict(self.named)
        self.solution = self._backward()

    def _before(self, i: int) -> Iterator[tuple[list[Node], Node]]:
        return zip(self._rows[:i], self.values, strict=False)

    def _entry(self, matrix: Sequence[Sequence[Node]], i: int, j: int) -> Node:
        """u_ij, 0 below the diagonal."""
        if j < i:
            return self.graph.zero
        parts = ((row[i], row[j], row[k]) for k, row in enumerate(self._rows))
        name = f"{self._names.matrix}{i + 1}{self._names.between}{j + 1}"
        return self._name(name, self._less(matrix[i][j], parts))

    def _less(self, start: Node, parts: Iterable[tuple[Node, Node, Node]]) -> Node:
        """start - sum u v / d."""
        graph = self.graph
        terms = [
            graph.scaled(graph.quotient(graph.product(u, v), d), -1)
            for u, v, d in parts
            if graph.zero not in (u, v)
        ]
        return graph.sum([start, *terms])

    def _name(self, name: str, node: Node) -> Node:
        """A symbol for what shows more than one operation."""
        if operations([node]) < 2:
            return node
        symbol = self.graph.symbol(name)
        self.named[symbol] = node
        return symbol

    def _backward(self) -> list[Node]:
        graph, size = self.graph, len(self.values)
        found = [graph.zero] * size
        for i in reversed(range(size)):
            row = self._rows[i]
            known = [graph.product(row[j], found[j]) for j in range(i + 1, size)]
            rest = graph.sum([self.values[i], *(graph.scaled(each, -1) for each in known)])
            whole = graph.quotient(rest, self.pivots[i])
            # the first is used by no other
            found[i] = self._name(f"{self._names.solution}{i + 1}", whole) if i else whole
        return found

    @property
    def unfolded(self) -> list[Node]:
        """The solution with every step put in."""
        whole: dict[Symbol, Node] = {}
        for symbol, node in self.named.items():
            whole[symbol] = Substitution(self.graph, whole)(node)
        return [Substitution(self.graph, whole)(x) for x in self.solution]
