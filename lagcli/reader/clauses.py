"""Names with formulas: `m*g*h with h = l - l*cos(phi)`, and `f(s): k*s^2` with its calls."""

from __future__ import annotations

import re

from lagcli.diagnostics import Diagnostic
from lagcli.reader.assignments import assigned
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.habits import KEYS, is_constant
from lagcli.reader.nodes import Scalar
from lagcli.reader.regex import regex
from lagcli.reader.scope import Definition, Scope, name_mistake

_WORD = r"(?:with|where|mit|wobei|avec|où|con|donde)\s*:?\s+"
_CLAUSE = regex(
    rf"(?P<formula>[^=]*?[^=\s])(?:\s*[,;]\s*(?:{_WORD})?|\s+\(?{_WORD})"
    r"(?P<given>[^\W\d]\w*\s*=[^=<>].*?)\)?",
    re.DOTALL,
)


def of_clause(node: Scalar, scope: Scope) -> Diagnostic | None:
    """What is done with such a formula; None for one of which a part is not read."""
    found = _CLAUSE.fullmatch(node.value.strip())
    if found is None:
        return None
    named = dict(assigned(found["given"]))
    formulas = (found["formula"].rstrip("("), *named.values())
    if {*named} <= {"T", "V"} - scope.energies.keys():
        lines = ", ".join(f"{name}: {value}" for name, value in named.items())
        hint = f"write {formulas[0].strip()}, and on a line of its own {lines}"
        return Diagnostic("two keys on one line", node.span, hint)
    is_taken = any(
        name_mistake(x) or x in KEYS or scope.kinds.get(x) == "coordinate" for x in named
    )
    if is_taken or any(formula_or_none(each) is None for each in formulas):
        return None
    sections: dict[str, list[str]] = {}
    for name, value in named.items():
        if name not in scope.kinds:
            scope.kinds[name] = "definition"  # where other formulas use it
            scope.definitions[name] = Definition(place=-1, order=0)
            section = "parameters" if is_constant(name, value) else "definitions"
            sections.setdefault(section, []).append(f"{name}: {value}")
    if not sections:
        return None
    text = node.text.source.text
    hints = [
        f"put {', '.join(listed)} under {section}"
        if re.search(rf"^{section}:", text, re.MULTILINE)
        else f"begin a line with {section}: {{{', '.join(listed)}}}"
        for section, listed in sections.items()
    ]
    gone = node.value.strip()[found.end("formula") :].strip()
    hint = ", and ".join([*hints, f"leave out '{gone}'"])
    return Diagnostic("a formula does not explain its names", node.span, hint)


def written_out(text: str, name: str, arguments: str, formula: str) -> str:
    """`in line 4 write V: (k*(x - 1)^2)` for the `V: f(x - 1)` of a text; nothing without a call.

    The formula of `f(s)` has its arguments in other letters than the coordinates.
    """
    letters = re.split(r"\s*,\s*", arguments)

    def one(found: re.Match[str]) -> str:
        given = dict(zip(letters, (x.strip() for x in found[1].split(",")), strict=False))
        grouped = {x: y if re.fullmatch(r"\w+'*", y) else f"({y})" for x, y in given.items()}
        inner = re.sub(r"[^\W\d]\w*", lambda m: grouped.get(m[0], m[0]), formula)
        return f"({inner})"

    call = re.compile(rf"(?<!\w){re.escape(name)}\(([^()]*)\)(?!\s*:\s)")
    lines = ((number, line, call.sub(one, line))
             for number, line in enumerate(text.split("\n"), start=1))  # fmt: skip
    return "; ".join(f"in line {n} write {new.strip()}" for n, old, new in lines if new != old)
