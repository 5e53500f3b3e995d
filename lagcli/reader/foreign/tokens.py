"""A foreign formula cut into pieces."""

from __future__ import annotations

import re
from typing import NamedTuple

from lagcli.reader.foreign.words import Vocabulary

RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻½⅓⅔¼¾⅛"
_LETTER = rf"[^\W\d{RAISED}]"
_TOKEN = re.compile(
    r"(?P<skip>(?:\s|\$|\\[,;:! ]"
    r"|\\(?:left|right|[bB]igg?[lr]?|q?quad|displaystyle|limits)(?![A-Za-z]))+)"
    r"|(?P<number>(?:\d{1,3}(?:[' _]\d{3})+(?![\w.])|\d+(?:\.\d+)?|\.\d+|\d+\.)"
    r"(?:[eEdD][-+]?\d+)?(?:[fF](?!\w))?)"
    r"|(?P<macro>\\[A-Za-z]+)"
    rf"|(?P<name>(?:(?:np|numpy|math|Math|sp|sympy|cmath|std|jnp)(?:\.linalg)?(?:\.|::))?{_LETTER}"
    rf"(?:[\w\u0300-\u036f](?<![{RAISED}]))*(?:(?<=_)\{{\\?\w+\}})?)"
    rf"|(?P<raised>[⁻{RAISED}]+)"
    r"|(?P<primes>['’′″‴`´]+)"
    r"|(?P<sign>\*\*|\.\^|\.\*|\./|==|:=|>=|<=|\\[{}|]|\S)"
)  # fmt: skip
SIGNS = {
    **dict.fromkeys(["·", "×", "∙", "⋅", "∗", "•", ".*", "\\cdot", "\\times", "\\ast"], "*"),
    **dict.fromkeys(["÷", "∕", "⁄", "./", "\\div"], "/"),
    **dict.fromkeys(["−", "–", "—", "‐", "‑"], "-"),
    **dict.fromkeys(["**", ".^"], "^"),
    **dict.fromkeys(["==", ":="], "="),
    **dict.fromkeys(["≥", "\\ge", "\\geq", "\\geqslant"], ">="),
    **dict.fromkeys(["≤", "\\le", "\\leq", "\\leqslant"], "<="),
    "\\{": "(", "\\}": ")", "[": "(", "]": ")", "{": "(", "}": ")", "\\|": "|",
}  # fmt: skip
#: v², |v|^2, \\vec{v}^2, v.v and v·v.
_SPEED = re.compile(
    r"(?<!\w)(?P<v>\|?(?:\\(?:vec|mathbf)\s*\{?)?v\}?\|?)(?:\s*(?:\^|\*\*)\s*\{?2\}?|\s*²"
    r"|\s*(?:\.|·|\\cdot)\s*(?P=v))(?![\w.])"
)


class Token(NamedTuple):
    """A piece: a number, a name, a macro of LaTeX, raised digits, primes or a sign."""

    kind: str
    text: str
    apart: bool  # a blank stands before it


def prepared(text: str, names: Vocabulary) -> str:
    """With the marks of web pages, v² and Leibniz' derivatives in the notation of a file."""
    text = re.sub(r"<su(p|b)>(\w+)</su\1>", lambda m: ("_" if m[1] == "b" else "^") + m[2], text)
    text = re.sub(r"(?<=\w)//(?=\w)", "/", text.strip(" =").rstrip(";,"))
    return _leibniz(_square_of_speed(text, names), names)


def _square_of_speed(text: str, names: Vocabulary) -> str:
    """The sum of squares for v², in Cartesian coordinates."""
    if len(names.coordinates) < 2 or "v" in names.known or not {*names.coordinates} <= {*"xyz"}:
        return text
    squares = " + ".join(f"{x}'^2" for x in names.coordinates)
    return _SPEED.sub(lambda _: f" ({squares}) ", text)


def _leibniz(text: str, names: Vocabulary) -> str:
    r"""A prime for each dx/dt, d/dt x and \frac{dx}{dt}."""
    for x in sorted(names.coordinates, key=len, reverse=True):
        d, name = r"(?:d|\\mathrm\{?d\}?|∂|\\partial)\s*", rf"\\?{re.escape(x)}(?!\w)(?:\(t\))?"
        for order, above, below in ((1, "", ""), (2, r"(?:\^\{?2\}?|²)", r"(?:\^\{?2\}?|²)")):
            prime = x + "'" * order
            below_line = rf"(?:\({d}t{below}\)|{d}t{below})"
            forms = [
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*{name}\s*\}}\{{\s*{d}t{below}\s*\}}",
                rf"\\[dt]?frac\s*\{{\s*{d}{above}\s*\}}\{{\s*{d}t{below}\s*\}}\s*{name}",
                rf"(?<!\w){d}{above}\s*{name}\s*/\s*{below_line}(?!\w)",
                rf"(?<!\w){d}{above}\s*/\s*{below_line}\s*(?:\({name}\)|{name})",
            ]
            for form in forms:
                text = re.sub(form, f" {prime} ", text)
    return text


def tokens(text: str) -> list[Token]:
    """The pieces of a text."""
    found = []
    at, apart = 0, False
    while at < len(text):
        match = _TOKEN.match(text, at)
        assert match is not None
        at = match.end()
        kind = match.lastgroup or ""
        if kind != "skip":
            found.append(Token(kind, match[0], apart))
        apart = kind == "skip"
    return found
