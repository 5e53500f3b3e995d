"""The function `series` of many coupled coordinates: M q'' = F solved order by order."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.graph.nodes import Node
from lagcli.numerics.compiled.emission import Series
from lagcli.numerics.compiled.kernels import STRIDE
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import Tape

#: Coordinates from which on this is cheaper than an elimination that is written out.
FEWEST = 6


def is_coupled(mass: Sequence[Sequence[Node]], mask: int) -> bool:
    """Whether what stands beside the diagonal of a mass matrix varies with these symbols."""
    return any(row[j].mask & mask for i, row in enumerate(mass) for j in range(i))


class CoupledSeries(Series):
    """`series` for M and F as nodes of a tape.

    Without constraints, so that M has an L D L^T without exchanges.
    """

    def __init__(
        self, numbers: Numbers, tape: Tape, mass: Sequence[Sequence[Node]], forcing: Sequence[Node]
    ) -> None:
        self._mass = [[tape.values[node] for node in row] for row in mass]
        #: the places of the entries that vary, by rows of M: (place, column)
        self._varying = [
            [
                (tape.place_of(value), column)
                for column, value in enumerate(row)
                if value.place is not None
            ]
            for row in self._mass
        ]
        super().__init__(numbers, tape, forcing, ())
        n = self._n
        self._back = self.rows  # of q''
        self._matrix = (self.rows + n) * STRIDE
        self._right = self._matrix + n * n
        self.rows += n - (-(n * n + 2 * n) // STRIDE)
        self._starts, places = [0], []
        for row in self._varying:
            for place, column in row:
                places += [self._row(place, "F") * STRIDE, (self._back + column) * STRIDE]
            self._starts.append(len(places) // 2)
        self._places = places or [0]

    def code(self) -> str:
        """Its definition, and the places of the entries."""
        tables = [
            f"@{name} = internal constant [{len(values)} x i64] "
            f"[{', '.join(f'i64 {value}' for value in values)}]"
            for name, values in (("starts", self._starts), ("places", self._places))
        ]
        return "\n".join((*tables, super().code()))

    def _begun(self, zero: Sequence[str]) -> tuple[str, list[str]]:
        text, n = self._text, self._n
        for i, row in enumerate(self._mass):
            for j, value in enumerate(row[: i + 1]):
                text.stored(text.scaled(value, zero), "%rows", self._matrix + i * n + j)
        for i, root in enumerate(self._roots):
            right = text.scaled(self._tape.values[root], zero)
            text.stored(right, "%rows", self._right + i)
        matrix, right = self._areas()
        work = text.place("%rows", self._right + n)
        fine = text.made(f"call i64 @factor(ptr {matrix}, ptr {work}, i64 {n})")
        text.lines.append(f"call void @solve(ptr {matrix}, ptr {right}, i64 {n})")
        found = [text.loaded("%rows", self._right + i) for i in range(n)]
        for i, a in enumerate(found):
            text.stored(a, "%rows", (self._back + i) * STRIDE)
        return fine, found

    def _areas(self) -> tuple[str, str]:
        """Where M and the right-hand side are."""
        place = self._text.place
        return place("%rows", self._matrix), place("%rows", self._right)

    def _accelerations(self, now: Sequence[str]) -> list[str]:
        text, n = self._text, self._n
        for i, root in enumerate(self._roots):
            value = text.scaled(self._tape.values[root], now, order_0=False)
            text.stored(value, "%rows", self._right + i)
        matrix, right = self._areas()
        given = f"ptr %rows, ptr @starts, ptr @places, ptr {right}, i64 {n}, i64 %k, i64 %behind"
        text.lines.append(f"call void @couple({given})")
        text.lines.append(f"call void @solve(ptr {matrix}, ptr {right}, i64 {n})")
        found = [text.loaded("%rows", self._right + i) for i in range(n)]
        for i, a in enumerate(found):
            text.stored(a, "%rows", text.made(f"add i64 %back, {(self._back + i) * STRIDE}"))
        return found
