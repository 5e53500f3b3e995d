"""The assumption that a text, a bound or a range says in other words: positive for `> 0`."""

from __future__ import annotations

import re
from collections.abc import Collection
from fractions import Fraction
from typing import get_args

from lagcli.problem_data import Assumption
from lagcli.reader.habits import SIGNS, TURNED, habits, letters, number_and_unit, spellings
from lagcli.reader.misshapen import RANGE, by_key, source_of, texts_of, values_in
from lagcli.reader.nodes import DocumentNode
from lagcli.reader.regex import regex

ASSUMPTIONS: tuple[str, ...] = get_args(Assumption)
#: The strongest first.
_ORDER = ("positive", "negative", "nonnegative", "nonzero", "real")
#: Words that every quantity of a file deserves.
NEUTRAL = frozenset("a always const constant finite fixed is known number numbers real reals "
                    "scalar strictly variable".split())  # fmt: skip
#: What tells that a text may be an assumption in words or in set theory.
_SPOKEN = regex(r"\b(?:than|least|not|zero|in|non|or)\b|Reals|Positive|\bR_?\+|[∈ℝ]|[<≤].*[<≤]")
_RELATION = regex(r"(?:[^\W\d]\w*\s*)?([<>]=?|[≥≤≠]|!=)\s*(-?\d*\.?\d*(?:[eE]-?\d+)?)")
#: A range in brackets: `[0, 3]`, `]0, inf[`.
_ENDS = regex(r"([\[(\]])\s*([^,;]*?)\s*[,;]\s*([^,;]*?)\s*([\])\[])")

_OF_PARAMETER = (
    "leave it out: a sign is written assume: positive; "
    "several values are run by lagcli sweep FILE --vary"
)


def sign_meant(text: str, relation: str = "") -> str:
    """`positive` for `real, positive`, `> 0`, `m > 1` and `[1, 3]`; nothing for other texts.

    A number that is a bound has a relation to the quantity.
    """
    parts = re.split(r"\s*(?:&&|∧|\band\b|,(?!.*[\])}]))\s*", text)
    if parts[1:]:
        return sign_meant(" ".join(map(sign_meant, parts)))
    words = {*re.findall(r"\w+", text.casefold())}
    if words <= {*ASSUMPTIONS, *NEUTRAL, "true"}:
        if {"positive", "negative"} <= words:
            return ""
        if {"nonnegative", "nonzero"} <= words:
            return "positive"
        return next((each for each in _ORDER if each in words), "")
    if assumed := re.search(r"\(.*\b(positive|negative|nonnegative|real)\s*=\s*True", text):
        return assumed[1]
    for form, sign in habits()["signs"] if _SPOKEN.search(text) else ():
        text = re.sub(form, f" {sign} ", text).strip()
    if text in ASSUMPTIONS:
        return text
    if ends := _ENDS.fullmatch(text):
        lower = sign_meant(f">{'=' * (ends[1] == '[')}{ends[2]}")
        return lower or sign_meant(f"<{'=' * (ends[4] == ']')}{ends[3]}")
    found = _RELATION.fullmatch(" ".join(f"{relation} {_turned(text)}".split()))
    if found is None or found[2] in {"-", "."}:
        return ""
    number = Fraction(found[2] or 0)
    if number and found[1][0] in "<≤":
        return "negative" if number < 0 else ""
    if number:
        return "positive" if number > 0 and found[1][0] in ">≥" else ""
    return SIGNS.get(found[1], "")


def integer_meant(text: str) -> str:
    """`integer: yes, assume: positive` for `positive integer` and `natural`; nothing for others."""
    words = re.findall(r"\w+", text.casefold())
    sign = next((each for each in ASSUMPTIONS if each in words), "")
    sign = sign or "positive" * ("natural" in words)
    is_integer = not {"integer", "int", "natural"}.isdisjoint(words)
    return f"integer: yes{f', assume: {sign}' * bool(sign)}" * is_integer


def _turned(text: str) -> str:
    """`> 0` for `0 < m`; other texts as they are."""
    found = re.fullmatch(r"\s*(-?[\d.]+)\s*([<>≤≥]=?)\s*[^\W\d]\w*\s*", text)
    return f"{found[2].translate(TURNED)}{found[1]}" if found else text


def range_meant(relation: str, value: DocumentNode, what: str, given: Collection[str]) -> str:
    """`write assume: positive` for `r > 0`, `(0, inf]`, `[1, 3]` and the bound `gt: 0`.

    Nothing is the relation of a value that has it; `given` are the keys of the entry.
    """
    written, is_parameter = source_of(value).strip("'\" "), what.startswith("the parameter")
    written = number_and_unit(written)[0]
    if among := RANGE.fullmatch(written):  # 0..5
        written = f"[{among[1]}, {among[3]}]"
    bounds = [each for each in given if letters(each) in spellings("bounds")]
    is_range = bounds[1:] or re.match(r"[\[(\]](?!.*(?:inf|oo|∞))", written)
    is_open = is_parameter or not is_range
    sign = sign_meant(written, relation) if is_open and "assume" not in given else ""
    hint = f"write assume: {sign}" if sign else "leave it out"
    if is_parameter and (values := values_in(written.strip("[]()"))):
        varied = f"{what.split(chr(39))[1]}={values}"
        return f"{hint}; several are run by lagcli sweep FILE --vary {varied}"
    if sign:
        return hint
    return _OF_PARAMETER if is_parameter else f"{hint}: a coordinate has no range"


def signs_of(node: DocumentNode) -> dict[str, str]:
    """`{m: positive, k: positive}` for `m > 0, k > 0` and `{m: positive, k: "> 0"}`; or nothing."""
    found = {name: sign_meant(said.strip("'\"")) for name, said in by_key(node).items()}
    for text in texts_of(node) if not found else ():
        names: list[str] = []
        for part in re.split(r"\s*(?:[,;]|&&|∧|\band\b)\s*", text):  # m, k > 0
            each = re.fullmatch(r"([^\W\d]\w*)\s*(.*)", part)
            names += [each[1]] if each else []
            if each and each[2]:
                found |= dict.fromkeys(names, sign_meant(each[2]))
                names = []
    return found if all(found.values()) else {}
