"""Expressions in MathML Core, which browsers set without a script."""
# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

import html

from lagcli.document import Integral, Label
from lagcli.expression import (
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Rate,
    Sum,
)
from lagcli.formatters.functions import FIXED, ON_PAPER, POWERED
from lagcli.formatters.numbers import decimal_parts, digit_groups
from lagcli.formatters.precedence import FractionPrinter, Level, begins_with_number, whole_ratio
from lagcli.notation.greek import BY_NAME
from lagcli.notation.letters import bold
from lagcli.notation.naming import name_parts
from lagcli.record import replace

_DOTS = {1: "˙", 2: "¨"}
#: A function applied to its argument, and a product of factors side by side.
_APPLIED, _TIMES = "<mo>&#x2061;</mo>", "<mo>&#x2062;</mo>"
_SUB, _END_SUB = "<msub>", "</msub>"
_DOTTED, _END_DOTTED = "<mover accent='true'>", "</mover>"
_SLASH = "<mo lspace='0' rspace='0'>/</mo>"
_THIN = "<mspace width='0.17em'/>"
#: What makes a formula higher than a line.
_HIGH = ("<mfrac", "<mtable", "<msqrt", "<mo>∫")


class MathmlPrinter(FractionPrinter[str]):
    """The notation of printed books, as elements."""

    leading_factor = Level.POWER

    def level(self, node: Expression) -> Level:
        match node:
            case Number(value=value, decimal=True):
                return Level.POWER if decimal_parts(value).exponent else Level.ATOM
            case Quotient() | Number() if super().level(node) is Level.QUOTIENT:
                return Level.POWER
            case Diff(operand=operand):
                return Level.POWER if isinstance(operand, Name) else Level.PRODUCT
            case Rate():
                return Level.PRODUCT
            case _:
                return super().level(node)

    def at(self, node: Expression, lowest: Level) -> str:
        shown = self.placed(node, lowest)
        return shown if self.level(node) >= lowest else self.bracketed(shown)

    def bracketed(self, shown: str) -> str:
        return enclosed("(", shown, ")")

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

    def negative(self, node: Negative | PlusMinus) -> str:
        return f"<mrow><mo>{self.sign(node)}</mo>{self.at(node.operand, Level.QUOTIENT)}</mrow>"

    def sum(self, node: Sum) -> str:
        return f"<mrow>{''.join(self.signed_terms(node))}</mrow>"

    def signed_terms(self, node: Sum) -> list[str]:
        """Show the terms, each with the sign before it."""
        return [f"<mo>{sign}</mo>{term}" if sign else term for sign, term in self.terms(node)]

    def product(self, node: Product) -> str:
        first, *others = self.factors(node)
        shown = [first]
        for after, factor in zip(node.factors[1:], others, strict=True):
            space = _THIN if _is_function(after) else ""
            shown.append(("<mo>⋅</mo>" if begins_with_number(after) else _TIMES) + space + factor)
        return f"<mrow>{''.join(shown)}</mrow>"

    def upright(self, node: Quotient) -> str:
        above, below = self.within.show(node.numerator), self.within.show(node.denominator)
        return f"<mfrac>{above}{below}</mfrac>"

    def sloped(self, above: str, below: str) -> str:
        return f"<mrow>{above}{_SLASH}{below}</mrow>"

    def power(self, node: Power) -> str:
        exponent = _on_one_line(node.exponent) or self.show(node.exponent)
        base = node.base
        natural = isinstance(node.exponent, Number) and node.exponent.value.denominator == 1
        if isinstance(base, Call) and base.function in POWERED and natural:
            name = ON_PAPER.get(base.function, base.function)
            head = f"<msup><mi>{name}</mi>{exponent}</msup>"
            return f"<mrow>{head}{_APPLIED}{self.within.arguments(base.arguments)}</mrow>"
        shown = self.at(base, Level.ATOM)
        if isinstance(base, Name) and shown.startswith(_SUB):  # one above the other
            return f"<msubsup>{_low(shown[len(_SUB) : -len(_END_SUB)])}{exponent}</msubsup>"
        return f"<msup>{_low(shown)}{exponent}</msup>"

    def call(self, node: Call) -> str:
        if node.function == "sqrt":
            return f"<msqrt>{self.show(node.arguments[0])}</msqrt>"
        if node.function == "abs":
            return enclosed("|", self.show(node.arguments[0]), "|")
        if node.function == "integral":
            return self._integral(node)
        if (exponent := self.exponential(node)) is not None:
            return f"<msup><mi mathvariant='normal'>e</mi>{exponent}</msup>"
        if node.function in FIXED:
            head = f"<mi>{ON_PAPER.get(node.function, node.function)}</mi>"
            return f"<mrow>{head}{_APPLIED}{self.within.arguments(node.arguments)}</mrow>"
        head = _primed(mathml_name(node.function), node.primes)
        return f"<mrow>{head}{_APPLIED}{self.arguments(node.arguments)}</mrow>"

    def _integral(self, node: Call) -> str:
        variable, start, end = (self.show(each) for each in node.arguments[1:])
        sign = f"<msubsup><mo>∫</mo>{start}{end}</msubsup>"
        inner = self.at(node.arguments[0], Level.PRODUCT)
        return self.bracketed(f"{sign}{inner}<mi>d</mi>{variable}")

    def partial_call(self, node: PartialCall) -> str:
        slots = "".join(f"<msub><mo>∂</mo><mn>{index}</mn></msub>" for index in node.indices)
        head = mathml_name(node.function)
        return f"<mrow>{slots}{head}{_APPLIED}{self.arguments(node.arguments)}</mrow>"

    def diff(self, node: Diff) -> str:
        below = f"<mrow><mo>∂</mo>{self.show(node.variable)}</mrow>"
        if isinstance(node.operand, Name):
            return f"<mfrac><mrow><mo>∂</mo>{self.show(node.operand)}</mrow>{below}</mfrac>"
        operand = self.bracketed(self.show(node.operand))
        return f"<mrow><mfrac><mo>∂</mo>{below}</mfrac>{operand}</mrow>"

    def rate(self, node: Rate) -> str:
        operator = "<mfrac><mi>d</mi><mrow><mi>d</mi><mi>t</mi></mrow></mfrac>"
        return f"<mrow>{operator}{self.at(node.operand, Level.POWER)}</mrow>"

    def arguments(self, nodes: tuple[Expression, ...]) -> str:
        """Show arguments in their brackets."""
        return self.bracketed("<mo>,</mo>".join(self.show(node) for node in nodes))

    def label(self, label: Label) -> str:
        """Show a symbol of the page."""
        if label.unit:
            inner = self.label(replace(label, unit=False))
            return enclosed("[", inner, "]")
        if label.change:
            return f"<mrow><mi mathvariant='normal'>Δ</mi>{mathml_name(label.letter)}</mrow>"
        letter = f"<mi>{bold(label.letter)}</mi>" if label.matrix else mathml_name(label.letter)
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


