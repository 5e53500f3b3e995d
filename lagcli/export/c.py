"""C (C99)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sympy.printing.c import C99CodePrinter

from lagcli.export.common import described, sentence, shared, unpacked
from lagcli.export.routines import Code


class _C(C99CodePrinter):  # type: ignore[misc]
    def _print_sign(self, expr: Any) -> str:
        shown = self._print(expr.args[0])
        return f"(({shown} > 0) - ({shown} < 0))"


def write(code: Code) -> Iterator[str]:
    """The lines of a file with one function a quantity, the result in `out`, row by row."""
    printer = _C()
    yield from ("/*", *(f" * {line}" for line in map(_plain_comment, described(code, ""))), " */")
    yield from ("#include <math.h>", "")
    yield from ("#ifndef M_PI", "#define M_PI 3.14159265358979323846", "#endif", "")
    for routine in code.routines:
        size = max(1, routine.rows * max(1, routine.columns))
        yield f"/* {sentence(routine)} */"
        arguments = f"double t, const double *y, const double *p, double out[{size}]"
        yield f"void {code.module}_{routine.name}({arguments})"
        yield "{"
        yield "    (void)t; (void)y; (void)p;"
        yield from (f"    {line}" for line in unpacked(code, routine, "const double {} = {}[{}];"))
        steps, formulas = shared(routine)
        yield from (f"    const double {name} = {printer.doprint(value)};" for name, value in steps)
        yield from (f"    out[{k}] = {printer.doprint(f)};" for k, f in enumerate(formulas))
        yield from ("}", "")


def _plain_comment(line: str) -> str:
    return line.strip().replace("*/", "* /")
