"""The equations of motion of one problem as machine code, beside the loop over the steps.

Code is made quickly at first: in a fifth of the time, and it takes four times as long to run.
A run that turns out to be long goes on in better code, which gives the same numbers.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import c_int64, c_void_p
from functools import cache
from pathlib import Path
from typing import Any

from lagcli.graph.nodes import Node, Symbol, mask_of
from lagcli.numerics.compiled.coupled import (
    FEWEST,
    CoupledSeries,
    Matrix,
    correction_function,
    is_coupled,
)
from lagcli.numerics.compiled.emission import (
    LONG,
    Series,
    convolution,
    convolution_for,
    declarations,
)
from lagcli.numerics.compiled.engine import Compiled, engine
from lagcli.numerics.compiled.narrow import narrow_parts
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import NoSeries, Tape
from lagcli.numerics.compiled.text import values_function
from lagcli.numerics.equations.arithmetic import UndefinedFunction
from lagcli.numerics.equations.motion import Motion

#: What the loop calls, made for each problem.
_OWN = ("series", "positions", "velocities", "sizes")
_GIVEN = (*_OWN, "in_doubles")
#: name -> the C types of the result and of the arguments
_KERNELS: dict[str, tuple[Any, ...]] = {
    "drive": (c_int64, *[c_void_p] * 15),
    "expand": (c_int64, *[c_void_p] * 9),
    "move": (c_int64, *[c_void_p] * 4, "real", *[c_void_p] * 3),
    "inside": (None, *[c_void_p] * 2, c_int64, c_int64, "real"),
    "slopes": (None, *[c_void_p] * 2, c_int64, c_int64, "real"),
}
#: name -> the types of the result and of the arguments, in LLVM's language
_SUMS = {
    "inner": ("real", ("ptr", "ptr", "i64")),
    "factor": ("i64", ("ptr", "ptr", "i64")),
    "solve": ("void", ("ptr", "ptr", "ptr", "i64")),
    "couple": ("void", ("ptr", "ptr", "ptr", "ptr", "i64", "i64", "i64")),
}
#: Operations beyond which straight code takes too long to make.
LARGEST = 20_000
#: Work of all runs, operations times the square of the order, from which on better code pays: a
#: unit takes 1.2 ns in quick code and 0.3 ns in the better one, whose making takes 40 to 120 ms
#: more; a run of more work follows, with the finer tolerance.
LONG_RUN = 1e8
#: The problems for which better code has been made in this process.
_IMPROVED: set[str] = set()


class NotCompiled(Exception):
    """There is no machine code for these equations; why, in words."""


class Machine:
    """Machine code for a motion.

    Parameters
    ----------
    motion
        In numbers that are at least as good as `numbers`.
    numbers
        Of the machine code.
    beside
        The same equations in doubles, for the small terms of numbers of 80 bits.

    Attributes
    ----------
    rows : int
        How many rows of coefficients it works in.
    is_quick : bool
        Whether the code was made quickly.

    Raises
    ------
    NotCompiled
        Where the equations have no series, or are left to numbers.
    NoCompiler
        Where nothing can be compiled.
    """

    def __init__(self, motion: Motion, numbers: Numbers, beside: Machine | None = None) -> None:
        self.motion, self.numbers, self.beside = motion, numbers, beside
        self.engine = engine()
        equations = motion.equations
        inputs = (*equations.q, *equations.qdot, equations.t)
        try:
            series = self._series(inputs)
            large = self.ops > LONG or isinstance(series, CoupledSeries)
            sums = _calls(numbers) if large else convolution_for(numbers, self.ops)
            parts = [declarations(numbers), sums, series.code()]
            if equations.rows:
                parts += self._constraints(inputs)
        except NoSeries as function:
            raise NotCompiled(f"{function} has no series") from None
        except (ArithmeticError, ValueError, UndefinedFunction, KeyError):
            raise NotCompiled("something is not defined") from None
        self.rows = series.rows
        self._text, self._calls_sums = "\n".join(parts), large
        self.is_quick = self._text not in _IMPROVED
        #: work of the runs that are done
        self.spent = 0.0
        self._make()

    def _make(self) -> None:
        """The code of the problem and of the loop, quick or better, each calling the other."""
        beside = self.beside
        if beside is not None and beside.is_quick and not self.is_quick:
            beside.is_quick = False
            beside._make()
        text, numbers, quickly = self._text, self.numbers, self.is_quick
        self._problem = self.engine.compiled(
            text.encode(), lambda: text, quickly=quickly or self.ops > LONG
        )
        if self._calls_sums:
            sums = _sums(numbers)
            for name in _SUMS:
                self._hook(self._problem, name).value = sums.address(name)
        self._kernels = _kernels(numbers, quickly=quickly)
        self._made = {name: self._kernels.function(name, *self._kinds(name)) for name in _KERNELS}
        self._hooks = [
            (self._hook(self._kernels, name), self._problem.address(name))
            for name in (_OWN if self.motion.equations.rows else _OWN[:1])
        ]
        if beside is not None:
            self._hooks.append((self._hook(self._kernels, "in_doubles"), beside.address))

    @property
    def address(self) -> int:
        """Where its function `series` is."""
        return self._problem.address("series")

    def improve(self, steps: float, order: int) -> None:
        """Go over to better code where the run, with those before it, is long."""
        if self.is_quick and self.spent + self.work(steps, order) >= LONG_RUN:
            self.is_quick = False
            _IMPROVED.add(self._text)
            self._make()
            self.take()

    def work(self, steps: float, order: int) -> float:
        """What a run of these steps takes."""
        return steps * order**2 * (self.ops + 4 * self.motion.n)

    @staticmethod
    def _hook(code: Compiled, name: str) -> c_void_p:
        """Where code has the address of a function that it is given."""
        return c_void_p.from_address(code.address(f"at.{name}"))

    def _series(self, inputs: Sequence[Symbol]) -> Series:
        """`series` of what is eliminated, or of M and F."""
        equations = self.motion.equations
        mask = mask_of(inputs)
        self._coupled = self.motion.n >= FEWEST and is_coupled(equations.mass, mask)
        eliminated = None if self._coupled else equations.eliminated
        roots: Sequence[Node]
        minus_bias: Sequence[Node] = ()
        if eliminated is None:
            guards: Sequence[Any] = ()
            minus_bias = [equations.graph.scaled(node, -1) for node in equations.bias]
            roots = [*_entries(equations.mass, equations.rows), *equations.forcing, *minus_bias]
        else:
            guards = eliminated.guards
            roots, _ = eliminated.motion(equations.forcing, equations.bias)
        known = mask | mask_of(self.motion.constants)
        narrow = narrow_parts(equations.graph, self._given(roots), mask)
        narrow += [
            each
            for each in narrow_parts(equations.graph, self.motion.looked_at, mask, turning=True)
            if each not in narrow and not any(node.mask & ~known for node in each.nodes)
        ]
        watched = [node for each in narrow for node in each.nodes]
        tape = self._tape(inputs, [*roots, *watched], guards, frozen=True)
        if len(tape.ops) > LARGEST:
            raise NotCompiled("the equations are too long")
        if any(op.name.endswith("_of") for op in tape.ops):
            raise NotCompiled("the equations are not smooth")
        if eliminated is None:
            made: Series = CoupledSeries(
                self.numbers, tape, equations.mass, equations.forcing, equations.rows, minus_bias
            )
        else:
            made = Series(self.numbers, tape, roots, guards)
        self.narrow = [each for each in narrow if tape.values[each.argument].place is not None]
        self.watched = [each.entry(made.kept) for each in self.narrow]
        self.ops = len(tape.ops)
        return made

    def _given(self, roots: Sequence[Node]) -> Sequence[Node]:
        """What is looked at for what is narrow.

        Under constraints the elimination divides by its pivots, which vanish where a mechanism
        is flat: the motion goes on there, and only a step over the place stays on its branch.
        """
        e = self.motion.equations
        return [*_entries(e.mass, e.rows), *e.forcing, *e.bias] if e.rows else roots

    @property
    def watch(self) -> list[int]:
        """What may be passed over, as the loop reads it."""
        other = self if self.beside is None else self.beside
        pairs = zip(self.watched, other.watched, strict=True)
        return [x for own, beside in pairs for x in (*own, *beside[1:3])]

    def _tape(self, inputs: Any, roots: Any, guards: Any, *, frozen: bool = False) -> Tape:
        nodes: list[Node] = [*roots, *(node for pair in guards for node in pair)]
        motion = self.motion
        signs = {node: k for k, node in enumerate(motion.kinks)} if frozen else None
        return Tape(inputs, nodes, motion.constants, motion.arithmetic, signs)

    def _constraints(self, inputs: Any) -> list[str]:
        e = self.motion.equations
        made: list[tuple[str, Any, Any]] = []
        if e.holonomic:
            made.append(("positions", [e.rows[k] for k in e.holonomic], e.positions))
        made.append(("velocities", e.rows, e.rates))
        texts = []
        for name, rows, residuals in made:
            eliminated = e.eliminated if name == "velocities" else e.eliminated_positions
            if self._coupled or eliminated is None:
                tape = self._tape(inputs, [*_entries(e.mass, rows), *residuals], ())
                text = correction_function(name, self.numbers, tape, e.mass, rows, residuals)
            else:
                roots = [*eliminated.correction(residuals), *residuals]
                tape = self._tape(inputs, roots, eliminated.guards)
                text = values_function(name, self.numbers, tape, roots, eliminated.guards)
            texts.append(text)
        if not e.holonomic:
            empty = "define i64 @positions(ptr %state, ptr %out) nounwind {\nret i64 1\n}"
            texts.append(empty)
        tape = self._tape(inputs, e.sizes, ())
        return [*texts, values_function("sizes", self.numbers, tape, e.sizes, ())]

    def take(self) -> None:
        """Let the loop call this problem's functions."""
        for place, address in self._hooks:
            place.value = address

    def kernel(self, name: str) -> Any:
        """A function of the loop."""
        return self._made[name]

    def _kinds(self, name: str) -> list[Any]:
        real = self.numbers.c_type
        return [real if kind == "real" else kind for kind in _KERNELS[name]]


