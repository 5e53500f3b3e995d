r"""Expressions in LaTeX, as pieces that may be broken over lines.

Brackets are sized by hand (\bigl, \bigr), since \left and \right cannot stand on two
lines.  A fraction, root or exponent that would be too wide for any line is set in a form
that can be broken: \frac{3 r}{D} ( ... ), ( ... )^{1/2}.
"""
# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

from copy import copy
from itertools import accumulate

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
    terms_of,
)
from lagcli.formatters.functions import FIXED, ON_PAPER, POWERED
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.latex_width import BINARY, SCRIPT, THIN_SPACE, digits, text_width
from lagcli.formatters.layout import (
    AFTER_BRACKET,
    BRACKETS,
    COMMA,
    PRODUCT,
    SUM,
    Layout,
    TextPiece,
    joined,
    kept_whole,
    width_of,
)
from lagcli.formatters.numbers import decimal_parts
from lagcli.formatters.precedence import (
    FractionPrinter,
    Level,
    begins_with_number,
    is_bracket,
    parted_root,
    whole_ratio,
)
from lagcli.record import record

#: Nothing that cannot be broken is wider, in points.
WIDEST = 205.0

#: Functions that LaTeX has no macro for.
_OPERATORS = ("arsinh", "arcosh", "artanh", "sgn", "atan2")
_FUNCTIONS = {
    name: rf"\operatorname{{{shown}}}" if shown in _OPERATORS else rf"\{shown}"
    for name, shown in ((name, ON_PAPER.get(name, name)) for name in FIXED)
}
#: Functions that may go without brackets.
_BARE = POWERED

#: Brackets by the height of what is in them.
_SIZES = (("", ""), (r"\bigl", r"\bigr"), (r"\Bigl", r"\Bigr"), (r"\biggl", r"\biggr"))
_BRACKET_WIDTHS = (3.9, 4.6, 6.0, 7.4)
_FLAT, _BIG, _TALL = 0, 1, 3

#: Points of a bracket that is not parted.
_SHORT = 90.0
_SLASH = TextPiece("/", 5)


@record
class Box:
    """A formula on the page.

    Attributes
    ----------
    pieces : Layout
        What is set.
    level : Level
        How tightly it binds as it is set.
    height : int
        Which brackets it needs, from plain to very tall.
    closed : Layout, optional
        How it is set before another factor: with the argument of sin in brackets.
    """

    pieces: Layout
    level: Level = Level.ATOM
    height: int = _FLAT
    closed: Layout | None = None

    @property
    def text(self) -> str:
        """The formula on one line."""
        return joined(self.pieces)

    @property
    def width(self) -> float:
        """Its width on one line, in points."""
        return width_of(self.pieces)


