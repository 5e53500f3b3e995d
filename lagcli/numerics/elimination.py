"""M a = F + A^T lambda with A a + c = 0, eliminated into straight-line nodes.

M = L D L^T once for all right sides, then the Schur complement S = A M^-1 A^T:

    S lambda = -(c + A M^-1 F),    a = M^-1 F + M^-1 A^T lambda.

Zeros of the structure stay out, and what does not change along the motion is worked out
once.  There is no exchange of rows: M and S are positive definite where the motion is
determined, and where they are not, or lose their rank, a pivot vanishes beside its entry.
The pivots are given back for that, and `dependent` takes over.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., sections 4.1 and 4.2.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.graph.nodes import Graph, Node

Matrix = Sequence[Sequence[Node]]


class Factored:
    """A symmetric matrix of nodes as L D L^T.

    Raises
    ------
    ZeroDivisionError
        When a pivot is 0 whatever the state.
    """

    def __init__(self, graph: Graph, matrix: Matrix) -> None:
        self.graph = graph
        n = len(matrix)
        zero = graph.zero
        #: the pivots, and the entries that they came from
        self.pivots: list[tuple[Node, Node]] = []
        self._lower: list[list[Node]] = [[zero] * n for _ in range(n)]
        for j in range(n):
            done = self._lower[j]
            # u_jk = l_jk d_k
            scaled = [graph.product(done[k], self.pivots[k][0]) for k in range(j)]
            pivot = _less(
                graph, matrix[j][j], [graph.product(done[k], scaled[k]) for k in range(j)]
            )
            if pivot is zero:
                raise ZeroDivisionError("a pivot is 0")
            self.pivots.append((pivot, matrix[j][j]))
            for i in range(j + 1, n):
                row = self._lower[i]
                rest = _less(
                    graph, matrix[i][j], [graph.product(row[k], scaled[k]) for k in range(j)]
                )
                row[j] = graph.quotient(rest, pivot)

    def solve(self, right: Sequence[Node]) -> list[Node]:
        """x of L D L^T x = right."""
        graph, lower = self.graph, self._lower
        n = len(right)
        x: list[Node] = []
        for i in range(n):
            x.append(_less(graph, right[i], [graph.product(lower[i][k], x[k]) for k in range(i)]))
        x = [graph.quotient(value, self.pivots[i][0]) for i, value in enumerate(x)]
        for i in reversed(range(n)):
            x[i] = _less(graph, x[i], [graph.product(lower[k][i], x[k]) for k in range(i + 1, n)])
        return x


class Eliminated:
    """The solution for given constraint rows.

    Parameters
    ----------
    graph
        Makes the nodes.
    mass
        M factored.
    rows
        A, shape (m, n).
    """

    def __init__(self, graph: Graph, mass: Factored, rows: Matrix) -> None:
        self.graph, self.mass, self.rows = graph, mass, rows
        #: the rows of (M^-1 A^T)^T
        self.weighted = [mass.solve(row) for row in rows]
        self.schur = Factored(
            graph, [[_dot(graph, row, other) for other in self.weighted] for row in rows]
        )
        self.guards = [*mass.pivots, *self.schur.pivots]

    def motion(
        self, forcing: Sequence[Node], bias: Sequence[Node]
    ) -> tuple[list[Node], list[Node]]:
        """Accelerations and multipliers."""
        graph = self.graph
        free = self.mass.solve(forcing)
        multipliers = self.schur.solve(
            [
                graph.scaled(graph.sum([c, _dot(graph, row, free)]), -1)
                for row, c in zip(self.rows, bias, strict=True)
            ]
        )
        held = self.moved(multipliers)
        return [graph.sum(pair) for pair in zip(free, held, strict=True)], multipliers

    def moved(self, multipliers: Sequence[Node]) -> list[Node]:
        """M^-1 A^T lambda."""
        graph = self.graph
        columns = zip(*self.weighted, strict=True) if self.weighted else ()
        if not self.weighted:
            return [graph.zero] * len(self.mass.pivots)
        return [_dot(graph, column, multipliers) for column in columns]

    def correction(self, residual: Sequence[Node]) -> list[Node]:
        """The shortest d in the metric M with A d = residual."""
        return self.moved(self.schur.solve(residual))


def _dot(graph: Graph, left: Sequence[Node], right: Sequence[Node]) -> Node:
    zero = graph.zero
    return graph.sum(
        graph.product(a, b)
        for a, b in zip(left, right, strict=True)
        if a is not zero and b is not zero
    )


def _less(graph: Graph, node: Node, taken: Sequence[Node]) -> Node:
    """The node minus a sum."""
    one = graph.one.value  # type: ignore[attr-defined]
    kept = [term for term in taken if term is not graph.zero]
    if not kept:
        return node
    return graph.combination([(node, one), *((term, -one) for term in kept)])
