"""Modelica."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from lagcli.export.common import described
from lagcli.export.routines import Code, NoCode, Routine


class _Modelica(StrPrinter):  # type: ignore[misc]
    """Modelica's operators and functions."""

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:
        if expr.exp == sympy.Rational(1, 2):
            return f"sqrt({self._print(expr.base)})"
        return str(super()._print_Pow(expr, rational=rational)).replace("**", "^")

    def _print_Abs(self, expr: Any) -> str:
        return f"abs({self._print(expr.args[0])})"

    def _print_Pi(self, expr: Any) -> str:
        del expr
        return "Modelica.Constants.pi"


def write(code: Code) -> Iterator[str]:
    """The lines of a model."""
    if not code.routines or code.routines[0].name != "rhs":
        raise NoCode(code.missing or "the accelerations were not found")
    printer = _Modelica()
    half = len(code.state) // 2
    rhs = code.routines[0].formulas
    yield from described(code, "//")
    yield f"model {code.module.capitalize()}"
    for word in code.parameters:
        value = f" = {code.values[word]!r}" if word in code.values else ""
        yield f"  parameter Real {word}{value};"
    for word in code.state:
        yield f"  Real {word}(start = {code.values.get(word, 0.0)!r}, fixed = true);"
    for routine in code.routines:
        if routine.name in ("multipliers", "energy", "charges"):
            yield from (f"  Real {name};" for name in _outputs(routine))
    yield "equation"
    for k, word in enumerate(code.state):
        formula = code.state[half + k] if k < half else _timed(printer.doprint(rhs[k]))
        yield f"  der({word}) = {formula};"
    for routine in code.routines:
        if routine.name in ("multipliers", "energy", "charges"):
            for name, formula in zip(_outputs(routine), routine.formulas, strict=True):
                yield f"  {name} = {_timed(printer.doprint(formula))};"
    yield f"end {code.module.capitalize()};"


def _timed(text: str) -> str:
    """Modelica's name for t."""
    return re.sub(r"\bt\b", "time", text)


def _outputs(routine: Routine) -> list[str]:
    return [f"{routine.name}_{k + 1}" for k in range(routine.rows)]