class LatexPrinter(FractionPrinter[Box]):
    """The notation of printed books: fractions, roots, dots, Greek letters."""

    leading_factor = Level.POWER

    def __init__(self, names: LatexNames | None = None) -> None:
        super().__init__()
        self.names = names or LatexNames()
        self.outermost: frozenset[Expression] = frozenset()
        self.room = WIDEST

    def line(self, node: Expression, room: float) -> Box:
        """The formula on lines of that width, which its outermost fractions may fill."""
        terms = (t.operand if isinstance(t, Negative) else t for t in terms_of(node))
        outer = copy(self)
        outer.ready, outer.room = {}, room
        outer.outermost = frozenset(t for t in terms if isinstance(t, Quotient))
        return outer.show(node) if outer.outermost and room > WIDEST else self.show(node)

    def at(self, node: Expression, lowest: Level) -> Box:
        box = self.placed(node, lowest)
        return box if box.level >= lowest else self.bracketed(box)

    def bracketed(self, shown: Box, before: str = "", after: str = "") -> Box:
        pieces = (*_enclosed(shown, "(", ")", after),)
        head = (TextPiece(before, 0),) if before else ()
        return Box((*head, *pieces), height=max(shown.height, _BIG))

    def number(self, node: Number) -> Box:
        if node.decimal:
            parts = decimal_parts(node.value)
            pieces = (TextPiece(parts.digits, text_width(parts.digits)),)
            if not parts.exponent:
                return Box(pieces)
            power = TextPiece(rf" \cdot 10^{{{parts.exponent}}}", BINARY + 10 + SCRIPT * 20)
            return Box((*pieces, power), Level.POWER)
        numerator = digits(node.value.numerator)
        if node.value.denominator == 1:
            return Box(numerator)
        return self._fraction(Box(numerator), Box(digits(node.value.denominator)))

    def name(self, node: Name) -> Box:
        shown = self.names.name(node.name, node.primes)
        return Box((TextPiece(shown, self.names.width(node.name, node.primes)),))

    minus = "-"
    either = (r"\pm ", r"\mp ")

    def negative(self, node: Negative | PlusMinus) -> Box:
        operand = self.at(node.operand, Level.QUOTIENT)
        return Box((TextPiece(self.sign(node), 8), *operand.pieces), Level.SUM, operand.height)

    def sum(self, node: Sum) -> Box:
        (sign, first), *others = self.terms(node)
        pieces = [TextPiece(sign, 8), *first.pieces] if sign else [*first.pieces]
        height = first.height
        for sign, term in others:
            spaced = f"{sign.strip()} "
            pieces.append(_breakable(f" {spaced}", BINARY, SUM, spaced, BINARY))
            pieces += term.pieces
            height = max(height, term.height)
        return Box(tuple(pieces), Level.SUM, height)

    def product(self, node: Product) -> Box:
        boxes = self.factors(node)
        pieces: list[TextPiece] = []
        for position, (factor, box) in enumerate(zip(node.factors, boxes, strict=True)):
            if position:
                before = node.factors[position - 1]
                pieces.append(_between(boxes[position - 1], before, factor, box))
            follower = boxes[position + 1] if position + 1 < len(boxes) else None
            open_end = follower is None or _is_function(follower)
            pieces += box.pieces if open_end or box.closed is None else box.closed
        last = boxes[-1]
        closed = None
        if last.closed is not None:
            closed = (*pieces[: -len(last.pieces)], *last.closed)
        return Box(tuple(pieces), Level.PRODUCT, max(box.height for box in boxes), closed)

    def sloped(self, above: Box, below: Box) -> Box:
        pieces = (*(above.closed or above.pieces), _SLASH, *below.pieces)
        return Box(pieces, Level.QUOTIENT, max(above.height, below.height))

    def upright(self, node: Quotient) -> Box:
        below = node.denominator
        if isinstance(below, Call) and below.function == "sqrt":
            content = self.within.show(below.arguments[0])
            if content.width > WIDEST:
                inverse = self.bracketed(content, after="^{-1/2}")
                return self._over(self.show(node.numerator), inverse)
        above, under = self.within.show(node.numerator), self.within.show(below)
        widest = max(above.width, under.width)
        if node in self.outermost and not self.small and WIDEST < widest <= self.room:
            return Box((_frac(above.text, under.text, widest),), Level.POWER, _TALL)
        if above.width > WIDEST >= under.width and isinstance(node.numerator, Product):
            parted = self._parted(node.numerator.factors, below)
            if parted is not None:
                return self.product(parted)
        return self._fraction(above, under)

    def _parted(self, above: tuple[Expression, ...], below: Expression) -> Product | None:
        """The product with those factors over `below` that fit into a fraction: 3 r / D ( ... )."""
        widths = accumulate(self.show(factor).width + THIN_SPACE for factor in above[:-1])
        count = sum(width <= WIDEST for width in widths)
        if not count:
            return None
        front = Product(above[:count]) if count > 1 else above[0]
        return Product((Quotient(front, below), *above[count:]))

    def _fraction(self, above: Box, below: Box) -> Box:
        if below.width > WIDEST:
            return self._over(above, self.bracketed(below, after="^{-1}"))
        if above.width > WIDEST:
            inverse = Box((_frac("1", below.text, below.width),))
            whole = above if above.level >= Level.PRODUCT else self.bracketed(above)
            return Box(
                (*inverse.pieces, TextPiece(r" \, ", THIN_SPACE), *whole.pieces),
                Level.PRODUCT,
                _TALL,
            )
        return Box(
            (_frac(above.text, below.text, max(above.width, below.width)),), Level.POWER, _TALL
        )

    def _over(self, above: Box, inverse: Box) -> Box:
        """A product in place of a fraction that is too wide."""
        numerator = above if above.level >= Level.PRODUCT else self.bracketed(above)
        pieces = numerator.closed or numerator.pieces
        gap = _breakable(r" \, ", THIN_SPACE, PRODUCT, r"\cdot ", BINARY)
        height = max(numerator.height, inverse.height)
        return Box((*pieces, gap, *inverse.pieces), Level.PRODUCT, height)

    def power(self, node: Power) -> Box:
        exponent = self._raised(node.exponent)
        if SCRIPT * exponent.width > WIDEST / 2:
            arguments = self.arguments((node.base, node.exponent))
            return Box((TextPiece(r"\operatorname{pow}", 18), *arguments.pieces), height=_BIG)
        raised = TextPiece(f"^{{{exponent.text}}}", SCRIPT * exponent.width + 1)
        base = node.base
        is_natural = isinstance(node.exponent, Number) and node.exponent.value.denominator == 1
        if isinstance(base, Call) and base.function in POWERED and is_natural:
            return self._function(base, raised)
        box = self.at(base, Level.ATOM)
        return Box((*box.pieces, raised), Level.POWER, box.height)

    def _raised(self, node: Expression) -> Box:
        """Set an exponent; a fraction of numbers stays on one line there, x^{1/2}."""
        ratio = whole_ratio(node)
        if ratio is None:
            return self.show(node)
        minus, above, below = ratio
        sign = (TextPiece("-", 8),) if minus else ()
        return Box((*sign, *digits(above), _SLASH, *digits(below)))

    def call(self, node: Call) -> Box:
        if node.function == "sqrt":
            content = self.show(node.arguments[0])
            parted = parted_root(node.arguments[0]) if content.width > WIDEST else None
            return self._root(content) if parted is None else self.show(parted)
        if node.function == "abs":
            content = self.show(node.arguments[0])
            return Box(_enclosed(content, r"\lvert ", r" \rvert "), height=content.height)
        if node.function == "integral":
            return self._integral(node)
        if (exponent := self.exponential(node)) is not None:
            raised = TextPiece(rf"\mathrm{{e}}^{{{exponent.text}}}", 6 + SCRIPT * exponent.width)
            return Box((raised,), Level.POWER)
        if node.function in _FUNCTIONS:
            return self._function(node)
        head = self.names.name(node.function) + "'" * node.primes
        width = self.names.width(node.function) + 3 * node.primes
        arguments = self.arguments(node.arguments)
        return Box((TextPiece(head, width), *arguments.pieces), height=arguments.height)

    def _integral(self, node: Call) -> Box:
        inner = self.at(node.arguments[0], Level.PRODUCT)
        variable, start, end = (self.show(each) for each in node.arguments[1:])
        limits = rf"\int_{{{start.text}}}^{{{end.text}}} "
        sign = TextPiece(limits, 14.0 + max(start.width, end.width))
        by = TextPiece(rf"\,\mathrm{{d}}{variable.text}", 8.0 + variable.width)
        return Box((sign, *inner.pieces, by), Level.QUOTIENT, _TALL)

    def _root(self, content: Box) -> Box:
        if content.width > WIDEST:
            whole = self.bracketed(content, after="^{1/2}")
            return Box(whole.pieces, Level.POWER, whole.height)
        root = TextPiece(rf"\sqrt{{{content.text}}}", content.width + 11)
        return Box((root,), height=_TALL if content.height >= _TALL else _BIG)

    def _function(self, node: Call, raised: TextPiece | None = None) -> Box:
        """Set a function with a fixed name, and the power of its value."""
        macro = _FUNCTIONS[node.function]
        name = TextPiece(macro, text_width(macro.rpartition("{")[2].strip("\\}")) + 2 * THIN_SPACE)
        head = (name, raised) if raised else (name,)
        arguments = self.within.arguments(node.arguments)
        closed = (*head, *arguments.pieces)
        inner = node.arguments[0]
        bare = isinstance(inner, Name) and inner.primes <= 2 and self.names.bare(inner.name)
        level = Level.POWER if raised else Level.ATOM
        if bare and node.function in _BARE:
            pieces = (*head, TextPiece(" ", THIN_SPACE), *self.show(inner).pieces)
            return Box(pieces, Level.POWER, _FLAT, closed)
        return Box(closed, level, arguments.height)

    def partial_call(self, node: PartialCall) -> Box:
        slots = " ".join(rf"\partial_{{{index}}}" for index in node.indices)
        head = TextPiece(
            f"{slots} {self.names.name(node.function)}",
            11 * len(node.indices) + self.names.width(node.function),
        )
        arguments = self.arguments(node.arguments)
        return Box((head, *arguments.pieces), height=arguments.height)

    def diff(self, node: Diff) -> Box:
        below = self.show(node.variable)
        if isinstance(node.operand, Name):
            above = self.show(node.operand)
            width = max(above.width, below.width) + 7
            whole = _frac(rf"\partial {above.text}", rf"\partial {below.text}", width)
            return Box((whole,), Level.POWER, _TALL)
        operator = _frac(r"\partial", rf"\partial {below.text}", below.width + 7)
        operand = self.bracketed(self.show(node.operand))
        gap = TextPiece(r" \, ", THIN_SPACE)
        return Box((operator, gap, *operand.pieces), Level.PRODUCT, _TALL)

    def rate(self, node: Rate) -> Box:
        operand = self.at(node.operand, Level.POWER)
        gap = TextPiece(r" \, ", THIN_SPACE)
        return Box((_frac("d", "dt", 9), gap, *operand.pieces), Level.PRODUCT, _TALL)

    def arguments(self, nodes: tuple[Expression, ...]) -> Box:
        pieces: list[TextPiece] = []
        height = _FLAT
        for node in nodes:
            if pieces:
                pieces += [TextPiece(",", 4.5), _breakable(" ", 0, COMMA, "", 0)]
            box = self.show(node)
            pieces += box.pieces
            height = max(height, box.height)
        return self.bracketed(Box(tuple(pieces), height=height))


