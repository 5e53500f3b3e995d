"""Expressions in MathML Core, which browsers set without a script."""
# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

import html

from lagcli.expression import (
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
)
from lagcli.formatters.document import Integral, Label
from lagcli.formatters.greek import BY_NAME
from lagcli.formatters.naming import name_parts
from lagcli.formatters.numbers import decimal_parts, digit_groups
from lagcli.formatters.precedence import Level, Printer
from lagcli.record import replace

_FUNCTIONS = {
    "log": "ln",
    "sign": "sgn",
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "asinh": "arsinh",
    "acosh": "arcosh",
    "atanh": "artanh",
}
_FIXED = frozenset(
    ("sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "exp", "atan2")
).union(_FUNCTIONS)
_TRIGONOMETRIC = _FIXED - {"exp", "atan2", *_FUNCTIONS}
_DOTS = {1: "˙", 2: "¨"}
#: A function applied to its argument, and a product of factors side by side.
_APPLIED, _TIMES = "<mo>&#x2061;</mo>", "<mo>&#x2062;</mo>"


class MathmlPrinter(Printer[str]):
    """The notation of printed books, as elements."""

    leading_factor = Level.POWER

    def level(self, node: Expression) -> Level:
        match node:
            case Number(value=value, decimal=True):
                return Level.POWER if decimal_parts(value).exponent else Level.ATOM
            case Quotient() | Number() if super().level(node) is Level.QUOTIENT:
                return Level.POWER
            case Diff():
                return Level.PRODUCT
            case _:
                return super().level(node)

    def bracketed(self, shown: str) -> str:
        return f"<mrow><mo>(</mo>{shown}<mo>)</mo></mrow>"

    def number(self, node: Number) -> str:
        if node.decimal:
            parts = decimal_parts(node.value)
            digits = f"<mn>{parts.digits}</mn>"
            if not parts.exponent:
                return digits
            power = f"<msup><mn>10</mn>{_signed(parts.exponent)}</msup>"
            return f"<mrow>{digits}<mo>⋅</mo>{power}</mrow>"
        numerator, denominator = node.value.numerator, node.value.denominator
        shown = f"<mn>{''.join(digit_groups(numerator))}</mn>"
        if denominator == 1:
            return shown
        return f"<mfrac>{shown}<mn>{''.join(digit_groups(denominator))}</mn></mfrac>"

    def name(self, node: Name) -> str:
        return mathml_name(node.name, node.primes)

    def negative(self, node: Negative) -> str:
        return f"<mrow><mo>−</mo>{self.at(node.operand, Level.QUOTIENT)}</mrow>"

    def sum(self, node: Sum) -> str:
        return f"<mrow>{''.join(self.signed_terms(node))}</mrow>"

    def signed_terms(self, node: Sum) -> list[str]:
        """Show the terms, each with the sign before it."""
        shown: list[str] = []
        for minus, term in self.terms(node):
            sign = "−" if minus else "+" if shown else ""
            shown.append(f"<mo>{sign}</mo>{term}" if sign else term)
        return shown

    def product(self, node: Product) -> str:
        first, *others = self.factors(node)
        shown = [first]
        for after, factor in zip(node.factors[1:], others, strict=True):
            shown.append(("<mo>⋅</mo>" if _is_numeral(after) else _TIMES) + factor)
        return f"<mrow>{''.join(shown)}</mrow>"

    def quotient(self, node: Quotient) -> str:
        return f"<mfrac>{self.show(node.numerator)}{self.show(node.denominator)}</mfrac>"

    def power(self, node: Power) -> str:
        exponent = self.show(node.exponent)
        base = node.base
        natural = isinstance(node.exponent, Number) and node.exponent.value.denominator == 1
        if isinstance(base, Call) and base.function in _TRIGONOMETRIC and natural:
            head = f"<msup><mi>{base.function}</mi>{exponent}</msup>"
            return f"<mrow>{head}{_APPLIED}{self.arguments(base.arguments)}</mrow>"
        return f"<msup>{self.at(base, Level.ATOM)}{exponent}</msup>"

    def call(self, node: Call) -> str:
        if node.function == "sqrt":
            return f"<msqrt>{self.show(node.arguments[0])}</msqrt>"
        if node.function == "abs":
            return f"<mrow><mo>|</mo>{self.show(node.arguments[0])}<mo>|</mo></mrow>"
        if node.function in _FIXED:
            head = f"<mi>{_FUNCTIONS.get(node.function, node.function)}</mi>"
        else:
            head = _primed(mathml_name(node.function), node.primes)
        return f"<mrow>{head}{_APPLIED}{self.arguments(node.arguments)}</mrow>"

    def partial_call(self, node: PartialCall) -> str:
        slots = "".join(f"<msub><mo>∂</mo><mn>{index}</mn></msub>" for index in node.indices)
        head = mathml_name(node.function)
        return f"<mrow>{slots}{head}{_APPLIED}{self.arguments(node.arguments)}</mrow>"

    def diff(self, node: Diff) -> str:
        below = f"<mrow><mo>∂</mo>{self.show(node.variable)}</mrow>"
        operand = self.bracketed(self.show(node.operand))
        return f"<mrow><mfrac><mo>∂</mo>{below}</mfrac>{operand}</mrow>"

    def arguments(self, nodes: tuple[Expression, ...]) -> str:
        """Show arguments in their brackets."""
        return self.bracketed("<mo>,</mo>".join(self.show(node) for node in nodes))

    def label(self, label: Label) -> str:
        """Show a symbol of the page."""
        if label.unit:
            inner = self.label(replace(label, unit=False))
            return f"<mrow><mo>[</mo>{inner}<mo>]</mo></mrow>"
        if label.change:
            return f"<mrow><mi>Δ</mi>{mathml_name(label.letter)}</mrow>"
        letter = f"<mi>{_bold(label.letter)}</mi>" if label.matrix else mathml_name(label.letter)
        if not label.index:
            return letter
        index = "<mo>,</mo>".join(mathml_name(name) for name in label.index)
        return f"<msub>{letter}<mrow>{index}</mrow></msub>"

    def integral(self, integral: Integral) -> str:
        """Show an integral without bounds."""
        before = f"<mn>{integral.times}</mn>" if integral.times != 1 else ""
        inner = self.at(integral.integrand, Level.PRODUCT)
        variable = f"<mi mathvariant='normal'>d</mi>{mathml_name(integral.variable)}"
        return f"<mrow>{before}<mo>∫</mo>{inner}<mspace width='0.2em'/>{variable}</mrow>"


def mathml_name(name: str, primes: int = 0) -> str:
    """Show a name with its subscripts, and dots for its time derivatives."""
    parts = name_parts(name)
    base = _identifier(parts.base)
    if primes in _DOTS:
        base = f"<mover accent='true'>{base}<mo>{_DOTS[primes]}</mo></mover>"
        primes = 0
    if parts.subscripts:
        index = "<mo>,</mo>".join(_subscript(each) for each in parts.subscripts)
        base = f"<msub>{base}<mrow>{index}</mrow></msub>"
    return _primed(base, primes)


def _primed(shown: str, primes: int) -> str:
    return f"<msup>{shown}<mo>{'′' * primes}</mo></msup>" if primes else shown


def _identifier(word: str) -> str:
    return f"<mi>{html.escape(BY_NAME.get(word, word))}</mi>"


def _subscript(part: str) -> str:
    if part.isascii() and part.isdigit():
        return f"<mn>{part}</mn>"
    inner = name_parts(part)
    return mathml_name(part) if inner.subscripts and inner.base != part else _identifier(part)


def _signed(exponent: int) -> str:
    sign = "<mo>−</mo>" if exponent < 0 else ""
    return f"<mrow>{sign}<mn>{abs(exponent)}</mn></mrow>"


def _bold(letter: str) -> str:
    """A letter in mathematical bold, such as 𝐌."""
    first = ord("𝐀") - ord("A") if letter.isupper() else ord("𝐚") - ord("a")
    return chr(ord(letter) + first)


def _is_numeral(node: Expression) -> bool:
    while isinstance(node, (Power, Quotient)):
        node = node.base if isinstance(node, Power) else node.numerator
    return isinstance(node, Number)
