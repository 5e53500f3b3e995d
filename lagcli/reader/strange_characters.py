"""What was meant by a character that begins no token of an expression."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from lagcli.reader.habits import COMMENT, called_meant, function_meant, meanings, unit_behind
from lagcli.reader.latex_habits import latex_meant

if TYPE_CHECKING:
    from lagcli.reader.automaton import Token

END_VALUE = frozenset({"NUMBER", "NAME", "RPAR"})
#: A derivative as a method: x.diff(t), x.diff(t, 2), V.diff(x).
_METHOD = re.compile(r"\.(?:diff|dt|ddt|dot)\b(?:\(\s*(\w*)\s*(?:,\s*(\w+)\s*)?\))?")


def character_meant(rest: str, tokens: list[Token]) -> str:
    """What was meant by LaTeX, by `math.pi`, by `10%`; nothing where that is unclear."""
    before = tokens[-1].type if tokens else ""
    if re.match(r"%\s*[A-Za-z]", rest) and before in END_VALUE:
        return COMMENT
    if rest.startswith(("!=", ":=")):
        return "write an equation with '='"
    if rest[0] == "[" and before != "NAME" and re.match(r"\[[^\]]*[,;\[]", rest):
        return "a vector is written by its components"
    index = re.match(r"\[(\d+)\]|\{(\w+)\}", rest)
    if index and before == "NAME" and (index[1] or tokens[-1].endswith("_")):
        return f"write {tokens[-1].rstrip('_')}_{index[1] or index[2]}"
    if re.match(r"\\\s*\d", rest):
        return "division is written with '/'"
    if by_element := re.match(r"\.([*/^'])", rest):
        return f"write {by_element[1]}"
    if rest[0] == "%" and before == "NUMBER":
        return f"write {tokens[-1]}/100"
    unit = re.match(r"\[([^\[\]]+)\]\s*$", rest)
    if unit and before in END_VALUE and unit_behind(f"1 {unit[1]}"):
        return f"leave out '{unit[0].strip()}': units stand where names are declared"
    name = next((str(each) for each in reversed(tokens) if each.type == "NAME" and each != "t"), "")
    if (derived := _METHOD.match(rest)) and before in {"NAME", "RPAR"}:
        variable, again = derived.groups("")
        if variable not in {"", "t"}:
            return f"write diff({name}, {variable})"
        return f"write {name}" + ("''" if again in {"2", "t"} else "'")
    if rest.startswith("[t]") and before == "NAME":
        return f"a coordinate is a function of t by itself: write {tokens[-1]}"
    called = re.match(r"\[((?:[^\[\]]|\[[^\[\]]*\])*)\]", rest)
    if called and before == "NAME" and (meant := called_meant(tokens[-1], called[1])):
        return meant
    if rest.startswith(("...", "…")):
        return "leave it out: a line that continues the one above begins with blanks"
    if re.match(r"\.\s", rest) and before in END_VALUE:
        return "write '*'"
    if method := re.match(r"\.(subs|evalf|simplify|expand|n|doit|replace|rewrite)\b", rest):
        values = ": values stand under 'parameters'" if method[1] == "subs" else ""
        return f"leave out what begins with '.{method[1]}'{values}"
    word = re.match(r"(?:\.|::)([A-Za-z]\w*)(?:\(([^()]*)\))?", rest)
    if word and before == "NAME":
        arguments = [each.strip() for each in (word[2] or "").split(",") if each.strip()]
        usual = meanings("functions").get(word[1], word[1])
        return function_meant(word[1], arguments) or f"write {usual}"
    return latex_meant(rest)


def prime_meant(tokens: list[Token]) -> str:
    """Where a prime stands instead of behind these tokens."""
    if [token.type for token in tokens[-4:]] == ["NAME", "LPAR", "NAME", "RPAR"] and (
        tokens[-2] == "t"
    ):
        return f"a coordinate is a function of t by itself: write {tokens[-4]}'"
    if [token.type for token in tokens[-3:]] == ["LPAR", "NAME", "RPAR"]:
        return f"write {tokens[-2]}'"
    if [token.type for token in tokens[-3:]] == ["NAME", "_POWER", "NUMBER"]:
        return f"write {tokens[-3]}'^{tokens[-1]}"
    if tokens and tokens[-1].type == "RPAR":
        return "a prime stands behind a name; give the expression a name under 'definitions'"
    return "a prime stands right behind a name, without a blank"
