"""Python with NumPy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sympy.printing.numpy import NumPyPrinter

from lagcli.export.common import described, sentence, shared, unpacked
from lagcli.export.routines import Code, Routine


def write(code: Code) -> Iterator[str]:
    """The lines of a module."""
    printer = NumPyPrinter({"fully_qualified_modules": False, "allow_unknown_functions": False})
    body: list[str] = []
    for routine in code.routines:
        body += ["", "", f"def {routine.name}(t, y, p):", f'    """{sentence(routine)}"""']
        body += [f"    {line}" for line in unpacked(code, routine, "{} = {}[{}]")]
        steps, formulas = shared(routine)
        body += [f"    {name} = {printer.doprint(value)}" for name, value in steps]
        body += ["    return array("]
        body += [f"        {line}" for line in _nested(routine, map(printer.doprint, formulas))]
        body += ["    )"]
    imported = (name for names in printer.module_imports.values() for name in names)
    functions = sorted({"array", *imported})
    yield f'"""{code.title}: written by lagcli.'
    yield ""
    yield from (line[2:] for line in list(described(code, "#"))[1:])
    yield '"""'
    yield ""
    yield f"from numpy import {', '.join(functions)}"
    yield ""
    yield f"STATE = {_pairs(code, code.state)}"
    yield f"PARAMETERS = {_pairs(code, code.parameters)}"
    yield from body


def _pairs(code: Code, names: tuple[str, ...]) -> str:
    entries = ", ".join(f"{name!r}: {code.values.get(name)!r}" for name in names)
    return f"{{{entries}}}"


def _nested(routine: Routine, formulas: Any) -> Iterator[str]:
    """A list, or a list of rows."""
    printed = list(formulas)
    if not routine.columns:
        yield "[" + ", ".join(printed) + "]"
        return
    rows = [printed[k * routine.columns : (k + 1) * routine.columns] for k in range(routine.rows)]
    yield "[" + ", ".join("[" + ", ".join(row) + "]" for row in rows) + "]"
