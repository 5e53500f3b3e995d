"""Julia."""

from __future__ import annotations

from collections.abc import Iterator

from sympy.printing.julia import JuliaCodePrinter

from lagcli.export.common import described, rows, scalar, sentence, shared, unpacked
from lagcli.export.routines import Code


def write(code: Code) -> Iterator[str]:
    """The lines of a module."""
    printer = JuliaCodePrinter()
    yield from described(code, "#", first=1)
    yield f"module {code.module.capitalize()}"
    for routine in code.routines:
        yield ""
        yield f'"{sentence(routine)}"'
        yield f"function {routine.name}(t, y, p)"
        yield from (f"    {line}" for line in unpacked(code, routine, "{} = {}[{}]", first=1))
        steps, formulas = shared(routine)
        yield from (f"    {name} = {scalar(printer.doprint(value))}" for name, value in steps)
        yield f"    return [{rows(routine, [scalar(printer.doprint(f)) for f in formulas])}]"
        yield "end"
    yield "end"
