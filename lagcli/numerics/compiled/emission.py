"""The tape as code: the loop over the orders of its series.

For each operation and order k the convolution of all coefficients that are known from the
orders before is one call, `inner`; what is new at this order is added by hand:

    product    c_k = a_0 b_k + a_k b_0 + sum_{0<j<k} a_j b_{k-j}
    quotient   c_k = (a_k - c_0 b_k - sum_{0<j<k} b_j c_{k-j}) / b_0
    root       c_k = (a_k - sum_{0<j<k} c_j c_{k-j}) / (2 c_0)
    power r    c_k = (r k a_k c_0 + sum_{0<j<k} (r j - (k - j)) a_j c_{k-j}) / (k a_0)
    exp        c_k = (k a_k c_0 + sum_{0<j<k} j a_j c_{k-j}) / k
    sin, cos   s_k = (sum_{0<j<=k} j a_j c_{k-j}) / k,    c_k = -(the same with s) / k
    tanh       t_k = (sum_{0<j<=k} j a_j w_{k-j}) / k,    w = 1 - t^2
    primitive  k y_k = (k a_k - sum_{0<j<k} j y_j u_{k-j}) / u_0    for y' = a' / u

A row of coefficients is kept forwards, backwards (so that both sides of a convolution are
read in the order of memory) and, where needed, multiplied by j.

References
----------
Griewank, Walther, *Evaluating Derivatives*, 2nd ed., section 13.2 and table 13.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lagcli.graph.nodes import Node
from lagcli.numerics.compiled.layout import STRIDE
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import Op, Tape
from lagcli.numerics.compiled.text import Text

#: The place of the coefficient 0 in a row that is kept backwards; zeros stand from there on.
LAST = STRIDE - 5
#: Operations up to which the convolution is copied to where it is used.
_COPIED = 40
#: Operations beyond which good code takes longer to make than it saves in most runs.
LONG = 150
#: Lines of a block of long code: LLVM is slow with blocks of thousands.
_BLOCK = 100

_FUNCTIONS = "sin cos sinh cosh tanh exp log pow asin acos atan asinh acosh atanh atan2".split()


def declarations(numbers: Numbers) -> str:
    """The functions of the C library."""
    real, suffix = numbers.type, numbers.suffix
    names = (numbers.root, f"@llvm.fabs.{suffix}")
    lines = [f"declare {real} {name}({real}) nounwind memory(none)" for name in names]
    for name in _FUNCTIONS:
        given = f"{real}, {real}" if name in {"pow", "atan2"} else real
        lines.append(f"declare {real} {numbers.function(name)}({given}) nounwind memory(none)")
    return "\n".join(lines)


def convolution(numbers: Numbers, how: str) -> str:
    """The function `inner`: a call costs a tenth, a copy a millisecond to make."""
    name = "inner_double.ll" if numbers.type == "double" else "inner.ll"
    text = Path(__file__).with_name(name).read_text("ascii")
    return text.replace("$real", numbers.type).replace("$how", how)


def convolution_for(numbers: Numbers, ops: int) -> str:
    """The same, for a number of operations of its own module."""
    return convolution(numbers, "alwaysinline" if ops <= _COPIED else "noinline")


class Series:
    """The function `series` for q'' as nodes of a tape.

    Attributes
    ----------
    rows : int
        Of `STRIDE` numbers each, that it works in.
    """

    def __init__(
        self, numbers: Numbers, tape: Tape, roots: Sequence[Node], guards: Sequence[Any]
    ) -> None:
        self._tape, self._roots, self._guards = tape, roots, guards
        self._n = len(roots)
        self._text = Text(numbers, tape)
        self._real = numbers.type
        self.rows = 2 * self._n + 1
        self._rows: dict[tuple[int, str], int] = {}
        self._first: list[str] = []
        self._inverses: dict[int, str] = {}
        self._watched: list[int] = []
        self._inputs = [place for place, op in enumerate(tape.ops) if op.name == "input"]

    def _row(self, place: int, kind: str) -> int:
        """The row in which an operation is kept: forwards F, backwards R, times j FJ, RJ."""
        if kind == "F" and self._tape.ops[place].name == "input":
            return int(self._tape.ops[place].numbers[0])
        if (place, kind) not in self._rows:
            self._rows[place, kind] = self.rows
            self.rows += 1
        return self._rows[place, kind]

    def kept(self, node: Node) -> int:
        """The row in which all coefficients of a node are found."""
        place = self._tape.place_of(self._tape.values[node])
        self._watched.append(place)
        return self._row(place, "F")

    def code(self) -> str:
        """Its definition."""
        text, n = self._text, self._n
        count = len(self._inputs)
        inputs = [text.loaded("%rows", i * STRIDE) for i in range(count)]
        zero = text.values(inputs, "%signs")
        for place in self._watched:
            text.stored(zero[place], "%rows", self._row(place, "F") * STRIDE)
        fine, accelerations = self._begun(zero)
        scale = text.loaded("%rows", 2 * n * STRIDE + 1)
        for j, a in enumerate(accelerations):
            text.stored(text.two("fmul", scale, inputs[n + j]), "%rows", j * STRIDE + 1)
            text.stored(text.two("fmul", scale, a), "%rows", (n + j) * STRIDE + 1)
        self._first, text.lines = text.lines, []
        now = self._orders(zero)
        real = self._real
        for j, a in enumerate(self._accelerations(now)):
            for row, value in ((j, now[n + j]), (n + j, a)):
                next_one = text.made(f"add i64 %next, {row * STRIDE}")
                text.stored(text.two("fmul", value, "%rate"), "%rows", next_one)
        first, last_of_first = self._blocks(self._first, "entry")
        lines, last = self._blocks(text.lines, "loop")
        return "\n".join(
            [
                "define i64 @series(ptr %rows, ptr %signs, i64 %order) nounwind {",
                "entry:",
                *first,
                "%several = icmp sgt i64 %order, 1",
                "br i1 %several, label %loop, label %end",
                "loop:",
                f"%k = phi i64 [ 1, %{last_of_first} ], [ %next, %{last} ]",
                "%known = sub i64 %k, 1",
                "%next = add i64 %k, 1",
                f"%back = sub i64 {LAST}, %k",
                "%behind = add i64 %back, 1",
                f"%k.real = sitofp i64 %k to {real}",
                f"%next.real = sitofp i64 %next to {real}",
                f"%part = fdiv {real} {text.whole(1)}, %k.real",
                f"%rate = fdiv {real} {scale}, %next.real",
                *lines,
                "%more = icmp slt i64 %next, %order",
                "br i1 %more, label %loop, label %end",
                "end:",
                f"ret i64 {fine}",
                "}",
            ]
        )

    def _blocks(self, lines: list[str], name: str) -> tuple[list[str], str]:
        """The lines in blocks where they are many, and the name of the last."""
        return in_blocks(lines, name) if len(self._tape.ops) > LONG else (lines, name)

    def _begun(self, zero: Sequence[str]) -> tuple[str, list[str]]:
        """Whether no pivot vanishes, and q'' of order 0."""
        text, values = self._text, self._tape.values
        fine = text.guarded(self._guards, zero)
        return fine, [text.scaled(values[root], zero) for root in self._roots]

    def _accelerations(self, now: Sequence[str]) -> list[str]:
        """q'' of order k."""
        values = self._tape.values
        return [self._text.scaled(values[root], now, order_0=False) for root in self._roots]

    def _orders(self, zero: Sequence[str]) -> list[str]:
        """The coefficients of order k of all operations."""
        text, now = self._text, list[str]()
        ops = self._tape.ops
        pending: dict[int, str] = {}
        pieces: list[list[str]] = []
        for place, op in enumerate(ops):
            text.lines = []
            value = pending.pop(place, "") or self._order(place, op, zero, now, pending)
            now.append(value)
            pieces.append(text.lines)
        # which rows are kept is known when all convolutions are written
        lines: list[str] = []
        for place, piece in enumerate(pieces):
            lines += piece
            text.lines = []
            self._kept(place, now[place])
            lines += text.lines
        text.lines = lines
        return now

    def _kept(self, place: int, value: str) -> None:
        text = self._text
        rows = {kind: self._rows.get((place, kind)) for kind in ("F", "R", "FJ", "RJ")}
        times = ""
        if rows["FJ"] is not None or rows["RJ"] is not None:
            times = text.two("fmul", value, "%k.real")
        for kind, row in rows.items():
            if row is not None:
                index = "%k" if kind[0] == "F" else "%back"
                at = text.made(f"add i64 {index}, {row * STRIDE}")
                text.stored(times if "J" in kind else value, "%rows", at)

    def _inverse(self, zero: Sequence[str], place: int) -> str:
        """1 / the value of an operation, worked out before the loop."""
        if place not in self._inverses:
            text, here = self._text, self._text.lines
            text.lines = self._first
            self._inverses[place] = text.two("fdiv", text.whole(1), zero[place])
            text.lines = here
        return self._inverses[place]

    def _inner(self, left: tuple[int, str], right: tuple[int, str]) -> str:
        """The sum over 0 < j < k of a forward row and a backward one."""
        text, real = self._text, self._real
        a = text.place("%rows", self._row(*left) * STRIDE + 1)
        b = text.place("%rows", text.made(f"add i64 %behind, {self._row(*right) * STRIDE}"))
        return text.made(f"call {real} @inner(ptr {a}, ptr {b}, i64 %known)")

    def _order(
        self, place: int, op: Op, zero: Sequence[str], now: list[str], pending: dict[int, str]
    ) -> str:
        text, two, inner = self._text, self._text.two, self._inner
        x = op.operands
        a = now[x[0]] if x else ""
        a0, c0 = (zero[x[0]] if x else ""), zero[place]
        match op.name:
            case "input":
                return text.loaded("%rows", text.made(f"add i64 %k, {op.numbers[0] * STRIDE}"))
            case "sum":
                return text.combined(op, now, constant=False)
            case "product":
                before = inner((x[0], "F"), (x[1], "R"))
                if x[0] == x[1]:
                    twice = two("fmul", a0, text.whole(2))
                    return two("fadd", before, two("fmul", twice, a))
                new = two("fadd", two("fmul", a0, now[x[1]]), two("fmul", a, zero[x[1]]))
                return two("fadd", before, new)
            case "quotient":
                below = x[-1]
                before = inner((below, "F"), (place, "R"))
                taken = two("fadd", before, two("fmul", c0, now[below]))
                rest = two("fsub", a, taken) if len(x) > 1 else text.minus(taken)
                return two("fmul", rest, self._inverse(zero, below))
            case "root":
                rest = two("fsub", a, inner((place, "F"), (place, "R")))
                half = two("fmul", rest, text.literal(0.5))
                return two("fmul", half, self._inverse(zero, place))
            case "power":
                r = text.literal(op.numbers[0])
                left = inner((x[0], "FJ"), (place, "R"))
                right = inner((x[0], "F"), (place, "RJ"))
                new = two("fmul", two("fmul", "%k.real", a), c0)
                before = two("fmul", r, two("fadd", left, new))
                rest = two("fmul", two("fsub", before, right), "%part")
                return two("fmul", rest, self._inverse(zero, x[0]))
            case "exp":
                return self._flow(x[0], a, place, c0)
            case "sin" | "sinh":
                other = self._other(place)
                cosine = self._flow(x[0], a, place, c0)
                pending[other] = text.minus(cosine) if op.name == "sin" else cosine
                return self._flow(x[0], a, other, zero[other])
            case "tanh":
                # w = 1 - t^2 is kept where an operation of its own would be
                return self._tanh(place, x[0], a, c0)
            case "primitive":
                rest = two("fmul", "%k.real", a)
                rest = two("fsub", rest, inner((place, "FJ"), (x[1], "R")))
                return two("fmul", two("fmul", rest, "%part"), self._inverse(zero, x[1]))
            case "angle":
                y, u, below = x
                turn = two("fsub", two("fmul", a, zero[u]), two("fmul", now[u], zero[y]))
                turn = two("fmul", "%k.real", turn)
                turn = two("fadd", turn, inner((y, "FJ"), (u, "R")))
                turn = two("fsub", turn, inner((u, "FJ"), (y, "R")))
                turn = two("fsub", turn, inner((place, "FJ"), (below, "R")))
                return two("fmul", two("fmul", turn, "%part"), self._inverse(zero, below))
            case "sign" | "side":
                return text.whole(0)
            case "signed":
                return two("fmul", text.loaded("%signs", op.numbers[0]), a)
        raise TypeError(op.name)

    def _other(self, place: int) -> int:
        """The place of the cosine that belongs to a sine."""
        return self._tape.ops.index(Op("other", (place,)))

    def _flow(self, argument: int, a: str, factor: int, value: str) -> str:
        """c_k of c' = a' f: (k a_k f_0 + sum of j a_j f_{k-j}) / k."""
        two = self._text.two
        before = self._inner((argument, "FJ"), (factor, "R"))
        new = two("fmul", two("fmul", "%k.real", a), value)
        return two("fmul", two("fadd", before, new), "%part")

    def _tanh(self, place: int, argument: int, a: str, t0: str) -> str:
        text, two = self._text, self._text.two
        w0 = two("fsub", text.whole(1), two("fmul", t0, t0))
        before = self._inner((argument, "FJ"), (-1 - place, "R"))
        new = two("fmul", two("fmul", "%k.real", a), w0)
        t = two("fmul", two("fadd", before, new), "%part")
        squares = self._inner((place, "F"), (place, "R"))
        twice = two("fmul", two("fmul", text.whole(2), t0), t)
        w = text.minus(two("fadd", squares, twice))
        text.stored(w, "%rows", text.made(f"add i64 %back, {self._row(-1 - place, 'R') * STRIDE}"))
        return t


def in_blocks(lines: list[str], name: str) -> tuple[list[str], str]:
    """The lines of a block in many, and the name of the last."""
    found, last = lines[:_BLOCK], name
    for start in range(_BLOCK, len(lines), _BLOCK):
        last = f"{name}.{start}"
        found += [f"br label %{last}", f"{last}:", *lines[start : start + _BLOCK]]
    return found, last
