"""A transformation with a parameter, `x -> x + v*t`, as its change per unit of it, `{x: t}`.

Where X(x, s) is x at s = s0, the change is ∂X/∂s at s0: s0 is 0, or 1 as of `x -> lambda*x`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping

from lagcli.expression import FUNCTIONS
from lagcli.reader.assignments import pieces
from lagcli.reader.foreign.translation import translated
from lagcli.reader.foreign.words import UnclearText, Vocabulary
from lagcli.reader.near import Near, near
from lagcli.reader.regex import regex

_MOVED = regex(r"\s*([^\W\d]\w*)\s*(?:['’](?=\s*=))?\s*(?:[-=]>|→|↦|⇒|:?=)\s*([^=<>]*[^=<>\s])\s*")
#: `x <-> y`, and `(x, y) -> (-x, -y)`.
_EXCHANGED = regex(r"([^\W\d]\w*)\s*(?:<[-=]+>|↔|⇔)\s*([^\W\d]\w*)")
_TUPLES = regex(r"\s*\(([^()]*)\)\s*(?:[-=]>|→|↦|⇒)\s*\((.*)\)\s*")
#: What is taken for the parameter of a change that has it as a factor: eps*y.
_SMALL = frozenset("eps epsilon ε s delta δ lambda lam λ alpha α a".split())


def moved(text: str) -> dict[str, str]:
    """What each coordinate of `x -> x + a, y -> y` becomes; empty for other texts."""
    text = _EXCHANGED.sub(r"\1 -> \2, \2 -> \1", text)
    if both := _TUPLES.fullmatch(text):  # (x, y) -> (-x, -y)
        text = ", ".join(map("{} -> {}".format, *(pieces(each, ",") for each in both.groups())))
    found = [_MOVED.fullmatch(each) for each in pieces(text, ",;")]
    return {each[1]: each[2] for each in found if each} if all(found) else {}


def small_change(
    finite: Mapping[str, str],
    coordinates: Collection[str],
    known: Collection[str],
    *,
    declared: bool = False,
) -> str:
    """`{x: t}`, the change per unit of the only name that is not known; else nothing.

    The finite transformation is what each coordinate becomes, or its change with the parameter as a
    factor; this may be `declared`, where all names are known.
    """
    words = {word for text in finite.values() for word in re.findall(r"[^\W\d]\w*", text)}
    unknown = words - {*known, *coordinates, "t", "pi", *FUNCTIONS}
    if not unknown and declared:
        unknown = words & {*known} - {*coordinates, *FUNCTIONS}
    elif len(unknown) != 1:
        return ""
    if not {*finite} <= {*coordinates, "t"}:
        return ""
    names = Vocabulary((*coordinates,), frozenset(words | {"t"}) - {*FUNCTIONS})
    rates = {f"{x}'" for x in coordinates}
    for parameter in sorted(unknown, key=lambda name: name not in _SMALL):
        for start in ("0", "1"):
            values = {each: Near(each) for each in words | rates} | {parameter: Near(start, "1")}
            try:
                changed = {x: near(translated(text, names), values) for x, text in finite.items()}
            except (UnclearText, KeyError, ArithmeticError, ValueError):
                continue
            is_part = parameter in _SMALL and all(each.value == "0" for each in changed.values())
            changes = [f"{x}: {each.rate}" for x, each in changed.items() if each.rate != "0"]
            is_finite = bool(changes) and all(each.value == x for x, each in changed.items())
            if is_finite or (is_part and len(changes) == len(changed)):
                return f"{{{', '.join(changes)}}}"
    return ""


def is_discrete(
    finite: Mapping[str, str], coordinates: Collection[str], known: Collection[str]
) -> bool:
    """Whether a transformation has no parameter, as x -> -x, and x -> y, y -> x."""
    words = {word for text in finite.values() for word in re.findall(r"[^\W\d]\w*", text)}
    of_file = {*known, *coordinates, "t", "pi", *FUNCTIONS}
    if not finite or not (words <= of_file and {*finite} <= {*coordinates, "t"}):
        return False
    return not small_change(finite, coordinates, known, declared=True)