def enclosed(left: str, shown: str, right: str) -> str:
    """Set brackets, as high as what they enclose."""
    high = any(element in shown for element in _HIGH)
    tag = "<mo>" if high else "<mo stretchy='false'>"  # a bracket that stretches has wide margins
    return f"<mrow>{tag}{left}</mo>{shown}{tag}{right}</mo></mrow>"


def _low(shown: str) -> str:
    """Let dots not lift the exponent beside them."""
    if not shown.startswith(_DOTTED):
        return shown
    letter, end, after = shown.partition(_END_DOTTED)
    return f"<mpadded height='0.75em'>{letter}{end}</mpadded>{after}"


def mathml_name(name: str, primes: int = 0) -> str:
    """Show a name with its subscripts, and dots for its time derivatives."""
    parts = name_parts(name)
    base = _identifier(parts.base)
    if primes in _DOTS:
        dots = f"<mo style='padding-bottom: 0.1em'>{_DOTS[primes]}</mo>"  # or they touch an x
        base = f"{_DOTTED}{base}{dots}{_END_DOTTED}"
        primes = 0
    if parts.subscripts:
        index = "<mo>,</mo>".join(_subscript(each) for each in parts.subscripts)
        base = f"{_SUB}{base}<mrow>{index}</mrow>{_END_SUB}"
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


def _is_function(node: Expression) -> bool:
    """Whether a name such as `sin` begins it, which would run into the factor before."""
    while isinstance(node, Power):
        node = node.base
    return isinstance(node, Call) and node.function in FIXED


def _on_one_line(exponent: Expression) -> str:
    """A fraction of whole numbers with a slash; empty for everything else."""
    ratio = whole_ratio(exponent)
    if ratio is None:
        return ""
    minus, above, below = ratio
    sign = "<mo>−</mo>" if minus else ""
    return f"<mrow>{sign}<mn>{above}</mn>{_SLASH}<mn>{below}</mn></mrow>"