def _entries(mass: Matrix, rows: Matrix) -> list[Node]:
    return [node for row in (*mass, *rows) for node in row]


@cache
def _kernels(numbers: Numbers, *, quickly: bool = False) -> Compiled:
    """The loop, which is the same for all problems."""
    outside, language = map(_source, ("intrinsics", "language"))
    source = "\n".join(map(_source, ("layout", "unseen", "expansion", "kernels")))

    def text() -> str:
        from lagcli.numerics.compiled.language import translated
        from lagcli.numerics.compiled.signatures import functions_of

        known = {name: kind for name, kind in functions_of(outside) if name in _GIVEN}
        return translated(source, numbers, known)

    whole = f"{numbers.type}\n{source}\n{outside}\n{language}"
    return engine().compiled(whole.encode(), text, quickly=quickly)


@cache
def _sums(numbers: Numbers) -> Compiled:
    """The sums of many terms, which long equations call: the same for all problems."""
    source, outside, language = map(_source, ("matrices", "intrinsics", "language"))
    inner = convolution(numbers, "noinline")

    def text() -> str:
        from lagcli.numerics.compiled.language import translated
        from lagcli.numerics.compiled.signatures import functions_of

        beside = {name: kind for name, kind in functions_of(outside) if name == "inner"}
        return "\n".join((declarations(numbers), inner, translated(source, numbers, {}, beside)))

    whole = f"{numbers.type}\n{inner}\n{source}\n{outside}\n{language}"
    return engine().compiled(whole.encode(), text)


def _calls(numbers: Numbers) -> str:
    """Functions that call those of `_sums`."""
    lines = []
    for name, (result, kinds) in _SUMS.items():
        result = result.replace("real", numbers.type)
        given = ", ".join(f"{kind} %a{i}" for i, kind in enumerate(kinds))
        call = f"call {result} %f({given})"
        body = f"{call}\nret void" if result == "void" else f"%r = {call}\nret {result} %r"
        lines += [
            f"@at.{name} = global ptr null",
            f"define internal {result} @{name}({given}) noinline nounwind {{",
            f"%f = load ptr, ptr @at.{name}",
            f"{body}\n}}",
        ]
    return "\n".join(lines)


def _source(module: str) -> str:
    return (Path(__file__).parent / f"{module}.py").read_text("utf-8")


def pointer(array: Any) -> int:
    """Where an array is in memory."""
    return ctypes.addressof(array)
