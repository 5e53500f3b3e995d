"""The frequencies of two coupled oscillators, whose radicand a book has as a square and a rest.

det(K - W M) = 0 has the discriminant

    (M11 K22 - M22 K11)² + 4 (M11 K12 - M12 K11) (M22 K12 - M12 K22),

the first of which is the difference of the squared frequencies without coupling.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations

from sympy import Expr, Mul, S, sqrt

from lagcli.algebra import dot, is_zero, nullspace, shape, simplify
from lagcli.expression import Call, Expression, Number, Power, Sum, operation_count, terms_of
from lagcli.rewriting import rebuilt

_TWO = Number(Fraction(2))
#: How many times as long as the shortest radicand it may be.
_LONGER = 1.1

Matrix = Sequence[Sequence[Expr]]
Rewrite = Callable[[Expression], Expression]
Build = Callable[[Expression], Expr]


def pairs_of(M: Matrix, K: Matrix) -> list[tuple[Matrix, Matrix]]:
    """The M and K of two coordinates that are coupled to each other and to no other ones.

    Of three that may be displaced together by v without force, those of two of them with the
    centre at rest: M v^T M v - M v (M v)^T.
    """
    n, found = len(M), list[tuple[Matrix, Matrix]]()
    null = nullspace(K) if n == 3 else []
    if len(null) == 1 and all(x != 0 for x in null[0]):
        momenta = [dot(row, null[0]) for row in M]
        whole = dot(momenta, null[0])
        inner = [
            [simplify(whole * M[i][j] - momenta[i] * momenta[j]) for j in range(n)]
            for i in range(n)
        ]
        i, j = min(combinations(range(n), 2), key=lambda pair: K[pair[0]][pair[1]] != 0)
        return [(_block(inner, i, j), _block(K, i, j))]
    near = [[j for j in range(n) if j != i and (M[i][j] != 0 or K[i][j] != 0)] for i in range(n)]
    for i, j in combinations(range(n), 2):
        if near[i] == [j] and near[j] == [i]:
            found.append((_block(M, i, j), _block(K, i, j)))
    return found


def _block(A: Matrix, i: int, j: int) -> Matrix:
    return [[A[a][b] for b in (i, j)] for a in (i, j)]


def with_discriminants(M: Matrix, K: Matrix, order: Sequence[str], build: Build) -> Rewrite:
    """Writes the radicands of frequencies of these matrices so, and leaves other trees."""
    found = [Discriminant(*pair, order) for pair in pairs_of(M, K)]

    def rewrite(tree: Expression) -> Expression:
        for each in found:
            tree = each.within(tree, build)
        return tree

    return rewrite


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

    def within(self, tree: Expression, build: Build) -> Expression:
        """The tree with the radicand in this form, where that is not longer."""
        if self.difference == 0 or self.coupling == 0:
            return tree
        match tree:
            case Call(function="sqrt", arguments=(Sum() as radicand,)):
                return Call("sqrt", (self._radicand(radicand, build),))
            case _:
                return rebuilt(tree, lambda part: self.within(part, build))

    def _radicand(self, tree: Sum, build: Build) -> Expression:
        ratio = simplify(build(tree) / self._whole)
        root = simplify(sqrt(ratio))
        powers = (factor.as_base_exp() for factor in Mul.make_args(root))
        if any(base.is_Add or not (e.is_Integer or base.is_number) for base, e in powers):
            return tree
        square = Power(shape(root * self.difference, self._order), _TWO)
        found = Sum((square, *terms_of(shape(ratio * self.coupling, self._order))))
        return found if operation_count(found) <= _LONGER * operation_count(tree) else tree
