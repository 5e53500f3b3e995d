"""What the languages share: common subexpressions, and the head of a file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy

from lagcli.export.routines import Code, Routine


def shared(routine: Routine) -> tuple[list[tuple[Any, Any]], list[Any]]:
    """Common subexpressions and the formulas that use them."""
    names = sympy.numbered_symbols("s", real=True)
    taken = {str(each) for formula in routine.formulas for each in formula.free_symbols}
    free = (name for name in names if str(name) not in taken)
    steps, formulas = sympy.cse(list(routine.formulas), symbols=free)
    return steps, formulas


def used(routine: Routine) -> set[str]:
    """The identifiers in its formulas."""
    return {str(each) for formula in routine.formulas for each in formula.free_symbols}


def described(code: Code, mark: str, first: int = 0) -> Iterator[str]:
    """The head of a file: what is in y and p, whose first entry has the index `first`."""
    yield f"{mark} {code.title}"
    yield f"{mark} Written by lagcli: the functions of time t, state y and parameters p."
    for letter, names in (("y", code.state), ("p", code.parameters)):
        for place, word in enumerate(names):
            value = f" = {code.values[word]!r}" if word in code.values else ""
            yield f"{mark}   {letter}[{place + first}]: {code.names[word]}{value}"
    if code.left_out:
        yield f"{mark} {code.left_out}"


def sentence(routine: Routine) -> str:
    """What it gives, as a sentence."""
    return routine.meaning[0].upper() + routine.meaning[1:] + "."


def unpacked(code: Code, routine: Routine, form: str, first: int = 0) -> Iterator[str]:
    """The state and the parameters that a function uses, under their names."""
    needed = used(routine)
    for letter, names in (("y", code.state), ("p", code.parameters)):
        for place, word in enumerate(names):
            if word in needed:
                yield form.format(word, letter, place + first)


def scalar(text: str) -> str:
    """Products and powers of numbers, not of arrays."""
    return text.replace(".*", "*").replace("./", "/").replace(".^", "^")


def rows(routine: Routine, printed: list[str]) -> str:
    """The entries of an array: rows apart by `;`, columns by blanks."""
    if not routine.columns:
        return "; ".join(printed)
    width = routine.columns
    return "; ".join(" ".join(f"({x})" for x in printed[k * width : (k + 1) * width])
                     for k in range(routine.rows))  # fmt: skip
