"""Generators that stand for expressions: symbols, moduli, signs, whatever is not looked into."""

from __future__ import annotations

from abc import ABC, abstractmethod

import sympy
from sympy import Add, Expr, Mul, Pow, Rational, Symbol

from lagcli.algebra.field import Element, FractionField, Generator
from lagcli.algebra.integral import DefiniteIntegral
from lagcli.algebra.ring import Poly


class ExpressionField(FractionField, ABC):
    """The field with generators by expression; `lagcli.algebra.entry.Field` enters expressions.

    Parameters
    ----------
    alone
        Whether nothing else will be entered: θ₁ − θ₂ is one angle where neither occurs otherwise.
    closed
        The same without that: of cos 2 x and cos 4 x the angle is 2 x.
    """

    def __init__(self, capacity: int, *, alone: bool, closed: bool = False) -> None:
        super().__init__(capacity)
        self.alone, self.closed = alone, alone or closed
        self._numbers: dict[Expr, int] = {}  # expression of a generator -> its number

    @abstractmethod
    def __call__(self, expression: Expr) -> Element:
        """The element of an expression; ZeroDivisionError where it has none."""

    def atom(self, expression: Expr) -> Element:
        """The generator of a symbol, or of an expression that the field does not look into."""
        number = self._numbers.get(expression)
        if number is None:
            kind = "symbol" if expression.is_Symbol else "opaque"
            nonnegative = bool(expression.is_nonnegative)
            number = self.add_generator(Generator(kind, expression, nonnegative=nonnegative))
            self._numbers[expression] = number
            if expression is sympy.I:
                self.ring.rule(number, 2, -self.ring.one)
        return self.generator(number)

    def opaque(self, expression: Expr) -> Element:
        """The generator of an expression that the field does not look into."""
        if expression not in self._numbers:
            if isinstance(expression, DefiniteIntegral):
                self.doubtful = True  # it may be elementary
            undefined = isinstance(expression, sympy.core.function.AppliedUndef)
            if not undefined and any(
                g.kind == "opaque" and g.expression.args for g in self.generators
            ):
                self.doubtful = True
        return self.atom(expression)

    def modulus(self, factor: Poly) -> Element:
        """The generator |factor|, with |factor|² = factor²."""
        expression = sympy.Abs(self.to_sympy(self.polynomial(factor)))
        if expression not in self._numbers:
            number = self.add_generator(Generator("abs", expression, nonnegative=True))
            self._numbers[expression] = number
            self.ring.rule(number, 2, self.ring.lift(factor) ** 2)
            self.doubtful = True
        return self.generator(self._numbers[expression])

    def signum(self, factor: Poly) -> Element:
        """The generator s = sign(f), with s*f = |f|, s*|f| = f and s³ = s, at f = 0 too."""
        expression = sympy.sign(self.to_sympy(self.polynomial(factor)))
        if expression not in self._numbers:
            size = self.modulus(factor).numerator
            number = self.add_generator(Generator("sign", expression))
            self._numbers[expression] = number
            one = self.ring.generator(number)
            for other, value in ((factor, size), (size, factor), (one**2, one)):
                self.ring.rule_of_product(number, other, value)
            self.doubtful = True
        return self.generator(self._numbers[expression])

    def to_sympy(self, element: Element) -> Expr:
        """The SymPy expression numerator / denominator, both expanded."""
        above = self.polynomial_to_sympy(element.numerator)
        if element.denominator == 1:
            return above
        return Mul(above, Pow(self.polynomial_to_sympy(element.denominator), -1))

    def polynomial_to_sympy(self, poly: Poly) -> Expr:
        """The SymPy expression of a polynomial, expanded."""
        terms = []
        for monomial, coefficient in self.ring.terms(poly):
            factors = [Pow(self.generators[g].expression, e) for g, e in monomial]
            terms.append(Mul(Rational(coefficient), *factors))
        return Add(*terms)

    def number_of(self, symbol: Symbol) -> int | None:
        """The generator of a symbol, None when it does not occur."""
        return self._numbers.get(symbol)
