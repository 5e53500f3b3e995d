"""Fortran (2008, free form)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy
from sympy.printing.fortran import FCodePrinter

from lagcli.export.common import described, sentence, shared, unpacked
from lagcli.export.routines import Code

#: The printer would declare its own constant in the middle of a subroutine.
_PI = {sympy.pi: sympy.Symbol("pi")}


class _Fortran(FCodePrinter):  # type: ignore[misc]
    def _print_sign(self, expr: Any) -> str:
        shown = self._print(expr.args[0])
        return f"merge(0d0, sign(1d0, {shown}), {shown} == 0d0)"


def write(code: Code) -> Iterator[str]:
    """The lines of a module of subroutines."""
    printer = _Fortran(
        {"source_format": "free", "standard": 2008, "precision": 17, "name_mangling": False}
    )
    yield from described(code, "!", first=1)
    yield f"module {code.module}"
    yield from ("  implicit none", "  integer, parameter :: dp = kind(1d0)")
    yield from ("  real(dp), parameter :: pi = acos(-1.0_dp)", "contains")
    for routine in code.routines:
        steps, formulas = shared(routine)
        steps = [(name, value.xreplace(_PI)) for name, value in steps]
        formulas = [formula.xreplace(_PI) for formula in formulas]
        names = [line.split(" ")[0] for line in unpacked(code, routine, "{} {} {}")]
        names += [str(name) for name, _ in steps]
        shape = f"{routine.rows}, {routine.columns}" if routine.columns else f"{routine.rows}"
        yield f"  ! {sentence(routine)}"
        yield f"  subroutine {routine.name}(t, y, p, out)"
        given = max(1, len(code.parameters))
        yield f"    real(dp), intent(in) :: t, y({len(code.state)}), p({given})"
        yield f"    real(dp), intent(out) :: out({shape})"
        yield from (f"    real(dp) :: {name}" for name in names)
        yield from (f"    {line}" for line in unpacked(code, routine, "{} = {}({})", first=1))
        for name, value in steps:
            yield from _indented(printer.doprint(value, assign_to=str(name)))
        for k, formula in enumerate(formulas):
            row, column = divmod(k, routine.columns or 1)
            place = f"out({row + 1}, {column + 1})" if routine.columns else f"out({k + 1})"
            yield from _indented(printer.doprint(formula, assign_to=place))
        yield f"  end subroutine {routine.name}"
    yield f"end module {code.module}"


def _indented(text: str) -> Iterator[str]:
    return (f"    {line}" for line in text.splitlines())
