"""Values of SymPy expressions modulo a prime, node by node: nothing is expanded.

Sums, products and integer powers are evaluated as they stand; symbols, roots and functions
are elements of a field, whose rules their values obey.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from sympy import Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import PRIME, ModularPoints, NoPoint
from lagcli.platform.effort import EFFORT

Memo = dict[Expr, int]

_BAD_POINTS = 50  # as of the search: half of them for each square root


class Tree:
    """Expressions with a field for their leaves.

    Parameters
    ----------
    expressions
        Whatever is to be evaluated.
    variables
        The symbols that change from point to point.
    """

    def __init__(
        self, expressions: Iterable[Expr], variables: Sequence[Symbol], allowed: Allowance
    ) -> None:
        self.allowed = allowed
        leaves = _leaves(expressions)
        self.field = Field(leaves)
        elements = {}
        for leaf in leaves:
            allowed.check()
            elements[leaf] = self.field(leaf)
        self.points = ModularPoints(self.field, variables)
        self._leaves = {leaf: self.points.compiled(x) for leaf, x in elements.items()}

    def value(self, expression: Expr, point: Sequence[int], memo: Memo) -> int:
        """The value at a point; `memo` keeps parts for other expressions at the same point.

        Raises
        ------
        NoPoint
            Where a denominator vanishes.
        """
        known = memo.get(expression)
        if known is not None:
            return known
        if expression.is_Add:
            result = sum(self.value(a, point, memo) for a in expression.args)
        elif expression.is_Mul:
            result = 1
            for factor in expression.args:
                result = result * self.value(factor, point, memo) % PRIME
        elif expression.is_Pow and expression.exp.is_Integer:
            base, exponent = self.value(expression.base, point, memo), int(expression.exp)
            if base == 0 and exponent < 0:
                raise NoPoint
            result = pow(base, exponent, PRIME)
        elif expression.is_Rational:
            result = int(expression.p) * pow(int(expression.q), -1, PRIME)
        else:
            result = self._leaves[expression](point)
        EFFORT.done += 1
        memo[expression] = result = result % PRIME
        return result

    def rows(
        self,
        columns: Sequence[Sequence[Expr]],
        count: int,
        draw: Callable[[], list[int]] | None = None,
    ) -> list[list[int]]:
        """Rows of values of vectors of functions at random points, at least a given number.

        Points are drawn from the whole space, or as `draw` gives them.

        Raises
        ------
        NoPoint
            Where too many points have no values.
        """
        rows: list[list[int]] = []
        bad = 0
        while len(rows) < count:
            self.allowed.check()
            memo: Memo = {}
            try:
                point = draw() if draw else self.points.point()
                values = [[self.value(e, point, memo) for e in column] for column in columns]
            except NoPoint:
                bad += 1
                if bad > _BAD_POINTS:
                    raise
                continue
            rows += [list(row) for row in zip(*values, strict=True)]
        return rows


def _leaves(expressions: Iterable[Expr]) -> list[Expr]:
    """What is neither sum nor product nor integer power nor number, in a fixed order."""
    found: dict[Expr, None] = {}
    seen: set[Expr] = set()
    stack = list(expressions)
    while stack:
        node = stack.pop()
        if node in seen:
            continue
        seen.add(node)
        if node.is_Add or node.is_Mul:
            stack.extend(node.args)
        elif node.is_Pow and node.exp.is_Integer:
            stack.append(node.base)
        elif not node.is_Rational:
            found[node] = None
    return sorted(found, key=str)
