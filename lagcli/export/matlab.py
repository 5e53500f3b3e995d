"""Matlab and Octave."""

from __future__ import annotations

from collections.abc import Iterator

from sympy.printing.octave import OctaveCodePrinter

from lagcli.export.common import described, rows, scalar, sentence, shared, unpacked
from lagcli.export.routines import Code


def write(code: Code) -> Iterator[str]:
    """The lines of a function that gives the handles of the others."""
    printer = OctaveCodePrinter()
    yield f"function functions = {code.module}()"
    yield from described(code, "%", first=1)
    for routine in code.routines:
        yield f"  functions.{routine.name} = @{routine.name};"
    yield "end"
    for routine in code.routines:
        yield ""
        yield f"function out = {routine.name}(t, y, p)"
        yield f"  % {sentence(routine)}"
        yield from (f"  {line}" for line in unpacked(code, routine, "{} = {}({});", first=1))
        steps, formulas = shared(routine)
        yield from (f"  {name} = {scalar(printer.doprint(value))};" for name, value in steps)
        yield f"  out = [{rows(routine, [scalar(printer.doprint(f)) for f in formulas])}];"
        yield "end"
