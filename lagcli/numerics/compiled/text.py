"""The tape as code: its values at a state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lagcli.graph.nodes import Node
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import Op, Scaled, Tape
from lagcli.numerics.equations.straight_line import PIVOT_TOLERANCE


class Text:
    """Lines of one function."""

    def __init__(self, numbers: Numbers, tape: Tape) -> None:
        self.numbers, self.tape, self.real = numbers, tape, numbers.type
        self.lines: list[str] = []
        self._count = 0

    def made(self, what: str) -> str:
        """The name of a new value."""
        self._count += 1
        name = f"%t{self._count}"
        self.lines.append(f"{name} = {what}")
        return name

    def two(self, word: str, a: str, b: str) -> str:
        """An operation of two."""
        return self.made(f"{word} {self.real} {a}, {b}")

    def minus(self, a: str) -> str:
        """-a."""
        return self.made(f"fneg {self.real} {a}")

    def literal(self, value: Any) -> str:
        """A number of the tape."""
        return self.numbers.literal(exact(value))

    def whole(self, value: int) -> str:
        """A whole number, as a real one."""
        return self.numbers.literal(float(value))

    def call(self, name: str, *arguments: str) -> str:
        """A function of the grammar."""
        given = ", ".join(f"{self.real} {x}" for x in arguments)
        intrinsics = {"sqrt": self.numbers.root, "fabs": f"@llvm.fabs.{self.numbers.suffix}"}
        function = intrinsics.get(name) or self.numbers.function(name)
        return self.made(f"call {self.real} {function}({given})")

    def loaded(self, base: str, index: str | int) -> str:
        """base[index]."""
        return self.made(f"load {self.real}, ptr {self.place(base, index)}")

    def stored(self, value: str, base: str, index: str | int) -> None:
        """base[index] = value."""
        self.lines.append(f"store {self.real} {value}, ptr {self.place(base, index)}")

    def place(self, base: str, index: str | int) -> str:
        """Where base[index] is."""
        return self.made(f"getelementptr {self.real}, ptr {base}, i64 {index}")

    def scaled(self, value: Scaled, at: Sequence[str], order_0: bool = True) -> str:
        """factor * operation, at order 0 or above."""
        if value.place is None:
            return self.literal(value.factor) if order_0 else self.whole(0)
        if value.factor == 1:
            return at[value.place]
        return self.two("fmul", self.literal(value.factor), at[value.place])

    def combined(self, op: Op, at: Sequence[str], *, constant: bool) -> str:
        """A sum, its constant at order 0 only."""
        total = ""
        if constant and op.numbers[0] != 0:
            total = self.literal(op.numbers[0])
        for place, factor in zip(op.operands, op.numbers[1:], strict=True):
            if factor == 1:
                total = self.two("fadd", total, at[place]) if total else at[place]
            elif factor == -1:
                total = self.two("fsub", total, at[place]) if total else self.minus(at[place])
            else:
                term = self.two("fmul", self.literal(factor), at[place])
                total = self.two("fadd", total, term) if total else term
        return total or self.whole(0)

    # -- order 0 ---------------------------------------------------------------------------------

    def values(self, inputs: Sequence[str], signs: str) -> list[str]:
        """The values of all operations."""
        found: list[str] = []
        for op in self.tape.ops:
            found.append(
                self._first(op, [found[place] for place in op.operands], inputs, signs, found)
            )
        return found

    def _first(
        self, op: Op, x: list[str], inputs: Sequence[str], signs: str, found: list[str]
    ) -> str:
        match op.name:
            case "input":
                return inputs[int(op.numbers[0])]
            case "sum":
                return self.combined(op, found, constant=True)
            case "product":
                return self.two("fmul", *x)
            case "quotient":
                return self.two("fdiv", *(x if len(x) > 1 else (self.whole(1), x[0])))
            case "power":
                return self.call("pow", x[0], self.literal(op.numbers[0]))
            case "root":
                return self.call("sqrt", x[0])
            case "exp" | "tanh" | "sin" | "sinh":
                return self.call(op.name, x[0])
            case "other":
                argument = self.tape.ops[op.operands[0]]
                return self.call(argument.name.replace("sin", "cos"), found[argument.operands[0]])
            case "primitive":
                return self.call(op.word, x[0])
            case "angle":
                return self.call("atan2", x[0], x[1])
            case "sign":
                return self.loaded(signs, op.numbers[0])
            case "signed":
                return self.two("fmul", self.loaded(signs, op.numbers[0]), x[0])
            case "side":
                negative = self.made(f"fcmp olt {self.real} {x[0]}, {self.whole(0)}")
                signs = f"{self.real} {self.whole(-1)}, {self.real} {self.whole(1)}"
                return self.made(f"select i1 {negative}, {signs}")
            case "abs_of":
                return self.call("fabs", x[0])
            case "sign_of":
                zero = self.whole(0)
                above = self.made(f"fcmp ogt {self.real} {x[0]}, {zero}")
                below = self.made(f"fcmp olt {self.real} {x[0]}, {zero}")
                less = self.made(f"uitofp i1 {below} to {self.real}")
                return self.two("fsub", self.made(f"uitofp i1 {above} to {self.real}"), less)
        raise TypeError(op.name)

    def guarded(self, guards: Sequence[tuple[Node, Node]], at: Sequence[str]) -> str:
        """Whether no pivot vanishes beside its entry."""
        fine = "true"
        for pivot, entry in guards:
            left = self.call("fabs", self.scaled(self.tape.values[pivot], at))
            right = self.whole(0)
            if pivot is not entry:
                size = self.call("fabs", self.scaled(self.tape.values[entry], at))
                right = self.two("fmul", self.literal(PIVOT_TOLERANCE), size)
            here = self.made(f"fcmp ugt {self.real} {left}, {right}")
            fine = self.made(f"and i1 {fine}, {here}")
        return self.made(f"zext i1 {fine} to i64")


def exact(value: Any) -> Any:
    """A double as it is, a ball's midpoint as a fraction."""
    if isinstance(value, (int, float)):
        return float(value)
    from fractions import Fraction

    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def values_function(
    name: str, numbers: Numbers, tape: Tape, roots: Sequence[Node], guards: Sequence[Any]
) -> str:
    """A function of a state that writes the values of the roots."""
    text = Text(numbers, tape)
    count = sum(op.name == "input" for op in tape.ops)
    inputs = [text.loaded("%state", i) for i in range(count)]
    at = text.values(inputs, "null")
    fine = text.guarded(guards, at)
    for index, root in enumerate(roots):
        text.stored(text.scaled(tape.values[root], at), "%out", index)
    body = "\n".join(text.lines)
    return f"define i64 @{name}(ptr %state, ptr %out) nounwind {{\n{body}\nret i64 {fine}\n}}"
