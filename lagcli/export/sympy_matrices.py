"""SymPy."""

from __future__ import annotations

from collections.abc import Iterator

from sympy.printing.pycode import SymPyPrinter

from lagcli.export.common import sentence
from lagcli.export.routines import Code


def write(code: Code) -> Iterator[str]:
    """The lines of a module of matrices."""
    printer = SymPyPrinter({"fully_qualified_modules": True})
    yield f'"""{code.title}: written by lagcli, as SymPy matrices of its symbols."""'
    yield ""
    yield "import sympy"
    yield ""
    for word in ("t", *code.state, *code.parameters):
        yield f'{word} = sympy.Symbol("{word}", real=True)'
    for routine in code.routines:
        shape = f"{routine.rows}, {routine.columns or 1}"
        yield ""
        yield f"#: {sentence(routine)}"
        yield f"{routine.name} = sympy.Matrix({shape}, ["
        yield from (f"    {printer.doprint(formula)}," for formula in routine.formulas)
        yield "])"
