r"""Which LaTeX a `symbol` may contain.

A symbol goes into documents as it is, so it must be unable to do anything but print:
letters, digits, known macros such as `\theta` and `\dot`, indices, balanced braces.
"""

from __future__ import annotations

import re

from lagcli.reader.file_reader import FileReader
from lagcli.reader.nodes import Scalar
from lagcli.reader.regex import regex

_LETTERS = """alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa
lambda mu nu xi pi varpi rho varrho sigma varsigma tau upsilon phi varphi chi psi omega
Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega
ell hbar imath jmath partial nabla infty prime ast star circ bullet dagger
perp parallel odot oplus ominus pm mp cdot"""

_ACCENTS = """dot ddot dddot vec hat bar tilde check breve acute grave mathring
overline underline widehat widetilde overrightarrow
mathrm mathcal mathbf mathit mathsf mathtt mathbb mathfrak boldsymbol text textrm operatorname
left right quad"""

_MACROS = frozenset((_LETTERS + " " + _ACCENTS).split()) - {"left", "right", "quad"}

#: A macro, a space macro, or one harmless character.
_TOKEN = regex(r"\\([A-Za-z]+)|\\[,;: ]|[A-Za-z0-9_^{}' ,.+\-*/()=]|[^\W\d_]")


def symbol_mistake(symbol: str) -> str:
    """Why a symbol is refused; empty when it is harmless."""
    if len(symbol) > 100:
        return "it is longer than 100 characters"
    depth = at = 0
    while at < len(symbol):
        token = _TOKEN.match(symbol, at)
        if token is None:
            return f"'{symbol[at]}' cannot stand in it"
        if token[1] is not None and token[1] not in _MACROS:
            return f"the macro \\{token[1]} is not known to be harmless"
        depth += {"{": 1, "}": -1}.get(token[0], 0)
        if depth < 0:
            return "a brace } was never opened"
        at = token.end()
    if depth:
        return "a brace { is never closed"
    if re.search(r"[_^]\s*(?:[_^}]|$)", symbol):
        return "nothing stands behind _ or ^"
    if re.search(r"_[^_^{}]_|\^[^_^{}]\^|''*\^", symbol):
        return "an index stands twice"
    return ""


def check_symbol(file: FileReader, text: Scalar) -> None:
    """Note what is wrong with a symbol."""
    wrong = symbol_mistake(text.value)
    if wrong:
        escaped = text.style == '"' and not text.value.isprintable()
        hint = "in double quotes a backslash is an escape: use single quotes" if escaped else ""
        bare = re.sub(r"^\$+(.*?)\$+$|^\\\((.*)\\\)$", r"\1\2", text.value)
        hint = f"write {bare}" if bare != text.value and not symbol_mistake(bare) else hint
        file.error(f"a symbol must be simple LaTeX: {wrong}", text.span, hint)
