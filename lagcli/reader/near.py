"""A formula with its derivative by one parameter, both as texts."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import partial

from lagcli.evaluation import evaluated
from lagcli.expression import FUNCTIONS
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.regex import outside
from lagcli.record import record

#: The value and the derivative of a function at some places.
_AT = {
    **{(name, "0"): ("0", "1") for name in ("sin", "tan", "sinh", "tanh", "asin", "atan")},
    **{(name, "0"): ("1", "0") for name in ("cos", "cosh")},
    ("exp", "0"): ("1", "1"),
    ("log", "1"): ("0", "1"),
    ("sqrt", "1"): ("1", "1/2"),
}
#: The derivatives of functions elsewhere.
_SLOPES = {
    "sin": "cos({0})", "cos": "-sin({0})", "tan": "1/cos({0})^2", "exp": "exp({0})",
    "log": "1/({0})", "sqrt": "1/(2*sqrt({0}))", "sinh": "cosh({0})", "cosh": "sinh({0})",
}  # fmt: skip


@record
class Near:
    """The value of a formula at s = s0, and its derivative by s there, as texts."""

    value: str
    rate: str = "0"

    def __add__(self, other: Near) -> Near:
        return Near(_sum(self.value, other.value), _sum(self.rate, other.rate))

    def __neg__(self) -> Near:
        return Near("-1") * self

    def __mul__(self, other: Near) -> Near:
        rate = _sum(_product(self.rate, other.value), _product(self.value, other.rate))
        return Near(_product(self.value, other.value), rate)

    def __truediv__(self, other: Near) -> Near:
        if other.rate != "0":
            return self * other**-1
        return Near(*(_over(each, other.value) for each in (self.value, self.rate)))

    def __pow__(self, power: int | Near) -> Near:
        exponent = power if isinstance(power, Near) else Near(str(power))
        if exponent.rate != "0":
            raise KeyError(exponent)
        less = str(power - 1) if isinstance(power, int) else f"{exponent.value} - 1"
        rate = _product(exponent.value, _raised(self.value, less))
        return Near(_raised(self.value, exponent.value), _product(rate, self.rate))


def near(text: str, values: Mapping[str, Near]) -> Near:
    """The value and the derivative of a formula, by those of its names; `KeyError` if not known."""
    formula = formula_or_none(text)
    if formula is None:
        raise KeyError(text)
    functions: dict[str, Callable[..., Near]] = {name: partial(_called, name) for name in FUNCTIONS}
    found: Near = evaluated(formula, values, functions, lambda number: Near(str(number)))
    return found


def _called(name: str, *inner: Near) -> Near:
    if len(inner) == 1 and (name, inner[0].value) in _AT:
        value, rate = _AT[name, inner[0].value]
        return Near(value, _product(rate, inner[0].rate))
    value = f"{name}({', '.join(each.value for each in inner)})"
    if all(each.rate == "0" for each in inner):
        return Near(value)
    return Near(value, _product(_SLOPES[name].format(inner[0].value), inner[0].rate))


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
    return re.search(r"\s[-+]\s", outside(text)) is not None


def _grouped(text: str) -> str:
    return f"({text})" if _is_sum(text) else text


def _atom(text: str) -> str:
    return text if re.fullmatch(r"\w+'*|\w+\([^()]*\)", text) else f"({text})"
