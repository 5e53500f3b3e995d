"""A transformation with a parameter, `x -> x + v*t`, as its change per unit of it, `{x: t}`.

Where X(x, s) is x at s = s0, the change is ∂X/∂s at s0: s0 is 0, or 1 as of `x -> lambda*x`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from functools import partial

from lagcli.evaluation import evaluated
from lagcli.expression import FUNCTIONS
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.foreign.translation import translated
from lagcli.reader.foreign.words import UnclearText, Vocabulary
from lagcli.reader.misshapen import pieces
from lagcli.reader.regex import regex
from lagcli.record import record

_MOVED = regex(r"\s*([^\W\d]\w*)\s*(?:['’](?=\s*=))?\s*(?:[-=]>|→|↦|⇒|:?=)\s*([^=<>]*[^=<>\s])\s*")
#: `x <-> y`, and `(x, y) -> (-x, -y)`.
_EXCHANGED = regex(r"([^\W\d]\w*)\s*(?:<[-=]+>|↔|⇔)\s*([^\W\d]\w*)")
_TUPLES = regex(r"\s*\(([^()]*)\)\s*(?:[-=]>|→|↦|⇒)\s*\((.*)\)\s*")
#: What is taken for the parameter of a change that has it as a factor: eps*y.
_SMALL = frozenset("eps epsilon ε s delta δ lambda lam λ alpha α a".split())
#: The value and the derivative of a function at some places.
_AT = {
    **{(name, "0"): ("0", "1") for name in ("sin", "tan", "sinh", "tanh", "asin", "atan")},
    **{(name, "0"): ("1", "0") for name in ("cos", "cosh")},
    ("exp", "0"): ("1", "1"),
    ("log", "1"): ("0", "1"),
    ("sqrt", "1"): ("1", "1/2"),
}


@record
class _Near:
    """The value of a formula at s = s0, and its derivative by s there, as texts."""

    value: str
    rate: str = "0"

    def __add__(self, other: _Near) -> _Near:
        return _Near(_sum(self.value, other.value), _sum(self.rate, other.rate))

    def __neg__(self) -> _Near:
        return _Near("-1") * self

    def __mul__(self, other: _Near) -> _Near:
        rate = _sum(_product(self.rate, other.value), _product(self.value, other.rate))
        return _Near(_product(self.value, other.value), rate)

    def __truediv__(self, other: _Near) -> _Near:
        if other.rate != "0":
            return self * other**-1
        return _Near(*(_over(each, other.value) for each in (self.value, self.rate)))

    def __pow__(self, power: int | _Near) -> _Near:
        exponent = power if isinstance(power, _Near) else _Near(str(power))
        if exponent.rate != "0":
            raise KeyError(exponent)
        less = str(power - 1) if isinstance(power, int) else f"{exponent.value} - 1"
        rate = _product(exponent.value, _raised(self.value, less))
        return _Near(_raised(self.value, exponent.value), _product(rate, self.rate))


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

    Parameters
    ----------
    finite
        What each coordinate becomes, or its change with the parameter as a factor.
    coordinates, known
        The names of the file.
    declared
        Whether the parameter may be one of the file, where all names are known.
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
            values = {each: _Near(each) for each in words | rates} | {parameter: _Near(start, "1")}
            try:
                near = {x: _near(translated(text, names), values) for x, text in finite.items()}
            except (UnclearText, KeyError, ArithmeticError, ValueError):
                continue
            is_part = parameter in _SMALL and all(each.value == "0" for each in near.values())
            changes = [f"{x}: {each.rate}" for x, each in near.items() if each.rate != "0"]
            is_finite = bool(changes) and all(each.value == x for x, each in near.items())
            if is_finite or (is_part and len(changes) == len(near)):
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


def _near(text: str, values: Mapping[str, _Near]) -> _Near:
    formula = formula_or_none(text)
    if formula is None:
        raise UnclearText
    functions: dict[str, Callable[..., _Near]] = {
        name: partial(_called, name) for name in FUNCTIONS
    }
    found: _Near = evaluated(formula, values, functions, lambda number: _Near(str(number)))
    return found


def _called(name: str, *inner: _Near) -> _Near:
    if len(inner) == 1 and (name, inner[0].value) in _AT:
        value, rate = _AT[name, inner[0].value]
        return _Near(value, _product(rate, inner[0].rate))
    if any(each.rate != "0" for each in inner):
        raise KeyError(name)
    return _Near(f"{name}({', '.join(each.value for each in inner)})")


def _sum(one: str, other: str) -> str:
    if "0" in {one, other}:
        return other if one == "0" else one
    return f"{one} - {other[1:]}" if other[0] == "-" else f"{one} + {other}"


def _product(one: str, other: str) -> str:
    if "0" in {one, other}:
        return "0"
    signs = [each[0] == "-" and not _is_sum(each) for each in (one, other)]
    sizes = [_grouped(each[sign:]) for each, sign in zip((one, other), signs, strict=True)]
    whole = "*".join(each for each in sizes if each != "1") or "1"
    return f"-{whole}" if signs[0] != signs[1] else whole


def _over(one: str, other: str) -> str:
    if one == "0" or other == "1":
        return one
    return f"{_grouped(one)}/{_atom(other)}"


def _raised(base: str, exponent: str) -> str:
    if base == "1" or exponent in {"0", "1"}:
        return base if exponent == "1" else "1"
    if base == "0":
        return str(0 ** int(exponent))
    return f"{_atom(base)}^{_atom(exponent)}"


def _is_sum(text: str) -> bool:
    return re.search(r"\s[-+]\s", re.sub(r"\([^()]*(?:\([^()]*\)[^()]*)*\)", "", text)) is not None


def _grouped(text: str) -> str:
    return f"({text})" if _is_sum(text) else text


def _atom(text: str) -> str:
    return text if re.fullmatch(r"\w+'*|\w+\([^()]*\)", text) else f"({text})"
