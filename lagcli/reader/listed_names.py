"""A text of names, or of names with their values, as the list or the map that it should be."""

from __future__ import annotations

import re

from lagcli.reader.assignments import assigned
from lagcli.reader.habits import names_among, number_and_unit
from lagcli.reader.headings import system_meant
from lagcli.reader.regex import regex

#: `Real x(start=1);`, `parameter Real m = 2 "mass";` of Modelica, `double m = 2;`.
_DECLARATION = regex(
    r"(?:\b(?:parameter|constant|const|final|var|let)\s+)*\b(?:Real|real|float|double|int|Integer)\s+"
    r"(\w+)(?:\([^()]*\))?\s*(?:=\s*([^;\"]+))?"
)
_WITH_ITS_UNIT = regex(r"\s*([^\W\d]\w*)(?:\s*[(\[](rad|deg|k?m|cm|mm|s|kg|g|N|J)[)\]])?\s*")
#: `m - mass of the cart = 1 kg`, `x is the height`, several of them.
_DESCRIBED = regex(
    r"(?:^|\s)([^\W\d]\w*)\s+(?:[-–—]|is|ist|est|es|è|means|=(?=\s+(?:the|an?|der|die|das|la)\s))\s+"
    r"((?=[^=]*[^\W\d]{3})[^\W\d][^=]*?)(?:\s*=\s*([-.\d][^=]*?))?"
    r"(?=[,;]?\s+[^\W\d]\w*\s+(?:[-–—]|is|ist)\s|\s*$)"
)
#: Between two names of a list, where nothing else stands.
_AND = frozenset("and und et en og och".split())


def _with_value(written: str) -> str:
    """`value: 1, unit: kg, ` for `1 kg`."""
    number, unit = number_and_unit(written)
    return (f"value: {number}, " if number else "") + (f"unit: {unit}, " if unit else "")


def as_names(text: str) -> str:
    """`[x, y]` for `x, y` and for `symbols("x y")`, and `m: 1` for `m = 1`."""
    if re.fullmatch(r"(?:\s*\d+[.)]\s*[^\W\d]\w*)+\s*", text):  # 1. x 2. y
        listed = ", ".join(re.findall(r"[^\W\d]\w*", text))
        return f"write [{listed}]"
    units = [_WITH_ITS_UNIT.fullmatch(each) for each in text.split(",")]
    if any(each and each[2] for each in units) and all(units):
        named = ", ".join(
            f"{x[1]}: {{unit: {x[2]}}}" if x[2] else f"{x[1]}: {{}}" for x in units if x
        )
        return f"write {{{named}}}"
    if declared := _DECLARATION.findall(text):
        pairs = [f"{name}: {value.strip()}" for name, value in declared if value.strip()]
        listed = ", ".join(pairs or [name for name, _ in declared])
        return f"write {{{listed}}}" if pairs else f"write [{listed}]"
    if described := _DESCRIBED.findall(text):
        named = ", ".join(
            f"{x}: {{{_with_value(value)}description: {said}}}" for x, said, value in described
        )
        return f"write {{{named}}}"
    if "struct" in text and (pairs_ := re.findall(r"'(\w+)'\s*,\s*([^,()']+)", text)):
        return f"write {{{', '.join(map(': '.join, pairs_))}}}"
    if re.search(r"\d,\d+\s*(?:;|$)", text) and (";" in text or text.count(",") == 1):
        text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    text = re.sub(r"^([\w\s,]*\w)\s+(?:y|e|i)\s+([^\W\d]\w*\s*)$", r"\1, \2", text)
    if vector := re.fullmatch(r"\s*\w+\s*=\s*[(\[<]([\w\s,']+)[)\]>](?:\^?T)?\s*", text):
        return f"write [{vector[1].strip()}]"
    text = re.sub(r"^(?:.*=)?\s*(?:\w+\.)?\w+\(\s*(['\"])(.*)\1.*\)\s*$", r"\2", text)
    if given := assigned(text):
        parts = ((name, *number_and_unit(value)) for name, value in given)
        listed = ", ".join(
            f"{x}: {{value: {value}, unit: {unit}}}" if unit else f"{x}: {value}"
            for x, value, unit in parts
        )
        return f"write {{{listed}}}" if given[1:] else f"write {listed}"
    if text.strip().casefold() in {"none", "null", "no", "~"}:
        return "leave out the key, or write such as [x, y]"
    if meant := system_meant(text):
        return f"write their names, as in {meant}"
    if counted := names_among(text):
        return f"write [{', '.join(counted)}]"
    words = re.findall(r"[^\W\d]\w*", re.sub(r"[(\[]t[)\]]", "", text))
    names = [name for name in words if name not in _AND]
    return f"write [{', '.join(names)}]" if names else "such as [x, y]"
