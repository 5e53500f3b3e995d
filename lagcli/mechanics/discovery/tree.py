"""Values of SymPy expressions modulo a prime, node by node: nothing is expanded.

Sums, products and integer powers are evaluated as they stand; symbols, roots and functions
are elements of a field, whose rules their values obey.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence
from functools import partial
from math import prod

from sympy import Expr, Symbol

from lagcli.algebra.entry import Field
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import (
    PRIME,
    CompiledElement,
    ModularPoints,
    NoPoint,
)
from lagcli.platform.effort import EFFORT

_MOST_MULTIPLE = 48  # nothing is printed: 12 phi beside 6 phi, and phi of the ansatz
_BAD_POINTS = 50  # as of the search: half of them for each square root

#: The value of a node from those of its parts, and the point.
Step = Callable[[list[int], Sequence[int]], int]


class Tree:
    """Expressions with a field for their leaves, each part of them numbered once.

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
        self.field = Field(leaves, closed=True, one_kind=True)
        self.field.circular.most = _MOST_MULTIPLE
        elements = {}
        for leaf in leaves:
            allowed.check()
            elements[leaf] = self.field(leaf)
        self.points = ModularPoints(self.field, variables)
        self._leaves = {leaf: self.points.compiled(x) for leaf, x in elements.items()}
        self._numbers: dict[Expr, int] = {}
        self._parts: list[tuple[int, ...]] = []
        self._steps: list[Step] = []

    def at(self, point: Sequence[int]) -> ModularValues:
        """The values at a point."""
        return ModularValues(self, point)

    def number(self, expression: Expr) -> int:
        """The number of a node, above those of its parts."""
        known = self._numbers.get(expression)
        if known is not None:
            return known
        step, parts = self._step(expression)
        numbers = tuple(map(self.number, parts))
        self._parts.append(numbers)
        self._steps.append(step)
        self._numbers[expression] = number = len(self._steps) - 1
        return number

    def _step(self, expression: Expr) -> tuple[Step, Sequence[Expr]]:
        if expression.is_Add:
            return _sum, expression.args
        if expression.is_Mul:
            return _product, expression.args
        if expression.is_Pow and expression.exp.is_Integer:
            return partial(_power, int(expression.exp)), (expression.base,)
        if expression.is_Rational:
            value = int(expression.p) * pow(int(expression.q), -1, PRIME) % PRIME
            return partial(_constant, value), ()
        return partial(_leaf, self._leaves[expression]), ()

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
        numbers = [[self.number(e) for e in column] for column in columns]
        order = self.needed({i for column in numbers for i in column})
        while len(rows) < count:
            self.allowed.check()
            known: dict[int, int] = {}
            try:
                self.fill(known, order, draw() if draw else self.points.point())
            except NoPoint:
                bad += 1
                if bad > _BAD_POINTS:
                    raise
                continue
            values = ([known[i] for i in column] for column in numbers)
            rows += [list(row) for row in zip(*values, strict=True)]
        return rows

    def needed(self, numbers: set[int], known: Container[int] = ()) -> list[int]:
        """The nodes without a value of which these are made, parts first."""
        missing, waiting = set(numbers), list(numbers)
        while waiting:
            new = {k for k in self._parts[waiting.pop()] if k not in known} - missing
            missing |= new
            waiting += new
        return sorted(missing)

    def fill(self, known: dict[int, int], nodes: Sequence[int], point: Sequence[int]) -> None:
        """Give nodes, parts first, their values at a point."""
        EFFORT.done += len(nodes)
        for i in nodes:
            known[i] = self._steps[i]([known[k] for k in self._parts[i]], point) % PRIME


class ModularValues:
    """The values of the expressions of a tree at one point, each part computed once."""

    def __init__(self, tree: Tree, point: Sequence[int]) -> None:
        self._tree = tree
        self._point = point
        self._known: dict[int, int] = {}

    def __call__(self, expression: Expr) -> int:
        """The value of one of them.

        Raises
        ------
        NoPoint
            Where a denominator vanishes.
        """
        number = self._tree.number(expression)
        if number not in self._known:
            missing = self._tree.needed({number}, self._known)
            self._tree.fill(self._known, missing, self._point)
        return self._known[number]


def _sum(values: list[int], _: Sequence[int]) -> int:
    return sum(values)


def _product(values: list[int], _: Sequence[int]) -> int:
    return prod(values)


def _power(exponent: int, values: list[int], _: Sequence[int]) -> int:
    [base] = values
    if base == 0 and exponent < 0:
        raise NoPoint
    return pow(base, exponent, PRIME)


def _constant(value: int, *_: object) -> int:
    return value


def _leaf(element: CompiledElement, _: list[int], point: Sequence[int]) -> int:
    return element(point)


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
