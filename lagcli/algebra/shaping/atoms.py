"""Atoms: the parts of a formula that shaping moves around but does not look into.

A shape is built from terms, coefficient times a product of atoms with rational
exponents.  Roots are exponents, so sqrt(f) meets f² in f^(-3/2); sines of sums of angles
are atoms besides those of the single angles.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TypeAlias

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.leaves import Translator
from lagcli.algebra.ring import Monomial, Poly
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    operation_count,
)

Exponent: TypeAlias = int | Fraction
Term: TypeAlias = tuple[tuple[int, Exponent], ...]  # (atom, exponent), ascending
Terms: TypeAlias = dict[Term, Fraction]
Angles: TypeAlias = tuple[tuple[int, int], ...]  # (cosine generator, multiple), ascending


class Atoms:
    """The atoms of one field: their trees, their cost, and the way back to SymPy."""

    def __init__(
        self, field: Field, writer: Writer, shape: Callable[[Poly], Expression]
    ) -> None:
        self.shape = shape  # of a radicand
        self.field = field
        self.writer = writer
        self.trees: list[Expression] = []
        self.costs: list[int] = []
        self.roots: dict[int, Poly] = {}  # atom -> radicand, where that is a sum
        self._numbers: dict[Expression, int] = {}
        self._of_generator: dict[int, tuple[int, Exponent]] = {}
        self._expressions: dict[Expression, Expr] = {}
        self._trigonometric: dict[tuple[str, Angles], int] = {}
        self._translator = Translator(writer)
        self._names = False

    def add(self, tree: Expression, expression: Expr | None = None) -> int:
        """The atom of a tree."""
        number = self._numbers.get(tree)
        if number is None:
            number = self._numbers[tree] = len(self.trees)
            self.trees.append(tree)
            self.costs.append(operation_count(tree))
        if expression is not None:
            self._expressions[tree] = expression
        return number

    def generator(self, number: int) -> tuple[int, Exponent]:
        """The atom of a generator of the field, and the exponent it comes with."""
        known = self._of_generator.get(number)
        if known is None:
            known = self._of_generator[number] = self._generator(number)
        return known

    def _generator(self, number: int) -> tuple[int, Exponent]:
        generator = self.field.generators[number]
        if generator.kind == "root":
            exponent = Fraction(1, generator.index)
            terms = list(self.field.ring.terms(generator.radicand))
            if len(terms) == 1 and len(terms[0][0]) == 1 and terms[0][0][0][1] == 1:
                if terms[0][1] == 1:
                    atom, inner = self.generator(terms[0][0][0][0])
                    return atom, inner * exponent
            tree = self.shape(generator.radicand)
            atom = self.add(tree, generator.expression.args[0])
            if len(terms) > 1:
                self.roots[atom] = generator.radicand
            return atom, exponent
        return self.add(self._translator.tree(generator.expression), generator.expression), 1

    def radicand(self, poly: Poly) -> tuple[int, int] | None:
        """(sign, atom) of a polynomial whose root occurs, up to its sign."""
        for atom, value in self.roots.items():
            lifted = self.field.ring.lift(value)
            if poly == lifted:
                return 1, atom
            if poly == -lifted:
                return -1, atom
        return None

    def angle_rank(self, cosine: int) -> tuple[object, int]:
        """Where the base argument of a cosine comes in a sum of angles."""
        tree = self._translator.tree(self.field.generators[cosine].argument)
        return self.writer.ordering.term(tree)[2], cosine

    def circular(self, function: str, angles: Angles) -> int:
        """The atom sin or cos of a sum of multiples of base arguments."""
        key = (function, angles)
        known = self._trigonometric.get(key)
        if known is None:
            generators = self.field.generators
            argument = sympy.Add(*(k * generators[g].argument for g, k in angles))
            tree = Call(function, (self._translator.tree(argument),))
            expression = (sympy.sin if function == "sin" else sympy.cos)(argument)
            known = self._trigonometric[key] = self.add(tree, expression)
        return known

    def term(self, monomial: Monomial) -> Term:
        """The product of atoms for a monomial of the ring."""
        exponents: dict[int, Exponent] = {}
        for number, exponent in monomial:
            atom, each = self.generator(number)
            exponents[atom] = exponents.get(atom, 0) + each * exponent
        return tuple(sorted((a, e) for a, e in exponents.items() if e))

    def terms(self, poly: Poly) -> Terms:
        """The terms of a polynomial of the ring."""
        result: Terms = {}
        for monomial, coefficient in self.field.ring.terms(poly):
            term = self.term(monomial)
            result[term] = result.get(term, Fraction(0)) + coefficient
        return result

    def to_sympy(self, node: Expression) -> Expr:
        """The SymPy expression of a tree made of these atoms."""
        known = self._expressions.get(node)
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
            case Call(function=function, arguments=arguments, primes=0):
                function = {"abs": "Abs"}.get(function, function)
                return getattr(sympy, function)(*map(self.to_sympy, arguments))
        if isinstance(node, Name) and not self._names:
            self._names = self._named()
            return self.to_sympy(node)
        raise TypeError(f"no expression for {node!r}")

    def _named(self) -> bool:
        """Let every symbol inside the generators be found by its name."""
        for generator in self.field.generators:
            for symbol in generator.expression.free_symbols:
                self._expressions[self._translator.tree(symbol)] = symbol
        self._expressions[Name("pi")] = sympy.pi
        return True


def multiply(left: Term, right: Term) -> Term:
    """The product of two products of atoms."""
    exponents = dict(left)
    for atom, exponent in right:
        exponents[atom] = exponents.get(atom, 0) + exponent
    return tuple(sorted((a, e) for a, e in exponents.items() if e))

