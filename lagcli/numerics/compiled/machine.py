"""The equations of motion of one problem as machine code, beside the loop over the steps."""

from __future__ import annotations

import ctypes
from ctypes import c_int64, c_void_p
from functools import cache
from pathlib import Path
from typing import Any

from lagcli.graph.nodes import Node
from lagcli.numerics.arithmetic import UndefinedFunction
from lagcli.numerics.compiled.emission import Series, head
from lagcli.numerics.compiled.engine import Compiled, engine
from lagcli.numerics.compiled.numbers import Numbers
from lagcli.numerics.compiled.tape import NoSeries, Tape
from lagcli.numerics.compiled.text import values_function
from lagcli.numerics.motion import Motion

#: What the loop calls, made for each problem.
_GIVEN = ("series", "positions", "velocities", "sizes")
#: name -> the C types of the result and of the arguments
_KERNELS: dict[str, tuple[Any, ...]] = {
    "drive": (c_int64, *[c_void_p] * 13),
    "expand": (c_int64, *[c_void_p] * 7),
    "move": (c_int64, *[c_void_p] * 4, "real", *[c_void_p] * 2),
    "inside": (None, *[c_void_p] * 2, c_int64, c_int64, "real"),
    "slopes": (None, *[c_void_p] * 2, c_int64, c_int64, "real"),
}
#: Operations beyond which straight code takes too long to make.
LARGEST = 4000


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

    Attributes
    ----------
    rows : int
        How many rows of coefficients it works in.

    Raises
    ------
    NotCompiled
        Where the equations have no series, or are left to numbers.
    NoCompiler
        Where nothing can be compiled.
    """

    def __init__(self, motion: Motion, numbers: Numbers) -> None:
        self.motion, self.numbers = motion, numbers
        self.engine = engine()
        equations = motion.equations
        eliminated = equations.eliminated
        if eliminated is None:
            raise NotCompiled("the elimination is left to numbers")
        roots, _ = eliminated.motion(equations.forcing, equations.bias)
        inputs = (*equations.q, *equations.qdot, equations.t)
        try:
            tape = self._tape(inputs, roots, eliminated.guards, frozen=True)
            self.ops = len(tape.ops)
            if self.ops > LARGEST:
                raise NotCompiled("the equations are too long")
            if any(op.name.endswith("_of") for op in tape.ops):
                raise NotCompiled("the equations are not smooth")
            series = Series(numbers, tape, roots, eliminated.guards)
            parts = [head(numbers, self.ops), series.code()]
            if equations.rows:
                parts += self._constraints(inputs)
        except NoSeries as function:
            raise NotCompiled(f"{function} has no series") from None
        except (ArithmeticError, ValueError, UndefinedFunction, KeyError):
            raise NotCompiled("something is not defined") from None
        self.rows = series.rows
        text = "\n".join(parts)
        self._problem = self.engine.compiled(text.encode(), lambda: text)
        self._kernels = _kernels(numbers)
        self._made = {name: self._kernels.function(name, *self._kinds(name)) for name in _KERNELS}
        self._hooks = [
            (
                c_void_p.from_address(self._kernels.address(f"at.{name}")),
                self._problem.address(name),
            )
            for name in (_GIVEN if equations.rows else _GIVEN[:1])
        ]

    def _tape(self, inputs: Any, roots: Any, guards: Any, *, frozen: bool = False) -> Tape:
        nodes: list[Node] = [*roots, *(node for pair in guards for node in pair)]
        motion = self.motion
        signs = {node: k for k, node in enumerate(motion.kinks)} if frozen else None
        return Tape(inputs, nodes, motion.constants, motion.arithmetic, signs)

    def _constraints(self, inputs: Any) -> list[str]:
        e = self.motion.equations
        made: list[tuple[str, Any, Any, Any]] = []
        on_positions = e.eliminated_positions if e.holonomic else None
        if e.holonomic:
            if on_positions is None:
                raise NotCompiled("the elimination is left to numbers")
            made.append(("positions", on_positions, e.positions, on_positions.guards))
        made.append(("velocities", e.eliminated, e.rates, e.eliminated.guards))  # type: ignore[union-attr]
        texts = []
        for name, eliminated, residuals, guards in made:
            roots = [*eliminated.correction(residuals), *residuals]
            tape = self._tape(inputs, roots, guards)
            texts.append(values_function(name, self.numbers, tape, roots, guards))
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


@cache
def _kernels(numbers: Numbers) -> Compiled:
    """The loop, which is the same for all problems."""
    folder = Path(__file__).parent
    source = (folder / "kernels.py").read_text("utf-8")
    outside = (folder / "intrinsics.py").read_text("utf-8")

    def text() -> str:
        from lagcli.numerics.compiled.language import functions_of, translated

        known = {name: kind for name, kind in functions_of(outside) if name in _GIVEN}
        return translated(source, numbers, known)

    language = (folder / "language.py").read_bytes()
    whole = b"\0".join((numbers.type.encode(), source.encode(), outside.encode(), language))
    return engine().compiled(whole, text)


def pointer(array: Any) -> int:
    """Where an array is in memory."""
    return ctypes.addressof(array)
