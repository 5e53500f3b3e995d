"""SymPy expressions into the field and back: which generator stands for what."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import sympy
from sympy import Expr

from lagcli.algebra.build import CIRCULAR, HYPERBOLIC, UNREAL, without_jumps
from lagcli.algebra.field import Element
from lagcli.algebra.generators import ExpressionField
from lagcli.algebra.multiples import Multiples
from lagcli.algebra.roots import absolute, rational_power, sign

_MAX_EXPONENT = 200  # measured: at most 16


class Field(ExpressionField):
    """The field over Q that holds the expressions put into it.

    Parameters
    ----------
    expressions
        The known expressions that are put in.
    alone, closed
        As of `ExpressionField`.
    one_kind
        Whether cosh(x) is (exp(x) + exp(-x))/2 where exponentials of x are put in as well.

    Its generators are made on demand: symbols; sin and cos (sinh and cosh) of base
    arguments with their quadratic relation; exponentials and symbolic powers; roots;
    absolute values; anything else is opaque, told apart by its normalized arguments.

    Examples
    --------
    >>> field = Field()
    >>> x = sympy.Symbol("x", real=True)
    >>> field(sympy.sin(x) ** 2 + sympy.cos(x) ** 2 - 1).is_zero()
    True
    """

    def __init__(
        self,
        expressions: Iterable[Expr] = (),
        *,
        alone: bool = False,
        closed: bool = False,
        one_kind: bool = False,
    ) -> None:
        expressions = list(expressions)
        symbols = {s for e in expressions for s in e.free_symbols}
        super().__init__(capacity=len(symbols) + 4, alone=alone, closed=closed)
        self._one_kind = one_kind
        self._memo: dict[Expr, Element] = {}
        self._powers: dict[Expr, Multiples] = {}
        self.circular = Multiples(self, "circular")
        self.hyperbolic = Multiples(self, "hyperbolic")
        self.exponential = Multiples(self, "exp")
        for each in sorted(symbols, key=lambda s: s.name):
            self.atom(each)
        self.prepare(expressions)

    def prepare(self, expressions: Iterable[Expr]) -> None:
        """Look at all arguments first, so that theta/2 and theta share one generator."""
        seen: set[Expr] = set()
        found: list[Expr] = []
        stack = list(expressions)
        while stack:
            node = stack.pop()
            if isinstance(node, Expr) and node.args and node not in seen:
                seen.add(node)
                if node.is_Function or (node.is_Pow and not node.exp.is_Rational):
                    found.append(node)
                stack.extend(node.args)
        for node in reversed(found):
            if isinstance(node, CIRCULAR):
                self.circular.prepare(node.args[0])
            elif isinstance(node, HYPERBOLIC):
                self.hyperbolic.prepare(node.args[0])
            elif isinstance(node, sympy.exp):
                self.exponential.prepare(node.args[0])
            elif node.is_Pow:
                self._power_family(node.base).prepare(node.exp)
        for node in found if self._one_kind else ():
            if isinstance(node, HYPERBOLIC) and self.exponential.has(node.args[0]):
                self.exponential.prepare(node.args[0])

    def __call__(self, expression: Expr) -> Element:
        """The element of an expression; ZeroDivisionError where it has none."""
        known = self._memo.get(expression)
        if known is None:
            known = self._memo[expression] = self._enter(expression)
        elif known.numerator.context() is not self.ring.context:
            known = self._memo[expression] = self.lifted(known)
        return known

    def _enter(self, node: Expr) -> Element:
        if node.is_Symbol:
            return self.atom(node)
        if node.is_Rational:
            return self.rational(Fraction(int(node.p), int(node.q)))
        if node.is_Add:
            return self.sum([self(a) for a in node.args])
        if node.is_Mul:
            return self._product(node)
        if node.is_Pow:
            return self._power(node.base, node.exp)
        if node is sympy.E:
            return self.exponential.power(sympy.S.One)
        if isinstance(node, UNREAL):
            return self(without_jumps(node))
        if node.is_Function and all(isinstance(a, Expr) for a in node.args):
            return self._function(node)
        if node in (sympy.zoo, sympy.nan, sympy.oo, -sympy.oo):
            raise ZeroDivisionError
        return self.atom(node)

    def _product(self, node: Expr) -> Element:
        above, below = self.ring.one, self.ring.one
        lift = self.ring.lift
        for factor in node.args:
            element = self(factor)
            above = lift(above) * lift(element.numerator)
            below = lift(below) * lift(element.denominator)
        return self.element(above, below)

    def _power(self, base: Expr, exponent: Expr) -> Element:
        if exponent.is_Integer and abs(int(exponent)) <= _MAX_EXPONENT:
            return self(base) ** int(exponent)
        if exponent.is_Rational and abs(int(exponent.p)) <= _MAX_EXPONENT:
            inside = self(base)
            result = rational_power(self, inside, Fraction(int(exponent.p), int(exponent.q)))
            self._note_radicand(base, inside)
            return result
        constant, rest = exponent.as_coeff_Add()
        if not constant.is_Rational:
            constant, rest = sympy.S.Zero, exponent
        result = self._power_family(base).power(rest)
        return result if constant == 0 else result * self._power(base, constant)

    def _note_radicand(self, given: Expr, radicand: Element) -> None:
        """Remember (x - a)² + (y - b)² as it was given, of several ways to write it the first."""
        if not given.is_Add or radicand.denominator != 1:
            return
        inside = self.ring.lift(radicand.numerator)
        for number, generator in enumerate(self.generators):
            if generator.kind == "root" and self.ring.lift(generator.radicand) == inside:
                self.radicands.setdefault(number, given)

    def _power_family(self, base: Expr) -> Multiples:
        base = self.to_sympy(self(base))
        if base not in self._powers:
            self._powers[base] = Multiples(self, "power", base)
        return self._powers[base]

    def _function(self, node: Expr) -> Element:
        argument = node.args[0]
        if isinstance(node, CIRCULAR):
            cosine, sine = self.circular.pair(argument)
            if isinstance(node, sympy.sin):
                return sine
            if isinstance(node, sympy.cos):
                return cosine
            if isinstance(node, sympy.tan):
                return sine / cosine
            if isinstance(node, sympy.cot):
                return cosine / sine
            return (cosine if isinstance(node, sympy.sec) else sine).inverse()
        if isinstance(node, HYPERBOLIC):
            cosine, sine = self._hyperbolic(argument)
            if isinstance(node, sympy.sinh):
                return sine
            if isinstance(node, sympy.cosh):
                return cosine
            return sine / cosine if isinstance(node, sympy.tanh) else cosine / sine
        if isinstance(node, sympy.exp):
            return self.exponential.power(argument)
        if isinstance(node, sympy.Abs):
            return absolute(self, self(argument))
        if isinstance(node, sympy.sign):
            return sign(self, self(argument))
        if isinstance(node, sympy.DiracDelta):  # SymPy's derivative of a sign: 0 where it is one
            return self.rational(0)
        value = node.func(*[self.to_sympy(self(a)) for a in node.args])
        # SymPy may have evaluated the function of the normalized arguments
        return self.opaque(value) if value.func is node.func else self(value)

    def _hyperbolic(self, argument: Expr) -> tuple[Element, Element]:
        """(cosh, sinh), by exponentials where the field is of one kind and these occur."""
        if not (self._one_kind and self.exponential.has(argument)):
            return self.hyperbolic.pair(argument)
        half, grown = self.rational(Fraction(1, 2)), self.exponential.power(argument)
        fallen = grown.inverse()
        return (grown + fallen) * half, (grown - fallen) * half
