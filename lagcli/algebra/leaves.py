"""SymPy -> tree, node by node: the parts that no normal form is needed for."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import sympy
from sympy import Expr
from sympy.core.function import AppliedUndef

from lagcli.algebra.integral import DefiniteIntegral, written_arguments
from lagcli.algebra.writing import Writer, name
from lagcli.expression import Call, Expression, Name, PartialCall, Power, operation_count

_NAMES = {"Abs": "abs"}


def to_expression(expression: Expr, order: Sequence[str] = ()) -> Expression:
    """The tree of a SymPy expression as it stands, in a textbook's order.

    Parameters
    ----------
    expression
        Symbols are named as the grammar writes them: ``x'`` is the velocity of ``x``.
    order
        Parameters, ``t``, coordinates, multipliers, as they are to follow in a product.
    """
    return Translator(Writer(order)).tree(expression)


class Translator:
    """SymPy -> tree with one writer; equal parts are translated once."""

    def __init__(self, writer: Writer) -> None:
        self.writer = writer
        self._memo: dict[Expr, Expression] = {}

    def tree(self, node: Expr) -> Expression:
        """The tree of a SymPy expression."""
        known = self._memo.get(node)
        if known is None:
            known = self._memo[node] = self._tree(node)
        return known

    def given(self, node: Expr) -> Expression | None:
        """The tree of the expression as it stands; None where it has none."""
        try:
            return self.tree(node)
        except TypeError:
            return None

    def count(self, node: Expr) -> int | None:
        """The operations of the expression as it stands; None where it has no tree."""
        tree = self.given(node)
        return None if tree is None else operation_count(tree)

    def _tree(self, node: Expr) -> Expression:
        if node.is_Symbol:
            return name(node.name)
        if node.is_Rational:
            return self.writer.number(Fraction(int(node.p), int(node.q)))
        if node.is_Add:
            return self.writer.sum([self.tree(a) for a in node.args])
        if node.is_Mul:
            coefficient, rest = node.as_coeff_Mul()
            if not coefficient.is_Rational:
                coefficient, rest = sympy.S.One, node
            parts = rest.args if rest.is_Mul else (rest,)
            number = Fraction(int(coefficient.p), int(coefficient.q))
            return self.writer.product(number, [self._factor(p) for p in parts])
        if node.is_Pow:
            return self._power(node)
        if isinstance(node, sympy.exp):
            return Call("exp", (self.tree(node.args[0]),))
        if isinstance(node, AppliedUndef):
            return self._unspecified(node)
        if isinstance(node, DefiniteIntegral):
            return self._integral(node)
        if isinstance(node, sympy.DiracDelta):  # of the derivative of a sign
            return self.writer.number(Fraction(0))
        if node.is_Function:
            function = type(node).__name__
            return Call(_NAMES.get(function, function), tuple(self.tree(a) for a in node.args))
        if node is sympy.pi:
            return Name("pi")
        if node is sympy.E:
            return Call("exp", (self.writer.number(Fraction(1)),))
        if node.is_Float:
            return self.writer.number(Fraction(str(node)))
        raise TypeError(f"no tree for {node!r}")

    def _factor(self, node: Expr) -> tuple[Expression, Fraction]:
        if node.is_Pow and node.exp.is_Rational:
            return self.tree(node.base), Fraction(int(node.exp.p), int(node.exp.q))
        return self.tree(node), Fraction(1)

    def _power(self, node: Expr) -> Expression:
        if node.exp.is_Rational:
            return self.writer.product(Fraction(1), [self._factor(node)])
        return Power(self.tree(node.base), self.tree(node.exp))

    def _integral(self, node: DefiniteIntegral) -> Expression:
        return Call("integral", tuple(self.tree(part) for part in written_arguments(node)))

    def _unspecified(self, node: AppliedUndef) -> Expression:
        arguments = tuple(self.tree(a) for a in node.args)
        function = type(node)
        indices = getattr(function, "indices", None)
        if indices is None:
            function_name = name(function.__name__)
            return Call(function_name.name, arguments, function_name.primes)
        base = function.base_name
        if len(arguments) == 1:
            return Call(base, arguments, len(indices))
        return PartialCall(base, indices, arguments) if indices else Call(base, arguments)