def _enclosed(content: Box, left: str, right: str, after: str = "") -> Layout:
    size = min(content.height, len(_SIZES) - 1)
    width = _BRACKET_WIDTHS[size]
    before, behind = _SIZES[size]
    trailing = SCRIPT * text_width(after)
    return (
        TextPiece(before + left, width, nesting=1),
        *kept_whole((AFTER_BRACKET, *content.pieces), _SHORT),
        TextPiece(behind + right + after, width + trailing, nesting=-1),
    )


def _frac(above: str, below: str, width: float) -> TextPiece:
    return TextPiece(rf"\frac{{{above}}}{{{below}}}", width + 3)


def _breakable(text: str, width: float, rank: int, broken: str, broken_width: float) -> TextPiece:
    return TextPiece(text, width, rank=rank, broken=broken, broken_width=broken_width)


def _between(box: Box, before: Expression, after: Expression, shown: Box) -> TextPiece:
    r"""Set the gap between two factors: \cdot before a number, a thin space at brackets and words.

    x\,(a + b) is a product, U(a + b) a function.
    """
    if begins_with_number(after):
        return _breakable(r" \cdot ", BINARY, PRODUCT, r"\cdot ", BINARY)
    first = shown.pieces[0]
    if is_bracket(after) and (is_bracket(before) or isinstance(before, Quotient)):
        return _breakable(r" \, ", THIN_SPACE, BRACKETS, r"\cdot ", BINARY)
    neighbours = box.pieces[-1].text + first.text
    rooted = box.pieces[-1].text.startswith(r"\sqrt") and not first.text.startswith(r"\sqrt")
    if first.nesting or rooted or "text" in neighbours or "mathit" in neighbours:
        return _breakable(r" \, ", THIN_SPACE, PRODUCT, r"\cdot ", BINARY)
    return _breakable(" ", 0.3, PRODUCT, r"\cdot ", BINARY)


def _is_function(box: Box) -> bool:
    return box.pieces[0].text in _FUNCTIONS.values()
