"""Names with their values in a text, `x = 1, y: 2`, in the notation of books and programs."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import accumulate

from lagcli.reader.regex import regex

_NAME = r"(?<![\w.'])[^\W\d]\w*'*"
#: Behind a name: what it depends on, and the sign before its value.
_IS = r"(?:\((?:[\w, ]|t\s*=)*\))?\s*(?:<-|←|[-=]>|→|:?=|[:：])(?![=<>])\s*"
_NEXT = r"(?:\s*[,;，]\s*|\s+)(?:(?:and|und|et|y)\s+)?"
_INNER = r"\((?:[^()]|\([^()]*\))*\)|\[[^\[\]]*\]|\{[^{}]*\}"
_ASSIGNED = regex(
    rf"({_NAME}){_IS}(?=\S)((?:{_INNER}|[^()\[\]{{}}])+?)(?={_NEXT}{_NAME}{_IS}|\s*[)\]}}]*\s*$)"
)
#: `x 1, x' 0`.
_BESIDE = regex(rf"({_NAME})\s+([-+]?[\d.][^\s,;，]*)[\s,;，]*")


def assigned(text: str) -> list[tuple[str, str]]:
    """`x` and 1, `x'` and 0 for `x = 1 and x'(0): 0`, also for `x 1, x' 0`; else nothing.

    A value ends at a comma or a semicolon that stands outside of brackets.
    """
    are_beside = not _BESIDE.sub("", text).strip()
    found = _ASSIGNED.findall(text) or (_BESIDE.findall(text) if are_beside else [])
    return [(name, pieces(value, ",;，")[0].strip()) for name, value in found]


def levels(text: Iterable[str]) -> list[int]:
    """How many brackets are open behind each character."""
    return [*accumulate((each in {*"([{"}) - (each in {*")]}"}) for each in text)]


def pieces(text: str, signs: str) -> list[str]:
    """What stands between signs that stand outside of brackets."""
    parts = [""]
    for each, level in zip(text, levels(text), strict=True):
        if level == 0 and each in signs and parts[-1].strip():
            parts.append("")
        else:
            parts[-1] += each
    return parts
