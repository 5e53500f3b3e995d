"""The frequencies of two coupled oscillators, whose radicand a book has as a square and a rest.

det(K - W M) = 0 has the discriminant

    (M11 K22 - M22 K11)² + 4 (M11 K12 - M12 K11) (M22 K12 - M12 K22),

the first of which is the difference of the squared frequencies without coupling.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from sympy import Expr, Mul, S, sqrt

from lagcli.algebra import is_zero, shape, simplify
from lagcli.algebra.writing import Writer
from lagcli.expression import Call, Expression, Number, Power, Sum, operation_count
from lagcli.rewriting import rebuilt

_TWO = Number(Fraction(2))
#: How many times as long as the shortest radicand it may be.
_LONGER = 1.1

Matrix = Sequence[Sequence[Expr]]
Rewrite = Callable[[Expression], Expression]


class Discriminant:
    """The discriminant of one pair of matrices of order 2; any others leave trees as they are."""

    def __init__(self, M: Matrix, K: Matrix, order: Sequence[str]) -> None:
        self._order = order
        self.difference: Expr = S.Zero
        self.coupling: Expr = S.Zero
        if len(M) == 2 and is_zero(K[0][1] - K[1][0]):
            (a, b), (_, c) = M
            (p, q), (_, r) = K
            self.difference = simplify(a * r - c * p)
            self.coupling = simplify(4 * (a * q - b * p) * (c * q - b * r))
        self._whole = simplify(self.difference**2 + self.coupling)

    def within(self, tree: Expression, build: Callable[[Expression], Expr]) -> Expression:
        """The tree with the radicand in this form, where that is not longer."""
        if self.difference == 0 or self.coupling == 0:
            return tree
        match tree:
            case Call(function="sqrt", arguments=(Sum() as radicand,)):
                return Call("sqrt", (self._radicand(radicand, build),))
            case _:
                return rebuilt(tree, lambda part: self.within(part, build))

    def _radicand(self, tree: Sum, build: Callable[[Expression], Expr]) -> Expression:
        ratio = simplify(build(tree) / self._whole)
        root = simplify(sqrt(ratio))
        powers = (factor.as_base_exp() for factor in Mul.make_args(root))
        if any(base.is_Add or not (e.is_Integer or base.is_number) for base, e in powers):
            return tree
        square = Power(shape(root * self.difference, self._order), _TWO)
        found = Writer(self._order).sum([square, shape(ratio * self.coupling, self._order)])
        return found if operation_count(found) <= _LONGER * operation_count(tree) else tree
