"""What LaTeX in a formula means here."""

from __future__ import annotations

import re

from lagcli.expression import FUNCTIONS
from lagcli.reader.habits import IN_FULL, group, meanings

#: LaTeX with arguments: \frac{a}{b}, \dot{x}, \dot x, \dot\theta.
_MACRO = re.compile(r"\\([A-Za-z]+)")
_ARGUMENT = re.compile(r"\s*(?:\{([^{}]*)\}|(\\[A-Za-z]+|\w))")
#: What only sets the type.
_LAYOUT = frozenset(
    "left right quad qquad displaystyle limits label tag nonumber bigl bigr big Big hfill mathrm "
    "text".split()
)


def latex_meant(text: str) -> str:
    """What to write instead of the LaTeX with which a text begins."""
    if re.match(r"\\[,;:! ]", text):
        return f"leave out {text[:2]}"
    macro = _MACRO.match(text)
    if macro is None:
        return ""
    name, rest = macro[1], text[macro.end() :]
    arguments = _arguments(rest, 2 if name in {"frac", "dfrac", "tfrac"} else 1)
    first = arguments[0] if arguments else "x"
    if name in {"dot", "ddot"}:
        return f"write {first}" + ("'" if name == "dot" else "''")
    if name in {"frac", "dfrac", "tfrac"} and len(arguments) == 2:
        return f"write {group(first)}/{group(arguments[1])}"
    if name == "sqrt":
        return f"write sqrt({first})"
    if name in {"cdot", "times"}:
        return "write '*'"
    if name in {"partial", "nabla"}:
        return "write diff(expression, name); a force that V has is found from V"
    if name in {"sum", "int", "prod"}:
        return IN_FULL[name]
    if name in {"vec", "mathbf", "boldsymbol", "begin", "end", "pmatrix"}:
        return "a vector is written by its components"
    if name in {"mathrm", "operatorname", "text"} and first != "x":
        return f"write {first}"
    if name in _LAYOUT:
        return f"leave out \\{name}"
    usual = meanings("functions").get(name, name)
    if usual in FUNCTIONS and arguments and not re.match(r"\s*(\\left)?\(", rest):
        return f"write {usual}({first})"
    return f"write {usual}"


def _arguments(text: str, count: int) -> list[str]:
    found: list[str] = []
    while len(found) < count and (one := _ARGUMENT.match(text)):
        found.append((one[1] or one[2] or "").lstrip("\\").strip())
        text = text[one.end() :]
    return found
