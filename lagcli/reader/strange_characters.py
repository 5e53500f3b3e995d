"""What was meant by a character that begins no token of an expression."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from lagcli.reader.habits import COMMENT, RELATIONS, instead, unit_behind

if TYPE_CHECKING:
    from lagcli.reader.automaton import Token

END_VALUE = frozenset({"NUMBER", "NAME", "RPAR"})
_ONE_SIGN = "write one sign: each is a problem of its own"
#: What begins with the character, and what is written instead.
_MEANT = [
    (r"\{\s*\w+\s*[-+]\s*\w+\s*\}", "every name in full, such as x_1"),
    (
        r"[·⋅]\s*[rv](?!\w)",
        "a product of vectors is written by its components, as in E_x*x + E_y*y",
    ),
    (r"[±∓]\s*[^\d\s.]", _ONE_SIGN),
    (r"\u20d7", "a product of vectors is written by its components, as in E_x*x + E_y*y"),
    (r"!=|:=", "write an equation with '='"),
    (
        r"\[[^\]]*[,;\[]|\\(?:vec|mathbf|boldsymbol|begin|end)",
        "a vector is written by its components",
    ),
    (
        r"\[\s*\d\s*\]",
        "a component of a point is written by its formula, y for [x, y]; that of a vector A is A_y",
    ),
    (r"\\\s*\d", "division is written with '/'"),
    (r"\\(?:partial|nabla)", "write diff(expression, name); a force that V has is found from V"),
    (r"\\int\b", instead("int")),
    (r"\\(?:sum|prod)\b", instead("sum")),
    (r"\[\s*[\w'.]+(?:\s+[-\w'.]+)+\s*\]", "a vector is written by its components"),
    (r"(?:\.\.\.|…)\s*[-+*]", instead("sum")),
    (r"\.\.\.|…", "leave it out: a line that continues the one above begins with blanks"),
    (r"\.subs\b", "leave out what begins with '.subs': values stand under 'parameters'"),
    (r"\.(?:evalf|simplify|expand|n|doit|replace|rewrite)\b", "leave out what begins with '.'"),
    (r"\.(?i:and|x?or|not|n?eqv|ne|true|false)\.", "write one comparison, as in x >= 0"),
    *((form, f"a relation is written {sign}") for form, sign in RELATIONS.items()),
    (r"\.[^\W\d]", "a product of vectors is written by its components, as in x'^2 + y'^2"),
]


def character_meant(rest: str, tokens: list[Token]) -> str:
    """What is done instead, where no formula is meant that could be written here."""
    before = tokens[-1].type if tokens else ""
    if before in END_VALUE:
        if re.match(r"[%!]\s*[A-Za-z]", rest):
            return COMMENT
        unit = re.match(r"\[([^\[\]]+)\]\s*$", rest)
        if unit and unit_behind(f"1 {unit[1]}"):
            return f"leave out '{unit[0].strip()}': units stand where names are declared"
    elif rest[0] in "±∓":
        return _ONE_SIGN
    return next((hint for form, hint in _MEANT if re.match(form, rest)), "")
