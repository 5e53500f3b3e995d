"""A small part of Python, translated to LLVM's language: what `kernels` is written in.

Functions of numbers (`float`, the type of the run), whole numbers (`int`), places in
memory (`Reals`, `Ints`, and `DoubleCells`, which are read and written as `float`); loops over
`range` and `while`, `if`, assignments, the four operations and `//` of whole numbers that are
not negative, comparisons of two, `and`, `or`, `not`, and calls of other functions.  A name in
capitals is a constant of the module.  Both sides of `and` and `or` are worked out.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.signatures import Signature, signature_of

#: Of what is in memory from a place on.
_ENTRIES = {"ptr": "real", "ints": "i64", "doubles": "double"}
_OPERATIONS: dict[tuple[type, str], str] = {
    (ast.Add, "real"): "fadd",
    (ast.Sub, "real"): "fsub",
    (ast.Mult, "real"): "fmul",
    (ast.Div, "real"): "fdiv",
    (ast.Add, "i64"): "add",
    (ast.Sub, "i64"): "sub",
    (ast.Mult, "i64"): "mul",
    (ast.FloorDiv, "i64"): "sdiv",
}
#: Ordered comparisons: all but != are false where one side is nan.
_COMPARISONS: dict[type, tuple[str, str]] = {
    ast.Lt: ("olt", "slt"),
    ast.LtE: ("ole", "sle"),
    ast.Gt: ("ogt", "sgt"),
    ast.GtE: ("oge", "sge"),
    ast.Eq: ("oeq", "eq"),
    ast.NotEq: ("une", "ne"),
}


class Value(NamedTuple):
    """What an expression gives: real, i64, i1, ptr, ints or doubles, and how it is written."""

    kind: str
    text: str


def translated(
    source: str,
    numbers: Numbers,
    given: Mapping[str, Signature],
    beside: Mapping[str, Signature] | None = None,
) -> str:
    """The definitions of a module's functions.

    Parameters
    ----------
    source
        The text of the module.
    numbers
        The type of its `float`.
    given
        Functions that are defined elsewhere; the address of f stands at `@at.f`.
    beside
        Functions that the module has, which also declares what of the C library it uses.
    """
    tree = ast.parse(source)
    constants = {
        target.id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    signatures = dict(given) | dict(beside or {}) | {f.name: signature_of(f) for f in functions}
    head = [] if beside else _head(numbers, given)
    bodies = [_Function(f, numbers, signatures, constants, set(given)).text() for f in functions]
    return "\n".join((*head, *bodies))


def _head(numbers: Numbers, given: Iterable[str]) -> list[str]:
    head = [f"@at.{name} = global ptr null" for name in given]
    real, suffix = numbers.type, numbers.suffix
    head += [f"declare {real} {name}({real})" for name in (numbers.root, f"@llvm.fabs.{suffix}")]
    head += [f"declare double @{name}(double)" for name in ("exp", "log")]
    head.append(f"declare {real} @llvm.fmuladd.{suffix}({', '.join([real] * 3)})")
    return head


class _Function:
    """One function, its locals in memory: LLVM takes them into registers."""

    def __init__(
        self,
        function: ast.FunctionDef,
        numbers: Numbers,
        signatures: Mapping[str, Signature],
        constants: Mapping[str, Any],
        given: set[str],
    ) -> None:
        self._given = given
        self._function, self._numbers = function, numbers
        self._signatures, self._constants = signatures, constants
        self._result, kinds = signatures[function.name]
        self._locals: dict[str, str] = {}
        self._lines: list[str] = []
        self._allocated: list[str] = []
        self._count = 0
        self._ends: list[str] = []  # where `break` goes
        self._arguments = dict(zip((a.arg for a in function.args.args), kinds, strict=True))

    def text(self) -> str:
        """Its definition."""
        given = ", ".join(f"{self._type(k)} %in.{n}" for n, k in self._arguments.items())
        for name, kind in self._arguments.items():
            self._set(name, Value(kind, f"%in.{name}"))
        self._block(self._function.body)
        if self._result == "void":
            self._lines.append("ret void")
        elif self._lines[-1].endswith(":"):
            self._lines.append("unreachable")
        name = f"{self._type(self._result)} @{self._function.name}({given})"
        body = "\n".join(("entry:", *self._allocated, *self._lines))
        return f"define {name} nounwind {{\n{body}\n}}"

    def _type(self, kind: str) -> str:
        return {"real": self._numbers.type, "ints": "ptr", "doubles": "ptr"}.get(kind, kind)

    # -- statements ------------------------------------------------------------------------------

    def _block(self, body: list[ast.stmt]) -> None:
        for statement in body:
            self._statement(statement)

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign(targets=[target], value=value):
                self._assign(target, self._value(value))
            case ast.AugAssign(target=target, op=op, value=value):
                left = ast.fix_missing_locations(_loaded(target))
                self._assign(target, self._value(ast.BinOp(left, op, value)))
            case ast.While(test=test, body=body):
                self._loop(lambda: self._value(test), body, lambda: None)
            case ast.For(target=ast.Name(id=name), iter=ast.Call(args=arguments), body=body):
                self._for(name, arguments, body)
            case ast.If(test=test, body=body, orelse=otherwise):
                self._if(self._value(test), body, otherwise)
            case ast.Return(value=value):
                found = None if value is None else self._value(value)
                returned = "void" if found is None else f"{self._type(found.kind)} {found.text}"
                self._lines.append(f"ret {returned}")
                self._begin(self._label())
            case ast.Break():
                self._jump(self._ends[-1])
                self._begin(self._label())
            case ast.Expr(value=ast.Call() as call):
                self._value(call)
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case _:
                raise TypeError(f"not of this language: {ast.dump(node)}")

    def _assign(self, target: ast.expr, value: Value) -> None:
        match target:
            case ast.Name(id=name):
                self._set(name, value)
            case ast.Subscript():
                place, kind = self._place(target)
                stored = self._as(value, "real" if kind == "double" else kind)
                if kind == "double":
                    stored = self._converted("fptrunc", self._numbers.type, stored, "double")
                self._lines.append(f"store {self._type(kind)} {stored}, ptr {place}")
            case _:
                raise TypeError("only names and places are assigned to")

    def _set(self, name: str, value: Value) -> None:
        if name not in self._locals:
            self._locals[name] = value.kind
            self._allocated.append(f"%{name} = alloca {self._type(value.kind)}")
        kind = self._locals[name]
        self._lines.append(f"store {self._type(kind)} {self._as(value, kind)}, ptr %{name}")

    def _for(self, name: str, arguments: list[ast.expr], body: list[ast.stmt]) -> None:
        """`range(end)`, `range(begin, end)`, and downwards with a third, -1."""
        begin = arguments[0] if len(arguments) > 1 else ast.Constant(0)
        end = arguments[min(1, len(arguments) - 1)]
        down = len(arguments) == 3
        self._set(name, self._value(begin))
        counter = ast.Name(name)
        compared = ast.Compare(counter, [ast.Gt() if down else ast.Lt()], [end])
        step = ast.BinOp(counter, ast.Sub() if down else ast.Add(), ast.Constant(1))
        self._loop(lambda: self._value(compared), body, lambda: self._set(name, self._value(step)))

    def _loop(
        self, test: Callable[[], Value], body: list[ast.stmt], after: Callable[[], None]
    ) -> None:
        head, inside, end = self._label(), self._label(), self._label()
        self._jump(head)
        self._begin(head)
        self._lines.append(f"br i1 {test().text}, label %{inside}, label %{end}")
        self._begin(inside)
        self._ends.append(end)
        self._block(body)
        self._ends.pop()
        after()
        self._jump(head)
        self._begin(end)

    def _if(self, test: Value, body: list[ast.stmt], otherwise: list[ast.stmt]) -> None:
        then, other, end = self._label(), self._label(), self._label()
        self._lines.append(f"br i1 {test.text}, label %{then}, label %{other}")
        for label, block in ((then, body), (other, otherwise)):
            self._begin(label)
            self._block(block)
            self._jump(end)
        self._begin(end)

    # -- expressions -----------------------------------------------------------------------------

    def _value(self, node: ast.expr) -> Value:
        match node:
            case ast.Constant(value=bool(value)):
                return Value("i1", str(value).lower())
            case ast.Constant(value=int(value)):
                return Value("i64", str(value))
            case ast.Constant(value=float(value)):
                return Value("real", self._numbers.literal(Fraction(value)))
            case ast.Name(id=name):
                return self._name(name)
            case ast.Subscript():
                place, kind = self._place(node)
                found = self._made(kind, f"load {self._type(kind)}, ptr {place}")
                return self._extended(found.text) if kind == "double" else found
            case ast.BinOp(left=left, op=op, right=right):
                return self._operation(op, self._value(left), self._value(right))
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=value)):
                return self._value(ast.Constant(-value))  # type: ignore[operator]
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return self._made("real", f"fneg {self._numbers.type} {self._real(operand)}")
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return self._made("i1", f"xor i1 {self._value(operand).text}, true")
            case ast.BoolOp(op=op, values=[first, *rest]):
                return self._both("and" if isinstance(op, ast.And) else "or", first, rest)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                return self._comparison(op, self._value(left), self._value(right))
            case ast.Call(func=ast.Name(id=name), args=arguments):
                return self._call(name, arguments)
        raise TypeError(f"not of this language: {ast.dump(node)}")

    def _name(self, name: str) -> Value:
        if name in self._constants:
            return self._value(ast.Constant(self._constants[name]))
        kind = self._locals[name]
        return self._made(kind, f"load {self._type(kind)}, ptr %{name}")

    def _both(self, word: str, first: ast.expr, rest: list[ast.expr]) -> Value:
        value = self._value(first)
        for other in rest:
            value = self._made("i1", f"{word} i1 {value.text}, {self._value(other).text}")
        return value

    def _operation(self, op: ast.operator, left: Value, right: Value) -> Value:
        kind = "real" if "real" in {left.kind, right.kind} or isinstance(op, ast.Div) else "i64"
        operands = f"{self._as(left, kind)}, {self._as(right, kind)}"
        return self._made(kind, f"{_OPERATIONS[type(op), kind]} {self._type(kind)} {operands}")

    def _comparison(self, op: ast.cmpop, left: Value, right: Value) -> Value:
        kind = "real" if "real" in {left.kind, right.kind} else "i64"
        real, whole = _COMPARISONS[type(op)]
        word = f"fcmp {real}" if kind == "real" else f"icmp {whole}"
        operands = f"{self._as(left, kind)}, {self._as(right, kind)}"
        return self._made("i1", f"{word} {self._type(kind)} {operands}")

    def _better(self, op: ast.cmpop, b: Value, best: Value) -> Value:
        kind = "real" if "real" in {b.kind, best.kind} else "i64"
        taken = self._comparison(op, b, best).text
        operands = (f"{self._type(kind)} {self._as(value, kind)}" for value in (b, best))
        return self._made(kind, f"select i1 {taken}, {', '.join(operands)}")

    def _call(self, name: str, arguments: list[ast.expr]) -> Value:
        values = [self._value(argument) for argument in arguments]
        real = self._numbers.type
        match name:
            case "float":
                return Value("real", self._as(values[0], "real"))
            case "int":
                return self._made("i64", f"fptosi {real} {values[0].text} to i64")
            case "at":
                return self._offset(values[0], _ENTRIES[values[0].kind], values[1])
            case "abs" | "sqrt":
                root, suffix = self._numbers.root, self._numbers.suffix
                function = root if name == "sqrt" else f"@llvm.fabs.{suffix}"
                return self._made("real", f"call {real} {function}({real} {values[0].text})")
            case "fma":
                given = ", ".join(f"{real} {self._as(value, 'real')}" for value in values)
                intrinsic = f"@llvm.fmuladd.{self._numbers.suffix}"
                return self._made("real", f"call {real} {intrinsic}({given})")
            case "max" | "min":  # max(a, b) is b where b > a, else a
                best, *others = values
                for b in others:
                    best = self._better(ast.Gt() if name == "max" else ast.Lt(), b, best)
                return best
            case "log" | "exp":  # of lengths of steps: doubles will do
                given = self._converted("fptrunc", real, values[0].text, "double")
                return self._extended(
                    self._made("double", f"call double @{name}(double {given})").text
                )
        result, kinds = self._signatures[name]
        operands = ", ".join(
            f"{self._type(kind)} {self._as(value, kind)}"
            for kind, value in zip(kinds, values, strict=True)
        )
        function = f"@{name}"
        if name in self._given:  # its address is put there before the first call
            function = self._made("ptr", f"load ptr, ptr @at.{name}").text
        call = f"call {self._type(result)} {function}({operands})"
        if result == "void":
            self._lines.append(call)
            return Value("void", "")
        return self._made(result, call)

    def _real(self, node: ast.expr) -> str:
        return self._as(self._value(node), "real")

    def _as(self, value: Value, kind: str) -> str:
        """A whole number where a real one is wanted."""
        if kind == "real" and value.kind == "i64":
            return self._made("real", f"sitofp i64 {value.text} to {self._numbers.type}").text
        assert kind == value.kind, (kind, value)
        return value.text

    def _extended(self, double: str) -> Value:
        return Value("real", self._converted("fpext", "double", double, self._numbers.type))

    def _converted(self, word: str, kind: str, text: str, other: str) -> str:
        """A number of one type as one of another."""
        if kind == other:
            return text
        return self._made(other, f"{word} {kind} {text} to {other}").text

    def _place(self, node: ast.Subscript) -> tuple[str, str]:
        base = self._value(node.value)
        kind = _ENTRIES[base.kind]
        return self._offset(base, kind, self._value(node.slice)).text, kind

    def _offset(self, base: Value, kind: str, index: Value) -> Value:
        operands = f"{self._type(kind)}, ptr {base.text}, i64 {index.text}"
        return self._made(base.kind, f"getelementptr {operands}")

    # -- text ------------------------------------------------------------------------------------

    def _made(self, kind: str, what: str) -> Value:
        self._count += 1
        self._lines.append(f"%.{self._count} = {what}")
        return Value(kind, f"%.{self._count}")

    def _label(self) -> str:
        self._count += 1
        return f"b{self._count}"

    def _begin(self, label: str) -> None:
        self._lines.append(f"{label}:")

    def _jump(self, label: str) -> None:
        self._lines.append(f"br label %{label}")


def _loaded(target: ast.expr) -> ast.expr:
    """A place that is written to, as one that is read."""
    match target:
        case ast.Subscript(value=value, slice=index):
            return ast.Subscript(value, index, ast.Load())
        case ast.Name(id=name):
            return ast.Name(name, ast.Load())
    raise TypeError("only names and places are assigned to")
