"""Readable shapes of an element: for now factored numerator over factored denominator."""

from __future__ import annotations

from fractions import Fraction

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.leaves import Translator
from lagcli.algebra.ring import Poly
from lagcli.algebra.writing import Factor, Writer
from lagcli.expression import Call, Expression, Negative, Number, Power, Product, Quotient, Sum


class Shaper:
    """Writes elements of one field with one writer."""

    def __init__(self, field: Field, writer: Writer) -> None:
        self.field = field
        self.writer = writer
        self._translator = Translator(writer)
        self._atoms: dict[Expression, Expr] = {}

    def shape(self, element: Element) -> Expression:
        """The tree of an element."""
        element = self.field.lifted(element)
        number, above = self._factors(element.numerator, 1)
        below_number, below = self._factors(element.denominator, -1)
        return self.writer.product(Fraction(number, below_number), [*above, *below])

    def _factors(self, poly: Poly, sign: int) -> tuple[int, list[Factor]]:
        if poly == 0:
            return 0, []
        content, factors = poly.factor()
        return int(content), [(self._sum(p), Fraction(sign * int(e))) for p, e in factors]

    def _sum(self, poly: Poly) -> Expression:
        terms = []
        for monomial, coefficient in self.field.ring.terms(poly):
            factors = [(self.atom(g), Fraction(e)) for g, e in monomial]
            terms.append(self.writer.product(Fraction(coefficient), factors))
        return self.writer.sum(terms)

    def atom(self, generator: int) -> Expression:
        """The tree of a generator."""
        expression = self.field.generators[generator].expression
        tree = self._translator.tree(expression)
        self._atoms[tree] = expression
        return tree

    def to_sympy(self, node: Expression) -> Expr:
        """The SymPy expression of a tree made here."""
        known = self._atoms.get(node)
        if known is not None:
            return known
        match node:
            case Number(value=value):
                return sympy.Rational(value.numerator, value.denominator)
            case Negative(operand=operand):
                return -self.to_sympy(operand)
            case Sum(terms=terms):
                return sympy.Add(*map(self.to_sympy, terms))
            case Product(factors=factors):
                return sympy.Mul(*map(self.to_sympy, factors))
            case Quotient(numerator=above, denominator=below):
                return self.to_sympy(above) / self.to_sympy(below)
            case Power(base=base, exponent=exponent):
                return sympy.Pow(self.to_sympy(base), self.to_sympy(exponent))
            case Call(function=function, arguments=arguments):
                values = map(self.to_sympy, arguments)
                return getattr(sympy, {"abs": "Abs"}.get(function, function))(*values)
        raise TypeError(f"no expression for {node!r}")
