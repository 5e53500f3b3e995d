"""Expressions as one reads them on paper, on one line of Unicode: `M ẍ − M g sin(α)`."""

# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

import unicodedata
from itertools import pairwise

from lagcli.document import Integral, Label
from lagcli.expression import Call, Diff, Expression, Name, Number, PartialCall, Power, Product
from lagcli.formatters.functions import ON_PAPER, POWERED
from lagcli.formatters.grammar import GrammarPrinter, text
from lagcli.formatters.layout import BRACKETS, PRODUCT, Layout, TextPiece, joined
from lagcli.formatters.numbers import DecimalParts, decimal_parts
from lagcli.formatters.precedence import Level, is_bracket
from lagcli.notation.greek import BY_NAME, romanized
from lagcli.notation.letters import in_ascii
from lagcli.notation.naming import name_parts

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_SUPERSCRIPTS = str.maketrans("0123456789−n", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ")
_RAISABLE = frozenset("0123456789−n")
_DOTS = {1: "\N{COMBINING DOT ABOVE}", 2: "\N{COMBINING DIAERESIS}"}
_NAMES = {"sqrt": "√", **ON_PAPER}
_FRACTIONS = {(1, 2): "½", (1, 4): "¼", (3, 4): "¾"}


class UnicodePrinter(GrammarPrinter):
    """The notation for reading: factors side by side, dots for d/dt, Greek letters."""

    minus = "−"
    either = ("±", "∓")
    leading_factor = Level.PRODUCT

    def spelled(self, name: str, primes: int) -> str:
        return unicode_name(name, primes)

    def product(self, node: Product) -> Layout:
        first, *others = self.factors(node)
        pieces = [*first]
        for (before, after), factor in zip(pairwise(node.factors), others, strict=True):
            pieces += [_between(before, after), *factor]
        return tuple(pieces)

    def factors(self, node: Product) -> list[Layout]:
        shown = super().factors(node)
        first = node.factors[0]
        if isinstance(first, Number) and not first.decimal:
            glyph = _FRACTIONS.get((first.value.numerator, first.value.denominator))
            if glyph:
                shown[0] = text(glyph)
        last = node.factors[-1]
        if isinstance(last, Call) and last.function == "integral":
            shown[-1] = self.show(last)  # it ends at its `ds`
        return shown

    def power(self, node: Power) -> Layout:
        exponent = joined(self.show(node.exponent))
        if len(exponent) > 4 or not _RAISABLE.issuperset(exponent):
            return super().power(node)
        raised = text(exponent.translate(_SUPERSCRIPTS))
        base = node.base
        if isinstance(base, Call) and base.function in POWERED and not exponent.startswith("−"):
            return (
                *text(_NAMES.get(base.function, base.function)),
                *raised,
                *self.arguments(base.arguments),
            )
        return (*self.at(base, Level.ATOM), *raised)

    def call(self, node: Call) -> Layout:
        if _is_root_of_one(node):
            return (*text("√"), *self.show(node.arguments[0]))
        if node.function in _NAMES:
            return (*text(_NAMES[node.function]), *self.arguments(node.arguments))
        if node.function == "integral":
            return self._definite(node)
        if node.function == "abs":
            inner = self.show(node.arguments[0])
            if "|" not in joined(inner):  # which bar opens and which closes is seen
                bars = (TextPiece("|", 1, nesting=side) for side in (1, -1))
                return (next(bars), *inner, next(bars))
        return (
            *text(_with_primes(self.spelled(node.function, 0), node.primes)),
            *self.arguments(node.arguments),
        )

    def _definite(self, node: Call) -> Layout:
        """Show the integral from a to b: `∫[a … b] f(x) dx`."""
        integrand, variable, start, end = node.arguments
        bounds = (*text("∫["), *self.show(start), *text(" … "), *self.show(end), *text("] "))
        inner = self.at(integrand, Level.PRODUCT)
        return (*bounds, *inner, *text(" d"), *self.show(variable))

    def partial_call(self, node: PartialCall) -> Layout:
        slots = "".join(f"∂{str(index).translate(_SUBSCRIPTS)}" for index in node.indices)
        return (*text(slots + self.spelled(node.function, 0)), *self.arguments(node.arguments))

    def diff(self, node: Diff) -> Layout:
        if isinstance(node.operand, Name):
            return (*text("∂"), *self.show(node.operand), *text("/∂"), *self.show(node.variable))
        return (
            *text("∂"),
            *self.arguments((node.operand,)),
            *text("/∂"),
            *self.show(node.variable),
        )

    def decimal(self, parts: DecimalParts) -> Layout:
        if not parts.exponent:
            return text(parts.digits)
        exponent = str(parts.exponent).replace("-", "−").translate(_SUPERSCRIPTS)
        return text(f"{parts.digits}·10{exponent}")

    def level(self, node: Expression) -> Level:
        if isinstance(node, Number) and node.decimal and decimal_parts(node.value).exponent:
            return Level.PRODUCT
        if isinstance(node, Call) and node.function == "integral":
            return Level.QUOTIENT
        if _is_root_of_one(node):
            return Level.POWER  # (√5)³
        return Level.QUOTIENT if isinstance(node, Diff) else super().level(node)

    def label(self, label: Label) -> Layout:
        """Show a symbol of the page."""
        return self.labelled(label, label.letter, "Δ")

    def integral(self, integral: Integral) -> Layout:
        """Show an integral: `2 ∫ f(x) dx`."""
        before = f"{integral.times} " if integral.times != 1 else ""
        inner = self.at(integral.integrand, Level.PRODUCT)
        return (*text(before + "∫ "), *inner, *text(" d" + self.spelled(integral.variable, 0)))


class AsciiPrinter(GrammarPrinter):
    """The notation of the problem format with every letter in ASCII."""

    def spelled(self, name: str, primes: int) -> str:
        return romanized(name) + "'" * primes

    def diff(self, node: Diff) -> Layout:
        if isinstance(node.operand, Name):
            return (*text("d"), *self.show(node.operand), *text("/d"), *self.show(node.variable))
        return super().diff(node)

    def level(self, node: Expression) -> Level:
        if isinstance(node, Diff) and isinstance(node.operand, Name):
            return Level.QUOTIENT
        return super().level(node)

    def label(self, label: Label) -> Layout:
        """Show a symbol of the page."""
        return self.labelled(label, in_ascii(label.letter), "Delta ")

    def integral(self, integral: Integral) -> Layout:
        """Show an integral: `2*integral(f(x), x)`."""
        before = f"{integral.times}*" if integral.times != 1 else ""
        inner = self.show(integral.integrand)
        variable = romanized(integral.variable)
        opening = TextPiece("integral(", 9, nesting=1)
        return (*text(before), opening, *inner, TextPiece(f", {variable})", 3 + len(variable), -1))


def unicode_name(name: str, primes: int = 0) -> str:
    """Spell a name for reading: `theta_1` with two primes is θ̈₁, `lambda_rolling` is λ_rolling."""
    parts = name_parts(name)
    base = BY_NAME.get(parts.base, parts.base)
    if primes in _DOTS and len(base) == 1:
        base = unicodedata.normalize("NFC", base + _DOTS[primes])
        primes = 0
    shown = base
    for subscript in parts.subscripts:
        if subscript.isascii() and subscript.isdigit():
            again = shown[-1] in "₀₁₂₃₄₅₆₇₈₉"
            shown += f"_{subscript}" if again else subscript.translate(_SUBSCRIPTS)
        else:
            inner = name_parts(subscript)
            digits = "".join(inner.subscripts).translate(_SUBSCRIPTS)
            shown += "_" + BY_NAME.get(inner.base, inner.base) + digits
    return _with_primes(shown, primes)


def _with_primes(name: str, primes: int) -> str:
    return name + {0: "", 1: "′", 2: "″", 3: "‴"}.get(primes, "′" * primes)


def _between(before: Expression, after: Expression) -> TextPiece:
    """Put a space between factors, a dot where a space could be misread or overlooked."""
    dotted = _begins_with_digit(after)
    rank = BRACKETS if is_bracket(before) and is_bracket(after) else PRODUCT
    return TextPiece("·" if dotted else " ", 1, rank=rank, broken="· ", broken_width=2)


def _begins_with_digit(node: Expression) -> bool:
    while isinstance(node, Power):
        node = node.base
    return isinstance(node, Number) and (node.decimal or node.value.denominator == 1)


def _is_root_of_one(node: Expression) -> bool:
    """Whether it is printed as √5 or √k."""
    if not isinstance(node, Call) or node.function != "sqrt":
        return False
    inner = node.arguments[0]
    whole = isinstance(inner, Number) and not inner.decimal and inner.value.denominator == 1
    return whole or isinstance(inner, Name)
