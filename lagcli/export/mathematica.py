"""Mathematica."""

from __future__ import annotations

from collections.abc import Iterator

import sympy
from sympy.printing.mathematica import MCodePrinter

from lagcli.export.common import described, sentence, shared, unpacked
from lagcli.export.routines import Code, Routine


def write(code: Code) -> Iterator[str]:
    """The lines of a package; identifiers lose their underscores, which stand for patterns."""
    words = (*code.state, *code.parameters)
    plain = {word: _camel(word) for word in words}
    if len(set(plain.values())) < len(words):
        plain = {word: f"{_camel(word)}x{k}" for k, word in enumerate(words)}
    symbols = {
        sympy.Symbol(word, real=True): sympy.Symbol(name, real=True) for word, name in plain.items()
    }
    printer = MCodePrinter({"user_functions": {"sign": [(lambda _: True, "Sign")]}})
    yield from ("(*", *(f"  {_plain_star(line)}" for line in described(code, "", first=1)), "*)")
    for routine in code.routines:
        steps, formulas = shared(routine)
        given = list(unpacked(code, routine, "{} {} {}", first=1))
        settings = [
            f"{plain[word]} = {letter}[[{place}]]" for word, letter, place in map(str.split, given)
        ]
        settings += [f"{name}" for name, _ in steps]
        lines = [f"{name} = {printer.doprint(value.xreplace(symbols))};" for name, value in steps]
        printed = [printer.doprint(formula.xreplace(symbols)) for formula in formulas]
        yield ""
        yield f"(* {sentence(routine)} *)"
        yield f"{_camel(code.module)}{_camel(routine.name, first=True)}[t_, y_, p_] := Module["
        yield f"  {{{', '.join(settings)}}},"
        yield from (f"  {line}" for line in lines)
        yield f"  {_braces(routine, printed)}"
        yield "]"


def _plain_star(line: str) -> str:
    return line.strip().replace("*)", "* )")


def _camel(word: str, *, first: bool = False) -> str:
    if word.endswith("_"):  # a letter that is taken, here as well
        return _camel(word.rstrip("_"), first=first) + "0"
    head, *rest = [part for part in word.split("_") if part] or ["x"]
    head = head.capitalize() if first else head
    return head + "".join(part[:1].upper() + part[1:] for part in rest)


def _braces(routine: Routine, printed: list[str]) -> str:
    if not routine.columns:
        return "{" + ", ".join(printed) + "}"
    width = routine.columns
    rows = (printed[k * width : (k + 1) * width] for k in range(routine.rows))
    return "{" + ", ".join("{" + ", ".join(row) + "}" for row in rows) + "}"
