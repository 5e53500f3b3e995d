"""Expressions in the grammar of the problem format, so that what is printed reads back."""

# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

from lagcli.document import Label
from lagcli.expression import (
    Call,
    Diff,
    Equation,
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
from lagcli.formatters.display_width import display_width
from lagcli.formatters.layout import (
    AFTER_BRACKET,
    COMMA,
    DIGITS,
    PRODUCT,
    QUOTIENT,
    SUM,
    Layout,
    TextPiece,
    joined,
    kept_whole,
)
from lagcli.formatters.numbers import DecimalParts, decimal_parts, digit_groups
from lagcli.formatters.precedence import Level, Printer

#: Columns of a bracket that is not parted.
_SHORT = 24
#: The same of a denominator: the line breaks before its slash.
_DENOMINATOR = 66


def to_grammar(expression: Expression) -> str:
    """Print the expression so the reader reads it back as the same tree.

    Examples
    --------
    >>> from lagcli.expression import Name, Negative, Sum
    >>> to_grammar(Sum((Name("x", 2), Negative(Name("g")))))
    "x'' - g"
    """
    return joined(GrammarPrinter().show(expression))


def equation_to_grammar(equation: Equation) -> str:
    """`left = right`."""
    return f"{to_grammar(equation.left)} = {to_grammar(equation.right)}"


class GrammarPrinter(Printer[Layout]):
    """The notation of the problem format: `M*x'' - M*g*sin(alpha)`."""

    minus = "-"
    either = ("+/-", "-/+")

    def spelled(self, name: str, primes: int) -> str:
        """Spell a name as it is written here."""
        return name + "'" * primes

    def bracketed(self, shown: Layout) -> Layout:
        inner = kept_whole((AFTER_BRACKET, *shown), _SHORT)
        return (TextPiece("(", 1, nesting=1), *inner, TextPiece(")", 1, nesting=-1))

    def number(self, node: Number) -> Layout:
        value = node.value
        if node.decimal:
            return self.decimal(decimal_parts(value))
        numerator = _digits(value.numerator)
        if value.denominator == 1:
            return numerator
        return (*numerator, TextPiece("/", 1), *_digits(value.denominator))

    def decimal(self, parts: DecimalParts) -> Layout:
        return text(parts.digits + (f"e{parts.exponent}" if parts.exponent else ""))

    def name(self, node: Name) -> Layout:
        return text(self.spelled(node.name, node.primes))

    def negative(self, node: Negative | PlusMinus) -> Layout:
        return (*text(self.sign(node)), *self.at(node.operand, Level.QUOTIENT))

    def sum(self, node: Sum) -> Layout:
        (sign, first), *others = self.terms(node)
        pieces = [*text(sign), *first] if sign else [*first]
        for sign, term in others:
            width = len(sign) + 1
            broken = f"{sign} "
            pieces += [
                TextPiece(f" {sign} ", width + 1, rank=SUM, broken=broken, broken_width=width),
                *term,
            ]
        return tuple(pieces)

    def product(self, node: Product) -> Layout:
        first, *others = self.factors(node)
        pieces = [*first]
        for factor in others:
            pieces += [TextPiece("*", 1, rank=PRODUCT, broken="* ", broken_width=2), *factor]
        return tuple(pieces)

    def quotient(self, node: Quotient) -> Layout:
        over = TextPiece("/", 1, rank=QUOTIENT, broken="/ ", broken_width=2)
        numerator = self.at(node.numerator, Level.PRODUCT)
        below = kept_whole(self.at(node.denominator, Level.POWER), _DENOMINATOR)
        return (*numerator, over, *below)

    def power(self, node: Power) -> Layout:
        base = self.at(node.base, Level.ATOM)
        return (*base, TextPiece("^", 1), *self.at(node.exponent, Level.ATOM))

    def call(self, node: Call) -> Layout:
        head = self.spelled(node.function, node.primes)
        return (*text(head), *self.arguments(node.arguments))

    def partial_call(self, node: PartialCall) -> Layout:
        indices = ", ".join(str(index) for index in node.indices)
        head = f"diff({self.spelled(node.function, 0)}, {indices})"
        return (*text(head), *self.arguments(node.arguments))

    def diff(self, node: Diff) -> Layout:
        return (*text("diff"), *self.arguments((node.operand, node.variable)))

    def rate(self, node: Rate) -> Layout:
        return (*text("d/dt"), *self.arguments((node.operand,)))

    def labelled(self, label: Label, letter: str, change: str) -> Layout:
        """A symbol of the page: its letter, the names at it, and what stands for a change."""
        head, *names = (self.spelled(name, 0) for name in (letter, *label.index))
        shown = "_".join([head, *names])
        if label.change:
            shown = change + head
        elif label.matrix and names:
            shown = f"{head}[{', '.join(names)}]"
        return text(f"[{shown}]" if label.unit else shown)

    def arguments(self, nodes: tuple[Expression, ...]) -> Layout:
        """Arguments in their brackets; a line may break after a comma."""
        pieces: list[TextPiece] = []
        for node in nodes:
            if pieces:
                pieces += [TextPiece(",", 1), TextPiece(" ", 1, rank=COMMA)]
            pieces += self.show(node)
        return self.bracketed(tuple(pieces))


def text(content: str) -> Layout:
    """One piece as wide as its characters."""
    return (TextPiece(content, display_width(content)),)


def _digits(value: int) -> Layout:
    """Print an integer; a very long one may be broken, with a backslash at the end of the line."""
    first, *others = digit_groups(value)
    pieces = [TextPiece(first, len(first))]
    for group in others:
        size = len(group)
        pieces.append(
            TextPiece(group, size, rank=DIGITS, broken=group, broken_width=size, tail="\\")
        )
    return tuple(pieces)
