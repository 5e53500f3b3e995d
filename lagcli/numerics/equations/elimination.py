"""M a = F + A^T lambda with A a + c = 0, eliminated into straight-line nodes.

M = L D L^T once for all right sides, then the Schur complement S = A M^-1 A^T:

    S lambda = -(c + A M^-1 F),    a = M^-1 F + M^-1 A^T lambda.

Zeros of the structure stay out, and what does not change along the motion is worked out
once.  There is no exchange of rows: M and S are positive definite where the motion is
determined, and where they are not, or lose their rank, a pivot vanishes beside its entry.
The pivots are given back for that, and `null_space` takes over.  Where a pivot is 0 at every
state but what is left of its row is not, as with L = x' y', M is replaced by W M W^T: W adds
another row, whose entry, twice, becomes the pivot.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., sections 4.1 and 4.2.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.graph.expansion import TooLong
from lagcli.graph.nodes import Graph, Node

Matrix = Sequence[Sequence[Node]]


#: Products beyond which a loop over numbers is cheaper: written out, a matrix is `TooLong`.
LONGEST = 3000


class Factored:
    """A symmetric matrix of nodes as L D L^T.

    Parameters
    ----------
    graph
        Makes the nodes.
    matrix
        Its entries.

    Attributes
    ----------
    products : int
        So many have been written, those of `solve` among them.

    Raises
    ------
    ZeroDivisionError
        When a pivot is 0 whatever the state.
    TooLong
        When there are more than `LONGEST`.
    """

    def __init__(self, graph: Graph, matrix: Matrix) -> None:
        self.graph, self.products = graph, 0
        #: (j, i): W adds row i to row j
        self._added: list[tuple[int, int]] = []
        while (pair := self._factor(matrix)) is not None:
            if pair in self._added:
                raise ZeroDivisionError("a pivot is 0")
            self._added.append(pair)
            matrix = self._with_added(matrix, *pair)

    def _with_added(self, matrix: Matrix, j: int, i: int) -> Matrix:
        rows = [list(row) for row in matrix]
        rows[j] = [self.graph.sum(pair) for pair in zip(rows[j], rows[i], strict=True)]
        for row in rows:
            row[j] = self.graph.sum([row[j], row[i]])
        return rows

    def _factor(self, matrix: Matrix) -> tuple[int, int] | None:
        """L and D; or a pivot that is 0 and the first row that is not, with it, in its column."""
        n, zero, graph = len(matrix), self.graph.zero, self.graph
        #: the pivots, and the entries that they came from
        self.pivots: list[tuple[Node, Node]] = []
        #: what L has below its diagonal, by rows and by columns
        self._rows: list[dict[int, Node]] = [{} for _ in range(n)]
        self._columns: list[dict[int, Node]] = [{} for _ in range(n)]
        for j in range(n):
            # u_jk = l_jk d_k
            scaled = {k: graph.product(x, self.pivots[k][0]) for k, x in self._rows[j].items()}
            pivot = self._less(matrix[j][j], self._rows[j], scaled)
            rests = {i: self._less(matrix[i][j], self._rows[i], scaled) for i in range(j + 1, n)}
            rests = {i: rest for i, rest in rests.items() if rest is not zero}
            if pivot is zero:
                if not rests:
                    raise ZeroDivisionError("a pivot is 0")
                return j, min(rests)
            self.pivots.append((pivot, matrix[j][j]))
            for i, rest in rests.items():
                self._rows[i][j] = self._columns[j][i] = graph.quotient(rest, pivot)
            self.limit()
        return None

    def limit(self) -> None:
        """Raise where it has become too long."""
        if self.products > LONGEST:
            raise TooLong

    def solve(self, right: Sequence[Node]) -> list[Node]:
        """x of L D L^T x = right."""
        graph, zero = self.graph, self.graph.zero
        x: dict[int, Node] = {}
        right = list(right)
        for j, i in self._added:
            right[j] = graph.sum([right[j], right[i]])

        def put(i: int, value: Node) -> None:
            x.pop(i, None)
            if value is not zero:
                x[i] = value

        for i, value in enumerate(right):
            put(i, self._less(value, self._rows[i], x))
        for i in list(x):
            put(i, graph.quotient(x[i], self.pivots[i][0]))
        for i in reversed(range(len(right))):
            put(i, self._less(x.get(i, zero), self._columns[i], x))
        for j, i in reversed(self._added):
            put(i, graph.sum([x.get(i, zero), x.get(j, zero)]))
        return [x.get(i, zero) for i in range(len(right))]

    def _less(self, node: Node, left: dict[int, Node], right: dict[int, Node]) -> Node:
        """The node minus the product of two vectors."""
        graph, one = self.graph, self.graph.one.value  # type: ignore[attr-defined]
        taken = [graph.product(x, right[k]) for k, x in left.items() if k in right]
        if not taken:
            return node
        self.products += len(taken)
        return graph.combination([(node, one), *((term, -one) for term in taken)])


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

    Raises
    ------
    ZeroDivisionError, TooLong
        As for `Factored`.
    """

    def __init__(self, graph: Graph, mass: Factored, rows: Matrix) -> None:
        self.graph, self.mass, self.rows = graph, mass, rows
        #: the rows of (M^-1 A^T)^T
        self.weighted: list[list[Node]] = []
        for row in rows:
            self.weighted.append(mass.solve(row))
            mass.limit()
        schur = [[graph.zero] * len(rows) for _ in rows]
        for i, row in enumerate(rows):
            for j, other in enumerate(self.weighted[: i + 1]):
                schur[i][j] = schur[j][i] = _dot(graph, row, other)
        self.schur = Factored(graph, schur)
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
