"""The formulas of one problem, each shaped once."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sympy import Add, Expr

from lagcli.algebra.leaves import to_expression
from lagcli.algebra.relations import Relations
from lagcli.algebra.simplification import shaped
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression, operation_count

_LONG = 40  # operations


class Shapes:
    """Readable forms in one order of names under one set of relations.

    A formula that was simplified is written as it was found, without a second search.

    Parameters
    ----------
    order, relations
        As for `shape`.
    """

    def __init__(self, order: Sequence[str] = (), relations: Relations | None = None) -> None:
        self.order = order
        self.relations = relations
        self._trees: dict[Expr, Expression] = {}
        self._simplified: dict[Expr, Expr] = {}

    def keep(self, expression: Expr, tree: Expression) -> None:
        """Let a formula be written as this tree."""
        self._trees[expression] = tree

    def simplify(self, expression: Expr) -> Expr:
        """The shortest readable shape as a SymPy expression."""
        if expression in self._trees:
            return expression
        known = self._simplified.get(expression)
        if known is None:
            known, tree = shaped(expression, self.order, self.relations)
            self._simplified[expression] = known
            if tree is not None:
                self._trees[known] = tree
        return known

    def combination(self, values: Sequence[Expr], factors: Sequence[Expr]) -> Expr:
        """sum value * factor, which for long values is written as it stands."""
        pairs = [(v, f) for v, f in zip(values, factors, strict=True) if v != 0 and f != 0]
        whole = Add(*(value * factor for value, factor in pairs))
        trees = [self.shape(value) for value, _ in pairs]
        if sum(map(operation_count, trees)) > _LONG and whole not in self._trees:
            writer = Writer(self.order)
            terms = (
                writer.product(Fraction(1), [(tree, Fraction(1)), (self.shape(f), Fraction(1))])
                for tree, (_, f) in zip(trees, pairs, strict=True)
            )
            self._trees[whole] = writer.sum(terms)
        return whole

    def shape(self, expression: Expr) -> Expression:
        """The shortest readable tree."""
        simplified = self.simplify(expression)
        tree = self._trees.get(simplified)
        return to_expression(simplified, self.order) if tree is None else tree
