"""Where a formula needs brackets: decided once, for every notation.

A notation says how each kind of node looks; `Printer` walks the tree and puts brackets
around a part that binds less tightly than its place demands.
"""

# ruff: noqa: D102 - what a method shows is its name: `sum`, `product`, `power`

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from copy import copy
from enum import IntEnum
from fractions import Fraction
from functools import cached_property
from typing import Generic, Self, TypeVar

from lagcli.expression import (
    ONE,
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
    factors_of,
    product_of,
    quotient_of,
    walk,
)

Shown = TypeVar("Shown")

#: Letters and numbers, at most, that are set with a slash, or as an exponent:
#: (x'^2 + y'^2 + z'^2)/c^2 has eight.
_SLOPED = 9


class Level(IntEnum):
    """How tightly a formula binds, loosest first."""

    SUM = 1  # a + b, -a
    QUOTIENT = 2  # a/b
    PRODUCT = 3  # a*b
    POWER = 4  # a^b
    ATOM = 5  # x, 2, f(x)


class Printer(ABC, Generic[Shown]):
    """A notation: one method for each kind of node.

    The tree is shown from its leaves upwards, so that a method finds its parts ready
    (`show` looks them up) and no formula is too deep for Python's stack.
    """

    #: What the first factor of a product needs: 1/2*x is (1/2)*x in the grammar.
    leading_factor = Level.QUOTIENT
    minus = "−"
    either = ("±", "∓")

    def __init__(self) -> None:
        self.ready: dict[int, tuple[Expression, Shown]] = {}  # the node is kept: so is its id

    def show(self, node: Expression) -> Shown:
        """Set the formula in this notation."""
        if id(node) in self.ready:
            return self.ready[id(node)][1]
        outermost = not self.ready
        try:
            for part in reversed(list(walk(node))):  # parts come before what holds them
                if id(part) not in self.ready:
                    self.ready[id(part)] = part, self._show(part)
            return self.ready[id(node)][1]
        finally:
            if outermost:
                self.ready.clear()

    def at(self, node: Expression, lowest: Level) -> Shown:
        """Set the formula for a place where anything looser than `lowest` needs brackets."""
        shown = self.show(node)
        return shown if self.level(node) >= lowest else self.bracketed(shown)

    def level(self, node: Expression) -> Level:
        """How tightly this node binds as it is shown."""
        match node:
            case Sum() | Negative() | PlusMinus():
                return Level.SUM
            case Quotient():
                return Level.QUOTIENT
            case Number(value=value, decimal=False) if value.denominator != 1:
                return Level.QUOTIENT
            case Product():
                return Level.PRODUCT
            case Power():
                return Level.POWER
            case _:
                return Level.ATOM

    def terms(self, node: Sum) -> list[tuple[str, Shown]]:
        """Set the terms of a sum, each with its sign; none before a first that is added."""
        signed: list[tuple[str, Shown]] = []
        for place, term in enumerate(node.terms):
            if isinstance(term, (Negative, PlusMinus)):
                signed.append((self.sign(term), self.at(term.operand, Level.QUOTIENT)))
            else:
                signed.append(("+" if place else "", self.at(term, Level.QUOTIENT)))
        return signed

    def sign(self, node: Negative | PlusMinus) -> str:
        """Spell the sign in this notation."""
        if isinstance(node, Negative):
            return self.minus
        return self.either[node.minus_above]

    def factors(self, node: Product) -> list[Shown]:
        """Set the factors of a product: a product that is itself a factor keeps its brackets."""
        first, *others = node.factors
        return [self.at(first, self.leading_factor), *(self.at(f, Level.POWER) for f in others)]

    def _show(self, node: Expression) -> Shown:
        match node:
            case Number():
                return self.number(node)
            case Name():
                return self.name(node)
            case Negative() | PlusMinus():
                return self.negative(node)
            case Sum():
                return self.sum(node)
            case Product():
                return self.product(node)
            case Quotient():
                return self.quotient(node)
            case Power():
                return self.power(node)
            case Call():
                return self.call(node)
            case PartialCall():
                return self.partial_call(node)
            case Diff():
                return self.diff(node)
            case Rate():
                return self.rate(node)
            case _:
                raise TypeError(f"{type(node).__name__} has no notation")

    @abstractmethod
    def bracketed(self, shown: Shown) -> Shown: ...
    @abstractmethod
    def number(self, node: Number) -> Shown: ...
    @abstractmethod
    def name(self, node: Name) -> Shown: ...
    @abstractmethod
    def negative(self, node: Negative | PlusMinus) -> Shown: ...
    @abstractmethod
    def sum(self, node: Sum) -> Shown: ...
    @abstractmethod
    def product(self, node: Product) -> Shown: ...
    @abstractmethod
    def quotient(self, node: Quotient) -> Shown: ...
    @abstractmethod
    def power(self, node: Power) -> Shown: ...
    @abstractmethod
    def call(self, node: Call) -> Shown: ...
    @abstractmethod
    def partial_call(self, node: PartialCall) -> Shown: ...
    @abstractmethod
    def diff(self, node: Diff) -> Shown: ...
    @abstractmethod
    def rate(self, node: Rate) -> Shown: ...


