"""The function `series` of many coupled coordinates: M q'' = F solved order by order.

With constraints the multipliers are unknowns beside the accelerations, and the functions
that lead back onto the constraints solve with the same matrix: see `matrices`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lagcli.graph.nodes import Node
from lagcli.numerics.compiled.emission import LONG, Series, in_blocks
from lagcli.numerics.compiled.layout import STRIDE
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import Scaled, Tape
from lagcli.numerics.compiled.text import Text

#: Coordinates from which on this is cheaper than an elimination that is written out.
FEWEST = 6

Matrix = Sequence[Sequence[Node]]


def is_coupled(mass: Matrix, mask: int) -> bool:
    """Whether what stands beside the diagonal of a mass matrix varies with these symbols."""
    return any(row[j].mask & mask for i, row in enumerate(mass) for j in range(i))


class Bordered:
    """The matrix of M and A with each constraint after the last coordinate it names.

    Attributes
    ----------
    size : int
        Of its rows.
    coordinates, constraints : list of int
        The row of each.
    entries : list of dict
        Of each row, by the column: what is not 0 up to the diagonal.
    first : list of int
        The first column of each row that is not 0.
    """

    def __init__(self, tape: Tape, mass: Matrix, rows: Matrix) -> None:
        def value(node: Node) -> Scaled | None:
            found = tape.values[node]
            return None if found.place is None and found.factor == 0 else found

        n = len(mass)
        named = [[value(node) for node in row] for row in rows]
        last = [max((j for j in range(n) if row[j] is not None), default=0) for row in named]
        order = sorted([*((j, -1) for j in range(n)), *((j, k) for k, j in enumerate(last))])
        self.size = len(order)
        self.coordinates, self.constraints = [0] * n, [0] * len(rows)
        for place, (j, k) in enumerate(order):
            if k < 0:
                self.coordinates[j] = place
            else:
                self.constraints[k] = place
        self.entries: list[dict[int, Scaled]] = []
        for place, (j, k) in enumerate(order):
            beside = [value(node) for node in mass[j]] if k < 0 else named[k]
            found = {
                column: entry
                for column, entry in zip(self.coordinates, beside, strict=True)
                if entry is not None and column <= place
            }
            if k < 0:  # a constraint stands before a coordinate that it does not name
                found.setdefault(place, Scaled(0.0, None))
            self.entries.append(found)
        self.first = [min(row, default=place) for place, row in enumerate(self.entries)]

    def lines(self, text: Text, at: Sequence[str], base: str, begin: int) -> None:
        """Write its values into memory; what is not written is 0."""
        for i, row in enumerate(self.entries):
            for j in range(self.first[i], i + 1):
                entry = row.get(j)
                value = text.whole(0) if entry is None else text.scaled(entry, at)
                text.stored(value, base, begin + i * self.size + j)

    def table(self, name: str) -> str:
        """The first columns, as LLVM has them."""
        return _table(name, self.first)


class CoupledSeries(Series):
    """`series` for M, F and the constraints' A and c as nodes of a tape.

    Parameters
    ----------
    numbers, tape
        As for `Series`.
    mass, forcing
        M and F.
    rows, minus_bias
        A and -c.
    """

    def __init__(
        self,
        numbers: Numbers,
        tape: Tape,
        mass: Matrix,
        forcing: Sequence[Node],
        rows: Matrix = (),
        minus_bias: Sequence[Node] = (),
    ) -> None:
        self._matrix = matrix = Bordered(tape, mass, rows)
        whole: list[dict[int, Scaled]] = [{} for _ in range(matrix.size)]
        for i, row in enumerate(matrix.entries):
            for j, value in row.items():
                whole[i][j] = whole[j][i] = value
        #: the places of the entries that vary, by rows: (place, column)
        varying = [
            [(tape.place_of(row[j]), j) for j in sorted(row) if row[j].place is not None]
            for row in whole
        ]
        super().__init__(numbers, tape, forcing, ())
        known = zip(
            [*matrix.coordinates, *matrix.constraints], [*forcing, *minus_bias], strict=True
        )
        self._sides = [tape.values[node] for _, node in sorted(known, key=lambda pair: pair[0])]
        size = matrix.size
        self._back = self.rows  # of the unknowns
        self._area = (self.rows + size) * STRIDE
        self._right = self._area + size * size
        self.rows += size - (-(size * size + size) // STRIDE)
        self._starts, places = [0], []
        for pairs in varying:
            for place, column in pairs:
                places += [self._row(place, "F") * STRIDE, (self._back + column) * STRIDE]
            self._starts.append(len(places) // 2)
        self._places = places or [0]

    def code(self) -> str:
        """Its definition, and the places of the entries."""
        tables = [_table("starts", self._starts), _table("places", self._places)]
        return "\n".join((*tables, self._matrix.table("first"), super().code()))

    def _begun(self, zero: Sequence[str]) -> tuple[str, list[str]]:
        text = self._text
        self._matrix.lines(text, zero, "%rows", self._area)
        for i, value in enumerate(self._sides):
            text.stored(text.scaled(value, zero), "%rows", self._right + i)
        matrix = text.place("%rows", self._area)
        fine = text.made(f"call i64 @factor(ptr {matrix}, ptr @first, i64 {self._matrix.size})")
        found = self._solved(matrix)
        for i, a in enumerate(found):
            text.stored(a, "%rows", (self._back + i) * STRIDE)
        return fine, [found[i] for i in self._matrix.coordinates]

    def _solved(self, matrix: str) -> list[str]:
        text, size = self._text, self._matrix.size
        right = text.place("%rows", self._right)
        text.lines.append(f"call void @solve(ptr {matrix}, ptr @first, ptr {right}, i64 {size})")
        return [text.loaded("%rows", self._right + i) for i in range(size)]

    def _accelerations(self, now: Sequence[str]) -> list[str]:
        text, size = self._text, self._matrix.size
        for i, value in enumerate(self._sides):
            text.stored(text.scaled(value, now, order_0=False), "%rows", self._right + i)
        right = text.place("%rows", self._right)
        given = f"ptr %rows, ptr @starts, ptr @places, ptr {right}, i64 {size}, i64 %k, i64 %behind"
        text.lines.append(f"call void @couple({given})")
        found = self._solved(text.place("%rows", self._area))
        for i, a in enumerate(found):
            text.stored(a, "%rows", text.made(f"add i64 %back, {(self._back + i) * STRIDE}"))
        return [found[i] for i in self._matrix.coordinates]


def correction_function(
    name: str, numbers: Numbers, tape: Tape, mass: Matrix, rows: Matrix, residuals: Sequence[Node]
) -> str:
    """A function of a state: (d, r), the shortest d in the metric M with A d = r, the residuals."""
    text, matrix = Text(numbers, tape), Bordered(tape, mass, rows)
    size, n, area = matrix.size, len(mass), f"@area.{name}"
    at = text.values([text.loaded("%state", i) for i in range(2 * n + 1)], "null")
    matrix.lines(text, at, area, 0)
    for place in matrix.coordinates:
        text.stored(text.whole(0), area, size * size + place)
    for k, (place, residual) in enumerate(zip(matrix.constraints, residuals, strict=True)):
        value = text.scaled(tape.values[residual], at)
        text.stored(value, area, size * size + place)
        text.stored(value, "%out", n + k)
    first, right = f"@first.{name}", text.place(area, size * size)
    fine = text.made(f"call i64 @factor(ptr {area}, ptr {first}, i64 {size})")
    text.lines.append(f"call void @solve(ptr {area}, ptr {first}, ptr {right}, i64 {size})")
    for j, place in enumerate(matrix.coordinates):
        text.stored(text.loaded(area, size * size + place), "%out", j)
    lines = in_blocks(text.lines, "entry")[0] if len(tape.ops) > LONG else text.lines
    return "\n".join(
        [
            f"{area} = internal global [{size * (size + 1)} x {numbers.type}] zeroinitializer",
            matrix.table(f"first.{name}"),
            f"define i64 @{name}(ptr %state, ptr %out) nounwind {{",
            "entry:",
            *lines,
            f"ret i64 {fine}\n}}",
        ]
    )


def _table(name: str, values: Iterable[int]) -> str:
    cells = [f"i64 {value}" for value in values]
    return f"@{name} = internal constant [{len(cells)} x i64] [{', '.join(cells)}]"
