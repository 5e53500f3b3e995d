"""SymPy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sympy.printing.pycode import SymPyPrinter

from lagcli.export.common import sentence
from lagcli.export.routines import Code


class _SymPy(SymPyPrinter):  # type: ignore[misc]
    """Exact numbers, which Python's own division would round."""

    def _print_Rational(self, expr: Any) -> str:
        return f"sympy.Rational({expr.p}, {expr.q})"

    def _print_NumberSymbol(self, expr: Any) -> str:
        return f"sympy.{expr}"

    def _module_format(self, fqn: str, register: bool = True) -> str:
        del register
        return f"sympy.{fqn.rpartition('.')[2]}"


def write(code: Code) -> Iterator[str]:
    """The lines of a module of matrices."""
    printer = _SymPy()
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