class FractionPrinter(Printer[Shown]):
    """A notation with upright fractions, and a slash where one of them would be too small.

    In a fraction and behind ln or cos a short quotient is set with a slash: 1 - v^2/c^2.
    """

    #: Whether this one sets what stands in a fraction or behind ln.
    small = False

    @cached_property
    def within(self) -> Self:
        """The same notation in a fraction, or behind ln."""
        inner = copy(self)
        inner.small, inner.ready, inner.__dict__["within"] = True, {}, inner
        return inner

    @abstractmethod
    def upright(self, node: Quotient) -> Shown: ...
    @abstractmethod
    def sloped(self, above: Shown, below: Shown) -> Shown: ...

    def quotient(self, node: Quotient) -> Shown:
        if not self.small and (apart := _apart(node)):
            return self.show(apart)
        if not self.is_sloped(node):
            return self.upright(node)
        return self.sloped(
            self.at(node.numerator, Level.PRODUCT), self.at(node.denominator, Level.POWER)
        )

    def is_sloped(self, node: Expression) -> bool:
        """Whether the node has a slash where no bracket would be needed around it."""
        return self.small and isinstance(node, Quotient) and _is_short(node)

    def exponential(self, node: Call) -> Shown | None:
        """Set the exponent of exp(a t), which is written as e^(a t); None where it is long."""
        if node.function != "exp" or not _is_short(node):
            return None
        return self.within.show(node.arguments[0])

    def placed(self, node: Expression, lowest: Level) -> Shown:
        """Set the node for a place that binds so tightly, still without a bracket around it."""
        factor = Level.QUOTIENT < lowest < Level.ATOM
        if factor and isinstance(node, Quotient) and self.is_sloped(node):
            return self.upright(node)
        return self.show(node)


def _apart(node: Quotient) -> Product | None:
    """A sum or a root with a tall fraction behind the fraction: 1/(2 m) (p² + (q - a)²/r² + s)."""
    factors = factors_of(node.numerator)
    tall = [factor for factor in factors if any(map(_is_tall, _parts(factor)))]
    if len(tall) != 1:
        return None
    rest = [factor for factor in factors if factor is not tall[0]]
    return Product((Quotient(product_of(rest), node.denominator), *tall))


def _parts(node: Expression) -> Iterator[Expression]:
    """The terms of a sum, what stands under a root or under one in a term."""
    match node:
        case Sum(terms=terms):
            for term in terms:
                whole = term.operand if isinstance(term, Negative) else term
                yield whole
                for factor in factors_of(whole):
                    yield from () if isinstance(factor, Sum) else _parts(factor)
        case Call(function="sqrt", arguments=arguments):
            yield from arguments


def _is_tall(node: Expression) -> bool:
    return isinstance(node, Quotient) and not _is_short(node)


def _is_short(node: Expression) -> bool:
    return sum(isinstance(part, (Name, Number)) for part in walk(node)) <= _SLOPED


def is_bracket(node: Expression) -> bool:
    """Whether a factor is a sum in brackets, or a power of one."""
    return isinstance(node.base if isinstance(node, Power) else node, Sum)


def begins_with_number(node: Expression) -> bool:
    """Whether the first thing that is read is a number: behind a letter it needs a dot."""
    while isinstance(node, (Power, Quotient)):
        node = node.base if isinstance(node, Power) else node.numerator
    return isinstance(node, Number)


def whole_ratio(node: Expression) -> tuple[bool, int, int] | None:
    """Whether a minus stands before a fraction of whole numbers, and these; None of others."""
    minus = isinstance(node, Negative)
    match node.operand if isinstance(node, Negative) else node:
        case Number(value=value, decimal=False) if value.denominator > 1:
            return minus, value.numerator, value.denominator
        case Quotient(
            numerator=Number(value=above, decimal=False),
            denominator=Number(value=below, decimal=False),
        ) if above.denominator == below.denominator == 1:
            return minus, above.numerator, below.numerator
    return None


def parted_root(node: Expression) -> Product | None:
    """sqrt(m/2) (E - V)^(-1/2) for sqrt(m/(2 (E - V))), which is too wide; None of others."""
    if not isinstance(node, Quotient) or any(
        isinstance(p, (Sum, Negative)) for p in walk(node.numerator)
    ):
        return None
    factors = factors_of(node.denominator)
    wide = [factor for factor in factors if isinstance(factor, Sum)]
    if len(wide) != 1:
        return None
    rest = [factor for factor in factors if factor is not wide[0]]
    half = Negative(Quotient(ONE, Number(Fraction(2))))
    before = Call("sqrt", (quotient_of([node.numerator], rest),))
    return Product((before, Power(wide[0], half)))
