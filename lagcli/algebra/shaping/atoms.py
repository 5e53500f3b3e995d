"""Atoms: the parts of a formula that shaping moves around but does not look into.

A shape is built from terms, coefficient times a product of atoms with rational
exponents.  Roots are exponents, so sqrt(f) meets f² in f^(-3/2); sines of sums of angles
are atoms besides those of the single angles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from itertools import permutations
from typing import TypeAlias

import sympy
from sympy import Expr

from lagcli.algebra.entry import Field
from lagcli.algebra.field import Element
from lagcli.algebra.integral import written_arguments
from lagcli.algebra.leaves import Translator
from lagcli.algebra.ring import Monomial, Poly
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    operation_count,
)
from lagcli.notation.ordering import Flat

Exponent: TypeAlias = int | Fraction
Term: TypeAlias = tuple[tuple[int, Exponent], ...]  # (atom, exponent), ascending
#: Most are integers, and those are ten times as fast.
Coefficient: TypeAlias = int | Fraction
Terms: TypeAlias = dict[Term, Coefficient]
Angles: TypeAlias = tuple[tuple[int, int], ...]  # (cosine generator, multiple), ascending

#: Functions whose arguments are shaped.
_SHORTENED = ("abs", "sign", "exp", "cosh", "sinh")


#: Operations that sin(2 α - θ) counts for beside those that it shows: no book prints it.  With 4
#: the triple pendulum and the slider-crank are longer, with 2 a pendulum on a slope has it.
_UNLIKE = 3


class Atoms:
    """The atoms of one field: their trees, their cost, and the way back to SymPy."""

    def __init__(
        self,
        field: Field,
        writer: Writer,
        shape: Callable[[Element], Expression],
        *,
        scaled: bool = False,
    ) -> None:
        self.shape = shape  # of a radicand
        self.scaled = scaled
        self.field = field
        self.writer = writer
        self.trees: list[Expression] = []
        self.costs: list[int] = []
        self.roots: list[tuple[Poly, Term]] = []  # radicands that are sums, in atoms
        self._numbers: dict[Expression, int] = {}
        self._of_generator: dict[int, Term] = {}
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

    def is_known(self, atom: int) -> bool:
        """Whether it is the name of a parameter."""
        tree = self.trees[atom]
        return isinstance(tree, Name) and self.writer.ordering.is_parameter(tree)

    def is_variable(self, atom: int) -> bool:
        """Whether it is the name of a coordinate, a velocity or a momentum."""
        return isinstance(self.trees[atom], Name) and not self.is_known(atom)

    def is_momentum(self, atom: int) -> bool:
        """Whether it is the name of a momentum."""
        tree = self.trees[atom]
        return isinstance(tree, Name) and tree.name.startswith("p_")

    def is_rate(self, atom: int) -> bool:
        """Whether it is the name of a velocity."""
        tree = self.trees[atom]
        return isinstance(tree, Name) and tree.primes > 0

    def generator(self, number: int) -> Term:
        """A generator of the field in atoms."""
        known = self._of_generator.get(number)
        if known is None:
            known = self._of_generator[number] = self._generator(number)
        return known

    def _generator(self, number: int) -> Term:
        generator = self.field.generators[number]
        if generator.kind != "root":
            try:
                tree = self._translator.tree(generator.expression)
            except TypeError:  # nothing that the grammar can say, such as a Piecewise
                tree = Name(f"#{number}")
            if generator.kind == "opaque" and isinstance(tree, Call | PartialCall):
                given = written_arguments(generator.expression)
                tree = self._with_short_arguments(tree, given)
            own = generator.argument  # SymPy writes exp(1) as a number, |sqrt(x)| as a power
            named = own is not None or generator.expression.is_Function
            kinds = {generator.kind} & {*_SHORTENED}  # that of cosh(asinh(x)) is a root
            if isinstance(tree, Call) and tree.function in kinds and named:
                given = (own,) if own is not None else written_arguments(generator.expression)
                return ((self._shortened(tree, given, generator.expression), 1),)
            return ((self.add(tree, generator.expression), 1),)
        return tuple((a, exact(Fraction(e) / generator.index)) for a, e in self._inside(number))

    def _shortened(self, tree: Call, arguments: Iterable[Expr], expression: Expr) -> int:
        """The atom of a function with the shortest shape of its argument, as |sin(a + b)|."""
        short = self._with_short_arguments(tree, arguments)
        return self.add(tree, expression) if short == tree else self.add(short)

    def _with_short_arguments(
        self, tree: Call | PartialCall, given_arguments: Iterable[Expr]
    ) -> Call | PartialCall:
        """U'(d) with the shortest shape of d."""
        arguments = []
        for given, argument in zip(tree.arguments, given_arguments, strict=True):
            try:
                shaped = self.shape(self.field(argument))
            except ZeroDivisionError:
                shaped = given
            arguments.append(min(given, shaped, key=operation_count))
        if isinstance(tree, PartialCall):
            return PartialCall(tree.function, tree.indices, tuple(arguments))
        return Call(tree.function, tuple(arguments), tree.primes)

    def _inside(self, number: int) -> Term:
        """The radicand of a root in atoms: one generator, f, or d² (f/d²)."""
        radicand = self.field.ring.lift(self.field.generators[number].radicand)
        terms = list(self.field.ring.terms(radicand))
        if len(terms) == 1 and terms[0][1] == 1 and sum(e for _, e in terms[0][0]) == 1:
            # a product stays: sqrt(k*m)/m is sqrt(k/m) for m > 0 only
            return self.term(terms[0][0])
        inside = self.field.polynomial(radicand)
        outside: Term = ()
        scale = self.field.root_scales.get(number) if self.scaled else None
        if scale is not None:
            square = self.field.ring.lift(scale) ** 2
            inside = self.field.element(radicand, square)
            outside = self.term(next(self.field.ring.terms(square))[0])
        given = self.field.radicands.get(number) if scale is None else None
        atom = self._radicand(given, self.shape(inside))
        whole = multiply(((atom, 1),), outside)
        if len(terms) > 1:
            self.roots.append((radicand, whole))
        return whole

    def _radicand(self, given: Expr | None, shaped: Expression) -> int:
        """The atom of what was put in, or of its shape where that is shorter."""
        if given is None:
            return self.add(shaped)
        try:
            tree = self._translator.tree(given)
        except TypeError:  # nothing that the grammar can say
            return self.add(shaped)
        if operation_count(shaped) < operation_count(tree):
            return self.add(shaped)
        return self.add(tree, given)

    def angle_rank(self, cosine: int) -> tuple[Flat, int]:
        """Where the base argument of a cosine comes in a sum of angles."""
        tree = self._translator.tree(self.field.generators[cosine].argument)
        return self.writer.ordering.rank(tree), cosine

    def circular(self, function: str, angles: Angles) -> int:
        """The atom sin, cos or tan of a sum of multiples of base arguments."""
        key = (function, angles)
        known = self._trigonometric.get(key)
        if known is None:
            generators = self.field.generators
            argument = sympy.Add(*(sympy.Mul(k, generators[g].argument) for g, k in angles))
            tree = Call(function, (self._translator.tree(argument),))
            expression = getattr(sympy, function)(argument)
            known = self._trigonometric[key] = self._shortened(tree, (argument,), expression)
            multiples = {abs(k) for _, k in angles}
            if len(multiples) > 1:  # sin(α - 2 θ) where a book has a product of sin θ
                self.costs[known] = operation_count(self.trees[known]) + _UNLIKE
        return known

    def has_double_angle(self, terms: Terms) -> bool:
        """Whether sin or cos of an even multiple of an angle occurs."""
        even = {
            atom
            for (_, angles), atom in self._trigonometric.items()
            if all(k % 2 == 0 for _, k in angles)
        }
        return any(atom in even for term in terms for atom, _ in term)

    def term(self, monomial: Monomial) -> Term:
        """The product of atoms for a monomial of the ring."""
        exponents: dict[int, Exponent] = {}
        for number, exponent in monomial:
            for atom, each in self.generator(number):
                exponents[atom] = exponents.get(atom, 0) + each * exponent
        return tuple(sorted((a, e) for a, e in exponents.items() if e))

    def terms(self, poly: Poly) -> Terms:
        """The terms of a polynomial of the ring."""
        result: Terms = {}
        for monomial, coefficient in self.field.ring.terms(poly):
            term = self.term(monomial)
            result[term] = result.get(term, 0) + coefficient
        return result

    def polynomial(self, terms: Mapping[Term, int]) -> Poly | None:
        """The polynomial of the ring, None where an atom is no generator."""
        generators = {term[0][0]: g for g, term in self._of_generator.items() if len(term) == 1}
        data = []
        for term, coefficient in terms.items():
            if not all(a in generators and isinstance(e, int) and e > 0 for a, e in term):
                return None
            data.append((tuple((generators[a], int(e)) for a, e in term), coefficient))
        return self.field.ring.build(data)

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
            case Call(function="sqrt", arguments=(radicand,)) if apart := self._roots_apart(
                radicand
            ):
                return apart
            case Call(function="sqrt", arguments=(Quotient(numerator=a, denominator=b),)):
                above, below = self.to_sympy(a), self.to_sympy(b)
                if above.is_nonnegative:
                    # sqrt(a/b) where that is real; of sqrt(1/b) no power of b goes away
                    base, exponent = below.as_base_exp()
                    if exponent.is_odd and exponent > 1:
                        # sqrt(b^3) is no multiple of sqrt(b) for every b
                        return sympy.sqrt(above) / sympy.sqrt(base) ** exponent
                    return sympy.sqrt(above * below) / below
                return sympy.sqrt(above / below)
            case Call(function=function, arguments=arguments, primes=0):
                function = {"abs": "Abs"}.get(function, function)
                return getattr(sympy, function)(*map(self.to_sympy, arguments))
        if isinstance(node, Name) and not self._names:
            self._names = self._named()
            return self.to_sympy(node)
        raise TypeError(f"no expression for {node!r}")

    def _roots_apart(self, radicand: Expression) -> Expr | None:
        """sqrt(a) sqrt(b)^(+-1) of sqrt(a b^(+-1)), where these roots were put in.

        For negative a and b they differ, so no other proof would find them equal.
        """
        signed = [
            g.expression.base
            for g in self.field.generators
            if g.kind == "root"
            and g.expression.is_Pow
            and g.expression.exp == sympy.S.Half
            and g.expression.base.is_nonnegative is None
        ]
        if len(signed) < 2:
            return None
        whole = self.to_sympy(radicand)
        for a, b in permutations(signed, 2):
            disjoint = a.free_symbols.isdisjoint(b.free_symbols)  # else factors of one polynomial
            for power in (1, -1) if disjoint else (-1,):
                if sympy.expand(whole - a * b**power) == 0:
                    return sympy.sqrt(a) * sympy.sqrt(b) ** power
        return None

    def _named(self) -> bool:
        """Let every symbol inside the generators be found by its name."""
        for generator in self.field.generators:
            for symbol in generator.expression.free_symbols:
                self._expressions[self._translator.tree(symbol)] = symbol
        self._expressions[Name("pi")] = sympy.pi
        return True


def exact(value: Fraction) -> Exponent:
    """An integer where it is one."""
    return value.numerator if value.denominator == 1 else value


def multiply(left: Term, right: Term) -> Term:
    """The product of two products of atoms."""
    if not left or not right:
        return left or right
    exponents = dict(left)
    for atom, exponent in right:
        if atom in exponents:
            exponents[atom] += exponent
        else:
            exponents[atom] = exponent
    return tuple(sorted([pair for pair in exponents.items() if pair[1]]))
